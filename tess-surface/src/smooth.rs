//! Smooth normals: one for each corner of a sheet, from the faces around it.
//!
//! G. Thürmer, C. A. Wüthrich, *Computing Vertex Normals from Polygonal Facets*, Journal of
//! Graphics Tools 3(1), 1998: the sum of the faces' normals, each weighted by its angle at the
//! corner. The sum is over the faces of one sheet ([`crate::sheets`]): neighbours that run the same
//! way round and are not folded onto each other. Faces without a common edge, such as those on both
//! sides of a crack, are included if their normals are within 60 degrees.

use crate::edges::MeshEdges;
use crate::math::unit;
use crate::mesh::{Face, PolygonMesh};
use crate::sheets::{fans, mixed};
use crate::sides::{Sides, edge_corners};
use crate::topology::{HalfEdge, HalfEdges, Topology};
use alloc::vec;
use alloc::vec::Vec;
use glam::{DVec3, Vec3};

/// The cosine of the smallest angle between normals at which neighbours are folded onto each other.
const FOLDED: f32 = -0.9999;

/// The same for neighbours that have their corners in common with each other's neighbours, as both
/// sides of a sheet whose faces are not flat. Those of a regular tetrahedron have -1/3.
const FOLDED_ON_CORNERS: f32 = -0.5;

/// The cosine of the largest angle between normals at which fans without a common edge are one
/// sheet.
const ONE_SHEET: f32 = 0.5;

/// Makes smooth normals for the faces that have none. `vertices` has the first position with the
/// same coordinates for each position.
///
/// Returns a unit normal for each position. A face with a corner where several sheets meet gets its
/// own normals in the mesh instead.
pub(crate) fn smooth_normals(
    mesh: &mut PolygonMesh,
    vertices: &[u32],
    topology: &Topology,
) -> Vec<Vec3> {
    let mut sums = vec![Vec3::ZERO; mesh.positions.len()];
    for (vertex, face, corner) in corners(mesh, vertices) {
        sums[vertex as usize] += angle_weighted(&mesh.corners(face), corner);
    }
    // If the normals cancel out, any direction will do: such places are mixed.
    let normals: Vec<Vec3> = sums.iter().map(|&sum| unit(sum).unwrap_or(Vec3::Z)).collect();
    let mut is_mixed = vec![false; mesh.positions.len()];
    for (vertex, face, corner) in corners(mesh, vertices) {
        let agrees =
            across(&mesh.corners(face), corner).dot(sums[vertex as usize].as_dvec3()) > 0.0;
        is_mixed[vertex as usize] |= !agrees;
    }
    for half in unlike_neighbours(mesh, vertices, topology) {
        let corners = &mesh.faces[half.patch].positions;
        for end in edge_corners(corners)[half.edge] {
            is_mixed[vertices[corners.as_slice()[end] as usize] as usize] = true;
        }
    }
    if is_mixed.contains(&true) {
        let of_sheets = normals_of_sheets(mesh, vertices, &is_mixed, topology);
        give_own_normals(mesh, vertices, &normals, &of_sheets);
    }
    normals
}

/// The half-edges at seams, and those whose neighbour belongs to another sheet.
fn unlike_neighbours<'a>(
    mesh: &'a PolygonMesh,
    vertices: &'a [u32],
    topology: &'a Topology,
) -> impl Iterator<Item = HalfEdge> + 'a {
    let halves = mesh.faces.iter().enumerate().flat_map(|(patch, face)| {
        (0..face.positions.as_slice().len()).map(move |edge| HalfEdge { patch, edge })
    });
    let unlike = halves.filter(move |&half| {
        let twin = topology.twin(half).filter(|&twin| half < twin);
        twin.is_some_and(|twin| !is_one_sheet(mesh, vertices, topology, half, twin))
    });
    topology.seams.iter().flatten().copied().chain(unlike)
}

/// Whether neighbours run the same way round and do not lie on each other.
///
/// ```text
///     d ------- c      The front has the faces abc and acd, the back bad and bdc. At the border ab
///     |  \  /  |      abc and bad are neighbours, although d is not a corner of abc: it is one
///     |   /\   |      of acd, the neighbour of abc.
///     a ------- b
/// ```
fn is_one_sheet(
    mesh: &PolygonMesh,
    vertices: &[u32],
    topology: &Topology,
    half: HalfEdge,
    twin: HalfEdge,
) -> bool {
    let edges = MeshEdges { mesh, vertices };
    // Neighbours that run round the same way walk their common edge in opposite directions.
    if edges.is_forward(half) == edges.is_forward(twin) {
        return false;
    }
    let vertices_of = |patch: usize| {
        let positions = mesh.faces[patch].positions.as_slice().iter();
        positions.map(|&position| vertices[position as usize])
    };
    let all_within = |patch: usize, others: &[usize]| {
        let is_there = |vertex| others.iter().any(|&other| vertices_of(other).any(|v| v == vertex));
        vertices_of(patch).all(is_there)
    };
    let around = |half: HalfEdge| {
        let others = (0..4).filter(move |&edge| edge != half.edge);
        let twins =
            others.filter_map(move |edge| topology.twin(HalfEdge { patch: half.patch, edge }));
        twins.map(|twin| twin.patch).chain([half.patch]).collect::<Vec<_>>()
    };
    let cosine = edges.normal(half).dot(edges.normal(twin));
    // Folded flat; or one face has all corners of the other; or the bend is sharp, and the corners
    // of one are those of the other and its neighbours, as in the picture above.
    let is_folded = cosine < FOLDED
        || all_within(twin.patch, &[half.patch])
        || all_within(half.patch, &[twin.patch])
        || cosine < FOLDED_ON_CORNERS
            && (all_within(twin.patch, &around(half)) || all_within(half.patch, &around(twin)));
    !is_folded
}

/// The vertex, the face and the number of each corner.
fn corners<'a>(
    mesh: &'a PolygonMesh,
    vertices: &'a [u32],
) -> impl Iterator<Item = (u32, &'a Face, usize)> {
    mesh.faces.iter().flat_map(move |face| {
        let positions = face.positions.as_slice().iter().enumerate();
        positions.map(move |(corner, &position)| (vertices[position as usize], face, corner))
    })
}

/// The slots of the corners at mixed places and their normals, in ascending order.
fn normals_of_sheets(
    mesh: &PolygonMesh,
    vertices: &[u32],
    is_mixed: &[bool],
    topology: &Topology,
) -> Vec<(u32, Vec3)> {
    let slots = mesh.faces.iter().enumerate().flat_map(|(patch, face)| {
        let positions = face.positions.as_slice().iter().enumerate();
        positions.map(move |(edge, &position)| {
            (vertices[position as usize], HalfEdge { patch, edge }.slot())
        })
    });
    let joins = |half, twin| is_one_sheet(mesh, vertices, topology, half, twin);
    let beyond = |half| topology.twin(half).filter(|&twin| joins(half, twin)).into_iter();
    let mut normals = Vec::new();
    // Each place by itself: the corners there, joined into fans across the edges of one sheet.
    for place in mixed(slots, is_mixed).chunk_by(|a, b| a.0 == b.0) {
        let corners: Vec<u32> = place.iter().map(|&(_, slot)| slot).collect();
        let fans = fans(&corners, |patch| mesh.faces[patch].positions.map(drop), beyond);
        let own: Vec<Vec3> = corners.iter().map(|&slot| weighted_normal(mesh, slot)).collect();
        let of_fans = sheet_normals(&fans, &own);
        normals.extend(corners.iter().zip(of_fans).map(|(&slot, normal)| (slot, normal)));
    }
    normals.sort_unstable_by_key(|&(slot, _)| slot);
    normals
}

fn weighted_normal(mesh: &PolygonMesh, slot: u32) -> Vec3 {
    let HalfEdge { patch, edge: corner } = HalfEdge::of_slot(slot);
    angle_weighted(&mesh.corners(&mesh.faces[patch]), corner)
}

/// The unit normal of each corner at a place. `fans` has the first corner of each corner's fan, and
/// `own` its weighted normal.
fn sheet_normals(fans: &[usize], own: &[Vec3]) -> Vec<Vec3> {
    let mut sums = vec![Vec3::ZERO; fans.len()];
    fans.iter().zip(own).for_each(|(&fan, &normal)| sums[fan] += normal);
    // The sum and the fans of each sheet.
    let mut sheets: Vec<(Vec3, Vec<usize>)> = Vec::new();
    // A fan joins the first sheet whose sum so far points its way, else it begins one. The order is
    // that of the corners, so equal meshes get equal normals.
    for fan in (0..fans.len()).filter(|&fan| fans[fan] == fan) {
        let direction = unit(sums[fan]).unwrap_or(Vec3::ZERO);
        let near = sheets
            .iter_mut()
            .find(|(sum, _)| unit(*sum).is_some_and(|sum| sum.dot(direction) > ONE_SHEET));
        match near {
            Some((sum, fans)) => {
                *sum += sums[fan];
                fans.push(fan);
            }
            None => sheets.push((sums[fan], Vec::from([fan]))),
        }
    }
    // Where the faces of a sheet cancel out, a corner keeps the normal of its own face.
    let normal_of = |at: usize| {
        let sheet = sheets.iter().find(|(_, of_sheet)| of_sheet.contains(&fans[at]));
        let shared = sheet.and_then(|(sum, _)| unit(*sum));
        shared.or_else(|| unit(own[at])).unwrap_or(Vec3::Z)
    };
    (0..fans.len()).map(normal_of).collect()
}

/// Gives own normals to the faces without normals that have a corner in `of_sheets`.
fn give_own_normals(
    mesh: &mut PolygonMesh,
    vertices: &[u32],
    normals: &[Vec3],
    of_sheets: &[(u32, Vec3)],
) {
    for run in of_sheets.chunk_by(|a, b| a.0 / 4 == b.0 / 4) {
        let face = &mut mesh.faces[(run[0].0 / 4) as usize];
        if face.normals.is_some() {
            continue;
        }
        let all = &mut mesh.normals;
        face.normals = Some(face.positions.map_numbered(|corner, position| {
            let own = run.iter().find(|(slot, _)| (slot % 4) as usize == corner);
            let shared = normals[vertices[position as usize] as usize];
            all.push(own.map_or(shared, |&(_, normal)| normal));
            u32::try_from(all.len() - 1).unwrap_or(u32::MAX)
        }));
    }
}

/// The unit normal at a corner times the angle between its edges.
fn angle_weighted(corners: &Sides<Vec3>, corner: usize) -> Vec3 {
    let [next, previous] = edges_from(corners, corner);
    let cross = next.cross(previous);
    let angle = libm::atan2(cross.length(), next.dot(previous));
    (cross.normalize_or_zero() * angle).as_vec3()
}

/// The direction of the normal at a corner.
fn across(corners: &Sides<Vec3>, corner: usize) -> DVec3 {
    let [next, previous] = edges_from(corners, corner);
    next.cross(previous)
}

/// The vectors from a corner to the next one and to the previous one.
fn edges_from(corners: &Sides<Vec3>, corner: usize) -> [DVec3; 2] {
    let points = corners.as_slice();
    let count = points.len();
    let to = |other: usize| points[other].as_dvec3() - points[corner].as_dvec3();
    [to((corner + 1) % count), to((corner + count - 1) % count)]
}
