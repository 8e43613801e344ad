//! Rounds a cube by its corners' normals, displaces it by a height image, and finds the same bits
//! on both sides of every edge.
#![expect(clippy::print_stdout, reason = "an example prints")]

use tess_surface::glam::Vec3;
use tess_surface::{
    DisplacedModel, Displacement, Face, HalfEdge, HeightMap, MeshError, Model, Place, PolygonMesh,
    Sides, Style,
};

/// The numbers of the corners of each face, counter-clockwise as seen from outside.
const FACES: [[u32; 4]; 6] =
    [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [1, 3, 7, 5], [3, 2, 6, 7], [2, 0, 4, 6]];

fn cube() -> PolygonMesh {
    let corner = |number: u8| {
        let side = |bit: u8| if number >> bit & 1 == 1 { 1.0 } else { -1.0 };
        Vec3::new(side(0), side(1), side(2))
    };
    let face = |corners| Face { positions: Sides::Quad(corners), normals: None, texcoords: None };
    PolygonMesh {
        positions: (0..8).map(corner).collect(),
        faces: FACES.map(face).to_vec(),
        ..PolygonMesh::default()
    }
}

pub(crate) fn main() -> Result<(), MeshError> {
    let model = Model::polygons(cube(), Style::PointNormal)?;
    let checkers = HeightMap::new(2, 2, vec![0.0, 1.0, 1.0, 0.0]).expect("four texels");
    let displacement = Displacement::new(checkers, 0.25).expect("a finite height");
    let displaced = DisplacedModel::new(&model, &displacement);

    for patch in 0..model.len() {
        let middle = displaced.patch(patch).sample([0.5, 0.5]).position;
        println!("the middle of face {patch} is at {middle}");
        for edge in 0..4 {
            let half = HalfEdge { patch, edge };
            let twin = model.twin(half).expect("a cube has no border");
            assert_eq!(middle_of(&displaced, half), middle_of(&displaced, twin), "one edge");
        }
    }
    Ok(())
}

/// The position of the middle of an edge, evaluated by one of its patches.
fn middle_of(displaced: &DisplacedModel<'_>, half: HalfEdge) -> Vec3 {
    let at = [[0.0, 0.5], [0.5, 0.0], [1.0, 0.5], [0.5, 1.0]][half.edge];
    let place = displaced.model().patch(half.patch).place(at[0], at[1]);
    assert_eq!(place, Place::Edge(half.edge, 0.5), "edges are in the tessellator's order");
    displaced.patch(half.patch).sample(at).position
}
