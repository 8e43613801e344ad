//! Every element of a patch, in sequence and by its number.
#![no_main]

libfuzzer_sys::fuzz_target!(|data: &[u8]| tess_fuzz::fail_if(tess_fuzz::random_access::check(
    data
)));
