//! The WGSL backend against the core.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| tess_fuzz::fail_if(tess_fuzz::gpu::check(data)));
