//! Patches with every number of segments.
#![expect(clippy::float_arithmetic, reason = "exact: eighths")]

use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_verify::Case;

/// For each domain, patches whose levels are all equal: each number of segments, and a level a
/// little below it. Isolines are one line. Patches in a row differ in the output alone, or in the
/// spacing.
pub(crate) fn every_number() -> Vec<Case> {
    let spacings =
        [Partitioning::Integer, Partitioning::FractionalOdd, Partitioning::FractionalEven];
    let levels = (1..=64u16).flat_map(|n| [f32::from(n) - 0.375, f32::from(n)]);
    let mut cases = Vec::new();
    for (domain, level) in Domain::ALL.into_iter().flat_map(|d| levels.clone().map(move |l| (d, l)))
    {
        let factors = PatchFactors::from_fn(domain, |position| {
            if domain == Domain::Isoline && position == 0 { 1.0 } else { level }
        });
        let outputs = match domain {
            Domain::Isoline => [OutputPrimitive::Line, OutputPrimitive::Point],
            _ => [OutputPrimitive::TriangleCw, OutputPrimitive::TriangleCcw],
        };
        for output in outputs {
            cases.extend(
                spacings.map(|spacing| Case { config: Config::new(spacing, output), factors }),
            );
        }
        let first = Config::new(spacings[0], outputs[0]);
        cases.push(Case { config: Config { output: outputs[1], ..first }, factors });
        cases.push(Case { config: first, factors });
    }
    cases
}
