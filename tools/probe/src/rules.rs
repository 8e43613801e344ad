//! Judges a device by the demands of a standard.

use crate::capture::{Method, Prober};
use crate::cases::rule_cases;
use crate::error::Error;
use tess_verify::generate::Selection;
use tess_verify::rules::{Checker, RulesReport, Specification};

/// Asks a device the selected cases in Vulkan's split order, including repeated ones, and judges
/// its output by the rules of a standard. `progress` gets the number of cases judged since its last
/// call.
///
/// # Errors
/// The device fails, captures only points, or returns a coordinate that is not a multiple of 2^-16
/// from 0 to 1, which cannot be judged.
pub fn rules(
    prober: &mut Prober,
    selection: Selection,
    specification: Specification,
    mut progress: impl FnMut(u64),
) -> Result<RulesReport, Error> {
    if prober.method() == Method::Points {
        return Err(Error::Missing("transform feedback, without which rules cannot be judged"));
    }
    let cases = rule_cases(selection);
    let mut checker = Checker::new(specification);
    prober.each(&cases, &mut progress, |case, captured| {
        let output = captured.output().ok_or_else(|| {
            Error::Capture(format!("{case}: a coordinate is not a multiple of 2^-16"))
        })?;
        checker.add(case, &output);
        Ok(())
    })?;
    Ok(checker.report())
}
