//! Factor processing: from raw binary32 factors to contexts (spec section 3).

use crate::d3d_float::{ceil, clamp, is_culled};
use crate::factor_context::FactorContext;
use crate::fixed_point::FixedFactor;
use crate::state::{Config, Domain, Parity, Partitioning};

/// Something said of each factor of an isoline patch; with `f32`, the raw factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct IsolineFactors<T = f32> {
    /// Number of lines; always processed as integer.
    pub density: T,
    /// Number of segments of each line.
    pub detail: T,
}

/// Something said of each factor of a triangle patch; with `f32`, the raw factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct TriangleFactors<T = f32> {
    /// Outer factor of the edge u = 0.
    pub u0: T,
    /// Outer factor of the edge v = 0.
    pub v0: T,
    /// Outer factor of the edge w = 0.
    pub w0: T,
    /// Inside factor.
    pub inside: T,
}

/// Something said of each factor of a quad patch; with `f32`, the raw factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[repr(C)]
pub struct QuadFactors<T = f32> {
    /// Outer factor of the edge u = 0.
    pub u0: T,
    /// Outer factor of the edge v = 0.
    pub v0: T,
    /// Outer factor of the edge u = 1.
    pub u1: T,
    /// Outer factor of the edge v = 1.
    pub v1: T,
    /// Inside factor along u.
    pub inside_u: T,
    /// Inside factor along v.
    pub inside_v: T,
}

/// The factors of one patch of any domain; with `f32`, the raw factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PatchFactors<T = f32> {
    /// An isoline patch.
    Isoline(IsolineFactors<T>),
    /// A triangle patch.
    Triangle(TriangleFactors<T>),
    /// A quad patch.
    Quad(QuadFactors<T>),
}

impl<T: Copy> TriangleFactors<T> {
    /// The outer factors in edge order: u = 0, v = 0, w = 0.
    pub const fn outer(&self) -> [T; 3] {
        [self.u0, self.v0, self.w0]
    }
}

impl<T: Copy> QuadFactors<T> {
    /// The outer factors in edge order: u = 0, v = 0, u = 1, v = 1.
    pub const fn outer(&self) -> [T; 4] {
        [self.u0, self.v0, self.u1, self.v1]
    }

    /// The inside factors: along u, along v.
    pub const fn inside(&self) -> [T; 2] {
        [self.inside_u, self.inside_v]
    }
}

impl<T> PatchFactors<T> {
    /// The domain these factors belong to.
    pub const fn domain(&self) -> Domain {
        match self {
            Self::Isoline(_) => Domain::Isoline,
            Self::Triangle(_) => Domain::Triangle,
            Self::Quad(_) => Domain::Quad,
        }
    }
}

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

/// Processes the raw factors of one patch. Total: every bit pattern is valid.
///
/// Spec section 3, whose steps the functions below are named after.
#[must_use]
pub fn process(config: Config, raw: PatchFactors) -> ProcessedPatch {
    match raw {
        PatchFactors::Isoline(raw) => process_isoline(config, raw),
        PatchFactors::Triangle(raw) => process_triangle(config, raw),
        PatchFactors::Quad(raw) => process_quad(config, raw),
    }
}

fn process_isoline(config: Config, raw: IsolineFactors) -> ProcessedPatch {
    if is_culled(&[raw.density, raw.detail]) {
        return ProcessedPatch::Culled;
    }
    let integer = Config { partitioning: Partitioning::Integer, ..config };
    ProcessedPatch::Regular(PatchFactors::Isoline(IsolineFactors {
        density: process_edge(integer, raw.density),
        detail: process_edge(config, raw.detail),
    }))
}

fn process_triangle(config: Config, raw: TriangleFactors) -> ProcessedPatch {
    if is_culled(&raw.outer()) {
        return ProcessedPatch::Culled;
    }
    let low = inside_low(config.partitioning, &[raw.u0, raw.v0, raw.w0, raw.inside]);
    let factors = TriangleFactors {
        u0: process_edge(config, raw.u0),
        v0: process_edge(config, raw.v0),
        w0: process_edge(config, raw.w0),
        inside: process_inside(config, raw.inside, low),
    };
    let all = [factors.u0, factors.v0, factors.w0, factors.inside];
    minimum_or_regular(&all, PatchFactors::Triangle(factors))
}

fn process_quad(config: Config, raw: QuadFactors) -> ProcessedPatch {
    if is_culled(&raw.outer()) {
        return ProcessedPatch::Culled;
    }
    let raw_all = [raw.u0, raw.v0, raw.u1, raw.v1, raw.inside_u, raw.inside_v];
    let low = inside_low(config.partitioning, &raw_all);
    let factors = QuadFactors {
        u0: process_edge(config, raw.u0),
        v0: process_edge(config, raw.v0),
        u1: process_edge(config, raw.u1),
        v1: process_edge(config, raw.v1),
        inside_u: process_inside(config, raw.inside_u, low),
        inside_v: process_inside(config, raw.inside_v, low),
    };
    let [u0, v0, u1, v1] = factors.outer();
    let all = [u0, v0, u1, v1, factors.inside_u, factors.inside_v];
    minimum_or_regular(&all, PatchFactors::Quad(factors))
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
fn inside_low(partitioning: Partitioning, all: &[f32]) -> f32 {
    const ONE_PLUS_2_POW_MINUS_17: f32 = f32::from_bits(0x3F80_0040);
    const ONE_PLUS_2_POW_MINUS_16: f32 = f32::from_bits(0x3F80_0080);
    let needs_picture_frame = partitioning == Partitioning::FractionalOdd
        && all.iter().any(|&factor| factor > ONE_PLUS_2_POW_MINUS_17);
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

/// Step 8.
fn minimum_or_regular(
    all: &[ProcessedFactor],
    factors: PatchFactors<ProcessedFactor>,
) -> ProcessedPatch {
    if all.iter().all(|factor| factor.fixed == FixedFactor::ONE) {
        ProcessedPatch::Minimum(factors)
    } else {
        ProcessedPatch::Regular(factors)
    }
}
