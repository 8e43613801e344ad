//! The grouping of corners at one place into sheets.
//!
//! Several sheets may meet at a place: the two sides of a leaf that has a face for each side, two
//! cones tip to tip, a wall on a floor. Their normals are unrelated, and the sum may be zero. The
//! corners at a place are therefore first grouped into fans: corners whose patches are neighbours
//! there.
//!
//! ```text
//!         \  A  /                A, B, C are neighbours at the edges that end here: one fan.
//!      C   \   /                 A', B', C' have the same corners in the opposite order, and are
//!    -------*-------             neighbours of each other: a second fan at the same place.
//!          / \   B
//! ```
//!
//! Most places have one sheet. These are recognised without a search: every corner's normal is
//! within 90 degrees of the sum. Only the other places ([`mixed`]) are grouped.

use crate::sides::{Sides, edge_corners};
use crate::topology::HalfEdge;
use alloc::vec::Vec;

/// The edges that end at a corner.
pub(crate) fn edges_at(sides: Sides<()>, corner: usize) -> impl Iterator<Item = usize> {
    let ends = edge_corners(&sides).iter().enumerate();
    ends.filter(move |(_, ends)| ends.contains(&corner)).map(|(edge, _)| edge)
}

/// For each of the corners at one place, the number of the first corner of the same fan.
///
/// Corners are slots ([`HalfEdge::slot`] of the edge with the corner's number), in ascending order.
/// `beyond` gives the half-edges on the other side of an edge, of patches that belong to the same
/// fan.
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

/// The corners at mixed places, in ascending order of the place and then of the slot. `corners` has
/// the place and the slot of each corner; `is_mixed` is indexed by place.
pub(crate) fn mixed(
    corners: impl Iterator<Item = (u32, u32)>,
    is_mixed: &[bool],
) -> Vec<(u32, u32)> {
    let mut found: Vec<_> = corners.filter(|&(place, _)| is_mixed[place as usize]).collect();
    found.sort_unstable();
    found
}
