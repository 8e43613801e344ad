//! The segments of isolines (spec section 8).

use crate::factors::ProcessedFactor;
use crate::output::Primitive;
use crate::patch_factors::IsolineFactors;
use crate::points::isoline::line_count;
use crate::sink::Sink;

pub(crate) fn emit(factors: &IsolineFactors<ProcessedFactor>, sink: &mut impl Sink) {
    let points = factors.detail.context.points;
    for line in 0..line_count(factors) {
        let first = line * points;
        for p in first + 1..first + points {
            sink.primitive(Primitive::Line([p - 1, p]));
        }
    }
}
