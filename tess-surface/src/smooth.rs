//! Smooth normals: one for each corner of a sheet, from the faces around it.
//!
//! G. Thürmer, C. A. Wüthrich, *Computing Vertex Normals from Polygonal Facets*, Journal of
//! Graphics Tools 3(1), 1998: the sum of the faces' normals, each weighted by its angle at the
//! corner. The sum is over the faces of one sheet ([`crate::sheets`]): neighbours that run the same
//! way round and are not folded onto each other. Faces without a common edge, such as those on both
//! sides of a crack, are included if their normals are within 60 degrees.

use crate::crease::{Creases, Hardness, Smoothed};
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
/// A face with a corner where several sheets meet, or where an edge is hard, gets its own normals
/// in the mesh instead of those of its positions.
pub(crate) fn smooth_normals(
    mesh: &mut PolygonMesh,
    vertices: &[u32],
    topology: &Topology,
    creases: &Creases<'_>,
) -> Smoothed {
    give_flat_normals(mesh, creases);
    let mut sums = vec![Vec3::ZERO; mesh.positions.len()];
    for (vertex, face, corner) in corners(mesh, vertices) {
        sums[vertex as usize] += angle_weighted(&mesh.corners(face), corner);
    }
    // Where the normals cancel out there is none, and none is needed: such places are mixed, so
    // their faces get own normals.
    let normals: Vec<Vec3> = sums.iter().map(|&sum| unit(sum).unwrap_or_default()).collect();
    let mut is_mixed = vec![false; mesh.positions.len()];
    for (vertex, face, corner) in corners(mesh, vertices) {
        let agrees =
            across(&mesh.corners(face), corner).dot(sums[vertex as usize].as_dvec3()) > 0.0;
        is_mixed[vertex as usize] |= !agrees;
    }
    let sheets = Sheets { mesh, vertices, topology, creases };
    let mut by_angle = Vec::new();
    for (half, link) in sheets.breaks() {
        if link == Link::Crease(Hardness::Angle) {
            by_angle.push(half);
        }
        let corners = &mesh.faces[half.patch].positions;
        for end in edge_corners(corners)[half.edge] {
            is_mixed[vertices[corners.as_slice()[end] as usize] as usize] = true;
        }
    }
    if is_mixed.contains(&true) {
        let of_sheets = sheets.normals(&is_mixed);
        give_own_normals(mesh, vertices, &normals, &of_sheets);
    }
    Smoothed { normals, creases: by_angle }
}

/// Gives the normal of its plane to each flat face that has no normals.
fn give_flat_normals(mesh: &mut PolygonMesh, creases: &Creases<'_>) {
    for number in 0..mesh.faces.len() {
        let face = mesh.faces[number];
        if face.normals.is_none() && creases.is_flat(number) {
            let normal = u32::try_from(mesh.normals.len()).unwrap_or(u32::MAX);
            mesh.normals.push(mesh.face_normal(&face));
            mesh.faces[number].normals = Some(face.positions.map(|_| normal));
        }
    }
}

/// How two neighbours are joined at an edge.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Link {
    /// They are one sheet, and their normals are one.
    Smooth,
    /// They are one sheet, but the edge is hard.
    Crease(Hardness),
    /// They are two sheets.
    Apart,
}

/// A mesh whose corners are grouped into sheets.
#[derive(Clone, Copy)]
struct Sheets<'a> {
    mesh: &'a PolygonMesh,
    vertices: &'a [u32],
    topology: &'a Topology,
    creases: &'a Creases<'a>,
}

impl<'a> Sheets<'a> {
    fn link(&self, half: HalfEdge, twin: HalfEdge) -> Link {
        let Self { mesh, vertices, topology, creases } = *self;
        if !is_one_sheet(mesh, vertices, topology, half, twin) {
            return Link::Apart;
        }
        let edges = MeshEdges { mesh, vertices };
        let cosine = edges.normal(half).dot(edges.normal(twin));
        match creases.hardness(half.patch, twin.patch, cosine) {
            Hardness::Smooth => Link::Smooth,
            hardness => Link::Crease(hardness),
        }
    }

    /// The half-edges at seams, and one side of each edge whose sides are not joined smoothly.
    /// Edges between faces that have their own normals are left out.
    fn breaks(self) -> impl Iterator<Item = (HalfEdge, Link)> + 'a {
        let Self { mesh, topology, .. } = self;
        let halves = mesh.faces.iter().enumerate().flat_map(|(patch, face)| {
            (0..face.positions.as_slice().len()).map(move |edge| HalfEdge { patch, edge })
        });
        let lacks = move |half: HalfEdge| mesh.faces[half.patch].normals.is_none();
        let pairs = halves.filter_map(move |half| {
            let twin = topology.twin(half).filter(|&twin| half < twin)?;
            (lacks(half) || lacks(twin)).then(|| (half, self.link(half, twin)))
        });
        let seams = topology.seams.iter().flatten().map(|&half| (half, Link::Apart));
        seams.chain(pairs.filter(|&(_, link)| link != Link::Smooth))
    }

    /// The slots of the corners at mixed places and their normals, in ascending order.
    fn normals(&self, is_mixed: &[bool]) -> Vec<(u32, Vec3)> {
        let Self { mesh, vertices, topology, .. } = *self;
        let slots = mesh.faces.iter().enumerate().flat_map(|(patch, face)| {
            let positions = face.positions.as_slice().iter().enumerate();
            positions.map(move |(edge, &position)| {
                (vertices[position as usize], HalfEdge { patch, edge }.slot())
            })
        });
        let beyond = |half, is_joined: fn(Link) -> bool| {
            let twin = topology.twin(half).filter(|&twin| is_joined(self.link(half, twin)));
            twin.into_iter()
        };
        let sides = |patch: usize| mesh.faces[patch].positions.map(drop);
        let mut normals = Vec::new();
        for place in mixed(slots, is_mixed).chunk_by(|a, b| a.0 == b.0) {
            let corners: Vec<u32> = place.iter().map(|&(_, slot)| slot).collect();
            let fans_of =
                |is_joined: fn(Link) -> bool| fans(&corners, sides, |half| beyond(half, is_joined));
            let corners = SheetCorners {
                fans: fans_of(|link| link == Link::Smooth),
                // Fans that only hard edges separate must not become one again.
                umbrellas: fans_of(|link| link != Link::Apart),
                own: corners.iter().map(|&slot| weighted_normal(mesh, slot)).collect(),
                faces: corners.iter().map(|&slot| HalfEdge::of_slot(slot).patch).collect(),
            };
            let of_corners = corners.normals(mesh, self.creases);
            normals.extend(place.iter().zip(of_corners).map(|(&(_, slot), normal)| (slot, normal)));
        }
        normals.sort_unstable_by_key(|&(slot, _)| slot);
        normals
    }
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

fn weighted_normal(mesh: &PolygonMesh, slot: u32) -> Vec3 {
    let HalfEdge { patch, edge: corner } = HalfEdge::of_slot(slot);
    angle_weighted(&mesh.corners(&mesh.faces[patch]), corner)
}

/// The corners at one place.
struct SheetCorners {
    /// The first corner of each corner's fan: the corners that smooth edges join.
    fans: Vec<usize>,
    /// The same with hard edges.
    umbrellas: Vec<usize>,
    /// The weighted normal of each corner.
    own: Vec<Vec3>,
    /// The face of each corner.
    faces: Vec<usize>,
}

impl SheetCorners {
    /// The unit normal of each corner.
    fn normals(&self, mesh: &PolygonMesh, creases: &Creases<'_>) -> Vec<Vec3> {
        let Self { fans, umbrellas, own, faces } = self;
        let mut sums = vec![Vec3::ZERO; fans.len()];
        fans.iter().zip(own).for_each(|(&fan, &normal)| sums[fan] += normal);
        // The sum and the fans of each sheet.
        let mut sheets: Vec<(Vec3, Vec<usize>)> = Vec::new();
        // A fan joins the first sheet whose sum so far points its way, else it begins one. The
        // order is that of the corners, so equal meshes get equal normals.
        for fan in (0..fans.len()).filter(|&fan| fans[fan] == fan) {
            // A sum of zero has no direction, and is near nothing.
            let direction = unit(sums[fan]).unwrap_or_default();
            let is_near = |sum: Vec3, of_sheet: &[usize]| {
                let cosine = unit(sum).unwrap_or_default().dot(direction);
                let is_apart = |other: usize| {
                    umbrellas[other] == umbrellas[fan]
                        || creases.hardness(faces[other], faces[fan], cosine) != Hardness::Smooth
                };
                cosine > ONE_SHEET && !of_sheet.iter().any(|&other| is_apart(other))
            };
            match sheets.iter_mut().find(|(sum, of_sheet)| is_near(*sum, of_sheet)) {
                Some((sum, of_sheet)) => {
                    *sum += sums[fan];
                    of_sheet.push(fan);
                }
                None => sheets.push((sums[fan], Vec::from([fan]))),
            }
        }
        // Where the faces of a sheet cancel out, and at a straight corner, whose edges span no
        // plane, a corner keeps the normal of its own face.
        let normal_of = |at: usize| {
            let sheet = sheets.iter().find(|(_, of_sheet)| of_sheet.contains(&fans[at]));
            let shared = sheet.and_then(|(sum, _)| unit(*sum));
            shared.unwrap_or_else(|| mesh.face_normal(&mesh.faces[faces[at]]))
        };
        (0..fans.len()).map(normal_of).collect()
    }
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
