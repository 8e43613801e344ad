//! Both formulations give the same elements: on every topology, and on random patches.

#[path = "common/shown.rs"]
mod shown;

use proptest::prelude::*;
use shown::shown;
use tess_core::{
    Config, DomainPoint, IsolineFactors, OutputPrimitive, Partitioning, Patch, PatchFactors,
    Primitive, QuadFactors, Sink, SplitOrder, TriangleFactors,
};
use tess_testkit::strategies;

/// The sequential formulation's elements, primitives kept apart.
#[derive(Clone, Default)]
struct Elements {
    points: Vec<DomainPoint>,
    primitives: Vec<Primitive>,
}

impl Sink for Elements {
    fn point(&mut self, point: DomainPoint) {
        self.points.push(point);
    }

    fn primitive(&mut self, primitive: Primitive) {
        self.primitives.push(primitive);
    }
}

impl Elements {
    fn of(patch: &Patch) -> Self {
        let mut elements = Self::default();
        patch.emit(&mut elements);
        elements
    }
}

/// The first element that random access gives differently, including one past the end, with its
/// origin.
fn first_difference(patch: &Patch, sequential: &Elements) -> Option<String> {
    fn differ<T: Copy + PartialEq>(
        sequential: &[T],
        access: impl Fn(u32) -> Option<T>,
        describe: impl Fn(u32, [Option<T>; 2]) -> String,
    ) -> Option<String> {
        let expected = sequential.iter().copied().map(Some).chain([None]);
        let mut elements = (0u32..).zip(expected).map(|(i, expected)| (i, access(i), expected));
        let (i, random, expected) = elements.find(|(_, random, expected)| random != expected)?;
        Some(describe(i, [random, expected]))
    }
    let of_point = |i, points: [Option<DomainPoint>; 2]| {
        let [random, sequential] = points.map(|point| point.map_or("none".into(), shown));
        let origin = patch.locate_point(i);
        format!("point {i} ({origin:?}): random access {random}, sequential {sequential}")
    };
    let of_primitive = |t, [random, sequential]: [Option<Primitive>; 2]| {
        let origin = patch.locate_primitive(t);
        format!("primitive {t} ({origin:?}): random access {random:?}, sequential {sequential:?}")
    };
    differ(&sequential.points, |i| patch.point(i), of_point)
        .or_else(|| differ(&sequential.primitives, |t| patch.primitive(t), of_primitive))
}

fn assert_equal(config: Config, factors: PatchFactors) {
    let patch = Patch::new(config, factors);
    let difference = first_difference(&patch, &Elements::of(&patch));
    assert_eq!(difference, None, "{config:?} {factors:?}");
}

/// Integer factors have every parity and every number of half points that a factor can have, and a
/// patch's connectivity depends on nothing else (spec section 12.8).
fn integer(split: SplitOrder) -> Config {
    let (partitioning, output) = (Partitioning::Integer, OutputPrimitive::TriangleCw);
    Config { partitioning, output, split }
}

fn pairs() -> impl Iterator<Item = (u8, u8)> {
    (1..=64).flat_map(|a| (1..=64).map(move |b| (a, b)))
}

/// Factor `a` advanced by `step`, wrapping within 1..=64.
fn turned(a: u8, step: u8) -> f32 {
    f32::from((a - 1 + step) % 64 + 1)
}

#[test]
fn every_isoline() {
    for (density, detail) in pairs() {
        let factors = IsolineFactors { density: density.into(), detail: detail.into() };
        assert_equal(integer(SplitOrder::Ruler), PatchFactors::Isoline(factors));
    }
}

/// Every interior, and on each edge every pair of an outer and an inside factor.
#[test]
fn every_triangle_topology() {
    for split in SplitOrder::ALL {
        for (outer, inside) in pairs() {
            let [u0, v0, w0] = [0, 21, 42].map(|step| turned(outer, step));
            let factors = TriangleFactors { u0, v0, w0, inside: inside.into() };
            assert_equal(integer(split), PatchFactors::Triangle(factors));
        }
    }
}

/// Every interior, and on each edge every pair of an outer factor and the inside factor along it:
/// along u on the edges v = 0 and v = 1, whose outer factors vary with the other inside factor.
fn every_quad_topology(split: SplitOrder) {
    for (u, v) in pairs() {
        let factors = QuadFactors {
            u0: turned(u, 0),
            v0: turned(v, 0),
            u1: turned(u, 31),
            v1: turned(v, 32),
            inside_u: u.into(),
            inside_v: v.into(),
        };
        assert_equal(integer(split), PatchFactors::Quad(factors));
    }
}

#[test]
fn every_quad_topology_ruler() {
    every_quad_topology(SplitOrder::Ruler);
}

#[test]
fn every_quad_topology_center() {
    every_quad_topology(SplitOrder::Centre);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn any_factors_in_any_configuration(
        config in strategies::config(),
        factors in strategies::factors(),
    ) {
        assert_equal(config, factors);
    }
}

/// The comparison detects each kind of damage.
#[test]
fn damage_is_noticed() {
    let factors = TriangleFactors { u0: 3.0, v0: 4.0, w0: 5.0, inside: 6.0 };
    let patch = Patch::new(integer(SplitOrder::Ruler), PatchFactors::Triangle(factors));
    let good = Elements::of(&patch);
    assert_eq!(first_difference(&patch, &good), None, "undamaged");
    type Damage = fn(&mut Elements);
    let damages: [(Damage, &str); 6] = [
        (
            |e| e.points[7] = DomainPoint::from_bits(e.points[7].u.to_bits() ^ 1, 0),
            "point 7 (Some(OuterEdge { edge: 2, p: 0 })): random access (",
        ),
        (|e| _ = e.points.pop(), "point 30 (Some("),
        (|e| e.points.push(DomainPoint::default()), "point 31 (None): random access none, "),
        (|e| e.primitives.swap(0, 1), "primitive 0 (Some(Transition { edge: 0, step: 0 })): "),
        (|e| _ = e.primitives.pop(), "primitive 47 (Some("),
        (|e| e.primitives.push(Primitive::Triangle([0, 1, 2])), "primitive 48 (None): "),
    ];
    for (damage, expected) in damages {
        let mut damaged = good.clone();
        damage(&mut damaged);
        let found = first_difference(&patch, &damaged).unwrap_or_default();
        assert!(found.starts_with(expected), "{expected} was found as {found:?}");
    }
}
