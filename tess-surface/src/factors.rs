//! Tessellation factors by rule, each a function of the edge.
//!
//! A rule gets an edge in canonical direction, and what both sides agree on. So neighbours get the
//! same factor, to the bit, and no crack opens.

use crate::curve::Curve;
use crate::model::Model;
use crate::patch::Patch;
use crate::sides::Sides;
use crate::topology::HalfEdge;
use crate::{bend, bend::Bend};
use glam::Vec3;
use tess_core::{Partitioning, PatchFactors, QuadFactors, TriangleFactors};

/// How many segments an edge gets.
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
    /// Segments of about `segment` pixels. The edge is seen as the sphere around its middle whose
    /// diameter is its length; a sphere looks the same from all sides, so edges that point away from
    /// the eye keep their segments (I. Cantlay, *DirectX 11 Terrain Tessellation*, NVIDIA 2011).
    ScreenSpace {
        /// The position of the eye.
        eye: Vec3,
        /// The pixels that a length of 1 covers at distance 1, across the view: for a picture of
        /// height h pixels and field of view f, h / (2 tan(f / 2)).
        pixels_per_unit: f32,
        /// The wanted length of a segment, in pixels.
        segment: f32,
    },
    /// As many segments as keep every point of a triangle within `tolerance` of the surface's point
    /// with the same domain coordinates, unless a factor would exceed 64. [`crate::bend`] has the
    /// formula. The factors are powers of two; with others, the triangles between different factors
    /// would deviate more. Under `fractional_odd`, which has no powers of two, the tolerance is
    /// approximate.
    Flatness {
        /// The largest distance, in the model's units.
        tolerance: f32,
    },
}

/// The range of factors of all partitionings together.
const RANGE: (f32, f32) = (1.0, 64.0);

fn in_range(factor: f32) -> f32 {
    if factor > RANGE.0 { factor.min(RANGE.1) } else { RANGE.0 }
}

impl FactorRule {
    /// The factor of an edge, 1..=64, from its canonical curve ([`Edge::curve`](crate::Edge::curve))
    /// and the larger [`Bend::along`] it of both patches.
    #[must_use]
    pub fn edge(&self, curve: &Curve, bend: f32) -> f32 {
        in_range(match *self {
            Self::Uniform(factor) => factor,
            Self::Distance { eye, scale } => scale / eye.distance(curve.position(0.5)),
            Self::ScreenSpace { eye, pixels_per_unit, segment } => {
                let pixels = curve.length_bound() * pixels_per_unit;
                pixels / (eye.distance(curve.position(0.5)) * segment)
            }
            Self::Flatness { tolerance } => flat_segments(bend, tolerance),
        })
    }

    /// The factors of patch `number` of a model, prepared for `partitioning` as a hull shader does:
    /// under `pow2` they are rounded up to powers of two.
    ///
    /// An inside factor of a quad is the larger factor of the two edges along its axis, that of a
    /// triangle the largest of all three; more where [`FactorRule::Flatness`] needs it inside.
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
            let outer = model.sides(number).map(|()| in_range(factor));
            return self.prepare(outer, Bend::ZERO, partitioning);
        }
        let patch = model.patch(number);
        let bend = self.bend(&patch);
        let outer = patch.edges().map_numbered(|edge, shared| {
            let half = HalfEdge { patch: number, edge };
            let twin = model.twin(half).map_or(0.0, |twin| self.bend_beside(model, twin));
            let own = bend.along(&patch.edges().map(drop), edge);
            self.edge(&shared.curve, own.max(twin))
        });
        self.prepare(outer, bend, partitioning)
    }

    /// The bend of a patch, which only one rule looks at.
    fn bend(&self, patch: &Patch) -> Bend {
        if matches!(self, Self::Flatness { .. }) { Bend::of(patch.surface()) } else { Bend::ZERO }
    }

    fn bend_beside(&self, model: &Model, twin: HalfEdge) -> f32 {
        if !matches!(self, Self::Flatness { .. }) {
            return 0.0;
        }
        let patch = model.patch(twin.patch);
        self.bend(&patch).along(&patch.edges().map(drop), twin.edge)
    }

    fn prepare(&self, outer: Sides<f32>, bend: Bend, partitioning: Partitioning) -> PatchFactors {
        let up = |factor: f32| match partitioning {
            Partitioning::Pow2 => next_power_of_two(factor),
            _ => factor,
        };
        // The rule applied to the inside alone; 1 for rules that look at edges only.
        let inside = |bend: f32| match *self {
            Self::Flatness { tolerance } => flat_segments(bend, tolerance),
            _ => RANGE.0,
        };
        match outer.map(up) {
            Sides::Triangle([u0, v0, w0]) => {
                let inside = up(inside(bend.u.max(bend.v))).max(u0).max(v0).max(w0);
                TriangleFactors::from([u0, v0, w0, inside]).into()
            }
            Sides::Quad([u0, v0, u1, v1]) => {
                let inside_u = up(inside(bend.u)).max(v0).max(v1);
                let inside_v = up(inside(bend.v)).max(u0).max(u1);
                QuadFactors::from([u0, v0, u1, v1, inside_u, inside_v]).into()
            }
        }
    }
}

/// The factor that keeps a bend within the tolerance.
fn flat_segments(bend: f32, tolerance: f32) -> f32 {
    next_power_of_two(in_range(bend::segments(bend, tolerance)))
}

/// The least power of two that is not less than `factor`, for factors 1..=64.
fn next_power_of_two(factor: f32) -> f32 {
    [1.0, 2.0, 4.0, 8.0, 16.0, 32.0].into_iter().find(|&power| power >= factor).unwrap_or(64.0)
}
