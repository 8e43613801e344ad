//! Seeds: factors at boundaries, in the form that each target reads.

use crate::input::{batch_bytes, repeated_bytes};
use crate::mesh;
use std::io;
use std::path::Path;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors, SplitOrder};
use tess_verify::generate::{SplitMix64, boundary_factors};

/// Every target.
pub const TARGETS: [&str; 11] = [
    "random_access",
    "simd",
    "prepare",
    "vectors",
    "capi",
    "obj",
    "gltf",
    "bpt",
    "height_png",
    "device",
    "gpu",
];

/// With `TESS_FUZZ_SEEDS` set, writes the seeds of every target to `fuzz/corpus`, and ends the
/// program: with status 1 if they cannot be written.
pub fn write_if_asked() {
    if std::env::var_os("TESS_FUZZ_SEEDS").is_none() {
        return;
    }
    let fuzz = Path::new(env!("CARGO_MANIFEST_DIR"));
    match write(&fuzz.join("corpus"), &fuzz.join("../golden")) {
        Ok(count) => println!("{count} seeds in fuzz/corpus"),
        Err(error) => {
            eprintln!("fuzz/corpus: {error}");
            std::process::exit(1);
        }
    }
    std::process::exit(0);
}

/// Writes the seeds of every target to `corpus/TARGET/`; `golden` is the folder of recorded
/// results. Errors: those of the file system.
pub fn write(corpus: &Path, golden: &Path) -> io::Result<usize> {
    let mut count = 0;
    for target in TARGETS {
        let folder = corpus.join(target);
        std::fs::create_dir_all(&folder)?;
        for (name, bytes) in of(target, golden)? {
            std::fs::write(folder.join(format!("seed-{name}")), bytes)?;
            count += 1;
        }
    }
    Ok(count)
}

/// The seeds of one target, each with a name. Errors: those of the file system, for the recorded
/// results.
pub fn of(target: &str, golden: &Path) -> io::Result<Vec<(String, Vec<u8>)>> {
    match target {
        "vectors" => return recorded(golden),
        "obj" => return Ok(numbered(mesh::seeds::obj())),
        "gltf" => return Ok(numbered(mesh::seeds::gltf())),
        "bpt" => return Ok(numbered(mesh::seeds::bpt())),
        "device" => return Ok(numbered(device_seeds())),
        "height_png" => return Ok(numbered(mesh::seeds::height_png())),
        _ => {}
    }
    let seed = |(i, (domain, config, patches)): (usize, &(Domain, Config, Vec<PatchFactors>))| {
        let batch = batch_bytes(*domain, *config, patches);
        let (setting, factors) = batch.split_at(1);
        let bytes = match target {
            "prepare" => [setting, &[low_byte(i % 3), low_byte(i / 3 % 2)], factors].concat(),
            "capi" => {
                let operation = low_byte(i % 4);
                let choices = if operation == 3 { &[9; 12][..] } else { &[] };
                [&[operation], choices, &batch].concat()
            }
            _ => batch,
        };
        (i.to_string(), bytes)
    };
    // For `simd`, every fifth batch is longer than a chunk of 64 patches.
    let long = |(i, (name, bytes)): (usize, (String, Vec<u8>))| {
        let is_long = target == "simd" && i % 5 == 0;
        let bytes = if is_long {
            repeated_bytes(&bytes, 130 + low_byte(i % 64), 1 << (i % 20))
        } else {
            bytes
        };
        (name, bytes)
    };
    // A batch is slow, and the other targets read only one patch.
    let size = if matches!(target, "simd" | "gpu") { 12 } else { 1 };
    // Calls that make a batch take milliseconds under a sanitizer.
    let step = if target == "capi" { 5 } else { 1 };
    let seeds = batches(size);
    let seeds = seeds.iter().enumerate().step_by(step).map(seed).enumerate().map(long);
    Ok(seeds.chain(if target == "capi" { culled_calls() } else { Vec::new() }).collect())
}

/// Calls of `tess_patch` with a culled patch, whose pointer to points is null (254) or misaligned
/// (255), with a capacity of `SIZE_MAX` (1), two points (8) or none (0). The bytes are a setting
/// and factors, zeros for a valid configuration and number of factors, then the capacities and the
/// pointers.
fn culled_calls() -> Vec<(String, Vec<u8>)> {
    let call = |capacity: u8, pointer: u8| {
        let bytes = [&[0; 15], &[capacity, 0, 0, 0, 0, pointer, 0][..]].concat();
        (format!("culled-{capacity}-{pointer}"), bytes)
    };
    [1, 8, 0].into_iter().flat_map(|capacity| [254, 255].map(|to| call(capacity, to))).collect()
}

fn numbered(seeds: Vec<Vec<u8>>) -> Vec<(String, Vec<u8>)> {
    seeds.into_iter().enumerate().map(|(number, seed)| (number.to_string(), seed)).collect()
}

/// Bytes without a meaning of their own, each a case.
fn device_seeds() -> Vec<Vec<u8>> {
    let mut random = SplitMix64::new(1);
    let mut word = || random.next_u64().to_le_bytes();
    (0..64).map(|_| [(); 8].map(|()| word()).concat()).collect()
}

fn low_byte(number: usize) -> u8 {
    number.to_le_bytes()[0]
}

/// A file unlike every recorded one: it has coordinates and no count.
const CAPTURE: &str = "\
# tess-vectors 1 kind=listings source=capture
case tri integer triangle_cw ruler 3f800000 3f800000 3f800000 3f800000
coordinates float
0 1 0
0 0 0x3f800000
1 0
end
case isoline integer line ruler 3f800000 3f800000
coordinates decimal 2
65536 0
0 0
end
# end
";

/// The first records of every vector file, and a capture.
fn recorded(golden: &Path) -> io::Result<Vec<(String, Vec<u8>)>> {
    let mut seeds = vec![("capture".to_owned(), CAPTURE.as_bytes().to_vec())];
    for file in std::fs::read_dir(golden)? {
        let file = file?;
        // Folders also contain other files than vector files.
        if file.file_type()?.is_dir() {
            continue;
        }
        if let Some(seed) = first_records(&std::fs::read_to_string(file.path())?) {
            seeds.push((file.file_name().to_string_lossy().into_owned(), seed.into_bytes()));
        }
    }
    Ok(seeds)
}

/// The head of a vector file, with the number of its records corrected.
fn first_records(text: &str) -> Option<String> {
    let (header, rest) = text.split_once('\n')?;
    let (before, count) = header.split_once(" count=")?;
    let after = count.split_once(' ')?.1;
    let (records, body) = if header.contains("kind=listings") {
        let listings: Vec<&str> = rest.split_inclusive("\nend\n").collect();
        let small: Vec<&str> = listings.into_iter().filter(|l| l.len() < 1500).take(4).collect();
        (small.len(), small.concat())
    } else {
        let rows: Vec<&str> = rest.split_inclusive('\n').take(6).collect();
        (rows.len() - 1, rows.concat())
    };
    Some(format!("{before} count={records} {after}\n{body}"))
}

/// Every boundary factor, on an edge, inside or everywhere in a patch, with `size` patches per
/// batch.
fn batches(size: usize) -> Vec<(Domain, Config, Vec<PatchFactors>)> {
    let factors = boundary_factors();
    let batch = |(i, factors): (usize, &[f32])| {
        let domain = Domain::ALL[i % 3];
        let config = Config {
            partitioning: Partitioning::ALL[i / 3 % 4],
            output: OutputPrimitive::ALL[i / 5 % 4],
            split: SplitOrder::ALL[i / 7 % 2],
        };
        let patch = |(k, &factor): (usize, &f32)| patch(domain, i / 12 + k, factor);
        (domain, config, factors.iter().enumerate().map(patch).collect())
    };
    factors.chunks(size).enumerate().map(batch).collect()
}

/// An ordinary patch with a factor in its first position, its last or all of them.
fn patch(domain: Domain, place: usize, factor: f32) -> PatchFactors {
    let mut list = [3.0, 4.5, 1.0, 7.25, 2.0, 5.0][..domain.factors()].to_vec();
    match (place % 3, list.as_mut_slice()) {
        (0, [first, ..]) => *first = factor,
        (1, [.., last]) => *last = factor,
        (_, all) => all.fill(factor),
    }
    PatchFactors::from_slice(domain, &list).expect("as many factors as the domain has")
}
