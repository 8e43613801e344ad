//! Faces without area, such as those at the pole of a sphere.
//!
//! A triangle with two corners in the same place is an edge. If it is dropped, the faces on its two
//! sides meet at that edge. A quad with one collapsed edge becomes a triangle.
//!
//! The distinct corners of a sliver are on one line:
//!
//! ```text
//!     a ------ m ------ b        The sliver a m b has neighbours at a-m, at m-b, and at a-b, where the neighbour has
//!      \               /         no corner at m. The sliver is dropped, and that neighbour gets the corner m: it
//!        \           /           becomes the polygon a m b c. All three then meet without a gap.
//!             c
//! ```
//!
//! In general, the neighbour at each edge of a sliver gets the sliver's other corners that are
//! between the ends of the edge. The order along the line is the same for all edges, so that all
//! neighbours get the same corners in the same order, wherever the sliver begins.

use crate::repair::draft::Draft;
use crate::repair::polygon::{Corner, Place, corners, place, triangles};
use crate::repair::tally::Tally;
use glam::Vec3;
use rayon::prelude::*;
use std::collections::{BTreeMap, HashMap};
use tess_surface::{Face, FaceError, PolygonMesh, Sides};

/// The largest number of rounds in which slivers are joined. Cutting a neighbour can leave another
/// sliver.
const MOST_ROUNDS: usize = 8;

/// Drops faces that have no area, and corners that coincide with the one before. Faces with other
/// faults are left unchanged.
pub(crate) fn repair(draft: &mut Draft) {
    drop_repeated(draft);
    let mut joined = Tally::default();
    for round in 0..MOST_ROUNDS {
        let slivers = slivers(draft);
        if slivers.is_empty() {
            break;
        }
        if round == 0 {
            joined = Tally::of(slivers.len(), || draft.place(slivers[0]));
        }
        join(draft, &slivers);
        drop_repeated(draft);
    }
    let done = "left out, as they have no area; their neighbours meet there";
    draft.note(joined.note("face", " with all corners on one line", done));
    let left = slivers(draft);
    if !left.is_empty() {
        let tally = Tally::of(left.len(), || draft.place(left[0]));
        let done = "left out; cracks may open where they joined others";
        draft.note(tally.note("face", " without area that could not be joined", done));
        drop_faces(draft, &left);
    }
}

/// The fault of a face that is repaired here; its normals and texture coordinates are ignored.
fn fault(mesh: &PolygonMesh, face: &Face) -> Option<FaceError> {
    let fault = mesh.check_face(&Face { normals: None, texcoords: None, ..*face }).err();
    fault.filter(|fault| matches!(fault, FaceError::RepeatedCorner | FaceError::NoArea))
}

/// The numbers of the faces without area whose corners are distinct.
fn slivers(draft: &Draft) -> Vec<usize> {
    let mesh = &draft.mesh;
    let faces = mesh.faces.par_iter().enumerate();
    let slivers = faces.filter(|(_, face)| fault(mesh, face) == Some(FaceError::NoArea));
    slivers.map(|(number, _)| number).collect()
}

fn drop_faces(draft: &mut Draft, dropped: &[usize]) {
    let mut number = 0..;
    draft.replace_faces(|_, face, _| {
        let number: usize = number.next().unwrap_or_default();
        if dropped.binary_search(&number).is_ok() { Vec::new() } else { vec![*face] }
    });
}

/// Drops faces that have too few distinct corners, and makes triangles of quads with three.
fn drop_repeated(draft: &mut Draft) {
    let is_repeated = |face: &Face| {
        fault(&draft.mesh, face) == Some(FaceError::RepeatedCorner)
            || has_opposite_repeat(&draft.mesh, face)
    };
    if !draft.mesh.faces.par_iter().any(is_repeated) {
        return;
    }
    let (mut repeated, mut narrowed) = (Tally::default(), Tally::default());
    draft.replace_faces(|mesh, face, place| {
        if has_opposite_repeat(mesh, face) {
            repeated.add(place);
            return Vec::new();
        }
        if fault(mesh, face) != Some(FaceError::RepeatedCorner) {
            return vec![*face];
        }
        let narrow = without_repeats(&mesh.positions, face);
        let tally = if narrow.is_some() { &mut narrowed } else { &mut repeated };
        tally.add(place);
        narrow.into_iter().collect()
    });
    let same = " with corners in the same place";
    draft.note(repeated.note("face", same, "left out, as they have no area"));
    draft.note(narrowed.note("quad", same, "made triangles"));
}

/// Whether a quad is folded onto itself: two opposite corners are in the same place. Each of its
/// edges is there in both directions, so nothing is missing without it.
fn has_opposite_repeat(mesh: &PolygonMesh, face: &Face) -> bool {
    let Sides::Quad(corners) = face.positions else { return false };
    let at = |index: u32| mesh.positions.get(index as usize).copied().unwrap_or(Vec3::NAN);
    let [a, b, c, d] = corners.map(at);
    a == c || b == d
}

/// The triangle that remains of a quad if one of its corners repeats the corner before.
fn without_repeats(positions: &[Vec3], face: &Face) -> Option<Face> {
    let places = face.positions.map(|index| positions[index as usize]);
    let places = places.as_slice();
    let is_new = |&corner: &usize| {
        let before = if corner == 0 { places.len() - 1 } else { corner - 1 };
        places[corner] != places[before]
    };
    let kept: Vec<usize> = (0..places.len()).filter(is_new).collect();
    let &[a, b, c] = kept.as_slice() else { return None };
    let three = |sides: Sides<u32>| Sides::Triangle([a, b, c].map(|k| sides.as_slice()[k]));
    Some(Face {
        positions: three(face.positions),
        normals: face.normals.map(three),
        texcoords: face.texcoords.map(three),
    })
}

/// The ends of an edge, the lower key first.
type EdgeKey = [Place; 2];

fn edge_key(a: Vec3, b: Vec3) -> EdgeKey {
    let (a, b) = (place(a), place(b));
    if a < b { [a, b] } else { [b, a] }
}

/// Drops slivers, and gives their corners to the neighbours at their edges.
fn join(draft: &mut Draft, slivers: &[usize]) {
    let mut polygons = Polygons::around(draft, slivers);
    for &sliver in slivers {
        let walk = polygons.take(draft, sliver);
        for (k, &from) in walk.iter().enumerate() {
            let ends = [from, walk[(k + 1) % walk.len()]];
            let between = between(&walk, ends);
            if !between.is_empty() {
                polygons.insert(draft, sliver, ends, &between);
            }
        }
    }
    let changed = polygons.changed;
    let mut number = 0..;
    draft.replace_faces(|mesh, face, _| {
        let number: usize = number.next().unwrap_or_default();
        match changed.get(&number) {
            _ if slivers.binary_search(&number).is_ok() => Vec::new(),
            Some(polygon) => triangles(polygon, &mesh.positions).faces,
            None => vec![*face],
        }
    });
}

/// The places of a sliver's corners that are between the ends of one of its edges, from the first
/// end to the second.
fn between(walk: &[Vec3], ends: [Vec3; 2]) -> Vec<Vec3> {
    // The two corners that are farthest from each other give the direction of the line.
    let pairs = walk.iter().flat_map(|&a| walk.iter().map(move |&b| (a, b)));
    let farthest = pairs.max_by(|x, y| {
        let length = |(a, b): &(Vec3, Vec3)| (a.as_dvec3() - b.as_dvec3()).length_squared();
        length(x)
            .total_cmp(&length(y))
            .then_with(|| (place(x.0), place(x.1)).cmp(&(place(y.0), place(y.1))))
    });
    let Some((start, end)) = farthest else { return Vec::new() };
    let along = (end - start).as_dvec3();
    // Corners at the same distance have an order too, which is the same for every edge.
    let order = |a: &Vec3, b: &Vec3| {
        let distance = |at: &Vec3| (at.as_dvec3() - start.as_dvec3()).dot(along);
        distance(a).total_cmp(&distance(b)).then_with(|| place(*a).cmp(&place(*b)))
    };
    let [from, to] = ends;
    let is_onwards = order(&from, &to).is_lt();
    let (low, high) = if is_onwards { (from, to) } else { (to, from) };
    let is_between = |at: &&Vec3| order(&low, at).is_lt() && order(at, &high).is_lt();
    let mut inner: Vec<Vec3> = walk.iter().filter(is_between).copied().collect();
    inner.sort_by(order);
    inner.dedup_by_key(|at| place(*at));
    if !is_onwards {
        inner.reverse();
    }
    inner
}

/// The slivers and their neighbours as polygons.
struct Polygons {
    /// The faces that have each edge of a sliver.
    faces_of: HashMap<EdgeKey, Vec<usize>>,
    /// The corners of the faces that have been given some.
    changed: BTreeMap<usize, Vec<Corner>>,
}

impl Polygons {
    fn around(draft: &Draft, slivers: &[usize]) -> Self {
        let mesh = &draft.mesh;
        let edges = |face: usize| {
            let places = mesh.corners(&mesh.faces[face]);
            let places = places.as_slice().to_vec();
            let count = places.len();
            (0..count).map(move |k| edge_key(places[k], places[(k + 1) % count]))
        };
        let mut faces_of: HashMap<EdgeKey, Vec<usize>> = HashMap::new();
        for &sliver in slivers {
            edges(sliver).for_each(|edge| _ = faces_of.entry(edge).or_default());
        }
        for face in 0..mesh.faces.len() {
            for edge in edges(face) {
                if let Some(faces) = faces_of.get_mut(&edge) {
                    faces.push(face);
                }
            }
        }
        Self { faces_of, changed: BTreeMap::new() }
    }

    /// The corners of a face, as far as they are known now.
    fn polygon(&self, draft: &Draft, face: usize) -> Vec<Corner> {
        self.changed.get(&face).cloned().unwrap_or_else(|| corners(&draft.mesh.faces[face]))
    }

    /// Removes a sliver, and returns the places of its corners.
    fn take(&mut self, draft: &Draft, sliver: usize) -> Vec<Vec3> {
        let polygon = self.polygon(draft, sliver);
        let places = polygon.iter().map(|corner| draft.mesh.positions[corner.position as usize]);
        let places: Vec<Vec3> = places.collect();
        for k in 0..places.len() {
            let edge = edge_key(places[k], places[(k + 1) % places.len()]);
            if let Some(faces) = self.faces_of.get_mut(&edge) {
                faces.retain(|&face| face != sliver);
            }
        }
        places
    }

    /// Inserts corners at these places into the edges between two others.
    fn insert(&mut self, draft: &mut Draft, sliver: usize, ends: [Vec3; 2], places: &[Vec3]) {
        let faces = self.faces_of.remove(&edge_key(ends[0], ends[1])).unwrap_or_default();
        for face in faces.into_iter().filter(|&face| face != sliver) {
            let polygon = self.polygon(draft, face);
            let mut longer = Vec::with_capacity(polygon.len() + places.len());
            for (k, &corner) in polygon.iter().enumerate() {
                longer.push(corner);
                let next = polygon[(k + 1) % polygon.len()];
                let [a, b] = [corner, next].map(|c| draft.mesh.positions[c.position as usize]);
                if a == ends[0] && b == ends[1] {
                    longer
                        .extend(places.iter().map(|&at| draft.corner_between([corner, next], at)));
                } else if a == ends[1] && b == ends[0] {
                    let places = places.iter().rev();
                    longer.extend(places.map(|&at| draft.corner_between([corner, next], at)));
                }
            }
            self.changed.insert(face, longer);
            let around = [&[ends[0]], places, &[ends[1]]].concat();
            for pair in around.windows(2) {
                let edge = edge_key(pair[0], pair[1]);
                let faces = self.faces_of.entry(edge).or_default();
                if !faces.contains(&face) {
                    faces.push(face);
                }
            }
        }
    }
}
