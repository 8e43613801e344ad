//! Coordinates up to [`MAX_COORDINATE`] are evaluated without overflow; larger ones are refused.

use crate::models::{creased_cube, cube, torus};
use glam::{Vec2, Vec3};
use tess_core::{Config, OutputPrimitive, Partitioning, PatchFactors};
use tess_surface::{
    DisplacedModel, Displacement, FaceError, FactorRule, HeightMap, MAX_COORDINATE, MeshError,
    Model, PolygonMesh, Sample, Sides, Style, Surface, SurfacePatch, teapot,
};

/// A mesh in a smaller unit, so that its coordinates are `times` as large.
fn in_units(mut mesh: PolygonMesh, times: f32) -> PolygonMesh {
    mesh.positions.iter_mut().for_each(|position| *position *= times);
    mesh
}

/// Bezier patches, planes, bilinear and point-normal patches, with coordinates of up to 4 units.
fn models_in_units(times: f32) -> Vec<Model> {
    let mut patches = teapot::patches();
    for point in patches.iter_mut().flat_map(|patch| patch.points.as_flattened_mut()) {
        *point = (point.truncate() * times).extend(1.0);
    }
    let mut models = vec![Model::bezier(patches).expect("in range")];
    for style in [Style::Flat, Style::PointNormal] {
        for mesh in [cube(), torus(), creased_cube()] {
            models.push(Model::polygons(in_units(mesh, times), style).expect("in range"));
        }
    }
    models
}

fn rules_in_units(times: f32) -> [FactorRule; 3] {
    let eye = Vec3::new(3.0, -4.0, 2.5) * times;
    [
        FactorRule::Distance { eye, scale: 35.0 * times },
        FactorRule::ScreenSize { eye, pixels_per_unit: 700.0, segment: 25.0 },
        FactorRule::Flatness { tolerance: 0.02 * times },
    ]
}

fn displacement_in_units(times: f32) -> Displacement {
    let texels = (0..64).map(|i| ((i * 37) % 64) as f32 / 64.0).collect();
    let map = HeightMap::new(8, 8, texels).expect("an image");
    Displacement::new(map, times).expect("in range")
}

/// The factors of a patch by every rule, and its samples, plain and displaced.
fn evaluate(
    displaced: &DisplacedModel<'_>,
    number: usize,
    times: f32,
) -> (Vec<PatchFactors>, Vec<Sample>) {
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let of = |rule: &FactorRule| rule.factors(displaced.model(), number, config.partitioning);
    let factors = rules_in_units(times).iter().map(of).collect();
    let domain = tess_core::Patch::new(config, of(&FactorRule::Uniform(5.0))).tessellate();
    let patches = (displaced.model().patch(number), displaced.patch(number));
    let samples = domain.points.iter().map(|point| point.to_f32());
    (factors, samples.flat_map(|at| [patches.0.sample(at), patches.1.sample(at)]).collect())
}

/// A power of two as the unit changes only the positions' exponents, as long as nothing overflows:
/// neither positions nor the squares in lengths, bounds and normals.
#[test]
fn the_unit_changes_no_bit() {
    let mut compared = 0;
    for exponent in [10, 30, 51] {
        let times = libm::ldexpf(1.0, exponent);
        assert!(exponent < 51 || 4.0 * times > 0.9 * MAX_COORDINATE, "up to the bound");
        let displacements = [1.0, times].map(displacement_in_units);
        for (ours, theirs) in models_in_units(1.0).iter().zip(&models_in_units(times)) {
            let ours = DisplacedModel::new(ours, &displacements[0]);
            let theirs = DisplacedModel::new(theirs, &displacements[1]);
            for number in 0..ours.model().len() {
                let (factors, samples) = evaluate(&ours, number, 1.0);
                let (larger_factors, larger_samples) = evaluate(&theirs, number, times);
                assert_eq!(larger_factors, factors, "patch {number}, 2^{exponent}");
                for (sample, larger) in samples.iter().zip(&larger_samples) {
                    let expected = Sample { position: sample.position * times, ..*sample };
                    assert_eq!(*larger, expected, "patch {number}, 2^{exponent}");
                    compared += 1;
                }
            }
        }
    }
    assert!(compared > 10_000, "{compared} samples were compared");
}

#[test]
fn larger_coordinates_are_refused() {
    for (scale, is_refused) in [(1.0f32, false), (1.000_001, true), (1.2e22, true)] {
        for position in [true, false] {
            let mut mesh = in_units(cube(), MAX_COORDINATE);
            mesh.texcoords = vec![Vec2::splat(MAX_COORDINATE); 2];
            mesh.faces[0].texcoords = Some(Sides::Quad([0, 1, 0, 1]));
            let what = if position { "position" } else { "texture coordinate" };
            match position {
                true => mesh.positions[5].y *= scale,
                false => mesh.texcoords[1].x *= scale,
            }
            let found = Model::polygons(mesh, Style::Flat).err();
            let face = if position { 1 } else { 0 };
            let expected = MeshError::Face { face, fault: FaceError::TooLarge(what) };
            assert_eq!(found, is_refused.then_some(expected), "{what} times {scale}");
        }
    }
    let error = MeshError::Face { face: 2, fault: FaceError::TooLarge("position") };
    let words = "face 2: a position is too large to be evaluated: coordinates must lie within \
                 1e16 of 0";
    assert_eq!(error.to_string(), words, "which and why");
}

fn is_finite(sample: &Sample) -> bool {
    sample.position.is_finite() && sample.texcoord.is_finite()
}

/// The bound is needed: without the check, these corners give no position.
#[test]
fn coordinates_out_of_range_overflow() {
    let corners = [Vec3::splat(3e38), Vec3::splat(-3e38), Vec3::splat(3e38), Vec3::ZERO];
    let sample = SurfacePatch::new(Surface::Bilinear(corners)).sample([0.5, 0.5]);
    assert!(!is_finite(&sample), "{sample:?}");
    let ordinary = SurfacePatch::new(Surface::Bilinear([Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Y]));
    assert!(is_finite(&ordinary.sample([0.0, 0.5])), "an ordinary patch");
    let sides = Sides::Quad([Vec2::splat(3e38), Vec2::ZERO, Vec2::ONE, Vec2::splat(-3e38)]);
    let patch = ordinary.with_texcoords(sides).expect("a quad");
    assert!(!is_finite(&patch.sample([0.0, 0.5])), "on the edge between the two");
}
