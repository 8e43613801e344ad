//! Displacement by a height image.

use crate::models::cube;
use glam::{Vec2, Vec3};
use tess_surface::{DisplacedModel, Displacement, HeightMap, MAX_COORDINATE, Model, Sample, Style};

/// The displacement by one row of texels.
fn displacement(width: usize, texels: Vec<f32>, scale: f32) -> Displacement {
    Displacement::new(HeightMap::new(width, 1, texels).unwrap(), scale).unwrap()
}

/// Samples of a flat cube's upper face, displaced by a height that is 1 everywhere.
fn raised(at: &[[f32; 2]]) -> Vec<Sample> {
    let displacement = displacement(1, vec![1.0], 0.5);
    let model = Model::polygons(cube(), Style::Flat).unwrap();
    let patch = DisplacedModel::new(&model, &displacement).patch(1);
    at.iter().map(|&at| patch.sample(at)).collect()
}

#[test]
fn inside_edges_and_corners_move_along_their_normals() {
    let samples = raised(&[[0.5, 0.5], [0.5, 0.0], [1.0, 1.0]]);
    let moved: Vec<Vec3> = samples.iter().map(|sample| sample.position).collect();
    assert_eq!(moved[0], Vec3::new(0.0, 0.0, 1.5), "straight up");
    let edge = Vec3::new(0.0, -1.0, 1.0) + Vec3::new(0.0, -1.0, 1.0).normalize() * 0.5;
    assert!(moved[1].distance(edge) < 1e-6, "between both sides' normals: {}", moved[1]);
    let corner = Vec3::ONE + Vec3::ONE.normalize() * 0.5;
    assert!(moved[2].distance(corner) < 1e-6, "between all three sides' normals: {}", moved[2]);
    assert!(samples.iter().all(|sample| sample.normal == Vec3::Z), "a level height tilts nothing");
}

#[test]
fn heights_are_interpolated_and_repeat() {
    let map = HeightMap::new(2, 2, vec![0.0, 1.0, 2.0, 3.0]).unwrap();
    for (at, expected) in [
        ((0.25, 0.75), 0.0), // the centre of the upper left texel
        ((0.75, 0.75), 1.0),
        ((0.25, 0.25), 2.0),
        ((0.5, 0.5), 1.5),
        ((1.25, -0.25), 0.0), // one image further right, one further down
        ((0.0, 0.75), 0.5),   // between the first column and the last
    ] {
        assert_eq!(map.sample(Vec2::from(at)).0, expected, "height at {at:?}");
    }
    let (_, slope) = map.sample(Vec2::new(0.5, 0.5));
    assert_eq!(slope, Vec2::new(2.0, -4.0), "1 per half a width, -2 per half a height");
    assert!(HeightMap::new(2, 2, vec![0.0; 3]).is_none(), "a texel is missing");
    assert!(HeightMap::new(1, 1, vec![f32::NAN]).is_none(), "no number");
    assert!(HeightMap::new(1, 1, vec![3e38]).is_none(), "differences would overflow");
}

#[test]
fn heights_in_units_of_the_model_stay_in_range() {
    let map = HeightMap::new(2, 1, vec![0.0, -2.0]).unwrap();
    assert!(Displacement::new(map.clone(), MAX_COORDINATE / 2.0).is_some(), "just in range");
    for scale in [MAX_COORDINATE, -3e38, f32::NAN, f32::INFINITY] {
        assert!(Displacement::new(map.clone(), scale).is_none(), "{scale}");
    }
}

#[test]
fn slopes_tilt_normals() {
    // Heights that rise to the right over the cube's upper face.
    let texels = (0..16).map(|i| (i % 16) as f32 / 16.0).collect();
    let displacement = displacement(16, texels, 2.0);
    let model = Model::polygons(cube(), Style::Flat).unwrap();
    let patch = DisplacedModel::new(&model, &displacement).patch(1);
    let normal = patch.sample([0.5, 0.5]).normal;
    // The face is 2 wide and rises by 2.
    assert!(normal.distance(Vec3::new(-1.0, 0.0, 1.0).normalize()) < 1e-5, "{normal}");
}
