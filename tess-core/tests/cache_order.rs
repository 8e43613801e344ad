//! The vertex-cache order lists every triangle once and reuses vertices soon.

use std::collections::VecDeque;
use tess_core::cache_order::CacheOrder;
use tess_core::{
    Config, Domain, OutputPrimitive, Partitioning, Patch, PatchFactors, ProcessedPatch,
    QuadFactors, TriangleFactors,
};

fn config() -> Config {
    Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw)
}

/// The triangle at each place of the vertex-cache order.
fn drawn(patch: &Patch) -> Vec<u32> {
    let count = patch.counts().primitives;
    let mut drawn = vec![None; count as usize];
    for t in 0..count {
        let position = patch.cache_position(t).expect("a triangle of the patch");
        let place = drawn.get_mut(position as usize);
        let place = place.unwrap_or_else(|| panic!("triangle {t} of {count} is at {position}"));
        assert_eq!(place.replace(t), None, "two triangles at {position}: {t} is the second");
    }
    assert_eq!(patch.cache_position(count), None, "one past the end");
    drawn.into_iter().flatten().collect()
}

/// The same by runs, with the triangles inside the innermost ring at the end.
fn run_by_run(patch: &Patch) -> Vec<u32> {
    let mut drawn = Vec::new();
    let add = |range: std::ops::Range<u32>| {
        assert!(!range.is_empty(), "{range:?} is a run");
        drawn.extend(range);
    };
    match patch.processed() {
        ProcessedPatch::Regular(PatchFactors::Triangle(factors)) => {
            let outer = factors.outer().map(|factor| factor.context.points);
            CacheOrder::new(outer, [factors.inside.context.points; 2]).runs(add);
        }
        ProcessedPatch::Regular(PatchFactors::Quad(factors)) => {
            let outer = factors.outer().map(|factor| factor.context.points);
            let inside = factors.inside().map(|factor| factor.context.points);
            CacheOrder::new(outer, inside).runs(add);
        }
        _ => {}
    }
    let rings = u32::try_from(drawn.len()).expect("a patch");
    drawn.extend(rings..patch.counts().primitives);
    drawn
}

fn quad(outer: [u32; 4], inside: [u32; 2]) -> Patch {
    let [u0, v0, u1, v1] = outer.map(|factor| factor as f32);
    let [inside_u, inside_v] = inside.map(|factor| factor as f32);
    Patch::new(config(), QuadFactors { u0, v0, u1, v1, inside_u, inside_v })
}

fn triangle(outer: [u32; 3], inside: u32) -> Patch {
    let [u0, v0, w0] = outer.map(|factor| factor as f32);
    Patch::new(config(), TriangleFactors { u0, v0, w0, inside: inside as f32 })
}

/// Every pair of inside factors with every outer factor on some edge, and all factors equal.
#[test]
fn every_triangle_is_drawn_once() {
    for u in 1..=64 {
        for v in 1..=64 {
            let outer = [u, v, (u * 7 + v) % 64 + 1, (v * 5 + u) % 64 + 1];
            let patch = quad(outer, [u, v]);
            assert_eq!(drawn(&patch), run_by_run(&patch), "quad {outer:?} {u} {v}");
        }
        for outer in 1..=64 {
            let outer = [outer, u, (outer * 7 + u) % 64 + 1];
            let patch = triangle(outer, u);
            assert_eq!(drawn(&patch), run_by_run(&patch), "triangle {outer:?} {u}");
        }
    }
}

/// Counts the vertices that are not among the last 32 when they are needed.
fn misses(patch: &Patch, order: impl Iterator<Item = u32>) -> usize {
    let mut recent = VecDeque::new();
    let mut misses = 0;
    for t in order {
        let primitive = patch.primitive(t).expect("a triangle of the patch");
        for index in primitive.indices() {
            if !recent.contains(index) {
                misses += 1;
                recent.push_back(*index);
                if recent.len() > 32 {
                    recent.pop_front();
                }
            }
        }
    }
    misses
}

/// At least a quarter of the vertices need not be computed again.
#[test]
fn vertices_come_back_soon() {
    for factor in [12, 16, 64] {
        for patch in [quad([factor; 4], [factor; 2]), triangle([factor; 3], factor)] {
            let ring_by_ring = misses(&patch, 0..patch.counts().primitives);
            let drawn = misses(&patch, drawn(&patch).into_iter());
            assert!(4 * drawn < 3 * ring_by_ring, "{factor}: {drawn} against {ring_by_ring}");
        }
    }
}

/// Lines, points, isolines and minimum patches keep the specification's order.
#[test]
fn what_has_no_rings_keeps_its_order() {
    for output in [OutputPrimitive::Point, OutputPrimitive::Line] {
        for domain in Domain::ALL {
            let factors = PatchFactors::uniform(domain, 9.0);
            let patch = Patch::new(Config::new(Partitioning::Integer, output), factors);
            for t in 0..patch.counts().primitives {
                assert_eq!(patch.cache_position(t), Some(t), "{domain:?} {output:?}");
            }
        }
    }
    assert_eq!(drawn(&quad([1; 4], [1; 2])), [0, 1]);
}

#[test]
fn counts_that_no_patch_has_count_as_the_nearest() {
    for (count, nearest) in [(0, 3), (2, 3), (66, 65), (u32::MAX, 65)] {
        let order = CacheOrder::new([count; 4], [count; 2]);
        let outer = if count == 0 { 2 } else { nearest.min(count) };
        assert_eq!(order, CacheOrder::new([outer; 4], [nearest; 2]), "{count} points");
        order.runs(|run| assert!(!run.is_empty(), "{count} points: {run:?}"));
    }
}
