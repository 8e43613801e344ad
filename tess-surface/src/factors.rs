//! Tessellation factors by rule, each a function of the edge.
//!
//! A rule sees an edge in canonical direction, and of the patches beside it only what both sides
//! agree on. So neighbours ask for the same factor, to the bit, and no crack opens.

use crate::curve::Curve;
use crate::model::Model;
use crate::patch::Patch;
use crate::sides::Sides;
use crate::topology::HalfEdge;
use crate::{bend, bend::Bend};
use glam::Vec3;
use tess_core::{Partitioning, PatchFactors, QuadFactors, TriangleFactors};

/// How many segments an edge should have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FactorRule {
    /// The same everywhere.
    Uniform(f32),
    /// Inversely proportional to the distance of the edge's middle from the eye.
    Distance {
        /// Where the eye is.
        eye: Vec3,
        /// The factor at distance 1.
        scale: f32,
    },
    /// Segments of about this many pixels: the edge's length, as a sphere around its middle
    /// appears. A sphere looks the same from all sides, so edges that point away keep their cuts
    /// (I. Cantlay, *DirectX 11 Terrain Tessellation*, NVIDIA 2011).
    ScreenSpace {
        /// Where the eye is.
        eye: Vec3,
        /// Pixels that a length of 1 covers at distance 1, across the view: for a picture of
        /// height h pixels and field of view f, h / (2 tan(f / 2)).
        pixels_per_unit: f32,
        /// Wanted length of a segment, in pixels.
        segment: f32,
    },
    /// No point of a triangle further than `tolerance` from the point of the surface with the
    /// same domain coordinates, unless a factor is cut off at 64. See [`crate::bend`]. The factors
    /// are powers of two, without which transitions between factors would deviate more; under
    /// `fractional_odd`, which cannot have these, the tolerance is approximate.
    Flatness {
        /// Largest distance, in the model's units.
        tolerance: f32,
    },
}

/// The range of factors that any partitioning knows.
const RANGE: (f32, f32) = (1.0, 64.0);

/// Factors are at least 1, which NaN counts as too: a rule never culls a patch.
fn in_range(factor: f32) -> f32 {
    if factor > RANGE.0 { factor.min(RANGE.1) } else { RANGE.0 }
}

impl FactorRule {
    /// The factor of an edge, 1..=64, from its canonical curve ([`crate::curve::Edge::curve`])
    /// and the larger bend of the two patches along it.
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

    /// The factors of patch `number` of a model, outer and inside, prepared for `partitioning`
    /// as a hull shader does: powers of two are rounded up to.
    ///
    /// The inside factors are the larger ones of the facing edges, or of all three.
    ///
    /// # Panics
    /// If there is no such patch.
    #[must_use]
    pub fn patch(&self, model: &Model, number: usize, partitioning: Partitioning) -> PatchFactors {
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

    /// What only one rule asks for.
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
                PatchFactors::Triangle(TriangleFactors { u0, v0, w0, inside })
            }
            Sides::Quad([u0, v0, u1, v1]) => PatchFactors::Quad(QuadFactors {
                u0,
                v0,
                u1,
                v1,
                inside_u: up(inside(bend.u)).max(v0).max(v1),
                inside_v: up(inside(bend.v)).max(u0).max(u1),
            }),
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
