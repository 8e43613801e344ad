//! Factor processing: from raw binary32 factors to contexts (spec section 3).

use crate::d3d_float::{ceil, clamp, is_culled, is_greater};
use crate::factor_context::FactorContext;
use crate::fixed_point::FixedFactor;
use crate::patch_factors::{IsolineFactors, PatchFactors};
use crate::state::{Config, Parity, Partitioning};

/// One factor after each step of spec section 3.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ProcessedFactor {
    /// Bits of the binary32 factor after clamping (steps 2 and 5).
    pub clamped: u32,
    /// Bits of the binary32 factor after rounding (steps 3 and 5).
    pub rounded: u32,
    /// The factor as a 15.16 number (step 7).
    pub fixed: FixedFactor,
    /// The six numbers derived from it and its parity (step 6, spec section 4).
    pub context: FactorContext,
}

/// What factor processing makes of a patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProcessedPatch {
    /// An outer factor is zero, negative or NaN: no points, no indices.
    Culled,
    /// A triangle or quad whose factors all equal one: a single triangle or two.
    Minimum(PatchFactors<ProcessedFactor>),
    /// Every other patch.
    Regular(PatchFactors<ProcessedFactor>),
}

/// Which bounds and which parity rule apply to a factor.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    Edge,
    Inside,
}

impl ProcessedPatch {
    /// The processed factors; `None` if the patch is culled.
    #[must_use]
    pub const fn factors(&self) -> Option<&PatchFactors<ProcessedFactor>> {
        match self {
            Self::Culled => None,
            Self::Minimum(factors) | Self::Regular(factors) => Some(factors),
        }
    }
}

/// Processes the raw factors of one patch. Total: every bit pattern is valid.
///
/// Spec section 3, whose steps the functions below are named after.
#[must_use]
pub fn process(config: Config, raw: PatchFactors) -> ProcessedPatch {
    if is_culled(raw.outer()) {
        return ProcessedPatch::Culled;
    }
    if let PatchFactors::Isoline(raw) = raw {
        return process_isoline(config, raw);
    }
    let low = inside_low(config.partitioning, raw.iter());
    let edges = raw.domain().outer_factors();
    let mut number = 0;
    let mut is_minimum = true; // step 8
    let factors = raw.map(|factor| {
        number += 1;
        let processed = if number <= edges {
            process_edge(config, factor)
        } else {
            process_inside(config, factor, low)
        };
        is_minimum &= processed.fixed == FixedFactor::ONE;
        processed
    });
    if is_minimum { ProcessedPatch::Minimum(factors) } else { ProcessedPatch::Regular(factors) }
}

/// The density is always processed as integer.
fn process_isoline(config: Config, raw: IsolineFactors) -> ProcessedPatch {
    let integer = Config { partitioning: Partitioning::Integer, ..config };
    ProcessedPatch::Regular(PatchFactors::Isoline(IsolineFactors {
        density: process_edge(integer, raw.density),
        detail: process_edge(config, raw.detail),
    }))
}

/// Steps 2, 3, 6 and 7 for an outer or isoline factor.
fn process_edge(config: Config, raw: f32) -> ProcessedFactor {
    process_factor(config, Role::Edge, clamp(raw, config.partitioning.range()))
}

/// Steps 5, 6 and 7 for an inside factor, with the lower bound of step 4.
fn process_inside(config: Config, raw: f32, low: f32) -> ProcessedFactor {
    let (_, high) = config.partitioning.range();
    process_factor(config, Role::Inside, clamp(raw, (low, high)))
}

fn process_factor(config: Config, role: Role, clamped: f32) -> ProcessedFactor {
    let rounded = if config.partitioning.has_integer_factors() { ceil(clamped) } else { clamped };
    let fixed = FixedFactor::from_f32(rounded);
    let parity = parity(config.partitioning, role, fixed);
    ProcessedFactor {
        clamped: clamped.to_bits(),
        rounded: rounded.to_bits(),
        fixed,
        context: FactorContext::new(fixed, parity, config.split),
    }
}

/// Step 4: the lower bound of the inside factors. A NaN is not greater than anything.
fn inside_low(partitioning: Partitioning, mut all: impl Iterator<Item = f32>) -> f32 {
    const ONE_PLUS_2_POW_MINUS_17: f32 = f32::from_bits(0x3F80_0040);
    const ONE_PLUS_2_POW_MINUS_16: f32 = f32::from_bits(0x3F80_0080);
    let needs_picture_frame = partitioning == Partitioning::FractionalOdd
        && all.any(|factor| is_greater(factor, ONE_PLUS_2_POW_MINUS_17));
    if needs_picture_frame { ONE_PLUS_2_POW_MINUS_16 } else { partitioning.range().0 }
}

/// Step 6. Integer factors have a zero fraction here.
fn parity(partitioning: Partitioning, role: Role, fixed: FixedFactor) -> Parity {
    match partitioning {
        Partitioning::FractionalOdd => Parity::Odd,
        Partitioning::FractionalEven => Parity::Even,
        Partitioning::Integer | Partitioning::Pow2 => {
            let odd = (fixed.to_bits() >> 16) & 1 == 1;
            let inside_one = role == Role::Inside && fixed == FixedFactor::ONE;
            if odd && !inside_one { Parity::Odd } else { Parity::Even }
        }
    }
}
