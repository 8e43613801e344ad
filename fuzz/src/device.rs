//! The example of a user's own tessellator (`tess-verify/examples/fuzz`) against the model.

#[path = "../../tess-verify/examples/fuzz/device.rs"]
mod example;

use crate::fault_is_planted;
use arbitrary::{Arbitrary, Unstructured};
use tess_verify::Case;

/// Compares a case. Errors: the first difference.
pub fn check_case(case: &Case) -> Result<(), String> {
    example::check(&mut example::Device { truncates: fault_is_planted() }, case)
}

/// Compares the case of these bytes. Errors: the first difference.
pub fn check(data: &[u8]) -> Result<(), String> {
    Case::arbitrary(&mut Unstructured::new(data)).map_or(Ok(()), |case| check_case(&case))
}
