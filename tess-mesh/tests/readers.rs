//! The readers against independent ones, over small valid files of every form and over files with
//! one change: changed, missing and repeated bytes, and every value of a document replaced or
//! removed.

#![expect(
    clippy::float_arithmetic,
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    clippy::cast_precision_loss,
    reason = "the independent readers are as short as possible"
)]

#[path = "naive/mutations.rs"]
mod mutations;
#[path = "naive/mod.rs"]
mod naive;

use std::cell::Cell;

thread_local! {
    static PLANTED: Cell<bool> = const { Cell::new(false) };
}

/// Whether the comparison must find a fault that it plants itself.
fn fault_is_planted() -> bool {
    PLANTED.get()
}

type Oracle = fn(&[u8]) -> Result<(), String>;

fn compare(target: &str, seeds: &[Vec<u8>], oracle: Oracle, is_read: fn(&[u8]) -> bool) {
    for seed in seeds {
        let shown = String::from_utf8_lossy(seed);
        assert_eq!(oracle(seed), Ok(()), "{shown}");
        assert!(is_read(seed), "a valid file: {shown}");
        PLANTED.set(true);
        assert!(oracle(seed).is_err(), "a planted fault is seen: {shown}");
        PLANTED.set(false);
    }
    let (mut count, mut read) = (0, 0);
    for variant in seeds.iter().flat_map(|seed| mutations::of(target, seed)) {
        let shown = || String::from_utf8_lossy(&variant).into_owned();
        assert_eq!(oracle(&variant), Ok(()), "a variant:\n{}", shown());
        count += 1;
        read += usize::from(is_read(&variant));
    }
    let balanced = read > count / 50 && read < count - count / 50;
    assert!(count > 1000 && balanced, "{target}: {count} variants, {read} of them are read");
}

#[test]
fn obj_files() {
    let is_read = |bytes: &[u8]| tess_mesh::raw::obj(bytes).is_ok();
    compare("obj", &naive::seeds::obj(), naive::obj::check, is_read);
}

#[test]
fn gltf_files() {
    let is_read = |bytes: &[u8]| {
        let options = tess_mesh::LoadOptions { max_memory: 1 << 22, ..Default::default() };
        tess_mesh::raw::gltf(bytes, &options).is_ok()
    };
    let has_texcoords = |bytes: &&Vec<u8>| {
        let read = tess_mesh::raw::gltf(bytes, &tess_mesh::LoadOptions::default());
        read.is_ok_and(|mesh| !mesh.texcoords.is_empty())
    };
    let seeds = naive::seeds::gltf();
    assert_eq!(seeds.iter().filter(has_texcoords).count(), 4, "files with texture coordinates");
    compare("gltf", &seeds, naive::gltf::check, is_read);
}

#[test]
fn bpt_files() {
    let is_read = |bytes: &[u8]| tess_mesh::raw::bpt(bytes).is_ok();
    compare("bpt", &naive::seeds::bpt(), naive::bpt::check, is_read);
}
