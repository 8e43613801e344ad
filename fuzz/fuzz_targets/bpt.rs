//! The reader of Bezier patch files.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| tess_fuzz::fail_if(tess_fuzz::mesh::bpt(data)));
