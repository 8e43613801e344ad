//! A device judged by what a standard demands.

use crate::capture::{Method, Prober};
use crate::cases::asked_for;
use crate::error::Error;
use tess_core::SplitOrder;
use tess_verify::Case;
use tess_verify::generate::Selection;
use tess_verify::rules::{Checker, RulesReport, Specification};

/// Asks a device the selected cases of the standard split order, repeated ones too, and judges what
/// it gives by the rules of a standard. `progress` is called with the number of cases that were
/// judged since its last call.
///
/// # Errors
/// The device fails, gives points alone, or a coordinate that is no multiple of 2^-16 from 0 to 1:
/// such coordinates cannot be judged.
pub fn rules(
    prober: &mut Prober,
    selection: Selection,
    specification: Specification,
    mut progress: impl FnMut(u64),
) -> Result<RulesReport, Error> {
    if prober.method() == Method::Points {
        return Err(Error::Missing("transform feedback, without which rules cannot be judged"));
    }
    let selection = Selection { split: Some(SplitOrder::Ruler), ..selection };
    let cases: Vec<Case> = selection.cases().map(|case| asked_for(&case)).collect();
    let mut checker = Checker::new(specification);
    prober.each(&cases, &mut progress, |case, captured| {
        let output = captured.output().ok_or_else(|| {
            Error::Capture(format!("{case}: a coordinate is no multiple of 2^-16"))
        })?;
        checker.add(case, &output);
        Ok(())
    })?;
    Ok(checker.report())
}
