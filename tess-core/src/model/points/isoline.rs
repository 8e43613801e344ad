//! Isoline points: line by line, from v = 0 (spec section 6).

use crate::model::factors::ProcessedFactor;
use crate::model::output::DomainPoint;
use crate::model::patch_factors::IsolineFactors;
use crate::model::place::place;
use crate::model::sink::Sink;

pub(crate) fn emit(factors: &IsolineFactors<ProcessedFactor>, sink: &mut impl Sink) {
    for line in 0..line_count(factors) {
        for p in 0..factors.detail.context.points {
            sink.point(point(factors, line, p));
        }
    }
}

/// The number of lines. The line at v = 1 is not drawn.
pub(crate) const fn line_count(factors: &IsolineFactors<ProcessedFactor>) -> u32 {
    factors.density.context.points - 1
}

/// Point `p` of a line.
pub(crate) const fn point(
    factors: &IsolineFactors<ProcessedFactor>,
    line: u32,
    p: u32,
) -> DomainPoint {
    DomainPoint { u: place(&factors.detail.context, p), v: place(&factors.density.context, line) }
}
