//! The reader of height images.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| tess_fuzz::fail_if(tess_fuzz::mesh::height_png::check(
    data
)));
