//! Hard edges: the normals on both sides are those of their own faces.

use crate::models::{cube, octahedron};
use glam::Vec3;
use tess_surface::{Creases, Model, PolygonMesh, Style};

fn normals(mesh: &PolygonMesh, creases: &Creases<'_>) -> Vec<Vec3> {
    let model = Model::creased(mesh.clone(), Style::PointNormal, creases).expect("a right mesh");
    let at = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
    (0..model.len()).flat_map(|patch| at.map(|at| model.patch(patch).sample(at).normal)).collect()
}

fn is_flat(mesh: &PolygonMesh, creases: &Creases<'_>) -> bool {
    normals(mesh, creases).chunks(3).all(|face| face.iter().all(|normal| *normal == face[0]))
}

#[test]
fn angles_decide() {
    // The normals of a cube's faces are 90 degrees apart, those of an octahedron's 70.5.
    for (mesh, cosine) in [(cube(), 0.0f32), (octahedron(), 1.0 / 3.0)] {
        let creases = |least_cosine| Creases { least_cosine, ..Creases::NONE };
        assert!(is_flat(&mesh, &creases(cosine + 0.01)), "hard at {cosine}");
        assert!(!is_flat(&mesh, &creases(cosine - 0.01)), "smooth at {cosine}");
        let hard = Model::creased(mesh.clone(), Style::PointNormal, &creases(cosine + 0.01));
        assert_eq!(hard.expect("a right mesh").creases().len(), 12, "every edge once");
        let smooth = Model::polygons(mesh, Style::PointNormal).expect("a right mesh");
        assert_eq!(smooth.creases(), [], "none without an angle");
    }
}

/// Faces around a corner that are not next to each other must not become smooth over its back: the
/// normals of every second face of an octahedron's corner are closer than 120 degrees.
#[test]
fn groups_decide() {
    let mesh = octahedron();
    let with = |groups: &[Option<u32>]| is_flat(&mesh, &Creases { groups, ..Creases::NONE });
    assert!(with(&[Some(0); 8]), "group 0 is flat");
    let own = [1, 2, 3, 4, 5, 6, 7, 8].map(Some);
    assert!(with(&own), "groups of their own");
    let apart = Creases { groups: &own, ..Creases::NONE };
    let model = Model::creased(mesh.clone(), Style::PointNormal, &apart).expect("a right mesh");
    assert_eq!(model.creases(), [], "no edge is hard for its angle");
    assert!(!with(&[Some(1); 8]), "one group is smooth");
    assert!(!with(&[None; 8]), "nothing is said");
    let angle = Creases { least_cosine: 0.9, groups: &[Some(3); 8] };
    assert!(!is_flat(&mesh, &angle), "a group is stronger than an angle");
}

/// A fan of narrow faces around one corner, every edge of which is hard: faces that are not next to
/// each other point almost the same way, and must still keep the normals that they have alone.
#[test]
fn narrow_faces_around_a_corner() {
    let mut positions = vec![[0.0, 0.0, 0.5f32]];
    let count = 12u16;
    for k in 0..count {
        let angle = f32::from(k) * std::f32::consts::TAU / f32::from(count);
        positions.push([libm::cosf(angle), libm::sinf(angle), 0.0]);
    }
    let next = |k: u32| if k == u32::from(count) { 1 } else { k + 1 };
    let faces: Vec<[u32; 3]> = (1..=u32::from(count)).map(|k| [0, k, next(k)]).collect();
    let faces: Vec<&[u32]> = faces.iter().map(|face| &face[..]).collect();
    let of = |faces: &[&[u32]], creases: &Creases<'_>| {
        normals(&crate::models::mesh(&positions, faces), creases)
    };
    let alone: Vec<Vec3> = faces.chunks(1).flat_map(|face| of(face, &Creases::NONE)).collect();
    assert_eq!(of(&faces, &Creases { least_cosine: 0.99, ..Creases::NONE }), alone, "by the angle");
    let groups: Vec<Option<u32>> = (1..=u32::from(count)).map(Some).collect();
    assert_eq!(of(&faces, &Creases { groups: &groups, ..Creases::NONE }), alone, "by groups");
    let turns: Vec<Option<u32>> = (0..u32::from(count)).map(|k| Some(1 + k % 2)).collect();
    let in_turn = of(&faces, &Creases { groups: &turns, ..Creases::NONE });
    assert_eq!(in_turn, alone, "two groups in turn: hard edges separate faces of one group");
}

/// Two neighbours with a hard edge, and a face that has only a corner in common with them: it joins
/// the one in its group, and none if it has another.
#[test]
fn groups_decide_about_faces_that_touch_in_a_corner() {
    let positions = [
        [0.0, 0.0, 0.0f32],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.3],
        [0.0, 1.0, 0.0],
        [-1.0, 0.0, 0.1],
        [-1.0, -1.0, 0.0],
    ];
    let faces: [&[u32]; 3] = [&[0, 1, 2], &[0, 2, 3], &[0, 4, 5]];
    let of = |faces: &[&[u32]], groups: &[Option<u32>]| {
        normals(&crate::models::mesh(&positions, faces), &Creases { groups, ..Creases::NONE })
    };
    let alone: Vec<Vec3> = faces.chunks(1).flat_map(|face| of(face, &[])).collect();
    assert_eq!(of(&faces, &[1, 2, 3].map(Some)), alone, "three groups");
    assert_ne!(of(&faces, &[1, 2, 1].map(Some)), alone, "the third joins the first");
}

/// A face keeps the normals that it has, also beside hard edges.
#[test]
fn given_normals_are_kept() {
    let mut mesh = octahedron();
    mesh.normals = vec![Vec3::X];
    let face = &mut mesh.faces[0];
    face.normals = Some(face.positions.map(|_| 0));
    let hard = Creases { least_cosine: 0.9, ..Creases::NONE };
    let [smooth, hard] = [&Creases::NONE, &hard].map(|creases| normals(&mesh, creases));
    assert_eq!(hard[..3], smooth[..3], "the face with normals");
    assert_ne!(hard[3..], smooth[3..], "the others have hard edges");
}

/// A hard edge between a face with normals and one without: the second keeps the normal of its
/// plane, whichever comes first.
#[test]
fn a_hard_edge_beside_a_face_with_normals() {
    let positions = [[0.0, 0.0, 0.0f32], [0.0, 1.0, 0.0], [1.0, 0.0, 1.0], [-1.0, 0.0, 1.0]];
    let plane = [Vec3::new(-1.0, 0.0, 1.0), Vec3::new(1.0, 0.0, 1.0)].map(Vec3::normalize);
    for given in [0, 1] {
        let mut mesh = crate::models::mesh(&positions, &[&[1, 0, 2], &[0, 1, 3]]);
        mesh.normals = vec![Vec3::Z];
        let face = &mut mesh.faces[given];
        face.normals = Some(face.positions.map(|_| 0));
        let other = 1 - given;
        let found = normals(&mesh, &Creases { least_cosine: 0.5, ..Creases::NONE });
        for normal in &found[3 * other..][..3] {
            assert!(normal.distance(plane[other]) < 1e-6, "{given}: {normal}");
        }
    }
}
