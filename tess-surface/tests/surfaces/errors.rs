//! Refused inputs, and the text of each error.

use crate::models::{cube, mesh};
use glam::{Vec2, Vec3};
use tess_core::Domain;
use tess_surface::{
    BezierPatch, FaceError, HalfEdge, MeshError, Model, PolygonMesh, Sides, SurfacePatch,
};
use tess_surface::{PnCorner, PnTriangle, Style, Surface, WrongDomainError, teapot};

fn refused(mesh: PolygonMesh) -> MeshError {
    Model::polygons(mesh, Style::PointNormal).expect_err("it is refused")
}

#[test]
fn polygons() {
    let at = |face, fault| MeshError::Face { face, fault };
    assert_eq!(refused(PolygonMesh::default()), MeshError::Empty, "no face");

    let mut nan = cube();
    nan.positions[6].y = f32::NAN;
    assert_eq!(
        refused(nan),
        at(1, FaceError::NotFinite("position")),
        "the first face with corner 6"
    );

    let mut beyond = cube();
    beyond.faces[2].positions = Sides::Quad([0, 1, 5, 8]);
    let fault = FaceError::OutOfRange { what: "position", count: 8 };
    assert_eq!(refused(beyond), at(2, fault), "an index too large");

    let mut no_normal = cube();
    no_normal.normals = vec![Vec3::ZERO];
    no_normal.faces[3].normals = Some(Sides::Quad([0; 4]));
    assert_eq!(
        refused(no_normal),
        at(3, FaceError::NotFinite("normal")),
        "a normal of length zero"
    );

    let mut too_few = cube();
    too_few.normals = vec![Vec3::Z];
    too_few.faces[4].normals = Some(Sides::Triangle([0; 3]));
    let fault = FaceError::WrongCount { what: "normal", found: 3, corners: 4 };
    assert_eq!(refused(too_few), at(4, fault), "three normals for four corners");

    let points =
        [[0., 0., 0.], [1., 0., 0.], [2., 0., 0.], [0., 1., 0.], [0., 0., 0.], [0., 0., 1.]];
    let on_a_line = mesh(&points, &[&[0, 1, 3], &[0, 1, 2]]);
    assert_eq!(refused(on_a_line), at(1, FaceError::NoArea), "three corners on a line");
    let repeated = mesh(&points, &[&[0, 1, 3], &[0, 4, 3]]);
    assert_eq!(refused(repeated), at(1, FaceError::RepeatedCorner), "two positions, one place");

    let fan = mesh(&points, &[&[0, 1, 3], &[1, 4, 5], &[3, 2, 1], &[0, 2, 5]]);
    assert!(Model::polygons(fan, Style::Flat).is_ok(), "two faces at an edge are right");
    let three = mesh(&points, &[&[0, 1, 3], &[1, 4, 5], &[3, 2, 1], &[3, 0, 5], &[0, 3, 2]]);
    let seams = |mesh| Model::polygons(mesh, Style::Flat).map(|model| model.seams().len());
    assert_eq!(seams(three), Ok(1), "three faces at an edge are a seam");
    let four = mesh(&points, &[&[0, 1, 3], &[3, 0, 5], &[0, 3, 2], &[3, 0, 1], &[1, 2, 5]]);
    assert_eq!(seams(four), Ok(1), "three one way, one the other");
}

/// Two cubes that touch along an edge: the four faces there are neighbours in pairs.
#[test]
fn surfaces_that_touch() {
    let mut mesh = cube();
    assert_eq!(
        Model::polygons(mesh.clone(), Style::Flat).map(|one| one.crowded_edges().len()),
        Ok(0)
    );
    let shift = Vec3::new(extent(&mesh).x, extent(&mesh).y, 0.0);
    let beside: Vec<Vec3> = mesh.positions.iter().map(|&position| position + shift).collect();
    let first = u32::try_from(beside.len()).expect("a cube");
    mesh.positions.extend(beside);
    let moved = mesh.faces.clone().into_iter().map(|mut face| {
        face.positions = face.positions.map(|position| position + first);
        face
    });
    mesh.faces.extend(moved);
    let model = Model::polygons(mesh, Style::Flat).expect("as many one way as the other");
    assert_eq!(
        (model.len(), model.crowded_edges().len()),
        (12, 1),
        "faces, edges where cubes touch"
    );
    for half in (0..12).flat_map(|patch| (0..4).map(move |edge| HalfEdge { patch, edge })) {
        let twin = model.twin(half).expect("two cubes have no border");
        assert_eq!(model.twin(twin), Some(half), "{half:?} and {twin:?} are neighbours");
    }
}

/// The size of a mesh along each axis.
fn extent(mesh: &PolygonMesh) -> Vec3 {
    let corners = |join: fn(Vec3, Vec3) -> Vec3| mesh.positions.iter().copied().reduce(join);
    corners(Vec3::max).zip(corners(Vec3::min)).map(|(high, low)| high - low).expect("positions")
}

#[test]
fn patches() {
    let at = |fault| Err(MeshError::Face { face: 7, fault });
    let tampered = |change: fn(&mut BezierPatch)| {
        let mut patches = teapot::patches();
        change(&mut patches[7]);
        Model::bezier(patches).map(|model| model.len())
    };
    assert_eq!(tampered(|_| ()), Ok(32), "as it is");
    let nan = tampered(|patch| patch.points[1][2].z = f32::NAN);
    assert_eq!(nan, at(FaceError::NotFinite("control point")), "NaN");
    let huge = tampered(|patch| patch.points[1][2].z = 1.2e38);
    assert_eq!(huge, at(FaceError::TooLarge("control point")), "a coordinate");
    let small = tampered(|patch| patch.points.as_flattened_mut()[6] *= 1e-17);
    assert_eq!(
        small,
        at(FaceError::TooLarge("control point")),
        "a tangent grows by the weights' ratio"
    );
    let weightless = tampered(|patch| patch.points[0][0].w = 0.0);
    assert_eq!(weightless, at(FaceError::Weight), "weight 0");
    let line = tampered(|patch| {
        patch.points = [patch.points[0]; 4].map(|row| [row[0], row[3], row[0], row[3]])
    });
    assert_eq!(line, at(FaceError::NoArea), "all points on a line");
    let mut doubled = teapot::patches();
    doubled.push(doubled[5]);
    let model = Model::bezier(doubled).expect("a patch may be there twice");
    assert_eq!(model.seams().len(), 4, "its edges are seams");
}

#[test]
fn texture_coordinates_of_another_domain() {
    let patch = SurfacePatch::new(Surface::Bilinear([Vec3::ZERO, Vec3::X, Vec3::ONE, Vec3::Y]));
    let wrong = patch.with_texcoords(Sides::Triangle([Vec2::ZERO; 3])).expect_err("a quad");
    assert_eq!(wrong, WrongDomainError { found: Domain::Triangle, expected: Domain::Quad });
    let words = "the values belong to a Triangle patch, but the surface is a Quad";
    assert_eq!(wrong.to_string(), words, "what and why");
    let own = patch.with_texcoords(Sides::Quad([Vec2::NEG_ONE; 4])).expect("a quad's");
    assert_eq!(own.sample([0.5, 0.5]).texcoord, Vec2::NEG_ONE, "they are used");
}

#[test]
fn edges_that_do_not_exist_have_no_other_side() {
    let model = Model::polygons(cube(), Style::Flat).expect("a cube");
    assert!(model.twin(HalfEdge { patch: 0, edge: 3 }).is_some(), "the last edge");
    for (patch, edge) in [(0, 4), (6, 0), (usize::MAX, 0), (1 << 30, 0), (0, usize::MAX)] {
        assert_eq!(model.twin(HalfEdge { patch, edge }), None, "edge {edge} of patch {patch}");
    }
}

#[test]
fn messages() {
    let error = MeshError::Face { face: 3, fault: FaceError::NoArea };
    assert_eq!(error.to_string(), "face 3: it has zero area", "which and what");
    let fault = FaceError::OutOfRange { what: "normal", count: 5 };
    assert_eq!(fault.to_string(), "a normal index is out of range: there are 5", "what and why");
}

/// Whether a face has an area does not depend on its size.
#[test]
fn thin_faces_are_told_by_their_angle() {
    for size in [1.0, 1000.0, 0.001] {
        // The sines of the two angles are about 2^-23 and 2^-21.
        for (height, is_thin) in [(1.2e-7f32, true), (4.8e-7, false)] {
            let model = Model::polygons(
                mesh(&[[0.0; 3], [size, 0.0, 0.0], [size, height * size, 0.0]], &[&[0, 1, 2]]),
                Style::Flat,
            );
            assert_eq!(model.is_err(), is_thin, "size {size}, height {height}: {:?}", model.err());
            // Whichever corner is the first.
            let corners = [[0.0; 3], [size, 0.0, 0.0], [size, height * size, 0.0]];
            for order in [[1, 2, 0], [2, 0, 1], [2, 1, 0]] {
                let model = Model::polygons(mesh(&corners, &[&order]), Style::Flat);
                assert_eq!(model.is_err(), is_thin, "size {size}, {order:?}: {:?}", model.err());
            }
        }
    }
}

/// Tangents are differences of positions times a quotient of weights, so the quotient matters.
#[test]
fn positions_times_the_quotient_of_weights_stay_in_range() {
    let points = |far: f32| {
        let grid = |j: usize| std::array::from_fn(|i| Vec3::new(i as f32, j as f32, 0.0) * far);
        std::array::from_fn(grid)
    };
    let mut weights = [[1.0; 4]; 4];
    weights[0][0] = 1e4;
    for (far, is_refused) in [(1e11, false), (1e13, true)] {
        let model = Model::bezier(vec![BezierPatch::rational(points(far), weights)]);
        assert_eq!(model.is_err(), is_refused, "{far}: {:?}", model.err());
    }
}

/// Two faces whose shared corners differ in the sign of their zeros.
#[test]
fn zeros_of_either_sign_are_one_place() {
    let positions = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [0.0, 1.0, 0.0],
        [-0.0, -0.0, 0.0],
        [1.0, -0.0, -0.0],
        [0.0, -1.0, 0.0],
    ];
    let model = Model::polygons(mesh(&positions, &[&[0, 1, 2], &[4, 3, 5]]), Style::Flat).unwrap();
    let twins = (0..3).filter(|&edge| model.twin(HalfEdge { patch: 0, edge }).is_some()).count();
    assert_eq!(twins, 1, "they share an edge");
    let corners = [-Vec3::ONE, -Vec3::ONE - Vec3::X, -Vec3::ZERO];
    let corners = corners.map(|position| PnCorner { position, normal: Vec3::Z });
    let surface = Surface::PnTriangle(PnTriangle::new(corners, [[-Vec3::ONE; 2]; 3]));
    let position = SurfacePatch::new(surface).frame(0.0, 0.0).position;
    assert_eq!(position.to_array().map(f32::to_bits), [0; 3], "no negative zeros: {position:?}");
}
