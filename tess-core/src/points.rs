//! The domain points of a patch, in order (spec section 6).

pub(crate) mod isoline;
pub(crate) mod quad;
pub(crate) mod triangle;

use crate::factors::{PatchFactors, ProcessedPatch};
use crate::fixed_point::{ONE, coordinate_to_f32};
use crate::sink::Sink;
use crate::state::Domain;
use fixed::types::U16F16;

/// A point of a patch's domain, each coordinate in 0..=1. On triangles w = 1 - u - v.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
#[repr(C)]
pub struct DomainPoint {
    /// First coordinate.
    pub u: U16F16,
    /// Second coordinate.
    pub v: U16F16,
}

impl DomainPoint {
    /// A point from the bits of its 16.16 coordinates.
    #[must_use]
    pub const fn from_bits(u: u32, v: u32) -> Self {
        Self { u: U16F16::from_bits(u), v: U16F16::from_bits(v) }
    }

    /// The coordinates as binary32, exactly.
    #[must_use]
    pub const fn to_f32(self) -> [f32; 2] {
        [coordinate_to_f32(self.u), coordinate_to_f32(self.v)]
    }
}

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
