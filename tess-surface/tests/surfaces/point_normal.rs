//! Point-normal triangles and quads.

use crate::models::{cube, mesh, octahedron};
use glam::Vec3;
use tess_surface::pn::edge_points;
use tess_surface::{
    Model, PnCorner, PnQuad, PnTriangle, PolygonMesh, Style, Surface, SurfacePatch,
};

/// Domain points of a grid, inside and on the border.
fn grid(is_triangle: bool) -> Vec<[f32; 2]> {
    let at = |i: u16, j: u16| [f32::from(i) / 16.0, f32::from(j) / 16.0];
    let all = (0..=16).flat_map(|i| (0..=16).map(move |j| (i, j)));
    all.filter(|(i, j)| !is_triangle || i + j <= 16).map(|(i, j)| at(i, j)).collect()
}

/// The smallest and the largest distance from the centre, and the smallest cosine of normal and
/// radius.
fn roundness(mesh: PolygonMesh, style: Style) -> (f32, f32, f32) {
    let model = Model::polygons(mesh, style).unwrap();
    let (mut least, mut greatest, mut cosine) = (f32::MAX, 0.0f32, 1.0f32);
    for number in 0..model.len() {
        let patch = model.patch(number);
        for at in grid(patch.edges().as_slice().len() == 3) {
            let sample = patch.sample(at);
            let radius = sample.position.length();
            least = least.min(radius);
            greatest = greatest.max(radius);
            cosine = cosine.min(sample.position.dot(sample.normal) / radius);
        }
    }
    (least, greatest, cosine)
}

#[test]
fn an_octahedron_becomes_round() {
    let (least, greatest, cosine) = roundness(octahedron(), Style::PointNormal);
    assert!(least > 0.75 && greatest < 1.05, "radii {least}..{greatest}");
    assert!(cosine > 0.97, "normals point outwards: {cosine}");
    let (least, ..) = roundness(octahedron(), Style::Flat);
    assert!(least < 0.6, "without it is not: {least}");
}

#[test]
fn a_cube_becomes_round() {
    let radius = 3.0f32.sqrt();
    let (least, greatest, cosine) = roundness(cube(), Style::PointNormal);
    assert!(least > 0.75 * radius && greatest < 1.05 * radius, "radii {least}..{greatest}");
    assert!(cosine > 0.95, "normals point outwards: {cosine}");
}

/// The paper's interpolation: the surface passes through the corners with their normals, and edges
/// start in the tangent planes.
#[test]
fn corners_and_their_normals_are_met() {
    let corner = |position: [f32; 3], normal: [f32; 3]| PnCorner {
        position: Vec3::from_array(position),
        normal: Vec3::from_array(normal).normalize(),
    };
    let [u, v, w] = [
        corner([1.0, 0.0, 0.0], [1.0, 0.2, 0.5]),
        corner([0.0, 1.0, 0.2], [0.1, 1.0, 0.8]),
        corner([0.0, 0.0, 0.0], [-0.2, 0.1, 1.0]),
    ];
    let edges = [edge_points(w, v), edge_points(w, u), edge_points(v, u)];
    let triangle = PnTriangle::new([u, v, w], edges);
    let patch = SurfacePatch::new(Surface::PnTriangle(triangle));
    for (at, corner) in [([1.0, 0.0], u), ([0.0, 1.0], v), ([0.0, 0.0], w)] {
        let sample = patch.sample(at);
        assert_eq!(sample.position, corner.position, "corner {at:?}");
        assert!(sample.normal.distance(corner.normal) < 1e-6, "normal at {at:?}");
        let tangents = patch.frame(at[0], at[1]).tangents;
        let normal = tangents.du.cross(tangents.dv).normalize();
        assert!(normal.distance(corner.normal) < 1e-5, "tangent plane at {at:?}");
    }
    // The edge's formula and the inside's agree where they meet, except for rounding.
    for at in grid(true) {
        let gap = patch.position(at).distance(triangle.frame(at[0], at[1]).position);
        assert!(gap < 1e-6, "at {at:?}: {gap}");
    }
}

#[test]
fn tangents_are_derivatives_of_positions() {
    for model in [octahedron(), cube()].map(|m| Model::polygons(m, Style::PointNormal).unwrap()) {
        let patch = model.patch(1);
        let step = 1.0 / 512.0;
        for (u, v) in [(0.25, 0.25), (0.125, 0.5), (0.5, 0.375)] {
            let along = |du: f32, dv: f32| {
                let (ahead, behind) = (patch.frame(u + du, v + dv), patch.frame(u - du, v - dv));
                (ahead.position - behind.position) / (2.0 * step)
            };
            let tangents = patch.frame(u, v).tangents;
            let errors = [along(step, 0.0) - tangents.du, along(0.0, step) - tangents.dv];
            let error = errors[0].length().max(errors[1].length());
            assert!(error < 1e-3, "at ({u}, {v}): {error}");
        }
    }
}

/// The quad form keeps planes, and any bilinear quad whose normals do not bend its edges.
#[test]
fn planar_quads_stay_as_they_are() {
    let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [3.0, 2.0, 0.0], [-0.5, 1.0, 0.0]]
        .map(|p| PnCorner { position: Vec3::from_array(p), normal: Vec3::Z });
    let [a, b, c, d] = corners;
    let edges = [edge_points(a, d), edge_points(a, b), edge_points(b, c), edge_points(d, c)];
    let pn = SurfacePatch::new(Surface::PnQuad(PnQuad::new(corners, edges)));
    let bilinear = SurfacePatch::new(Surface::Bilinear(corners.map(|c| c.position)));
    for at in grid(false) {
        let gap = pn.position(at).distance(bilinear.position(at));
        assert!(gap < 1e-6, "at {at:?}: {gap}");
        assert!(pn.normal(at).distance(Vec3::Z) < 1e-6, "normal at {at:?}");
    }
}

/// Given normals matter: the same two triangles, once smooth and once with a crease.
#[test]
fn creases_meet_in_the_middle() {
    let positions = [[0., 0., 0.], [1., 0., 0.], [0.5, 1., -0.4], [0.5, -1., -0.4]];
    let mut creased = mesh(&positions, &[&[0, 1, 2], &[1, 0, 3]]);
    creased.normals = vec![Vec3::new(0.3, 0.4, 1.0), Vec3::new(0.3, -0.4, 1.0)];
    for (number, face) in creased.faces.iter_mut().enumerate() {
        face.normals = Some(face.positions.map(|_| number as u32));
    }
    let model = Model::polygons(creased, Style::PointNormal).unwrap();
    // Corner 0 at u = 1, corner 1 at v = 1: their edge is w = 0 in both.
    let (ours, theirs) =
        (model.patch(0).position([0.75, 0.25]), model.patch(1).position([0.25, 0.75]));
    assert_eq!(ours.to_array().map(f32::to_bits), theirs.to_array().map(f32::to_bits), "one edge");
    assert!(ours.z.abs() > 1e-3 && ours.y.abs() < 1e-6, "the mean of both sides: {ours}");
    let normals = [model.patch(0).normal([0.5, 0.5]), model.patch(1).normal([0.5, 0.5])];
    assert!(normals[0].distance(normals[1]) > 0.1, "the crease is still lit as one");
}

/// The centre's coefficient gives a quadratic surface for a quadratic boundary, as the paper says:
/// z = u^2 + 2uv - v^2, with its edges raised to cubics.
#[test]
fn quadratic_surfaces_are_met() {
    let corner = |position| PnCorner { position: Vec3::from_array(position), normal: Vec3::Z };
    let corners = [[1., 0., 1.], [0., 1., -1.], [0., 0., 0.]].map(corner);
    let third = 1.0 / 3.0;
    let edges = [
        [[0., third, 0.], [0., 2. * third, -third]],
        [[third, 0., 0.], [2. * third, 0., third]],
        [[third, 2. * third, third], [2. * third, third, 1.]],
    ];
    let triangle = PnTriangle::new(corners, edges.map(|edge| edge.map(Vec3::from_array)));
    for [u, v] in grid(true) {
        let expected = Vec3::new(u, v, u * u + 2.0 * u * v - v * v);
        let found = triangle.frame(u, v).position;
        assert!(found.distance(expected) < 1e-6, "at ({u}, {v}): {found}");
    }
}
