//! Mistakes: lines that are divided as under another spacing or another split order.

#![expect(clippy::float_arithmetic, clippy::float_cmp, reason = "a mistake in binary32")]

use super::family::Family;
use super::places::{edge_points, move_all, one, outer, place_along, with_config};
use crate::case::Case;
use crate::names::Named;
use std::collections::BTreeSet;
use tess_core::fixed_point::ONE;
use tess_core::place::place;
use tess_core::{
    Config, Domain, DomainPoint, FactorContext, FixedFactor, Parity, Partitioning, SplitOrder,
};

pub(super) fn all() -> Vec<Family> {
    vec![whole_patch(), density(), edge(), inside(), split(), split_of_edge()]
}

const SPACINGS: [Partitioning; 3] =
    [Partitioning::Integer, Partitioning::FractionalOdd, Partitioning::FractionalEven];

fn whole_patch() -> Family {
    SPACINGS.into_iter().fold(Family::new("another spacing is used"), |mistake, spacing| {
        mistake.asks(spacing.name(), move |case| {
            with_config(case, |config| Config { partitioning: spacing, ..config })
        })
    })
}

/// The number of isolines rounded according to the spacing of their segments.
fn density() -> Family {
    Family::new("the number of isolines follows the spacing").asks("density", |case| {
        let odd = case.config.partitioning == Partitioning::FractionalOdd;
        let even = case.config.partitioning == Partitioning::FractionalEven;
        if case.domain() != Domain::Isoline || !(odd || even) {
            return *case;
        }
        one(case, 0, |level| {
            let up = level.ceil();
            let is_odd = up % 2.0 == 1.0;
            if level > 0.0 && is_odd != odd { up + 1.0 } else { level }
        })
    })
}

/// Places along a line of n segments under another spacing with as many segments: equal, or two
/// shorter ones.
fn other_places(case: &Case, n: usize) -> Vec<u32> {
    let number = u32::try_from(n).expect("at most 64");
    let parity = if n.is_multiple_of(2) { Parity::Even } else { Parity::Odd };
    // In place of fractional spacing, equal segments; in place of equal spacing, two that are
    // shorter.
    let less = if case.config.partitioning.has_integer_factors() { 0x8000 } else { 0 };
    let fixed = FixedFactor::from_bits((number << 16) - less);
    let context = FactorContext::new(fixed, parity, SplitOrder::Ruler);
    (0..=number).map(|p| place(&context, p).to_bits()).collect()
}

fn edge() -> Family {
    let name = "an edge is spaced by another mode, with as many segments";
    (0..4).fold(Family::new(name), |mistake, edge| {
        mistake.answers(format!("edge {edge}"), move |case, output| {
            if case.domain() == Domain::Isoline || edge >= outer(case) || output.points.is_empty() {
                return;
            }
            let n = edge_points(case, output, edge).len() - 1;
            let places = other_places(case, n);
            // With fractional spacing, all lengths of 3 segments belong to some level.
            place_along(case, output, edge, |k, _| places[k]);
        })
    })
}

/// The columns, rows or rings of the inside, divided by another spacing.
fn inside() -> Family {
    let name = "the inside is spaced by another mode, with as many segments";
    (0..2).fold(Family::new(name), |mistake, axis| {
        mistake.answers(format!("axis {axis}"), move |case, output| {
            if case.domain() != Domain::Quad {
                return;
            }
            let is_inside = |[u, v]: [u32; 2]| u != 0 && v != 0 && u != ONE && v != ONE;
            let own = |point: &DomainPoint| [point.u.to_bits(), point.v.to_bits()];
            let inside = output.points.iter().map(own).filter(|place| is_inside(*place));
            let along: BTreeSet<u32> = inside.map(|place| place[axis]).collect();
            let along: Vec<u32> = along.into_iter().collect();
            let places = other_places(case, along.len() + 1);
            move_all(output, |mut place| {
                if let (true, Ok(k)) = (is_inside(place), along.binary_search(&place[axis])) {
                    place[axis] = places[k + 1];
                }
                place
            });
        })
    })
}

fn split() -> Family {
    Family::new("new vertices are split off from the centre outwards (section 10)")
        .asks("center", |case| {
            with_config(case, |config| Config { split: SplitOrder::Centre, ..config })
        })
        .vulkan_allows(
            "",
            "the location of the shorter segments is implementation-dependent (22.3), and so are the \
             triangles (22.6, 22.7)",
        )
}

/// The shorter segments of one edge at the places of the other split order.
fn split_of_edge() -> Family {
    let name = "the shorter segments of one edge are at another place";
    (0..4).fold(Family::new(name), |mistake, edge| {
        mistake.answers(format!("edge {edge}"), move |case, output| {
            if case.domain() == Domain::Isoline || edge >= outer(case) || output.points.is_empty() {
                return;
            }
            let other = with_config(case, |config| Config { split: SplitOrder::Centre, ..config });
            let center = other.patch().tessellate();
            let there = edge_points(&other, &center, edge);
            let along = |i: &usize| {
                let [u, v] = [center.points[*i].u.to_bits(), center.points[*i].v.to_bits()];
                let is_across = edge == 0 || edge == 2 && case.domain() == Domain::Quad;
                if is_across { v } else { u }
            };
            let places: Vec<u32> = there.iter().map(along).collect();
            place_along(case, output, edge, |k, own| places.get(k).copied().unwrap_or(own));
        })
    })
}
