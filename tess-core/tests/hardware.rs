//! Section 14 of the specification, "For hardware": computes every number in it, and compares every
//! formula with the model.

use std::fmt::Write as _;
use tess_core::place::placement;
use tess_core::ruler::rank;
use tess_core::stitch::transition;
use tess_core::{
    Config, Domain, FactorContext, FixedFactor, OutputPrimitive, Parity, Partitioning, Patch,
    PatchFactors, PointOrigin, QuadFactors, Side, SplitOrder, Step, TriangleFactors,
};

const ONE: u32 = 0x10000;

/// The section's text; a table row or formula that it lacks has changed.
fn section() -> String {
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/specification.md");
    let text = std::fs::read_to_string(path).expect("the specification");
    let (_, section) = text.split_once("\n## 14. ").expect("section 14");
    section.to_owned()
}

/// Fails with the row that the specification should have.
fn expect_row(row: &str) {
    assert!(section().lines().any(|line| line == row), "section 14 lacks the row\n{row}");
}

/// The smallest and the largest value seen.
#[derive(Clone, Copy)]
struct Range {
    least: u32,
    most: u32,
}

impl Range {
    const NONE: Self = Self { least: u32::MAX, most: 0 };

    fn see(&mut self, value: u32) {
        self.least = self.least.min(value);
        self.most = self.most.max(value);
    }

    /// The row of a value: its range and the bits of its maximum.
    fn row(self, name: &str) -> String {
        let shown = |value: u32| match value {
            0..=4225 => value.to_string(),
            _ => format!("0x{value:X}"),
        };
        let bits = u32::BITS - self.most.leading_zeros();
        format!("| {name} | {} | {} | {bits} |", shown(self.least), shown(self.most))
    }
}

/// Every factor that reaches the contexts, of each parity and in each split order.
fn every_context(mut see: impl FnMut(FixedFactor, &FactorContext)) {
    for split in SplitOrder::ALL {
        for (parity, least, most) in [(Parity::Odd, 1, 63), (Parity::Even, 2, 64)] {
            for bits in least * ONE..=most * ONE {
                let factor = FixedFactor::from_bits(bits);
                see(factor, &FactorContext::new(factor, parity, split));
            }
        }
    }
}

/// 14.1, the front end.
#[test]
fn contexts_have_the_widths_that_the_specification_says() {
    let mut ranges = [Range::NONE; 7];
    every_context(|factor, context| {
        let FactorContext {
            inv_floor,
            inv_ceil,
            fraction,
            half_points,
            split_position,
            points,
            ..
        } = *context;
        let values =
            [factor.to_bits(), fraction, half_points, split_position, inv_floor, inv_ceil, points];
        for (range, value) in ranges.iter_mut().zip(values) {
            range.see(value);
        }
        assert_eq!(points, 2 * half_points + 1 - context.parity.odd(), "points from half_points");
    });
    let names = ["f", "fraction", "half_points", "split", "inv_floor", "inv_ceil", "points"];
    for (name, range) in names.iter().zip(ranges) {
        expect_row(&range.row(name));
    }
}

/// 14.1, the placer. Within a half edge `a` and `b` do not decrease, so each of them, and their
/// weighted sum, is largest at the last position.
#[test]
fn placements_have_the_widths_that_the_specification_says() {
    let [mut a, mut b, mut sum, mut x] = [Range::NONE; 4];
    let [mut position, mut mirrored] = [Range::NONE; 2];
    every_context(|_, context| {
        position.see(context.points - 1);
        mirrored.see(placement(context, context.half_points).position);
        mirrored.see(placement(context, context.points / 2).position);
        for p in [0, context.half_points - 1] {
            let blend = placement(context, p).blend.expect("a position before the middle");
            a.see(blend.coarse);
            b.see(blend.fine);
            let weighted = blend.coarse * (ONE - blend.fraction) + blend.fine * blend.fraction;
            sum.see(weighted + ONE / 2);
            x.see(blend.half_location());
        }
    });
    for (name, range) in [("a", a), ("b", b), ("sum", sum), ("x", x)] {
        expect_row(&range.row(name));
    }
    let bits = [position, mirrored].map(|range| u32::BITS - range.most.leading_zeros());
    assert_eq!(bits, [7, 6], "bits of a position, and of a mirrored one");
}

/// The assumption of the test above, for every factor with few fraction bits.
#[test]
fn places_do_not_decrease_along_a_half_edge() {
    for split in SplitOrder::ALL {
        for (parity, least, most) in [(Parity::Odd, 1, 63), (Parity::Even, 2, 64)] {
            for bits in (least * ONE..=most * ONE).step_by(0x155) {
                let context = FactorContext::new(FixedFactor::from_bits(bits), parity, split);
                let places: Vec<_> =
                    (0..context.half_points).filter_map(|p| placement(&context, p).blend).collect();
                assert!(
                    places.is_sorted_by(
                        |one, next| one.coarse <= next.coarse && one.fine <= next.fine
                    ),
                    "{bits:#x}, {split:?}"
                );
            }
        }
    }
}

fn patch(partitioning: Partitioning, factors: impl Into<PatchFactors>) -> Patch {
    Patch::new(Config::new(partitioning, OutputPrimitive::TriangleCw), factors)
}

/// 14.1, the interior of triangles: the two products of a ring's location.
#[test]
fn ring_locations_have_the_widths_that_the_specification_says() {
    let [mut perp, mut shift] = [Range::NONE; 2];
    every_context(|_, context| {
        for ring in 1..context.points / 2 {
            // Rings are on the first half of the edge, where places do not decrease.
            if ring == 1 || ring + 1 == context.points / 2 {
                let place = placement(context, ring).location.to_bits();
                let location = (place * 0xAAAA + ONE / 2) >> 16;
                perp.see(location);
                shift.see(location.div_ceil(2));
            }
        }
    });
    expect_row(&perp.row("perp"));
    expect_row(&shift.row("shift"));
}

/// 14.2: where each interior ring begins, from only the counts.
fn first_of_ring(domain: Domain, [n_u, n_v]: [u32; 2], outer: u32, ring: u32) -> u32 {
    let before = ring - 1;
    match domain {
        Domain::Triangle => outer + before * (3 * n_u - 3) - 3 * ring * before,
        _ => outer + before * (2 * (n_u + n_v) - 4) - 4 * ring * before,
    }
}

/// Points of ring `ring` (from 1), if the ring is not a row.
fn points_of_ring(domain: Domain, [n_u, n_v]: [u32; 2], ring: u32) -> u32 {
    match domain {
        Domain::Triangle => 3 * (n_u - 1 - 2 * ring),
        _ => 2 * (n_u + n_v - 2 - 4 * ring),
    }
}

#[test]
fn rings_begin_where_the_specification_says() {
    let mut rings_seen = 0;
    for (u, v) in (2..=33).flat_map(|u| (2..=33).map(move |v| (u, v))).chain([(64, 64), (64, 63)]) {
        let [inside_u, inside_v] = [u, v].map(f32::from);
        let outer = [5.0, 2.0, 7.0, 1.0];
        let quad = QuadFactors {
            u0: outer[0],
            v0: outer[1],
            u1: outer[2],
            v1: outer[3],
            inside_u,
            inside_v,
        };
        let triangle =
            TriangleFactors { u0: outer[0], v0: outer[1], w0: outer[2], inside: inside_u };
        let [n_u, n_v] = [u, v].map(|factor: u16| u32::from(factor) + 1);
        let patches = [
            (Domain::Quad, PatchFactors::from(quad), [n_u, n_v], 15),
            (Domain::Triangle, triangle.into(), [n_u, n_u], 14),
        ];
        for (domain, factors, counts, outer_points) in patches {
            let patch = patch(Partitioning::Integer, factors);
            for ring in 1..counts[0].min(counts[1]) / 2 {
                let first = first_of_ring(domain, counts, outer_points, ring);
                let origin = patch.locate_point(first);
                assert_eq!(origin, Some(PointOrigin::Ring { ring, edge: 0, p: 0 }), "{factors:?}");
                let after = first + points_of_ring(domain, counts, ring);
                let origin = patch.locate_point(after);
                assert!(
                    !matches!(origin, Some(PointOrigin::Ring { ring: same, .. }) if same == ring),
                    "{factors:?}: ring {ring} ends before {after}"
                );
                rings_seen += 1;
            }
        }
    }
    assert!(rings_seen > 5000, "only {rings_seen} rings were compared");
}

/// 14.2, from a point's number to its origin: five comparisons find the ring, and subtractions find
/// the edge and the position.
fn origin(domain: Domain, counts: [u32; 2], outer: u32, number: u32) -> PointOrigin {
    let rings = counts[0].min(counts[1]) / 2 - 1;
    if rings == 0 {
        return PointOrigin::Centre { p: number - outer };
    }
    let mut ring = 0;
    for step in [16, 8, 4, 2, 1] {
        let next = ring + step;
        if next <= rings && first_of_ring(domain, counts, outer, next) <= number {
            ring = next;
        }
    }
    let mut p = number - first_of_ring(domain, counts, outer, ring);
    let edges = if domain == Domain::Triangle { 3 } else { 4 };
    for edge in 0..edges {
        let along = counts[usize::from(domain == Domain::Quad && edge % 2 == 0)];
        let points = along - 1 - 2 * ring;
        if p < points {
            return PointOrigin::Ring { ring, edge, p };
        }
        p -= points;
    }
    PointOrigin::Centre { p }
}

#[test]
fn origins_follow_from_point_numbers() {
    let (mut points, mut rings) = (0, 0);
    for (u, v) in [(2, 2), (3, 2), (9, 4), (4, 9), (12, 12), (31, 30), (63, 64), (64, 64), (64, 63)]
    {
        for domain in [Domain::Triangle, Domain::Quad] {
            let factors = PatchFactors::from_fn(domain, |i| match i {
                0..3 => 3.0,
                3 if domain == Domain::Quad => 3.0,
                5 => f32::from(v),
                _ => f32::from(u),
            });
            let patch = patch(Partitioning::Integer, factors);
            let n_v = if domain == Domain::Quad { v } else { u };
            let counts = [u, n_v].map(|factor: u16| u32::from(factor) + 1);
            let outer = if domain == Domain::Quad { 12 } else { 9 };
            for number in outer..patch.counts().points {
                let expected = origin(domain, counts, outer, number);
                assert_eq!(patch.locate_point(number), Some(expected), "{factors:?}: {number}");
                points = points.max(number);
                if let PointOrigin::Ring { ring, .. } = expected {
                    rings = rings.max(ring);
                }
            }
        }
    }
    let largest = PatchFactors::uniform(Domain::Quad, 64.0);
    points = points.max(patch(Partitioning::Integer, largest).counts().points - 1);
    let bits = |most: u32| u32::BITS - most.leading_zeros();
    assert_eq!([bits(points), bits(rings)], [13, 5], "bits of point and ring numbers");
}

/// 14.3: bit k - 1 is set if position k of a half edge of `n` half steps has a point.
fn mask(split: SplitOrder, n: u32) -> u32 {
    (1..=32).filter(|&k| rank(split, k).is_some_and(|rank| rank < n)).map(|k| 1 << (k - 1)).sum()
}

#[test]
fn masks_are_those_of_the_specification() {
    for n in (0..=32).step_by(4) {
        let mut row = String::from("|");
        for n in n..(n + 4).min(33) {
            write!(row, " {n} | {:08X} |", mask(SplitOrder::Ruler, n)).expect("text");
        }
        expect_row(&row);
    }
    for n in 0..=32_u32 {
        for split in SplitOrder::ALL {
            assert_eq!(mask(split, n).count_ones(), n.saturating_sub(1), "bits of mask({n})");
        }
        let center = 1_u32.checked_shl(n.saturating_sub(1)).map_or(u32::MAX, |bit| bit - 1);
        assert_eq!(mask(SplitOrder::Centre, n), center, "the first n - 1 bits");
    }
}

/// The rows that advance in a transition, found by the next set bit, with one triangle per
/// iteration.
fn by_next_bit(split: SplitOrder, outer_points: u32, inside_points: u32) -> Vec<Side> {
    let [oh, ih] = [outer_points, inside_points].map(|points| (points - 1) / 2);
    let [outer_mask, inner_mask] = [oh, ih].map(|half| mask(split, half));
    let mut sides = vec![Side::Outer; usize::from(oh > 0)];
    let (mut outer, mut inner) = (outer_mask, inner_mask);
    while outer | inner != 0 {
        let bit = 1 << (outer | inner).trailing_zeros();
        // At one position the inner row comes first,
        let (mask, side) =
            if inner & bit != 0 { (&mut inner, Side::Inner) } else { (&mut outer, Side::Outer) };
        *mask ^= bit;
        sides.push(side);
    }
    sides.extend(inside_points.is_multiple_of(2).then_some(Side::Inner));
    sides.extend(outer_points.is_multiple_of(2).then_some(Side::Outer));
    let (mut outer, mut inner) = (outer_mask, inner_mask);
    while outer | inner != 0 {
        let bit = 1 << (31 - (outer | inner).leading_zeros());
        // and on the way back the outer row.
        let (mask, side) =
            if outer & bit != 0 { (&mut outer, Side::Outer) } else { (&mut inner, Side::Inner) };
        *mask ^= bit;
        sides.push(side);
    }
    sides.extend((oh > 0).then_some(Side::Outer));
    sides
}

#[test]
fn the_next_set_bit_walks_every_transition() {
    for split in SplitOrder::ALL {
        for (outer, inside) in (2..=65).flat_map(|outer| (3..=65).map(move |i| (outer, i))) {
            let mut expected = Vec::new();
            transition(split, outer, inside, |step: Step| expected.push(step.advances));
            assert_eq!(by_next_bit(split, outer, inside), expected, "{outer} to {inside}");
            let [oh, ih] = [outer, inside].map(|points| (points - 1) / 2);
            let way_out = &expected[..(oh + ih.saturating_sub(1)) as usize];
            let on_outer = way_out.iter().filter(|side| **side == Side::Outer).count();
            assert_eq!(on_outer, oh as usize, "{outer} to {inside}: the way out");
        }
    }
}

/// Points, primitives and indices of the largest patch: no factors give more than the largest ones
/// do, because every formula of section 12.6 grows with each count.
#[test]
fn the_largest_outputs_are_those_of_the_specification() {
    let names = ["isoline", "triangle", "quad"];
    for (domain, name) in [Domain::Isoline, Domain::Triangle, Domain::Quad].into_iter().zip(names) {
        for (output, primitive) in [
            (OutputPrimitive::Point, "points"),
            (OutputPrimitive::Line, "lines"),
            (OutputPrimitive::TriangleCw, "triangles"),
        ] {
            if domain == Domain::Isoline && output == OutputPrimitive::TriangleCw {
                continue; // gives lines
            }
            let config = Config::new(Partitioning::Integer, output);
            let counts = Patch::new(config, PatchFactors::from_fn(domain, |_| 64.0)).counts();
            expect_row(&format!(
                "| {name} | {primitive} | {} | {} | {} |",
                counts.points, counts.primitives, counts.indices
            ));
        }
    }
}

/// 14.4: the largest distance between the indices of a triangle.
#[test]
fn the_spread_of_a_triangle_is_that_of_the_specification() {
    for (domain, name) in [(Domain::Triangle, "triangle"), (Domain::Quad, "quad")] {
        let factors = PatchFactors::from_fn(domain, |_| 64.0);
        let whole = patch(Partitioning::Integer, factors).tessellate();
        let spread = |triangle: &[u32; 3]| {
            triangle.iter().max().expect("three") - triangle.iter().min().expect("three")
        };
        let most = whole.indices.as_chunks().0.iter().map(spread).max().expect("triangles");
        expect_row(&format!("| {name} | {most} |"));
    }
}
