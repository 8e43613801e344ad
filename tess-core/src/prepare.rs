//! Factor preparation: HLSL's `Process...TessFactors` functions (spec section 9).
//!
//! This is Direct3D 11's form (Shader Model 5, compiler FXC). DXC (Shader Model 6) generates
//! another form, which no public document defines and which this crate does not have; section 9
//! lists the differences.
//!
//! This stage is optional. It turns the outer factors and inside scales that a hull shader asks for
//! into *unrounded* factors, which are reported back to the shader, and *rounded* factors, which
//! are tessellated. All arithmetic is binary32, rounded to nearest even, never fused.
#![expect(
    clippy::float_arithmetic,
    reason = "the one stage that the specification defines in floats"
)]

use crate::model::d3d_float::{ceil, clamp, is_culled, next_power_of_two};
use crate::model::patch_factors::{IsolineFactors, PatchFactors, QuadFactors, TriangleFactors};
use crate::model::state::{Domain, Partitioning};

/// The operation that makes one inside factor from several outer factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Reduction {
    /// The smallest.
    Min,
    /// The largest.
    Max,
    /// The sum, left to right, divided by the number of factors.
    Average,
}

/// Whether a quad's two inside factors are reduced together.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum QuadAxes {
    /// One reduction over all four edges, with the u scale, for both. The v scale has no effect.
    One,
    /// u from the edges v = 0 and v = 1, v from the edges u = 0 and u = 1.
    Two,
}

/// The factors of one patch as a hull shader hands them over: outer factors, and scales from which
/// the inside factors are computed. A scale is clamped to `0..=1`; NaN counts as 0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Request {
    /// Density and detail; an isoline patch has no scales.
    Isoline(IsolineFactors),
    /// A triangle patch.
    Triangle {
        /// Outer factors in edge order: u = 0, v = 0, w = 0.
        outer: [f32; 3],
        /// Scale of the inside factor.
        scale: f32,
    },
    /// A quad patch.
    Quad {
        /// Outer factors in edge order: u = 0, v = 0, u = 1, v = 1.
        outer: [f32; 4],
        /// Scales of the inside factors along u and along v.
        scales: [f32; 2],
        /// How the inside factors are reduced.
        axes: QuadAxes,
    },
}

impl Request {
    /// The request from a record that stores the scales in place of the inside factors, as C
    /// structures and vector files do. `axes` matters only for a quad.
    #[must_use]
    pub const fn from_record(record: PatchFactors, axes: QuadAxes) -> Self {
        match record {
            PatchFactors::Isoline(factors) => Self::Isoline(factors),
            PatchFactors::Triangle(record) => {
                Self::Triangle { outer: record.outer(), scale: record.inside }
            }
            PatchFactors::Quad(record) => {
                Self::Quad { outer: record.outer(), scales: record.inside(), axes }
            }
        }
    }
}

/// The factors of one patch before and after rounding.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Prepared {
    /// Reported back to the shader.
    pub unrounded: PatchFactors,
    /// Tessellated.
    pub rounded: PatchFactors,
}

/// Prepares the factors of one patch. Total: every bit pattern is valid. Spec section 9.
///
/// A patch with an outer factor that is not greater than zero is culled: its unrounded outer
/// factors are the inputs as given, and every other result is 0.
#[must_use]
pub fn prepare(partitioning: Partitioning, reduction: Reduction, request: Request) -> Prepared {
    match request {
        Request::Isoline(factors) => prepare_isoline(partitioning, factors),
        Request::Triangle { outer, scale } => {
            prepare_triangle(partitioning, reduction, outer, scale)
        }
        Request::Quad { outer, scales, axes } => {
            prepare_quad(partitioning, reduction, outer, scales, axes)
        }
    }
}

fn prepare_isoline(partitioning: Partitioning, factors: IsolineFactors) -> Prepared {
    if is_culled([factors.density, factors.detail].into_iter()) {
        return Prepared {
            unrounded: PatchFactors::Isoline(factors),
            rounded: PatchFactors::uniform(Domain::Isoline, 0.0),
        };
    }
    let unrounded = IsolineFactors {
        density: clamp(clean(factors.density), Partitioning::Integer.range()),
        detail: clamp(clean(factors.detail), partitioning.range()),
    };
    let rounded = IsolineFactors {
        density: round_up(Partitioning::Integer, unrounded.density),
        detail: round_up(partitioning, unrounded.detail),
    };
    Prepared {
        unrounded: PatchFactors::Isoline(unrounded),
        rounded: PatchFactors::Isoline(rounded),
    }
}

fn prepare_triangle(
    partitioning: Partitioning,
    reduction: Reduction,
    outer @ [u0, v0, w0]: [f32; 3],
    scale: f32,
) -> Prepared {
    if is_culled(outer.into_iter()) {
        return Prepared {
            unrounded: PatchFactors::Triangle(TriangleFactors { u0, v0, w0, inside: 0.0 }),
            rounded: PatchFactors::uniform(Domain::Triangle, 0.0),
        };
    }
    let outer @ [u0, v0, w0] = outer.map(clean);
    let inside = inside(partitioning, reduction, &outer, scale);
    let unrounded = TriangleFactors { u0, v0, w0, inside };
    let [u0, v0, w0] = outer.map(|factor| round_outer(partitioning, factor));
    let inside = round_up(partitioning, inside);
    Prepared {
        unrounded: PatchFactors::Triangle(unrounded),
        rounded: PatchFactors::Triangle(TriangleFactors { u0, v0, w0, inside }),
    }
}

fn prepare_quad(
    partitioning: Partitioning,
    reduction: Reduction,
    outer @ [u0, v0, u1, v1]: [f32; 4],
    [scale_u, scale_v]: [f32; 2],
    axes: QuadAxes,
) -> Prepared {
    if is_culled(outer.into_iter()) {
        let (inside_u, inside_v) = (0.0, 0.0);
        return Prepared {
            unrounded: PatchFactors::Quad(QuadFactors { u0, v0, u1, v1, inside_u, inside_v }),
            rounded: PatchFactors::uniform(Domain::Quad, 0.0),
        };
    }
    let outer @ [u0, v0, u1, v1] = outer.map(clean);
    let (inside_u, inside_v) = match axes {
        QuadAxes::One => {
            let both = inside(partitioning, reduction, &[v0, v1, u0, u1], scale_u);
            (both, both)
        }
        QuadAxes::Two => widen_narrower_axis(
            partitioning,
            inside(partitioning, reduction, &[v0, v1], scale_u),
            inside(partitioning, reduction, &[u0, u1], scale_v),
        ),
    };
    let unrounded = QuadFactors { u0, v0, u1, v1, inside_u, inside_v };
    let [u0, v0, u1, v1] = outer.map(|factor| round_outer(partitioning, factor));
    let [inside_u, inside_v] = unrounded.inside().map(|factor| round_up(partitioning, factor));
    Prepared {
        unrounded: PatchFactors::Quad(unrounded),
        rounded: PatchFactors::Quad(QuadFactors { u0, v0, u1, v1, inside_u, inside_v }),
    }
}

/// Under `fractional_odd`, an axis that is below 3 and below the other axis grows to the smaller of
/// 3 and the other. Rounding does not change fractional factors, so this holds for the rounded
/// factors too.
fn widen_narrower_axis(partitioning: Partitioning, u: f32, v: f32) -> (f32, f32) {
    let widened = |this: f32, other: f32| {
        let narrower = this < 3.0 && this < other;
        if partitioning == Partitioning::FractionalOdd && narrower { other.min(3.0) } else { this }
    };
    (widened(u, v), widened(v, u))
}

/// The unrounded inside factor from cleaned outer factors, none of them NaN, and a scale.
fn inside(partitioning: Partitioning, reduction: Reduction, outer: &[f32], scale: f32) -> f32 {
    // Infinity times zero is NaN, which is clamped to the low end.
    let scaled = clamp(reduce(reduction, outer) * clean_scale(scale), partitioning.range());
    if partitioning != Partitioning::FractionalOdd || scaled >= 3.0 {
        return scaled;
    }
    // The picture frame rule.
    match reduction {
        Reduction::Max => reduce(Reduction::Max, outer).min(3.0),
        Reduction::Min | Reduction::Average => reduce(Reduction::Average, outer).min(3.0),
    }
}

fn reduce(reduction: Reduction, factors: &[f32]) -> f32 {
    let [first, rest @ ..] = factors else { return 0.0 }; // patches have outer factors
    let rest = rest.iter().copied();
    match reduction {
        Reduction::Min => rest.fold(*first, f32::min),
        Reduction::Max => rest.fold(*first, f32::max),
        Reduction::Average => {
            let (sum, count) = rest.fold((*first, 1.0), |(sum, n), factor| (sum + factor, n + 1.0));
            sum / count
        }
    }
}

/// Outer factors below 1 count as 1.
fn clean(factor: f32) -> f32 {
    if factor < 1.0 { 1.0 } else { factor }
}

/// Clamps a scale to `0..=1`; NaN gives 0.
fn clean_scale(scale: f32) -> f32 {
    clamp(scale, (0.0, 1.0))
}

fn round_outer(partitioning: Partitioning, factor: f32) -> f32 {
    clamp(round_up(partitioning, factor), partitioning.range())
}

/// Rounds a factor of at least 1 up to the next one that the partitioning allows.
fn round_up(partitioning: Partitioning, factor: f32) -> f32 {
    match partitioning {
        Partitioning::Integer => ceil(factor),
        Partitioning::Pow2 => next_power_of_two(factor),
        Partitioning::FractionalOdd | Partitioning::FractionalEven => factor,
    }
}
