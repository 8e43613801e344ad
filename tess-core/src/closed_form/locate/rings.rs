//! The t-th triangle of the rings of a triangle or quad patch.
//!
//! `locate::primitive` asks for a triangle by its number, for both domains: [`locate`] finds its
//! stitch, and [`triangle`] its three indices. The differences between the domains are in
//! [`ClosedForms`].
//!
//! # The data
//!
//! With `n` the points of the inside factor along an edge, stitch `k` joins that edge of rings `k -
//! 1` and `k`:
//!
//! ```text
//! stitch    rows                     triangles on an edge        triangles before it
//! 1         outer edge, ring 1       outer points + n - 4        those of the edges before it
//! k >= 2    ring k-1, ring k         2 (n - 2 k)                 triangles_before(k), and transitions
//! centre    innermost ring           triangle: 1 or 0; strip     triangles_before(end)
//! ```
//!
//! A ring's indices are consecutive, so a row is a first index and a direction ([`Row`]). The
//! exception is the last entry of a ring's last edge, which is the ring's first index.
//!
//! # One patch
//!
//! The triangle (3, 3, 3; 8), integer, has 9 points along its inside factor. Ring 0 has the indices
//! 0 to 8, ring 1 has 9 to 26, ring 2 has 27 to 38, ring 3 has 39 to 44, and the centre is 45. Each
//! transition has 4 + 9 - 4 = 9 triangles; stitches 2, 3 and 4 have 30, 18 and 6. Triangle 60 is
//! number 33 after the 27 of the transitions, hence number 3 of stitch 3, which has 6 on each edge:
//! edge 0, step 3. Its rows are 27 to 31 and 39 to 41, and its indices 40, 29 and 30. The test
//! `the_worked_rings` checks these numbers.
//!
//! # What holds
//!
//! - `triangles_before(2)` is 0, and it grows with the ring. The search for a ring relies on both.
//! - Stitches `1..end` exist, one for each ring `1..end`; an innermost ring may be a single point
//!   or a row of points. The triangles after them are the centre's, which only a ring that goes
//!   round has.
//! - Step numbers are below the stitch's size: [`locate`] gives no others. `triangle` does not
//!   check them again.
//!
//! # Why not simpler
//!
//! The sequential walk (`model/connect/rings.rs`) adds up sizes from ring to ring. Here a row
//! follows from the ring's number with two products; adding up would take a step for each of up to
//! 31 rings.

use crate::closed_form::locate::origin::PrimitiveOrigin;
use crate::closed_form::locate::point::{quad_points_before, triangle_points_before};
use crate::closed_form::locate::{centre_strip, last_ring_at_or_before, slot_of, stitch};
use crate::model::connect::rings::Rings;
use crate::model::connect::{quad, triangle};
use crate::model::factors::ProcessedFactor;
use crate::model::patch_factors::{QuadFactors, TriangleFactors};
use crate::model::points::quad::Inside;
use crate::model::row::Row;
use crate::model::state::{Parity, SplitOrder};
use crate::model::stitch::{Triangle, centre_triangle};

/// The closed forms of a patch with `EDGES` edges.
pub(crate) trait ClosedForms<const EDGES: usize> {
    fn rings(&self) -> Rings<'_, EDGES>;
    /// Interior points on the rings `1..ring`.
    fn points_before(&self, ring: u32) -> u32;
    /// Triangles of the ring stitches `2..ring`.
    fn triangles_before(&self, ring: u32) -> u32;
    /// Triangle `step` inside the innermost ring, whose first index is `innermost`.
    fn centre_triangle(&self, innermost: u32, step: u32) -> Option<Triangle>;
}

impl ClosedForms<3> for TriangleFactors<ProcessedFactor> {
    fn rings(&self) -> Rings<'_, 3> {
        triangle::rings(self)
    }

    fn points_before(&self, ring: u32) -> u32 {
        triangle_points_before(&self.inside.context, ring)
    }

    /// The sum of 3 * 2 (n - 2 k).
    fn triangles_before(&self, ring: u32) -> u32 {
        6 * (ring - 2) * (self.inside.context.points - ring - 1)
    }

    fn centre_triangle(&self, innermost: u32, step: u32) -> Option<Triangle> {
        let has_centre = self.inside.context.parity == Parity::Odd && step == 0;
        has_centre.then(|| centre_triangle(innermost))
    }
}

impl ClosedForms<4> for QuadFactors<ProcessedFactor> {
    fn rings(&self) -> Rings<'_, 4> {
        quad::rings(self)
    }

    fn points_before(&self, ring: u32) -> u32 {
        quad_points_before(&Inside::new(self), ring)
    }

    /// The sum of 2 * 2 (nU - 2 k) + 2 * 2 (nV - 2 k).
    fn triangles_before(&self, ring: u32) -> u32 {
        let Inside { u, v } = Inside::new(self);
        4 * (ring - 2) * (u.points + v.points - 2 * ring - 2)
    }

    fn centre_triangle(&self, innermost: u32, step: u32) -> Option<Triangle> {
        centre_strip::triangle(&Inside::new(self), innermost, step)
    }
}

/// The origin of triangle `t`: in a transition, in a ring stitch, or in the centre.
pub(crate) fn locate<const EDGES: usize>(
    patch: &impl ClosedForms<EDGES>,
    t: u32,
) -> PrimitiveOrigin {
    let rings = patch.rings();
    let transitions: [u32; EDGES] =
        core::array::from_fn(|e| rings.outer[e].points + rings.along[e].points - 4);
    let Some(t) = t.checked_sub(transitions.iter().sum()) else {
        let (edge, step) = slot_of(t, transitions);
        return PrimitiveOrigin::Transition { edge, step };
    };
    let end = rings.end();
    let in_rings = patch.triangles_before(end);
    if t >= in_rings {
        return PrimitiveOrigin::Centre { step: t - in_rings };
    }
    // The search begins at 1 and stitches of rings at 2, hence both shifts by one.
    let ring = 1 + last_ring_at_or_before(t, end - 1, |r| patch.triangles_before(r + 1));
    let stitches: [u32; EDGES] = core::array::from_fn(|e| 2 * rings.inner_row_points(ring, e));
    let (edge, step) = slot_of(t - patch.triangles_before(ring), stitches);
    PrimitiveOrigin::Ring { ring, edge, step }
}

/// The triangle of an origin that [`locate`] gave, clockwise; `None` for another kind of origin.
pub(crate) fn triangle<const EDGES: usize>(
    patch: &impl ClosedForms<EDGES>,
    split: SplitOrder,
    location: PrimitiveOrigin,
) -> Option<Triangle> {
    let rings = patch.rings();
    match location {
        PrimitiveOrigin::Transition { edge, step } => {
            let edge = edge as usize;
            let (outer, inner) = rows(patch, &rings, 1, edge);
            let (edge, inside) = (rings.outer.get(edge)?, rings.along.get(edge)?);
            Some(stitch::transition_triangle((&outer, &inner), edge, inside, split, step))
        }
        PrimitiveOrigin::Ring { ring, edge, step } => {
            let edge = edge as usize;
            let (outer, inner) = rows(patch, &rings, ring, edge);
            let inner_points = rings.inner_row_points(ring, edge);
            Some(stitch::ring_triangle((&outer, &inner), inner_points, step))
        }
        PrimitiveOrigin::Centre { step } => {
            let innermost = first_of_ring(patch, &rings, rings.end() - 1);
            patch.centre_triangle(innermost, step)
        }
        PrimitiveOrigin::Sequence { .. }
        | PrimitiveOrigin::Line { .. }
        | PrimitiveOrigin::Minimum { .. } => None,
    }
}

/// The two rows of the stitch along `edge` between rings `ring - 1` and `ring`.
fn rows<const EDGES: usize>(
    patch: &impl ClosedForms<EDGES>,
    rings: &Rings<'_, EDGES>,
    ring: u32,
    edge: usize,
) -> (Row, Row) {
    let outer_sizes: [u32; EDGES] = core::array::from_fn(|e| rings.outer_row_points(ring, e));
    let inner_sizes: [u32; EDGES] = core::array::from_fn(|e| rings.inner_row_points(ring, e));
    let outer = ring_row(first_of_ring(patch, rings, ring - 1), &outer_sizes, edge);
    let inner_start = first_of_ring(patch, rings, ring);
    // The second long edge of a row walks it back, from where the first one ended.
    let inner = if rings.walks_back(ring, edge) {
        Row::descending(inner_start + points_before_edge(&inner_sizes, edge))
    } else {
        ring_row(inner_start, &inner_sizes, edge)
    };
    (outer, inner)
}

/// The first index of a ring; ring 0 is the outer one.
fn first_of_ring<const EDGES: usize>(
    patch: &impl ClosedForms<EDGES>,
    rings: &Rings<'_, EDGES>,
    ring: u32,
) -> u32 {
    if ring == 0 { 0 } else { rings.outer_points() + patch.points_before(ring) }
}

/// One edge of a ring that starts at index `start`; the last edge ends at `start` again.
fn ring_row<const EDGES: usize>(start: u32, sizes: &[u32; EDGES], edge: usize) -> Row {
    let row = Row::ascending(start + points_before_edge(sizes, edge));
    if edge == EDGES - 1 { row.with(sizes[edge] - 1, start) } else { row }
}

/// Points of a ring's earlier edges, each without its last point.
fn points_before_edge(sizes: &[u32], edge: usize) -> u32 {
    sizes[..edge].iter().map(|size| size - 1).sum()
}
