//! Which corners at one place belong to one sheet.
//!
//! Several sheets may meet at a place: the two sides of a leaf that has a face for each, two cones
//! tip to tip, a wall that stands on a floor. Their normals have nothing to do with each other, and
//! their sum may be zero. So the corners at a place are sorted into fans first: corners whose
//! patches are neighbours there.
//!
//! ```text
//!         \  A  /                A, B, C are neighbours at the edges that end here: one fan.
//!      C   \   /                 A', B', C' have the same corners in the opposite order, and are
//!    -------*-------             neighbours of each other: a second fan at the same place.
//!          / \   B
//! ```
//!
//! Most places have one sheet, which shows without any search: every corner's normal is within 90
//! degrees of their sum. Only the others ([`mixed`]) are sorted.

use crate::sides::{Sides, edge_corners};
use crate::topology::HalfEdge;
use alloc::vec::Vec;

/// The edges that end at a corner.
pub(crate) fn edges_at(sides: Sides<()>, corner: usize) -> impl Iterator<Item = usize> {
    let ends = edge_corners(&sides).iter().enumerate();
    ends.filter(move |(_, ends)| ends.contains(&corner)).map(|(edge, _)| edge)
}

/// The number of the first corner of the same fan, for each of the corners at one place.
///
/// Corners are slots ([`HalfEdge::slot`] of the edge with the corner's number), in ascending order.
/// `beyond` has the half-edges on the other side of an edge whose patches join there.
pub(crate) fn fans<I: Iterator<Item = HalfEdge>>(
    corners: &[u32],
    sides: impl Fn(usize) -> Sides<()>,
    beyond: impl Fn(HalfEdge) -> I,
) -> Vec<usize> {
    let mut firsts: Vec<usize> = (0..corners.len()).collect();
    for (at, &slot) in corners.iter().enumerate() {
        let HalfEdge { patch, edge: corner } = HalfEdge::of_slot(slot);
        for other in
            edges_at(sides(patch), corner).flat_map(|edge| beyond(HalfEdge { patch, edge }))
        {
            for end in edge_corners(&sides(other.patch))[other.edge] {
                let slot = HalfEdge { patch: other.patch, edge: end }.slot();
                if let Ok(neighbour) = corners.binary_search(&slot) {
                    unite(&mut firsts, at, neighbour);
                }
            }
        }
    }
    (0..corners.len()).map(|at| first(&firsts, at)).collect()
}

fn first(firsts: &[usize], mut at: usize) -> usize {
    while firsts[at] != at {
        at = firsts[at];
    }
    at
}

fn unite(firsts: &mut [usize], one: usize, other: usize) {
    let (one, other) = (first(firsts, one), first(firsts, other));
    firsts[one.max(other)] = one.min(other);
}

/// The corners at mixed places, place by place, each in ascending order. `corners` has the place
/// and the slot of each corner; `is_mixed` is asked about places.
pub(crate) fn mixed(
    corners: impl Iterator<Item = (u32, u32)>,
    is_mixed: &[bool],
) -> Vec<(u32, u32)> {
    let mut found: Vec<_> = corners.filter(|&(place, _)| is_mixed[place as usize]).collect();
    found.sort_unstable();
    found
}
