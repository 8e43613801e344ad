//! The line, edge or ring of the i-th point of a patch, and its place there.
//!
//! [`locate`] turns a point's number into its origin, and [`point`] the origin into coordinates.
//! They are separate because tests, `tess explain` and debuggers want the origin, and because
//! shaders keep an origin to step to the next point.
//!
//! # The data
//!
//! ```text
//! isoline    line 0: detail points | line 1 | ...                i / points, i % points
//! triangle   outer edges: n - 1 each | ring 1: 3 (n - 3) | ring 2: 3 (n - 5) | ... | centre: 1 or 0
//! quad       outer edges: n - 1 each | ring 1: 2 (u - 3) + 2 (v - 3) | ...         | centre row
//! ```
//!
//! An edge includes its first point; its last point belongs to the next edge. The sizes of interior
//! rings depend only on the inside factors, not on the outer edges.
//!
//! # One patch
//!
//! The triangle (3, 3, 3; 8), integer, has 9 points on its outer edges and n = 9 inside: 18, 12 and
//! 6 on rings 1, 2 and 3, and the centre. Point 33 is number 24 of the interior. The rings begin at
//! 0, 18 and 30, so it is number 6 of ring 2, which has 9 - 1 - 2 * 2 = 4 points on each edge: edge
//! 1, point 2. Its coordinates are 0x6aaa and 0x2aab, close to 5 / 12 and 1 / 6. The test
//! `the_worked_rings` checks these numbers.
//!
//! # What holds
//!
//! - `i` is below the patch's count. Any other number would become a point of the centre.
//! - `triangle_points_before` and `quad_points_before` are 0 for ring 1 and grow with the ring up
//!   to the last one that goes round. Past it the formulas decrease, so the search stops there.
//! - Every edge of a ring has at least 1 point, because a ring that goes round has at least two
//!   points along each axis.
//!
//! # Why not simpler
//!
//! A walk that subtracts ring after ring takes up to 31 steps, and threads of a workgroup would
//! wait for the longest. The search takes five for every point.

use crate::closed_form::locate::origin::PointOrigin;
use crate::closed_form::locate::{last_ring_at_or_before, slot_of};
use crate::model::connect::rings::Rings;
use crate::model::connect::{quad as quad_rings, triangle as triangle_rings};
use crate::model::factor_context::FactorContext;
use crate::model::factors::{ProcessedFactor, ProcessedPatch};
use crate::model::output::DomainPoint;
use crate::model::patch_factors::{PatchFactors, QuadFactors, TriangleFactors};
use crate::model::points::quad::Inside;
use crate::model::points::{isoline, minimum_corners, quad, triangle};

/// The origin of point `i`, which is less than the patch's point count.
pub(crate) fn locate(patch: &ProcessedPatch, i: u32) -> PointOrigin {
    match patch {
        ProcessedPatch::Culled | ProcessedPatch::Minimum(_) => PointOrigin::Corner { corner: i },
        ProcessedPatch::Regular(PatchFactors::Isoline(factors)) => {
            let points = factors.detail.context.points;
            PointOrigin::Line { line: i / points, p: i % points }
        }
        ProcessedPatch::Regular(PatchFactors::Triangle(factors)) => locate_in_triangle(factors, i),
        ProcessedPatch::Regular(PatchFactors::Quad(factors)) => locate_in_quad(factors, i),
    }
}

fn locate_in_triangle(factors: &TriangleFactors<ProcessedFactor>, i: u32) -> PointOrigin {
    let outer = triangle_rings::rings(factors);
    let Some(interior) = i.checked_sub(outer.outer_points()) else {
        return locate_on_outer_edge(&outer, i);
    };
    let inside = &factors.inside.context;
    let end = inside.points / 2;
    if interior >= triangle_points_before(inside, end) {
        return PointOrigin::Centre { p: 0 };
    }
    let ring = last_ring_at_or_before(interior, end, |r| triangle_points_before(inside, r));
    let in_ring = interior - triangle_points_before(inside, ring);
    let size = triangle::ring_edge_points(inside, ring);
    PointOrigin::Ring { ring, edge: in_ring / size, p: in_ring % size }
}

fn locate_in_quad(factors: &QuadFactors<ProcessedFactor>, i: u32) -> PointOrigin {
    let outer = quad_rings::rings(factors);
    let Some(interior) = i.checked_sub(outer.outer_points()) else {
        return locate_on_outer_edge(&outer, i);
    };
    let inside = Inside::new(factors);
    let end = inside.first_open_ring();
    let rings_total = quad_points_before(&inside, end);
    if interior >= rings_total {
        return PointOrigin::Centre { p: interior - rings_total };
    }
    let ring = last_ring_at_or_before(interior, end, |r| quad_points_before(&inside, r));
    let in_ring = interior - quad_points_before(&inside, ring);
    let sizes = [0, 1, 2, 3].map(|edge| inside.ring_edge_points(ring, edge));
    let (edge, p) = slot_of(in_ring, sizes);
    PointOrigin::Ring { ring, edge, p }
}

fn locate_on_outer_edge<const EDGES: usize>(rings: &Rings<'_, EDGES>, i: u32) -> PointOrigin {
    let (edge, p) = slot_of(i, rings.outer.map(|context| context.points - 1));
    PointOrigin::OuterEdge { edge, p }
}

/// Interior points on the rings `1..ring`: the sum of 3 (n - 1 - 2 k) over these rings `k`.
pub(crate) const fn triangle_points_before(inside: &FactorContext, ring: u32) -> u32 {
    3 * (ring - 1) * (inside.points - 1 - ring)
}

/// Interior points on the rings `1..ring`: the sum of 2 (nU - 1 - 2 k) + 2 (nV - 1 - 2 k) over
/// these rings `k`.
pub(crate) const fn quad_points_before(inside: &Inside<'_>, ring: u32) -> u32 {
    2 * (ring - 1) * (inside.u.points + inside.v.points - 2 - 2 * ring)
}

/// The point of an origin that [`locate`] gave for this patch; `None` for an origin of another kind
/// of patch.
pub(crate) fn point(patch: &ProcessedPatch, location: PointOrigin) -> Option<DomainPoint> {
    match (patch, location) {
        (ProcessedPatch::Minimum(factors), PointOrigin::Corner { corner }) => {
            minimum_corners(factors.domain()).get(corner as usize).copied()
        }
        (ProcessedPatch::Regular(factors), location) => regular_point(factors, location),
        _ => None,
    }
}

fn regular_point(
    factors: &PatchFactors<ProcessedFactor>,
    location: PointOrigin,
) -> Option<DomainPoint> {
    match (factors, location) {
        (PatchFactors::Isoline(factors), PointOrigin::Line { line, p }) => {
            Some(isoline::point(factors, line, p))
        }
        (PatchFactors::Triangle(factors), location) => triangle_point(factors, location),
        (PatchFactors::Quad(factors), location) => quad_point(factors, location),
        _ => None,
    }
}

fn triangle_point(
    factors: &TriangleFactors<ProcessedFactor>,
    location: PointOrigin,
) -> Option<DomainPoint> {
    match location {
        PointOrigin::OuterEdge { edge, p } => {
            let context = factors.outer_contexts().get(edge as usize).copied()?;
            Some(triangle::outer_point(context, edge, p))
        }
        PointOrigin::Ring { ring, edge, p } => {
            Some(triangle::ring_point(&factors.inside.context, ring, edge, p))
        }
        PointOrigin::Centre { .. } => Some(triangle::CENTRE),
        PointOrigin::Corner { .. } | PointOrigin::Line { .. } => None,
    }
}

fn quad_point(
    factors: &QuadFactors<ProcessedFactor>,
    location: PointOrigin,
) -> Option<DomainPoint> {
    let inside = Inside::new(factors);
    match location {
        PointOrigin::OuterEdge { edge, p } => {
            let context = factors.outer_contexts().get(edge as usize).copied()?;
            Some(quad::outer_point(context, edge, p))
        }
        PointOrigin::Ring { ring, edge, p } => Some(inside.ring_point(ring, edge, p)),
        PointOrigin::Centre { p } => Some(inside.centre_row_point(inside.centre_row()?, p)),
        PointOrigin::Corner { .. } | PointOrigin::Line { .. } => None,
    }
}
