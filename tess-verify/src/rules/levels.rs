//! The number of segments that a standard derives from a level.

use super::standard::Specification;
use crate::case::Case;
use tess_core::{Domain, Partitioning};

/// The largest level. A Vulkan device may support larger ones, but is given no level above this.
const LARGEST: f32 = 64.0;

/// A level of a patch and the spacing that applies to it. The level is not NaN.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct TessellationLevel {
    pub(super) raw: f32,
    pub(super) spacing: Partitioning,
    pub(super) is_inner: bool,
    /// Its position among all levels of the patch, outer ones first.
    pub(super) position: usize,
}

impl TessellationLevel {
    /// Outer level `number`; `None` if it is NaN. The number of isolines always has equal
    /// spacing.
    pub(super) fn outer(case: &Case, number: usize) -> Option<Self> {
        let raw = case.factors.outer().nth(number).filter(|level| !level.is_nan())?;
        let is_density = case.domain() == Domain::Isoline && number == 0;
        let spacing = if is_density { Partitioning::Integer } else { case.config.partitioning };
        Some(Self { raw, spacing, is_inner: false, position: number })
    }

    /// Inner level `number`; `None` if it is NaN.
    pub(super) fn inner(case: &Case, number: usize) -> Option<Self> {
        let raw = case.factors.inside().nth(number).filter(|level| !level.is_nan())?;
        let position = case.domain().outer_factors() + number;
        Some(Self { raw, spacing: case.config.partitioning, is_inner: true, position })
    }

    /// The level clamped to the spacing's range.
    pub(super) fn clamped(self) -> f32 {
        match self.spacing {
            Partitioning::Integer | Partitioning::Pow2 => self.raw.clamp(1.0, LARGEST),
            Partitioning::FractionalEven => self.raw.clamp(2.0, LARGEST),
            Partitioning::FractionalOdd => self.raw.clamp(1.0, LARGEST.next_down().floor()),
        }
    }

    /// The clamped level, rounded up to an integer of the spacing's parity, if it has one. An
    /// inner level of 1 counts as the next higher number, because the patch has an inside.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a ceiling from 1 to 64, exact in binary32"
    )]
    pub(super) fn segments(self) -> u32 {
        let n = self.clamped().ceil() as u32;
        let n = if self.is_inner { n.max(2) } else { n };
        match self.spacing {
            Partitioning::Integer | Partitioning::Pow2 => n,
            Partitioning::FractionalEven => n.next_multiple_of(2),
            Partitioning::FractionalOdd => n | 1,
        }
    }

    /// Whether two of the segments may be shorter than the others.
    pub(super) fn is_fractional(self) -> bool {
        !self.spacing.has_integer_factors()
    }

    /// The clamped level in units of 2^-16, rounded down.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        clippy::float_arithmetic,
        reason = "a level from 1 to 64, scaled by a power of two"
    )]
    pub(super) fn fixed(self) -> u32 {
        (self.clamped() * 65536.0) as u32
    }
}

/// Whether all levels are 1 after clamping, so that the patch has no inside.
pub(super) fn is_minimum(case: &Case) -> bool {
    case.domain() != Domain::Isoline
        && case.config.partitioning != Partitioning::FractionalEven
        && case.factors.iter().all(|level| level <= 1.0 || level.is_nan())
}

/// Whether vertices inside may be on the outline: with fractional odd spacing, if an inner level is
/// not above 1, and so counts as just above 1 (Vulkan 22.6, 22.7). In Direct3D, levels up to 1 +
/// 8/65536 count too, because their locations round to the outline. Vulkan does not say what an
/// inner level is that is NaN, so it may be that.
pub(super) fn may_touch_outline(case: &Case, specification: Specification) -> bool {
    const ROUNDED: f32 = f32::from_bits(0x3F80_0400);
    let highest = if specification == Specification::D3d11 { ROUNDED } else { 1.0 };
    case.config.partitioning == Partitioning::FractionalOdd
        && !is_minimum(case)
        && case.factors.inside().any(|level| level <= highest || level.is_nan())
}

/// The number of vertices inside that the inner levels ask for; `None` if one of them is NaN.
pub(super) fn inside_asked(case: &Case) -> Option<usize> {
    let segments = |number| Some(TessellationLevel::inner(case, number)?.segments());
    match case.domain() {
        _ if is_minimum(case) => Some(0),
        Domain::Isoline => Some(0),
        Domain::Triangle => segments(0).map(vertices_inside),
        Domain::Quad => Some((segments(0)? - 1) as usize * (segments(1)? - 1) as usize),
    }
}

/// The number of vertices inside for `n` segments of the inner level.
pub(super) fn vertices_inside(n: u32) -> usize {
    (1..=n / 2).map(|ring| ring_vertices(n, ring)).sum()
}

/// The number of vertices on a ring; the centre is a ring with one.
pub(super) const fn ring_vertices(n: u32, ring: u32) -> usize {
    if 2 * ring == n { 1 } else { 3 * (n - 2 * ring) as usize }
}
