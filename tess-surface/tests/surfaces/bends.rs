//! Bounds of second derivatives: the longest second differences of the control points, written with
//! the points' indices, in binary64.

use glam::{DVec3, Vec3};
use tess_surface::{Bend, BezierPatch, PnCorner, PnQuad, PnTriangle, Surface};
use tess_verify::generate::SplitMix64;

/// Small integers, so that differences are exact.
fn vector(random: &mut SplitMix64) -> Vec3 {
    let mut coordinate = || random.below(64) as f32 - 32.0;
    Vec3::new(coordinate(), coordinate(), coordinate())
}

fn longest(vectors: impl Iterator<Item = DVec3>) -> f64 {
    vectors.map(DVec3::length).fold(0.0, f64::max)
}

fn check(surface: &Surface, [u, v]: [f64; 2]) {
    let bend = Bend::of(surface);
    for (found, expected) in [(bend.u, u), (bend.v, v)] {
        let error = (f64::from(found) - expected).abs();
        assert!(error <= 1e-5 * expected, "{found} for {expected}: {surface:?}");
    }
}

/// The bounds of a bicubic net: 6 second differences along each axis, 9 mixed ones.
fn bicubic(net: [[Vec3; 4]; 4]) -> [f64; 2] {
    let at = |i: usize, j: usize| net[j][i].as_dvec3();
    let twelve = || (0..2).flat_map(|i| (0..4).map(move |j| (i, j)));
    let uu = longest(twelve().map(|(i, j)| at(i + 2, j) - at(i + 1, j) * 2.0 + at(i, j)));
    let vv = longest(twelve().map(|(j, i)| at(i, j + 2) - at(i, j + 1) * 2.0 + at(i, j)));
    let nine = (0..3).flat_map(|i| (0..3).map(move |j| (i, j)));
    let uv = longest(nine.map(|(i, j)| at(i + 1, j + 1) - at(i, j + 1) - at(i + 1, j) + at(i, j)));
    [6.0 * uu + 9.0 * uv, 6.0 * vv + 9.0 * uv]
}

#[test]
fn of_quads() {
    let mut random = SplitMix64::new(1);
    for _ in 0..500 {
        let net: [[Vec3; 4]; 4] =
            std::array::from_fn(|_| std::array::from_fn(|_| vector(&mut random)));
        check(&Surface::Bezier(BezierPatch::polynomial(net)), bicubic(net));
        let [a, b, c, d] = net[0];
        let twist = ((a + c).as_dvec3() - (b + d).as_dvec3()).length();
        check(&Surface::Bilinear([a, b, c, d]), [twist, twist]);
        let corners = [a, b, c, d].map(|position| PnCorner { position, normal: Vec3::Z });
        let edges = std::array::from_fn(|_| std::array::from_fn(|_| vector(&mut random)));
        let quad = PnQuad::new(corners, edges);
        let net = quad.patch.points.map(|row| row.map(|point| point.truncate()));
        check(&Surface::PnQuad(quad), bicubic(net));
    }
}

#[test]
fn of_triangles() {
    let mut random = SplitMix64::new(2);
    for _ in 0..500 {
        let corners: [Vec3; 3] = std::array::from_fn(|_| vector(&mut random));
        let edges: [[Vec3; 2]; 3] =
            std::array::from_fn(|_| std::array::from_fn(|_| vector(&mut random)));
        let ([u, v, w], [[wv, vw], [wu, uw], [vu, uv]]) = (corners, edges);
        // The paper's centre: the mean of the edges' points, moved half as far again from the
        // corners' mean.
        let mean = edges.as_flattened().iter().map(|point| point.as_dvec3()).sum::<DVec3>() / 6.0;
        let center = mean * 1.5 - (u + v + w).as_dvec3() / 6.0;
        // P(i, j, k) is at i + 4 j: i steps from w to u, j to v.
        let net =
            [w, wu, uw, u, wv, center.as_vec3(), uv, w, vw, vu, w, w, v].map(|p| p.as_dvec3());
        let at = |i: usize, j: usize| if (i, j) == (1, 1) { center } else { net[i + 4 * j] };
        let three = || [(0, 0), (1, 0), (0, 1)].into_iter();
        let uu = longest(three().map(|(i, j)| at(i + 2, j) - at(i + 1, j) * 2.0 + at(i, j)));
        let vv = longest(three().map(|(i, j)| at(i, j + 2) - at(i, j + 1) * 2.0 + at(i, j)));
        let uv = longest(
            three().map(|(i, j)| at(i + 1, j + 1) - at(i + 1, j) - at(i, j + 1) + at(i, j)),
        );
        // Triangles of a tessellated triangle extend over 4/3 of a segment.
        let scale = 6.0 * 1.334 * 1.334;
        let corners = corners.map(|position| PnCorner { position, normal: Vec3::Z });
        let triangle = PnTriangle::new(corners, edges);
        check(&Surface::PnTriangle(triangle), [(uu + uv) * scale, (vv + uv) * scale]);
    }
}
