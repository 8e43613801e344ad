//! A whole probe: cases in, a report out.

use crate::capture::Prober;
use crate::error::Error;
use crate::judge::Judge;
use crate::report::ProbeReport;
use std::sync::Arc;
use tess_verify::Case;
use tess_verify::check::{Known, Strength};

/// Asks a device every case and compares what it gives. `progress` is called with the number of
/// cases that were compared since its last call.
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

/// [`probe`], where a case that differs does not count as different if that is `known`. The first
/// different case is asked again by itself.
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
