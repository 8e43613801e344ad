//! The embedded figures: counts, size, symmetry, closed edges and orientation.

use crate::weld::tessellate;
use glam::Vec3;
use tess_core::Partitioning;
use tess_surface::{FactorRule, HalfEdge, Model, teapot};

fn points() -> Vec<[f32; 3]> {
    let patches = teapot::patches();
    let all = patches.iter().flat_map(|patch| patch.points.into_iter().flatten());
    all.map(|point| point.truncate().to_array()).collect()
}

#[test]
fn size_and_symmetry() {
    let points = points();
    assert_eq!(points.len(), 32 * 16, "32 patches");
    let distinct: std::collections::BTreeSet<_> =
        points.iter().map(|p| p.map(|x| (x + 0.0).to_bits())).collect();
    assert_eq!(distinct.len(), 290, "the bottom repeats 12 points of the body; 4 are unused");
    let model = Model::bezier(teapot::patches()).unwrap();
    let (low, high) = model.bounds();
    assert_eq!(low.to_array(), [-3.0, -2.0, 0.0], "least corner of the control points");
    assert_eq!(high.to_array(), [3.525, 2.0, 3.15], "greatest corner");
    let mirrored = |p: &[f32; 3]| points.contains(&[p[0], -p[1], p[2]]);
    assert!(points.iter().all(mirrored), "left and right are alike");
    // Everything except handle and spout (patches 12..20) looks the same after a quarter turn.
    let round: Vec<_> = points[..192].iter().chain(&points[320..]).collect();
    let turned = |p: &[f32; 3]| round.contains(&&[p[1], -p[0], p[2]]);
    assert!(round.iter().all(|p| turned(p)), "body and lid are surfaces of revolution");
}

#[test]
fn closes_where_it_should() {
    let model = Model::bezier(teapot::patches()).unwrap();
    let (mut shared, mut open, mut collapsed) = (0, Vec::new(), 0);
    for patch in 0..model.len() {
        for edge in 0..4 {
            let is_point =
                model.patch(patch).edges().as_slice()[edge].curve.collapsed_to().is_some();
            match model.twin(HalfEdge { patch, edge }) {
                Some(_) => shared += 1,
                None if is_point => collapsed += 1,
                None => open.push(patch),
            }
        }
    }
    assert_eq!(shared, 2 * 52, "sides of common curves");
    assert_eq!(collapsed, 8, "four at the knob, four under the bottom");
    // The inside of the rim, both ends of handle and spout, and the lid's margin.
    let expected = [0, 1, 2, 3, 12, 13, 14, 15, 16, 17, 18, 19, 24, 25, 26, 27];
    assert_eq!(open, expected, "patches with an open side");
}

/// The parts' volumes about their own centres, so that open ends matter little.
#[test]
fn outside_is_out() {
    let patches = teapot::patches();
    let parts = [
        ("body and bottom", [&patches[..12], &patches[28..]].concat()),
        ("handle", patches[12..16].to_vec()),
        ("spout", patches[16..20].to_vec()),
        ("lid", patches[20..28].to_vec()),
    ];
    for (name, patches) in parts {
        let model = Model::bezier(patches).unwrap();
        let rule = FactorRule::Uniform(8.0);
        let out = tessellate(&model, &rule, Partitioning::Integer, None, None);
        let center = (model.bounds().0 + model.bounds().1) * 0.5;
        let volume: f32 = out
            .triangles
            .iter()
            .map(|t| t.map(|p| Vec3::from_array(p) - center))
            .map(|[a, b, c]| a.dot(b.cross(c)) / 6.0)
            .sum();
        assert!(volume > 0.1, "{name}: {volume}");
    }
}
