//! The C interface with hostile arguments.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| tess_fuzz::fail_if(tess_fuzz::capi::check(data)));
