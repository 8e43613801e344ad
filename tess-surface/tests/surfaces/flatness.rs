//! The flatness rule keeps its promise: no triangle is further from the surface than the tolerance.

use crate::models::models;
use glam::Vec3;
use tess_core::{Config, OutputPrimitive, Partitioning, Patch, PatchFactors, QuadFactors};
use tess_core::{Tessellation, TriangleFactors};
use tess_surface::{FactorRule, Model};

const INTEGER: Config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);

/// The largest distance between a triangle's points and the surface's at the same coordinates;
/// `None` if a factor is clamped.
fn deviation(model: &Model, rule: &FactorRule) -> Option<f32> {
    let mut largest = 0.0f32;
    for number in 0..model.len() {
        let factors = rule.factors(model, number, Partitioning::Integer);
        if factors.iter().any(|factor| factor >= 64.0) {
            return None;
        }
        let (patch, whole) = (model.patch(number), Patch::new(INTEGER, factors).tessellate());
        for corners in triangles(&whole) {
            let points = corners.map(|at| patch.position(at));
            for weights in [[0.5, 0.5, 0.0], [0.0, 0.5, 0.5], [0.5, 0.0, 0.5], [1.0 / 3.0; 3]] {
                let mix = |k: usize| (0..3).map(|c| corners[c][k] * weights[c]).sum::<f32>();
                let on_triangle: Vec3 = (0..3).map(|c| points[c] * weights[c]).sum();
                let surface = patch.frame(mix(0), mix(1)).position;
                largest = largest.max(surface.distance(on_triangle));
            }
        }
    }
    Some(largest)
}

fn triangles(whole: &Tessellation) -> impl Iterator<Item = [[f32; 2]; 3]> {
    let corners = whole.indices.as_chunks::<3>().0.iter();
    corners.map(|t| t.map(|index| whole.points[index as usize].to_f32()))
}

#[test]
fn deviation_stays_within_the_tolerance() {
    let mut compared = 0;
    for (name, model) in &models() {
        for tolerance in [0.05, 0.01, 0.003] {
            let Some(found) = deviation(model, &FactorRule::Flatness { tolerance }) else {
                continue;
            };
            // The rounding of positions adds to the tolerance.
            assert!(found <= tolerance + 1e-5, "{name}: {found} for {tolerance}");
            compared += 1;
        }
    }
    assert!(compared > 30, "{compared} were compared; others need factors beyond 64");
}

#[test]
fn a_coarser_cut_is_told() {
    let models = models();
    let teapot = &models[0].1;
    let coarse = deviation(teapot, &FactorRule::Uniform(2.0)).unwrap();
    assert!(coarse > 0.05, "two segments deviate by {coarse}");
}

/// With powers of two, the triangles of a quad extend over at most one segment of the coarsest
/// factor along each axis, and those of a triangle over 4/3 of one: the constants of the bend's
/// bounds. With other factors it would be five, because the stitch then runs ahead of the
/// positions.
#[test]
fn extents_of_triangles() {
    let powers = || (0..=6).map(|k| (1u32 << k) as f32);
    let (mut quads, mut tris) = (0.0f32, 0.0f32);
    for (n, m) in powers().flat_map(|n| powers().map(move |m| (n, m))) {
        for (outer, inside) in powers().flat_map(|a| powers().map(move |b| (a, b))) {
            let [v0, inside_u] = [outer.max(n), inside.max(n)];
            let [u0, inside_v] = [outer.max(m), inside.max(m)];
            let quad = QuadFactors { u0, v0, u1: m, v1: n, inside_u, inside_v };
            quads = quads.max(extent(PatchFactors::Quad(quad), n, m));
            let triangle = TriangleFactors { u0: v0, v0: n, w0: n.max(m), inside: inside_u };
            tris = tris.max(extent(PatchFactors::Triangle(triangle), n, n));
        }
    }
    assert_eq!(quads, 1.0, "quads");
    assert!((1.333..1.334).contains(&tris), "triangles: {tris}");
    let odd = QuadFactors { u0: 64., v0: 64., u1: 64., v1: 64., inside_u: 48., inside_v: 48. };
    assert!(extent(PatchFactors::Quad(odd), 48.0, 48.0) > 4.9, "64 around 48");
}

/// The largest extent of a triangle along u, in segments of `n`, or along v, in segments of `m`.
fn extent(factors: PatchFactors, n: f32, m: f32) -> f32 {
    let span = |t: &[[f32; 2]; 3], k: usize| {
        let along = t.map(|at| at[k]);
        along.iter().copied().fold(0.0, f32::max) - along.iter().copied().fold(1.0, f32::min)
    };
    let whole = Patch::new(INTEGER, factors).tessellate();
    triangles(&whole).map(|t| (span(&t, 0) * n).max(span(&t, 1) * m)).fold(0.0, f32::max)
}
