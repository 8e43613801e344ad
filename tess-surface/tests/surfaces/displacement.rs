//! Displacement by a height image.

use crate::models::{cube, mesh};
use glam::{Vec2, Vec3};
use tess_surface::{
    Address, DisplacedModel, Displacement, HeightError, HeightMap, MAX_COORDINATE, Model, Sample,
    Style,
};

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
    assert_eq!(map.texels(), [0.0, 1.0, 2.0, 3.0], "from left to right, row by row from above");
    let (_, slope) = map.sample(Vec2::new(0.5, 0.5));
    assert_eq!(slope, Vec2::new(2.0, -4.0), "1 per half a width, -2 per half a height");
}

#[test]
fn heights_beyond_a_clamped_image_are_its_outermost() {
    let map = HeightMap::new(2, 2, vec![0.0, 1.0, 2.0, 3.0]).unwrap().with_address(Address::Clamp);
    for (at, expected, slope) in [
        ((0.25, 0.25), 0.0, [2.0, -4.0]), // the centre of the upper left texel
        ((0.5, 0.5), 1.5, [2.0, -4.0]),
        ((0.0, 0.5), 1.0, [0.0, -4.0]),
        ((1.0, 0.5), 2.0, [0.0, -4.0]),
        ((0.75, 7.5), 3.0, [0.0, 0.0]),
        ((-3.0, 0.125), 0.0, [0.0, 0.0]),
        ((f32::INFINITY, 0.25), 1.0, [0.0, -4.0]),
        ((f32::MAX, f32::MAX), 3.0, [0.0, 0.0]),
        ((f32::NEG_INFINITY, f32::MIN), 0.0, [0.0, 0.0]),
    ] {
        let place = Vec2::from(at);
        assert_eq!(map.height_at(place), expected, "height at {at:?}");
        let (height, found) = map.sample(Vec2::new(place.x, 1.0 - place.y));
        assert_eq!((height, found.to_array()), (expected, slope), "sample at {at:?}");
    }
}

#[test]
fn mirrored_images_meet_at_equal_heights() {
    let map = HeightMap::new(2, 2, vec![0.0, 1.0, 2.0, 3.0]).unwrap().with_address(Address::Mirror);
    for (at, expected, slope) in [
        ((0.25, 0.25), 0.0, [2.0, -4.0]), // the centre of the upper left texel
        ((0.375, 0.5), 1.25, [2.0, -4.0]),
        ((-0.375, 0.5), 1.25, [-2.0, -4.0]),
        ((1.625, 0.5), 1.25, [-2.0, -4.0]),
        ((2.375, 0.5), 1.25, [2.0, -4.0]),
        ((0.375, -0.5), 1.25, [2.0, 4.0]),
        ((0.0, 0.5), 1.0, [0.0, -4.0]), // both neighbours are the outermost texel
        ((1.0, 0.5), 2.0, [0.0, -4.0]),
    ] {
        let place = Vec2::from(at);
        assert_eq!(map.height_at(place), expected, "height at {at:?}");
        let (height, found) = map.sample(Vec2::new(place.x, 1.0 - place.y));
        assert_eq!((height, found.to_array()), (expected, slope), "sample at {at:?}");
    }
    for place in [f32::INFINITY, f32::NEG_INFINITY] {
        assert!(map.height_at(Vec2::new(place, 0.5)).is_nan(), "no height at infinity");
    }
}

/// A planet: u goes round, and v ends at the poles. Each axis has its own continuation.
#[test]
fn axes_continue_in_their_own_way() {
    let image = HeightMap::new(2, 2, vec![0.0, 1.0, 2.0, 3.0]).unwrap();
    let ways = [Address::Repeat, Address::Clamp, Address::Mirror];
    for u in ways {
        for v in ways {
            let map = image.clone().with_addresses([u, v]);
            for place in [-0.375, 0.0, 0.125, 0.875, 1.0, 1.75] {
                let along =
                    |way: Address, texcoord| image.clone().with_address(way).sample(texcoord);
                let across = along(u, Vec2::new(place, 0.375)).0;
                assert_eq!(map.sample(Vec2::new(place, 0.375)).0, across, "{u:?} at u {place}");
                let down = along(v, Vec2::new(0.375, place)).0;
                assert_eq!(map.sample(Vec2::new(0.375, place)).0, down, "{v:?} at v {place}");
            }
        }
    }
}

/// Heights take places rounded to 1/256 of a texel; samples take them as they are.
#[test]
fn places_are_rounded_as_samplers_do() {
    for address in [Address::Repeat, Address::Clamp, Address::Mirror] {
        let map = HeightMap::new(2, 1, vec![0.0, 256.0]).unwrap().with_address(address);
        for (parts, expected) in
            [(0.0, 0.0), (0.5, 0.0), (0.625, 1.0), (1.5, 2.0), (100.375, 100.0)]
        {
            let place = Vec2::new((0.5 + parts / 256.0) / 2.0, 0.5);
            assert_eq!(map.height_at(place), expected, "{parts} parts, {address:?}");
            assert_eq!(map.sample(place).0, parts, "{parts} parts, {address:?}");
        }
    }
}

#[test]
fn images_that_cannot_be_evaluated_are_refused() {
    for (width, height, texels, expected, words) in [
        (2, 2, vec![0.0; 3], HeightError::WrongLength { texels: 3, width: 2, height: 2 }, "2 x 2"),
        (0, 2, vec![], HeightError::WrongLength { texels: 0, width: 0, height: 2 }, "at least one"),
        (2, 1, vec![0.0, f32::NAN], HeightError::NotFinite { index: 1 }, "texel 1 is NaN"),
        (1, 1, vec![-f32::INFINITY], HeightError::NotFinite { index: 0 }, "infinite"),
        // Differences would overflow.
        (2, 1, vec![1.0, 3e38], HeightError::TooLarge { index: 1 }, "within 1e16"),
    ] {
        let error = HeightMap::new(width, height, texels).unwrap_err();
        assert_eq!(error, expected, "{width} x {height}");
        assert!(error.to_string().contains(words), "{error}");
    }
}

#[test]
fn heights_in_units_of_the_model_stay_in_range() {
    let map = HeightMap::new(2, 1, vec![0.0, -2.0]).unwrap();
    assert!(Displacement::new(map.clone(), MAX_COORDINATE / 2.0).is_ok(), "just in range");
    for scale in [MAX_COORDINATE, -3e38, f32::NAN, f32::INFINITY] {
        let error = Displacement::new(map.clone(), scale).unwrap_err();
        assert!(matches!(error, HeightError::TooHigh { height: 2.0, .. }), "{scale}: {error:?}");
        assert!(error.to_string().contains("heights up to 2e0 times the scale"), "{error}");
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

/// One flat face with texture coordinates.
fn textured(positions: &[[f32; 3]], texcoords: &[[f32; 2]]) -> Model {
    let numbers: Vec<u32> = (0..).zip(positions).map(|(number, _)| number).collect();
    let mut mesh = mesh(positions, &[&numbers]);
    mesh.texcoords = texcoords.iter().copied().map(Vec2::from).collect();
    mesh.faces[0].texcoords = Some(mesh.faces[0].positions);
    Model::polygons(mesh, Style::Flat).unwrap()
}

/// Texture coordinates outside the image have its heights there, in lanes as one at a time.
#[test]
fn heights_beyond_the_image_move_points() {
    let image = HeightMap::new(2, 2, vec![0.0, 1.0, 2.0, 3.0]).unwrap();
    let model = textured(
        &[[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        &[[-1.5, -0.5], [1.75, -0.5], [1.75, 2.0], [-1.5, 2.0]],
    );
    let places = [[0.125, 0.25], [0.5, 0.5], [0.75, 0.875]];
    let mut heights = Vec::new();
    for address in [Address::Repeat, Address::Clamp, Address::Mirror] {
        let map = image.clone().with_address(address);
        let displacement = Displacement::new(map.clone(), 0.25).unwrap();
        let patch = DisplacedModel::new(&model, &displacement).patch(0);
        for at in places {
            let sample = patch.sample(at);
            let expected = map.sample(sample.texcoord).0 * 0.25;
            assert_eq!(sample.position.z, expected, "{at:?}, {address:?}");
            heights.push(expected);
        }
    }
    assert!(heights[..3] != heights[3..6] && heights[3..6] != heights[6..], "{heights:?}");
}

/// A flat patch over an image that rises evenly: its normals are those of differences between the
/// moved points, for any direction of the texture coordinates and any unit of length.
#[test]
fn normals_are_those_of_the_displaced_surface() {
    let texels = (0..16 * 16).map(|i| (i % 16) as f32 * 0.05 + (i / 16) as f32 * 0.03).collect();
    let map = HeightMap::new(16, 16, texels).unwrap();
    let quad = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.5], [2.5, 1.0, 0.5], [0.5, 1.0, 0.0]];
    let texcoords = [[0.2, 0.3], [0.8, 0.25], [0.6, 0.7], [0.25, 0.6]];
    for (corners, unit) in
        [3, 4].into_iter().flat_map(|n| [1.0, 4096.0, 1.0 / 4096.0].map(|unit| (n, unit)))
    {
        let displacement = Displacement::new(map.clone(), 1.5 * unit).unwrap();
        let positions = quad.map(|position| position.map(|coordinate: f32| coordinate * unit));
        let model = textured(&positions[..corners], &texcoords[..corners]);
        let patch = DisplacedModel::new(&model, &displacement).patch(0);
        for [u, v] in [[0.25, 0.25], [0.5, 0.3], [0.2, 0.6]] {
            let at = |du: f32, dv: f32| patch.sample([u + du / 16.0, v + dv / 16.0]).position;
            let expected = (at(1.0, 0.0) - at(-1.0, 0.0)).cross(at(0.0, 1.0) - at(0.0, -1.0));
            let error = patch.sample([u, v]).normal.distance(expected.normalize());
            assert!(error < 1e-4, "{corners} corners, ({u}, {v}), unit {unit}: {error}");
        }
    }
}
