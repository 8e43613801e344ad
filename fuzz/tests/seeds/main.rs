//! Every seed passes its oracle, and each oracle fails when a fault is planted.
//!
//! There is one test, because the planted fault affects the whole process.

#[path = "../../../tess-mesh/tests/naive/mutations.rs"]
mod mutations;

use std::io::Cursor;
use std::path::Path;
use tess_fuzz::mesh;
use tess_fuzz::mesh::seeds::chunk;
use tess_fuzz::{capi, device, plant_fault, prepare, random_access, seeds, simd, vectors};
use tess_mesh::{LoadError, LoadOptions, height, raw};

type Oracle = fn(&[u8]) -> Result<(), String>;

const ORACLES: &[(&str, Oracle)] = &[
    ("random_access", random_access::check),
    ("simd", simd::check),
    ("prepare", prepare::check),
    ("vectors", vectors::check),
    ("capi", capi::check),
    ("obj", mesh::obj),
    ("gltf", mesh::gltf),
    ("bpt", mesh::bpt),
    ("height_png", mesh::height_png::check),
    ("device", device::check),
    #[cfg(feature = "gpu")]
    ("gpu", tess_fuzz::gpu::check),
];

/// The most bytes that a reader of mesh files and its oracle may allocate.
const MOST_BYTES: u64 = 64 << 20;

/// Whether the reader accepts a file.
fn is_read(target: &str, bytes: &[u8]) -> Result<(), LoadError> {
    let options = LoadOptions { max_memory: 1 << 22, ..LoadOptions::default() };
    match target {
        "obj" => raw::obj(bytes).map(drop),
        "gltf" => raw::gltf(bytes, &options).map(drop),
        "bpt" => raw::bpt(bytes).map(drop),
        _ => height::decode(Cursor::new(bytes), 1 << 10).map(drop),
    }
}

/// The readers accept the seeds. They refuse files with faults or read them as the independent
/// reader does, and use little memory.
fn files_with_faults_pass(target: &str, oracle: Oracle) {
    let (mut count, mut read) = (0, 0);
    for (name, bytes) in seeds::of(target, Path::new("")).expect("seeds") {
        assert_eq!(is_read(target, &bytes), Ok(()), "seed {name} of {target} is right");
        for variant in mutations::of(target, &bytes) {
            let variant = if target == "height_png" { with_checksums(&variant) } else { variant };
            let mut result = Ok(());
            let memory = allocation_counter::measure(|| result = oracle(&variant));
            let shown = String::from_utf8_lossy(&variant);
            assert_eq!(result, Ok(()), "a variant of seed {name} of {target}:\n{shown}");
            assert!(memory.bytes_max < MOST_BYTES, "{name} of {target}: {memory:?}\n{shown}");
            count += 1;
            read += usize::from(is_read(target, &variant).is_ok());
        }
    }
    let balanced = read > count / 50 && read < count - count / 50;
    assert!(count > 1000 && balanced, "{target}: {count} variants, {read} of them are read");
    println!("{target}: {count} variants of the seeds, {read} of them are read");
}

/// The file with right checksums, as far as it consists of chunks.
fn with_checksums(file: &[u8]) -> Vec<u8> {
    let Some((signature, mut rest)) = file.split_at_checked(8) else { return file.to_vec() };
    let mut right = signature.to_vec();
    while let Some(length) = rest.first_chunk().map(|&word| u32::from_be_bytes(word) as usize) {
        let (Some(kind), Some(content)) = (rest.get(4..8), rest.get(8..8 + length)) else { break };
        chunk(&mut right, kind, content);
        rest = rest.get(12 + length..).unwrap_or_default();
    }
    right.extend(rest);
    right
}

#[test]
fn seeds_pass_until_a_fault_is_planted() {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("../golden");
    for &(target, oracle) in ORACLES {
        let seeds = seeds::of(target, &golden).expect("seeds");
        assert!(seeds.len() >= 8, "{target} has only {} seeds", seeds.len());
        for (name, bytes) in seeds {
            assert_eq!(oracle(&bytes), Ok(()), "seed {name} of {target}");
        }
    }
    for &(target, oracle) in &ORACLES[5..9] {
        files_with_faults_pass(target, oracle);
    }
    plant_fault();
    for &(target, oracle) in ORACLES {
        let seeds = seeds::of(target, &golden).expect("seeds");
        let failures: Vec<_> = seeds.iter().filter_map(|(_, bytes)| oracle(bytes).err()).collect();
        assert!(failures.len() >= seeds.len() / 3, "{target}: {} failures", failures.len());
        println!(
            "{target}: {} of {} seeds fail, such as: {}",
            failures.len(),
            seeds.len(),
            failures[0]
        );
    }
}
