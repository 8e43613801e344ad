//! Tessellation factors by rule, each a function of the edge.
//!
//! A rule depends only on data that both patches of an edge share, and gives the same bits for
//! either patch. Neighbours therefore have the same factor, and no crack opens. Inside factors
//! cannot open cracks.
//!
//! In WGSL, tess-gpu's `surfaces::FACTORS` has the functions for straight edges, and
//! `surfaces::BEZIER_FACTORS` the rules of [`FactorRule`] for cubic edges.
//!
//! # Insides
//!
//! Rules that depend only on edges give an inside factor the *mean* of the edges: of the two edges
//! that run the same way on a quad, of all three on a triangle. So do the Direct3D 11 samples and
//! HLSL's `ProcessQuadTessFactorsAvg`. Opposite edges differ because one is nearer to the eye. The
//! middle of the patch is between them, so with the mean its segments have about the length that
//! the rule asks for. With the larger factor they would be too short, down to half of that.
//!
//! [`FactorRule::Flatness`] takes the *larger* factor instead: its bound holds for powers of two,
//! and a mean is in general not one.

use crate::bend::Bend;
use crate::curve::Curve;
use crate::math::sqrt;
use crate::model::Model;
use crate::patch::SurfacePatch;
use crate::pn::{PnCorner, edge_bend};
use crate::sides::Sides;
use crate::topology::HalfEdge;
use glam::Vec3;
use tess_core::{Partitioning, PatchFactors, QuadFactors, TriangleFactors};

/// A rule for the number of segments of an edge.
///
/// Every number is valid. A rule's result is clamped to 1..=64, and NaN becomes 1, so that a rule
/// never culls a patch.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum FactorRule {
    /// The same factor everywhere.
    Uniform(f32),
    /// A factor inversely proportional to the distance of the edge's middle from the eye.
    Distance {
        /// The position of the eye.
        eye: Vec3,
        /// The factor at distance 1.
        scale: f32,
    },
    /// Segments of about `segment` pixels. The edge is measured as the sphere around its middle
    /// whose diameter is its length. A sphere looks the same from all sides, so edges that point
    /// away from the eye keep their segments (I. Cantlay, *DirectX 11 Terrain Tessellation*, NVIDIA
    /// 2011).
    ScreenSize {
        /// The position of the eye.
        eye: Vec3,
        /// The number of pixels that a length of 1 covers at distance 1, across the view: h / (2
        /// tan(f / 2)) for a picture of height h pixels and a field of view f.
        pixels_per_unit: f32,
        /// The desired length of a segment, in pixels.
        segment: f32,
    },
    /// The number of segments that keeps every point of a triangle within `tolerance` of the
    /// surface's point with the same domain coordinates, unless a factor would exceed 64.
    /// [`crate::bend`] has the formula. The factors are powers of two; with others, the triangles
    /// between different factors would deviate more. Under `fractional_odd`, which has no powers of
    /// two, the tolerance is approximate.
    Flatness {
        /// The largest distance, in the model's units.
        tolerance: f32,
    },
}

/// The range of factors over all partitionings.
const RANGE: (f32, f32) = (1.0, 64.0);

/// The factor clamped to 1..=64; 1 for NaN.
#[must_use]
pub const fn clamp_factor(factor: f32) -> f32 {
    if factor > RANGE.0 { factor.min(RANGE.1) } else { RANGE.0 }
}

/// `dividend / divisor` within 1..=64, also for a divisor of 0. The result is 1 unless both are
/// numbers and `dividend > divisor >= 0`.
#[must_use]
pub fn quotient(dividend: f32, divisor: f32) -> f32 {
    within(dividend, divisor, RANGE.1, |quotient| quotient)
}

/// The square root of `dividend / divisor` within 1..=64, with the exceptions of [`quotient`].
#[must_use]
pub fn root_quotient(dividend: f32, divisor: f32) -> f32 {
    within(dividend, divisor, RANGE.1 * RANGE.1, sqrt)
}

/// A function of a quotient, which is computed only between 1 and `most`, a power of two, because
/// WGSL does not define the result of a division that overflows.
fn within(dividend: f32, divisor: f32, most: f32, function: impl Fn(f32) -> f32) -> f32 {
    if dividend > divisor && divisor >= 0.0 {
        let is_most = dividend * (1.0 / most) >= divisor;
        if is_most { RANGE.1 } else { clamp_factor(function(dividend / divisor)) }
    } else {
        RANGE.0
    }
}

/// A factor for segments of `segment` pixels on the straight edge between these ends, as
/// [`FactorRule::ScreenSize`].
#[must_use]
pub fn edge_by_screen_size(ends: [Vec3; 2], eye: Vec3, pixels_per_unit: f32, segment: f32) -> f32 {
    let pixels = ends[0].distance(ends[1]) * pixels_per_unit;
    quotient(pixels, eye.distance(middle(ends)) * segment)
}

/// A factor for segments of `segment` pixels on the straight edge between these ends, under a
/// camera without perspective: a length of 1 covers `pixels_per_unit` pixels at any distance.
#[must_use]
pub fn edge_by_length(ends: [Vec3; 2], pixels_per_unit: f32, segment: f32) -> f32 {
    quotient(ends[0].distance(ends[1]) * pixels_per_unit, segment)
}

/// A factor of at most `most`, like HLSL's `maxtessfactor`. A factor that culls (0, negative or
/// NaN) still culls if `most` is positive.
#[must_use]
pub const fn at_most(factor: f32, most: f32) -> f32 {
    if factor > most { most } else { factor }
}

/// `scale` divided by the distance from the eye to the middle of the straight edge between these
/// ends, as [`FactorRule::Distance`].
#[must_use]
pub fn edge_by_distance(ends: [Vec3; 2], eye: Vec3, scale: f32) -> f32 {
    quotient(scale, eye.distance(middle(ends)))
}

/// A factor that keeps equal segments within `tolerance`, in units of the positions, of the
/// point-normal edge between two corners.
///
/// The edge's second derivative is at most M = 6 [`edge_bend`], and a chord over 1/n of the edge is
/// within M / (8 n^2) of it.
#[must_use]
pub fn edge_by_curvature(ends: [PnCorner; 2], tolerance: f32) -> f32 {
    root_quotient(0.75 * edge_bend(ends), tolerance)
}

/// A factor, a power of two, that keeps triangles within `tolerance` of a surface whose [`Bend`]
/// along the edge is at most `bend`, as [`FactorRule::Flatness`].
#[must_use]
pub fn edge_by_flatness(bend: f32, tolerance: f32) -> f32 {
    next_power_of_two(root_quotient(bend, 4.0 * tolerance))
}

/// The factors of an edge next to two edges of half its length, from the factor that a rule gives
/// the whole edge. The whole edge gets a power of two in 2..=64, at least the rule's factor; each
/// half gets half of it.
///
/// With these factors, the whole edge and its halves have the same domain points under
/// [`Partitioning::Integer`] and [`Partitioning::Pow2`]. With other factors, such as 6 next to 3
/// and 3, the points differ by up to 9.5/65536 of the edge: the tessellator rounds every location
/// to 1/65536, and rounding differs between the halves and the whole. Neighbours must compute both
/// factors from the whole edge.
#[must_use]
pub fn edge_beside_halves(factor: f32) -> [f32; 2] {
    let whole = next_power_of_two(clamp_factor(factor)).max(2.0);
    [whole, 0.5 * whole]
}

/// The inside factors along u and v of a quad with these factors on its edges u = 0, v = 0, u = 1,
/// v = 1: the mean of the two edges that run the same way.
#[must_use]
pub fn inside_quad([u0, v0, u1, v1]: [f32; 4]) -> [f32; 2] {
    [0.5 * (v0 + v1), 0.5 * (u0 + u1)]
}

/// The inside factor of a triangle: the mean of its edges, exact if they are equal.
#[must_use]
pub fn inside_triangle([u0, v0, w0]: [f32; 3]) -> f32 {
    u0 + ((v0 - u0) + (w0 - u0)) / 3.0
}

/// The middle of an edge, with the same bits whichever end comes first.
fn middle([a, b]: [Vec3; 2]) -> Vec3 {
    (a + b) * 0.5
}

impl FactorRule {
    /// The factor of an edge, 1..=64, from its canonical curve
    /// ([`Edge::curve`](crate::Edge::curve)) and the largest [`Bend::along`] it of all its patches.
    #[must_use]
    pub fn edge(&self, curve: &Curve, bend: f32) -> f32 {
        match *self {
            Self::Uniform(factor) => clamp_factor(factor),
            Self::Distance { eye, scale } => quotient(scale, eye.distance(curve.position(0.5))),
            Self::ScreenSize { eye, pixels_per_unit, segment } => {
                let pixels = curve.length_bound() * pixels_per_unit;
                quotient(pixels, eye.distance(curve.position(0.5)) * segment)
            }
            Self::Flatness { tolerance } => edge_by_flatness(bend, tolerance),
        }
    }

    /// The factors of patch `number` of a model, prepared for `partitioning` as by a hull shader:
    /// under `pow2` they are rounded up to powers of two, inside factors after taking their mean.
    ///
    /// Inside factors are the means of the edges' factors ([`inside_quad`], [`inside_triangle`]).
    /// Under [`FactorRule::Flatness`] they are the largest of the edges' factors and the factor
    /// that the inside needs.
    ///
    /// # Panics
    /// If there is no such patch.
    #[must_use]
    pub fn factors(
        &self,
        model: &Model,
        number: usize,
        partitioning: Partitioning,
    ) -> PatchFactors {
        if let Self::Uniform(factor) = *self {
            let outer = model.sides(number).map(|()| clamp_factor(factor));
            return self.prepare(outer, Bend::ZERO, partitioning);
        }
        let patch = model.patch(number);
        let bend = self.bend(&patch);
        let outer = patch.edges().map_numbered(|edge, shared| {
            let half = HalfEdge { patch: number, edge };
            let own = bend.along(&patch.edges().map(drop), edge);
            let others = model.topology().others(half);
            let largest =
                others.fold(own, |largest, side| largest.max(self.bend_beside(model, side)));
            self.edge(&shared.curve, largest)
        });
        self.prepare(outer, bend, partitioning)
    }

    /// The bend of a patch, or zero for rules that do not use it.
    fn bend(&self, patch: &SurfacePatch) -> Bend {
        if matches!(self, Self::Flatness { .. }) { Bend::of(patch.surface()) } else { Bend::ZERO }
    }

    fn bend_beside(&self, model: &Model, side: HalfEdge) -> f32 {
        if !matches!(self, Self::Flatness { .. }) {
            return 0.0;
        }
        let patch = model.patch(side.patch);
        self.bend(&patch).along(&patch.edges().map(drop), side.edge)
    }

    fn prepare(&self, outer: Sides<f32>, bend: Bend, partitioning: Partitioning) -> PatchFactors {
        let up = |factor: f32| match partitioning {
            Partitioning::Pow2 => next_power_of_two(factor),
            _ => factor,
        };
        // Under the flatness rule the largest of these edges and the bend's own factor, otherwise
        // the mean.
        let inside = |bend: f32, edges: &[f32], mean: f32| match *self {
            Self::Flatness { tolerance } => {
                edges.iter().copied().fold(edge_by_flatness(bend, tolerance), f32::max)
            }
            _ => mean,
        };
        match outer {
            Sides::Triangle(edges) => {
                let inside = inside(bend.u.max(bend.v), &edges, inside_triangle(edges));
                let [u0, v0, w0] = edges;
                TriangleFactors::from([u0, v0, w0, inside].map(up)).into()
            }
            Sides::Quad(edges) => {
                let ([u0, v0, u1, v1], [mean_u, mean_v]) = (edges, inside_quad(edges));
                let inside_u = inside(bend.u, &[v0, v1], mean_u);
                let inside_v = inside(bend.v, &[u0, u1], mean_v);
                QuadFactors::from([u0, v0, u1, v1, inside_u, inside_v].map(up)).into()
            }
        }
    }
}

/// The smallest power of two that is not below `factor`, for factors 1..=64.
fn next_power_of_two(factor: f32) -> f32 {
    [1.0, 2.0, 4.0, 8.0, 16.0, 32.0].into_iter().find(|&power| power >= factor).unwrap_or(64.0)
}
