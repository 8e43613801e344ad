//! The number of segments that a standard makes of a level.

use super::standard::Specification;
use crate::case::Case;
use tess_core::{Domain, Partitioning};

/// The largest level. A Vulkan device may have a larger one, and is then given no level above this.
const LARGEST: f32 = 64.0;

/// The number of segments that level `position` of a patch asks for; `None` for an inner level, and
/// for levels that are NaN.
pub(super) fn segments(case: &Case, position: usize) -> Option<u32> {
    let level = case.factors.outer().nth(position)?;
    let is_density = case.domain() == Domain::Isoline && position == 0;
    let spacing = if is_density { Partitioning::Integer } else { case.config.partitioning };
    (!level.is_nan()).then(|| rounded_up(spacing, level))
}

/// The level clamped to the spacing's range.
pub(super) fn clamped(spacing: Partitioning, level: f32) -> f32 {
    match spacing {
        Partitioning::Integer | Partitioning::Pow2 => level.clamp(1.0, LARGEST),
        Partitioning::FractionalEven => level.clamp(2.0, LARGEST),
        Partitioning::FractionalOdd => level.clamp(1.0, LARGEST.next_down().floor()),
    }
}

/// The clamped level rounded up to an integer, of the spacing's parity if it has one.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a ceiling from 1 to 64, exact in binary32"
)]
fn rounded_up(spacing: Partitioning, level: f32) -> u32 {
    let n = clamped(spacing, level).ceil() as u32;
    match spacing {
        Partitioning::Integer | Partitioning::Pow2 => n,
        Partitioning::FractionalEven => n.next_multiple_of(2),
        Partitioning::FractionalOdd => n | 1,
    }
}

/// Whether all levels are 1 after clamping: the patch then has no inside.
pub(super) fn is_minimum(case: &Case) -> bool {
    case.domain() != Domain::Isoline
        && case.config.partitioning != Partitioning::FractionalEven
        && case.factors.iter().all(|level| level <= 1.0 || level.is_nan())
}

/// Whether vertices of the inside may lie on the outline: under fractional odd spacing, if an inner level is
/// not above 1. In Direct3D the locations of levels up to 1 + 8/65536 round to the outline.
pub(super) fn may_touch_outline(case: &Case, specification: Specification) -> bool {
    const ROUNDED: f32 = f32::from_bits(0x3F80_0400);
    let highest = if specification == Specification::D3d11 { ROUNDED } else { 1.0 };
    case.config.partitioning == Partitioning::FractionalOdd
        && case.factors.inside().any(|level| level <= highest || level.is_nan())
}
