//! The domain points of a patch, in order (spec section 6).

pub(crate) mod isoline;
pub(crate) mod quad;
pub(crate) mod triangle;

use crate::model::factors::ProcessedPatch;
use crate::model::fixed_point::ONE;
use crate::model::output::DomainPoint;
use crate::model::patch_factors::PatchFactors;
use crate::model::sink::Sink;
use crate::model::state::Domain;

/// Sends all points of a patch to `sink`.
pub(crate) fn emit(patch: &ProcessedPatch, sink: &mut impl Sink) {
    match patch {
        ProcessedPatch::Culled => {}
        ProcessedPatch::Minimum(factors) => {
            minimum_corners(factors.domain()).iter().for_each(|&corner| sink.point(corner));
        }
        ProcessedPatch::Regular(PatchFactors::Isoline(factors)) => isoline::emit(factors, sink),
        ProcessedPatch::Regular(PatchFactors::Triangle(factors)) => triangle::emit(factors, sink),
        ProcessedPatch::Regular(PatchFactors::Quad(factors)) => quad::emit(factors, sink),
    }
}

/// The corners of a minimum patch (spec section 3, step 8). Isolines have none.
pub(crate) const fn minimum_corners(domain: Domain) -> &'static [DomainPoint] {
    const TRIANGLE: [DomainPoint; 3] = [
        DomainPoint::from_bits(0, ONE),
        DomainPoint::from_bits(0, 0),
        DomainPoint::from_bits(ONE, 0),
    ];
    const QUAD: [DomainPoint; 4] = [
        DomainPoint::from_bits(0, 0),
        DomainPoint::from_bits(ONE, 0),
        DomainPoint::from_bits(ONE, ONE),
        DomainPoint::from_bits(0, ONE),
    ];
    match domain {
        Domain::Isoline => &[],
        Domain::Triangle => &TRIANGLE,
        Domain::Quad => &QUAD,
    }
}
