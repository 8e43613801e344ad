//! A whole probe: from cases to a report.

use crate::capture::Prober;
use crate::error::Error;
use crate::judge::Judge;
use crate::report::ProbeReport;
use std::sync::Arc;
use tess_verify::Case;
use tess_verify::check::{Known, Strength};

/// Asks a device every case, and compares its output with the model's. `progress` gets the number
/// of cases compared since its last call.
///
/// # Errors
/// The device fails.
pub fn probe(
    prober: &mut Prober,
    cases: &[Case],
    strength: Strength,
    progress: impl FnMut(u64),
) -> Result<ProbeReport, Error> {
    probe_known(prober, cases, strength, &Arc::default(), progress)
}

/// Does what [`probe`] does, except that a case does not count as different if its difference is
/// `known`. The first different case is repeated by itself.
///
/// # Errors
/// The device fails.
pub fn probe_known(
    prober: &mut Prober,
    cases: &[Case],
    strength: Strength,
    known: &Arc<Known>,
    progress: impl FnMut(u64),
) -> Result<ProbeReport, Error> {
    let report = ask(prober, cases, strength, known, progress)?;
    let Some(first) = &report.first_different else { return Ok(report) };
    let alone = ask(prober, &[first.case], strength, &Arc::default(), |_| ())?;
    Ok(report.with_alone(&alone))
}

fn ask(
    prober: &mut Prober,
    cases: &[Case],
    strength: Strength,
    known: &Arc<Known>,
    mut progress: impl FnMut(u64),
) -> Result<ProbeReport, Error> {
    let mut judge = Judge::new(prober.info(), prober.method(), strength).with_known(known);
    prober.each(cases, &mut progress, |case, captured| {
        judge.add(case, captured);
        Ok(())
    })?;
    Ok(judge.finish())
}
