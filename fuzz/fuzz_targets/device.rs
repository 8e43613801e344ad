//! A user's own tessellator against the model, by cases instead of bytes.
#![no_main]

use tess_verify::Case;

libfuzzer_sys::fuzz_target!(|case: Case| tess_fuzz::fail_if(tess_fuzz::device::check_case(&case)));
