//! The kernels, compiled once for each CPU level and chosen at run time.

use crate::batch::Batch;
use crate::format::{IndexFormat, PointFormat};
use crate::level::Level;
use crate::part::{self, Part, PartCounts};
use crate::stitch::Stitches;
use multiversion::multiversion;
use tess_core::Config;

/// [`part::count`] at a level.
pub(crate) fn count(level: Level, config: Config, batch: &Batch<'_>) -> PartCounts {
    match level {
        Level::Baseline => part::count(config, batch),
        Level::Avx2 => count_avx2(config, batch),
        Level::Avx512 => count_avx512(config, batch),
    }
}

/// [`part::emit`] at a level.
pub(crate) fn emit<P: PointFormat, I: IndexFormat>(
    level: Level,
    config: Config,
    stitches: &Stitches,
    part: Part<'_, P, I>,
) {
    match level {
        Level::Baseline => part::emit(config, stitches, part),
        Level::Avx2 => emit_avx2(config, stitches, part),
        Level::Avx512 => emit_avx512(config, stitches, part),
    }
}

#[multiversion(targets("x86_64+avx2+bmi1+bmi2+lzcnt+popcnt"))]
fn count_avx2(config: Config, batch: &Batch<'_>) -> PartCounts {
    part::count(config, batch)
}

#[multiversion(targets(
    "x86_64+avx2+bmi1+bmi2+lzcnt+popcnt+avx512f+avx512bw+avx512cd+avx512dq+avx512vl"
))]
fn count_avx512(config: Config, batch: &Batch<'_>) -> PartCounts {
    part::count(config, batch)
}

#[multiversion(targets("x86_64+avx2+bmi1+bmi2+lzcnt+popcnt"))]
fn emit_avx2<P: PointFormat, I: IndexFormat>(
    config: Config,
    stitches: &Stitches,
    part: Part<'_, P, I>,
) {
    part::emit(config, stitches, part);
}

#[multiversion(targets(
    "x86_64+avx2+bmi1+bmi2+lzcnt+popcnt+avx512f+avx512bw+avx512cd+avx512dq+avx512vl"
))]
fn emit_avx512<P: PointFormat, I: IndexFormat>(
    config: Config,
    stitches: &Stitches,
    part: Part<'_, P, I>,
) {
    part::emit(config, stitches, part);
}
