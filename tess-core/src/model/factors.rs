//! Factor processing: from raw binary32 factors to contexts (spec section 3).

use crate::model::d3d_float::{ceil, clamp, is_culled, is_greater};
use crate::model::factor_context::FactorContext;
use crate::model::fixed_point::FixedFactor;
use crate::model::patch_factors::{IsolineFactors, PatchFactors, QuadFactors, TriangleFactors};
use crate::model::state::{Config, Parity, Partitioning};

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

/// A patch after factor processing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ProcessedPatch {
    /// An outer factor is zero, negative or NaN: no points, no indices.
    Culled,
    /// A triangle or quad whose factors all equal one: a single triangle or two.
    Minimum(PatchFactors<ProcessedFactor>),
    /// Every other patch.
    Regular(PatchFactors<ProcessedFactor>),
}

/// The role of a factor, which determines its bounds and its parity rule.
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

impl TriangleFactors<ProcessedFactor> {
    /// The contexts of the outer factors in edge order: u = 0, v = 0, w = 0.
    pub(crate) const fn outer_contexts(&self) -> [&FactorContext; 3] {
        [&self.u0.context, &self.v0.context, &self.w0.context]
    }
}

impl QuadFactors<ProcessedFactor> {
    /// The contexts of the outer factors in edge order: u = 0, v = 0, u = 1, v = 1.
    pub(crate) const fn outer_contexts(&self) -> [&FactorContext; 4] {
        [&self.u0.context, &self.v0.context, &self.u1.context, &self.v1.context]
    }
}

/// Processes the raw factors of one patch. Total: every bit pattern is valid.
///
/// The functions below name the steps of spec section 3.
#[must_use]
pub fn process(config: Config, raw: PatchFactors) -> ProcessedPatch {
    if is_culled(raw.outer()) {
        return ProcessedPatch::Culled;
    }
    let (low, _) = config.partitioning.range();
    let inside_low = inside_low(config.partitioning, raw.iter());
    match raw {
        PatchFactors::Isoline(raw) => process_isoline(config, raw),
        PatchFactors::Triangle(raw) => {
            let outer = process_each(config, Role::Edge, low, raw.outer());
            let inside = process_each(config, Role::Inside, inside_low, [raw.inside]);
            let ([u0, v0, w0], [inside_uvw]) = (outer, inside);
            let factors = TriangleFactors { u0, v0, w0, inside: inside_uvw };
            minimum_or_regular(are_one(&outer) && are_one(&inside), factors.into())
        }
        PatchFactors::Quad(raw) => {
            let outer = process_each(config, Role::Edge, low, raw.outer());
            let inside = process_each(config, Role::Inside, inside_low, raw.inside());
            let ([u0, v0, u1, v1], [inside_u, inside_v]) = (outer, inside);
            let factors = QuadFactors { u0, v0, u1, v1, inside_u, inside_v };
            minimum_or_regular(are_one(&outer) && are_one(&inside), factors.into())
        }
    }
}

/// Step 8.
fn minimum_or_regular(all_one: bool, factors: PatchFactors<ProcessedFactor>) -> ProcessedPatch {
    if all_one { ProcessedPatch::Minimum(factors) } else { ProcessedPatch::Regular(factors) }
}

fn are_one(factors: &[ProcessedFactor]) -> bool {
    factors.iter().all(|factor| factor.fixed == FixedFactor::ONE)
}

/// The density is always processed as integer.
fn process_isoline(config: Config, raw: IsolineFactors) -> ProcessedPatch {
    let integer = Config { partitioning: Partitioning::Integer, ..config };
    ProcessedPatch::Regular(PatchFactors::Isoline(IsolineFactors {
        density: process_factor(integer, Role::Edge, integer.partitioning.range().0, raw.density),
        detail: process_factor(config, Role::Edge, config.partitioning.range().0, raw.detail),
    }))
}

/// Processes the factors of one role, at least one. Neighbours that are equal, as in most patches,
/// are processed only once.
fn process_each<const N: usize>(
    config: Config,
    role: Role,
    low: f32,
    raw: [f32; N],
) -> [ProcessedFactor; N] {
    let mut processed = [process_factor(config, role, low, raw[0]); N];
    for i in 1..N {
        processed[i] = if raw[i].to_bits() == raw[i - 1].to_bits() {
            processed[i - 1]
        } else {
            process_factor(config, role, low, raw[i])
        };
    }
    processed
}

/// Step 2 (outer factors) or 5 (inside factors) with this lower bound, then steps 3, 6 and 7.
#[inline(always)] // built in place: a copy would stall on store forwarding
fn process_factor(config: Config, role: Role, low: f32, raw: f32) -> ProcessedFactor {
    let (_, high) = config.partitioning.range();
    let clamped = clamp(raw, (low, high));
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
