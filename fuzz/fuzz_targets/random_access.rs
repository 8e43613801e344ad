//! Every element of a patch, in sequence and by its number. With `TESS_FUZZ_SEEDS` set, writes the
//! seeds of every target instead: a program for that alone would compile everything once more.
#![no_main]

libfuzzer_sys::fuzz_target!(
    init: tess_fuzz::seeds::write_if_asked(),
    |data: &[u8]| tess_fuzz::fail_if(tess_fuzz::random_access::check(data))
);
