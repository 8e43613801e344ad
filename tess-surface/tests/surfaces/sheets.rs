//! Places and edges where more than one sheet meets.

use crate::models::{bumps, face, fin, hills, leaf, mesh};
use glam::Vec3;
use tess_core::Partitioning;
use tess_surface::{
    DisplacedModel, FactorRule, HalfEdge, Model, PolygonMesh, Sample, Style, SurfacePatch,
};

const PLACES: [[f32; 2]; 6] = [[0., 0.], [1., 0.], [0., 1.], [0.5, 0.], [0., 0.25], [0.25, 0.5]];

fn rounded(mesh: PolygonMesh) -> Model {
    Model::polygons(mesh, Style::PointNormal).expect("a right mesh")
}

fn samples(patch: &SurfacePatch) -> [Sample; 6] {
    PLACES.map(|at| patch.sample(at))
}

/// Four triangles around the middle of a square, counter-clockwise, then the same clockwise.
fn square() -> PolygonMesh {
    let points = [[0., 0., 0.], [2., 0., 0.], [2., 2., 0.], [0., 2., 0.], [1., 1., 0.]];
    let fronts: [&[u32]; 4] = [&[0, 1, 4], &[1, 2, 4], &[2, 3, 4], &[3, 0, 4]];
    let backs: [&[u32]; 4] = [&[1, 0, 4], &[2, 1, 4], &[3, 2, 4], &[0, 3, 4]];
    mesh(&points, &[fronts, backs].concat())
}

#[test]
fn each_side_of_a_sheet_has_its_own_normal() {
    let model = rounded(square());
    for number in 0..8 {
        let normal = if number < 4 { Vec3::Z } else { -Vec3::Z };
        for (at, sample) in PLACES.iter().zip(samples(&model.patch(number))) {
            assert_eq!(sample.normal, normal, "patch {number} at {at:?}");
            assert_eq!(sample.position.z, 0.0, "patch {number} at {at:?}: it stays flat");
        }
    }
}

/// The back may be cut along the other diagonal, so that front and back have no face in common.
#[test]
fn sides_that_are_cut_differently() {
    let points = [[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]];
    let cut = mesh(&points, &[&[0, 1, 2], &[0, 2, 3], &[1, 0, 3], &[1, 3, 2]]);
    let whole = mesh(&points, &[&[0, 1, 2, 3], &[1, 0, 3], &[1, 3, 2]]);
    for (mesh, fronts) in [(cut, 2), (whole, 1)] {
        let model = rounded(mesh);
        for number in 0..model.len() {
            let normal = if number < fronts { Vec3::Z } else { -Vec3::Z };
            let found = samples(&model.patch(number)).map(|sample| sample.normal);
            assert_eq!(found, [normal; 6], "patch {number} of {}", model.len());
        }
    }
}

/// Both sides of a curved sheet bend as a sheet with only one side does.
#[test]
fn curved_sheets() {
    let (one, both) = (rounded(hills()), rounded(leaf()));
    let count = one.len();
    for number in 0..count {
        assert_eq!(samples(&one.patch(number)), samples(&both.patch(number)), "front {number}");
        // The back's corners run the other way: its u is the front's v.
        for [u, v] in PLACES {
            let (front, back) = (one.patch(number), both.patch(count + number));
            let (front, back) = (front.sample([u, v]), back.sample([v, u]));
            assert!(front.position.distance(back.position) < 1e-5, "{number}: {front:?} {back:?}");
            assert!(front.normal.distance(-back.normal) < 1e-5, "{number}: {front:?} {back:?}");
        }
    }
}

/// Faces that are not flat, cut along one diagonal in front and along the other at the back, or in
/// front not cut at all: each side has the normals of a sheet with only one side.
#[test]
fn curved_sides_that_are_cut_differently() {
    let hills = hills();
    let quads: Vec<[u32; 4]> = hills
        .faces
        .iter()
        .map(|face| *face.positions.as_slice().as_array().expect("a quad"))
        .collect();
    let cut = |turn: usize, reversed: bool| -> Vec<Vec<u32>> {
        let halves = quads.iter().flat_map(|quad| {
            let [a, b, c, d] = [0, 1, 2, 3].map(|corner| quad[(corner + turn) % 4]);
            [vec![a, b, c], vec![a, c, d]]
        });
        halves.map(|face| if reversed { face.into_iter().rev().collect() } else { face }).collect()
    };
    let whole: Vec<Vec<u32>> = quads.iter().map(|quad| quad.to_vec()).collect();
    // A quad and half of it are two sides, however steep they are.
    for (front, steepness) in [(whole, 1.0), (cut(0, false), 0.3)] {
        let points: Vec<[f32; 3]> =
            hills.positions.iter().map(|point| [point.x, point.y, steepness * point.z]).collect();
        let model = |faces: &[Vec<u32>]| {
            let faces: Vec<&[u32]> = faces.iter().map(Vec::as_slice).collect();
            rounded(mesh(&points, &faces))
        };
        for turn in [0, 1] {
            let back = cut(turn, true);
            let both = model(&[&front[..], &back].concat());
            let sides = [(model(&front), 0), (model(&back), front.len())];
            for (side, first) in &sides {
                for number in 0..side.len() {
                    let found = samples(&both.patch(first + number)).map(|sample| sample.normal);
                    let expected = samples(&side.patch(number)).map(|sample| sample.normal);
                    for (found, expected) in found.iter().zip(expected) {
                        let near = found.distance(expected) < 1e-3;
                        assert!(near, "turn {turn}, face {number} of {first}: {found} {expected}");
                    }
                }
            }
        }
    }
}

/// A face whose corners are in the wrong order is a sheet of its own.
#[test]
fn a_face_in_the_wrong_order() {
    let mut turned = hills();
    turned.faces[12] = face(&[14, 20, 21, 15]);
    let (right, model) = (rounded(hills()), rounded(turned));
    assert!(samples(&model.patch(12)).iter().all(|sample| sample.normal.z < 0.0), "downwards");
    for number in (0..25).filter(|&number| number != 12) {
        let [found, expected] = [&model, &right].map(|model| samples(&model.patch(number)));
        for (found, expected) in found.iter().zip(expected) {
            assert!(found.normal.dot(expected.normal) > 0.7, "{number}: {found:?} {expected:?}");
        }
    }
}

/// When displaced, the sides separate inside and stay together along the border.
#[test]
fn a_displaced_sheet_is_closed() {
    let (mesh, bumps) = (square(), bumps());
    let model = rounded(mesh);
    let displaced = DisplacedModel::new(&model, &bumps);
    let height = |number: usize, at: [f32; 2]| displaced.patch(number).sample(at).position.z;
    for number in 0..4 {
        assert!(height(number, [0.25, 0.25]) > 0.0, "the front rises");
        assert!(height(number + 4, [0.25, 0.25]) < 0.0, "the back sinks");
        let middles = [number, number + 4].map(|number| height(number, [0.0, 0.0]));
        assert!(middles[0] > 0.0 && middles[1] < 0.0, "the middle parts: {middles:?}");
        for border in [[1.0, 0.0], [0.5, 0.5], [0.0, 1.0]] {
            assert_eq!(height(number, border), 0.0, "the border stays");
        }
    }
}

#[test]
fn a_fin_is_a_seam() {
    let model = rounded(fin());
    // The fin's edge 1 (v = 0) meets the quads below and above it.
    let sides = |k: usize| {
        vec![
            HalfEdge { patch: 6 + k, edge: 3 },
            HalfEdge { patch: 11 + k, edge: 1 },
            HalfEdge { patch: 25 + k, edge: 1 },
        ]
    };
    assert_eq!(model.seams(), [sides(0), sides(1)], "both edges of the fin");
    assert!(model.crowded_edges().is_empty(), "no pairs");
    let rule = FactorRule::Flatness { tolerance: 0.001 };
    for half in model.seams().iter().flatten() {
        assert_eq!(model.twin(*half), None, "no single neighbour");
    }
    for seam in model.seams() {
        let at = |half: &HalfEdge| if half.edge == 3 { [0.3125, 1.0] } else { [0.3125, 0.0] };
        let positions: Vec<Vec3> =
            seam.iter().map(|half| model.patch(half.patch).position(at(half))).collect();
        assert_eq!(positions, [positions[0]; 3], "one curve");
        let factors: Vec<f32> = seam
            .iter()
            .map(|half| {
                let factors = rule.factors(&model, half.patch, Partitioning::Integer);
                factors.iter().nth(half.edge).expect("a factor")
            })
            .collect();
        assert_eq!(factors, [factors[0]; 3], "one factor");
    }
    let upright = model.patch(25).normal([0.5, 0.0]);
    assert!(upright.z.abs() < 0.7, "the fin keeps its own normal: {upright}");
    for (patch, at) in [(6, [0.5, 1.0]), (11, [0.5, 0.0])] {
        let normal = model.patch(patch).normal(at);
        assert!(normal.z > 0.3, "the hills keep theirs: {normal}");
    }
}

/// Three faces at one edge, each with its own normal.
#[test]
fn three_faces_at_an_edge() {
    let points = [[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [0., -1., 0.], [0., 0., 1.]];
    let model = rounded(mesh(&points, &[&[0, 1, 2], &[0, 1, 3], &[0, 1, 4]]));
    assert_eq!(model.seams().len(), 1, "a seam");
    for (number, normal) in [Vec3::Z, -Vec3::Z, -Vec3::Y].into_iter().enumerate() {
        let found = samples(&model.patch(number)).map(|sample| sample.normal);
        assert_eq!(found, [normal; 6], "face {number}");
    }
}

/// The normals of a model's patches at their corners, each with the corner's position.
fn normals_at_corners(model: &Model) -> Vec<(Vec3, Vec3)> {
    let corners = [[0., 0.], [1., 0.], [0., 1.], [1., 1.]];
    let places = |number: usize| {
        let patch = model.patch(number);
        let is_triangle = patch.domain() == tess_core::Domain::Triangle;
        let own = corners.into_iter().take(if is_triangle { 3 } else { 4 });
        own.map(|at| (patch.position(at), patch.normal(at))).collect::<Vec<_>>()
    };
    (0..model.len()).flat_map(places).collect()
}

/// Two quads that meet in a ridge of height 1, along x; each is `half_width` wide.
fn ridge(half_width: f32) -> PolygonMesh {
    let points = [
        [0., -half_width, 0.],
        [4., -half_width, 0.],
        [4., 0., 1.],
        [0., 0., 1.],
        [0., half_width, 0.],
        [4., half_width, 0.],
    ];
    mesh(&points, &[&[0, 1, 2, 3], &[4, 3, 2, 5]])
}

/// A ridge may be sharp: faces that have not each other's corners are folded onto each other only
/// if they are nearly parallel. The normals of these have cosines of -0.8, -0.99989 and -0.99992.
#[test]
fn a_sharp_ridge_is_one_sheet() {
    for (half_width, is_one_sheet) in [(1.0 / 3.0, true), (0.0075, true), (0.0065, false)] {
        let found = normals_at_corners(&rounded(ridge(half_width)));
        let ridge: Vec<_> = found.iter().filter(|(position, _)| position.z > 0.9).collect();
        assert_eq!(ridge.len(), 4, "two corners of each face: {found:?}");
        for (at, (position, normal)) in ridge.into_iter().enumerate() {
            let own = if at < 2 { -Vec3::Y } else { Vec3::Y };
            let expected = if is_one_sheet { Vec3::Z } else { own };
            let near = normal.distance(expected) < 0.01;
            assert!(near, "{half_width}: {position}: {normal}, not {expected}");
        }
    }
}

/// A bumpy front of two quads, and a back of triangles one of which has corners of both quads: at
/// the border the back's corners are those of the front's faces, and not the other way round.
#[test]
fn a_side_whose_faces_have_corners_of_two_others() {
    let points =
        [[0., 0., 0.], [1., -0.5, 0.3], [2., 0., 0.], [0., 1., 0.3], [1., 1.5, 0.], [2., 1., 0.3]];
    let front: [&[u32]; 2] = [&[0, 1, 4, 3], &[1, 2, 5, 4]];
    let back: [&[u32]; 4] = [&[1, 0, 5], &[2, 1, 5], &[5, 0, 3], &[5, 3, 4]];
    let alone = [&front[..], &back].map(|side| normals_at_corners(&rounded(mesh(&points, side))));
    for (both, expected) in [
        ([&front[..], &back].concat(), [&alone[0][..], &alone[1]].concat()),
        ([&back[..], &front].concat(), [&alone[1][..], &alone[0]].concat()),
    ] {
        let found = normals_at_corners(&rounded(mesh(&points, &both)));
        for ((position, found), (_, expected)) in found.iter().zip(&expected) {
            let near = found.distance(*expected) < 1e-5;
            assert!(near, "{both:?}: {position}: {found}, not {expected}");
        }
    }
}

/// Eight faces around a place, whose normals are +z twice, +y twice, -z twice and -y twice, are one
/// sheet without a direction: each keeps its own normal, and a face that touches there keeps its.
#[test]
fn normals_that_cancel_out() {
    let rays = [Vec3::X, Vec3::Y, -Vec3::X, Vec3::Z, Vec3::X, -Vec3::Y, -Vec3::X, -Vec3::Z];
    let around: Vec<Vec3> = rays.iter().zip(1u8..).map(|(&ray, k)| ray * f32::from(k)).collect();
    let fan: Vec<[u32; 3]> = (0..8).map(|k| [0, k + 1, (k + 1) % 8 + 1]).collect();
    let own: Vec<Vec3> = (0..8).map(|k| rays[k].cross(rays[(k + 1) % 8])).collect();
    for normal in [Vec3::X, Vec3::Y, Vec3::Z] {
        let (a, b) = normal.any_orthonormal_pair();
        let points = [&[Vec3::ZERO], &around[..], &[a * 20.0, b * 20.0]].concat();
        let points: Vec<[f32; 3]> = points.iter().map(|point| point.to_array()).collect();
        for touching_is_first in [false, true] {
            let mut faces: Vec<&[u32]> = fan.iter().map(|face| &face[..]).collect();
            let at = if touching_is_first { 0 } else { 8 };
            faces.insert(at, &[0, 9, 10]);
            let model = rounded(mesh(&points, &faces));
            let centres = (0..9).map(|number| model.patch(number).normal([1.0, 0.0]));
            let mut centres: Vec<Vec3> = centres.collect();
            assert!(centres.remove(at).distance(normal) < 1e-6, "{normal}: the face that touches");
            assert_eq!(centres, own, "{normal}: the faces around");
        }
    }
}

/// The edges at a straight corner span no plane: its normal is that of its face.
#[test]
fn a_straight_corner() {
    for turn in 0..4 {
        let mut points = [[0., 0., 0.], [1., 0., 0.], [2., 0., 0.], [1., 0., 2.]];
        points.rotate_left(turn);
        for (position, normal) in normals_at_corners(&rounded(mesh(&points, &[&[0, 1, 2, 3]]))) {
            assert!(normal.distance(-Vec3::Y) < 1e-6, "turn {turn}, {position}: {normal}");
        }
    }
}

/// Three faces at an edge, whose normals are within 90 degrees of their sum, are a seam all the
/// same: each keeps its own normal.
#[test]
fn faces_of_a_seam_that_agree() {
    let turned = |degrees: f32| {
        let (s, c) = (libm::sinf(degrees.to_radians()), libm::cosf(degrees.to_radians()));
        ([0.0, c, s], Vec3::new(0.0, -s, c))
    };
    let sides = [-70.0, 0.0, 70.0].map(turned);
    let points = [[0., 0., 0.], [1., 0., 0.], sides[0].0, sides[1].0, sides[2].0];
    let model = rounded(mesh(&points, &[&[0, 1, 2], &[0, 1, 3], &[0, 1, 4]]));
    assert_eq!(model.seams().len(), 1, "a seam");
    for (number, (_, normal)) in sides.into_iter().enumerate() {
        for sample in samples(&model.patch(number)) {
            assert!(sample.normal.distance(normal) < 1e-6, "{number}: {sample:?}, not {normal}");
        }
    }
}

/// Equal positions are one place, whichever of them a face refers to.
#[test]
fn faces_with_positions_of_their_own() {
    let cone = mesh(
        &[[0., 0., 1.], [1., 0., 0.], [0., 1., 0.], [-1., 0., 0.], [0., -1., 0.], [0., 0., 4.]],
        &[&[0, 1, 2], &[0, 2, 3], &[0, 3, 4], &[0, 4, 1], &[0, 5, 1]],
    );
    for shared in [hills(), leaf(), fin(), square(), ridge(0.0065), cone] {
        let mut own = PolygonMesh::default();
        for face in &shared.faces {
            let corners = shared.corners(face);
            let first = u32::try_from(own.positions.len()).expect("few corners");
            own.positions.extend(corners.as_slice());
            let numbers: Vec<u32> = (first..).take(corners.as_slice().len()).collect();
            own.faces.push(crate::models::face(&numbers));
        }
        assert_eq!(
            normals_at_corners(&rounded(own)),
            normals_at_corners(&rounded(shared)),
            "equal"
        );
    }
}

/// The faces of a tetrahedron have all of their corners in common with their neighbours, and are no
/// two sides of a sheet: their normals have a cosine of -1/3.
#[test]
fn a_tetrahedron_is_round() {
    let points = [[1., 1., 1.], [1., -1., -1.], [-1., 1., -1.], [-1., -1., 1.]];
    let faces: [&[u32]; 4] = [&[0, 1, 2], &[0, 3, 1], &[0, 2, 3], &[1, 3, 2]];
    let found = normals_at_corners(&rounded(mesh(&points, &faces)));
    assert_eq!(found.len(), 12, "three corners of each face");
    for (position, normal) in found {
        assert!(normal.distance(position.normalize()) < 1e-6, "{position}: {normal}");
    }
}

/// Three faces touch in a corner; the third one is turned over. The others are one sheet if their
/// normals are within 60 degrees.
#[test]
fn faces_that_touch_in_a_corner() {
    for (degrees, is_one_sheet) in [(25.0f32, true), (29.9, true), (30.1, false), (35.0, false)] {
        let (s, c) = (libm::sinf(degrees.to_radians()), libm::cosf(degrees.to_radians()));
        let points = [
            [0., 0., 0.],
            [1., 0., 0.],
            [0., c, s],
            [-1., 0., 0.],
            [0., -c, s],
            [2., 1., 0.],
            [1., -2., 0.],
        ];
        let model = rounded(mesh(&points, &[&[0, 1, 2], &[0, 3, 4], &[0, 5, 6]]));
        let own = [Vec3::new(0., -s, c), Vec3::new(0., s, c), -Vec3::Z];
        let shared = [Vec3::Z, Vec3::Z, -Vec3::Z];
        let expected = if is_one_sheet { shared } else { own };
        let found = normals_at_corners(&model);
        let touching = found.iter().filter(|(position, _)| position.length() < 1e-6);
        let touching: Vec<Vec3> = touching.map(|(_, normal)| *normal).collect();
        assert_eq!(touching.len(), 3, "one corner of each face: {found:?}");
        for (found, expected) in touching.iter().zip(expected) {
            assert!(found.distance(expected) < 1e-5, "{degrees}: {touching:?}, not {expected}");
        }
    }
}
