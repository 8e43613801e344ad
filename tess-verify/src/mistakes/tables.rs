//! Mistakes: one number of a table is wrong. The tables are those of edges and isolines; another
//! table may serve the inside.

use super::family::Family;
use super::places::{edge_points, outer, place_along};
use crate::case::Case;
use tess_core::fixed_point::ONE;
use tess_core::place::place;
use tess_core::reciprocal::reciprocal;
use tess_core::{Domain, FactorContext, Tessellation};

pub(super) fn all() -> Vec<Family> {
    // The only vertex between the ends of two segments is in the exact middle.
    let reciprocals = (3..64).fold(
        Family::new("a number of segments has its neighbour's reciprocal"),
        |family, n| {
            let [own, next] = [n, n + 1].map(|n| reciprocal(n).unwrap_or_default());
            spoils(family, format!("{n} segments"), move |context| {
                let change = |number: &mut u32| {
                    if *number == own {
                        *number = next;
                    }
                };
                change(&mut context.inv_floor);
                change(&mut context.inv_ceil);
            })
        },
    );
    // A half edge of one or two points has no other position to split.
    let splits =
        (3..=32).fold(Family::new("a half edge is split at the next position"), |family, n| {
            spoils(family, format!("{n} points"), move |context| {
                let is_split = context.split_position <= context.half_points;
                if context.half_points == n && is_split {
                    let next = context.split_position + 1;
                    context.split_position = if next > n { 1 } else { next };
                }
            })
        });
    let free = "the location of the shorter segments is implementation-dependent (22.3)";
    vec![reciprocals, splits.vulkan_allows("", free)]
}

/// Adds a mistake: edges and isolines are divided according to another context.
fn spoils(
    family: Family,
    variant: String,
    change: impl Fn(&mut FactorContext) + Send + Sync + 'static,
) -> Family {
    family.answers(variant, move |case, output| {
        for edge in 0..divided(case) {
            if let Some(places) = other_places(case, edge, &change) {
                move_line(case, output, edge, &places);
            }
        }
    })
}

/// The number of lines whose division can differ: a patch of isolines has one for all of its lines.
fn divided(case: &Case) -> usize {
    if case.domain() == Domain::Isoline { 1 } else { outer(case) }
}

/// The places along a line after a change of its context; `None` if that does not change.
fn other_places(
    case: &Case,
    edge: usize,
    change: &impl Fn(&mut FactorContext),
) -> Option<Vec<u32>> {
    let patch = case.patch();
    let factors = patch.processed().factors()?;
    let number = if case.domain() == Domain::Isoline { 1 } else { edge };
    let right = factors.iter().nth(number)?.context;
    let mut wrong = right;
    change(&mut wrong);
    (wrong != right).then(|| (0..wrong.points).map(|p| place(&wrong, p).to_bits()).collect())
}

/// Moves the inner points of a line to other places.
fn move_line(case: &Case, output: &mut Tessellation, edge: usize, places: &[u32]) {
    if case.domain() == Domain::Isoline {
        for line in output.points.chunks_mut(places.len()) {
            for (point, &u) in line.iter_mut().zip(places).filter(|(_, u)| **u > 0 && **u < ONE) {
                *point = tess_core::DomainPoint::from_bits(u, point.v.to_bits());
            }
        }
        return;
    }
    if edge_points(case, output, edge).len() == places.len() {
        place_along(case, output, edge, |k, _| places[k]);
    }
}
