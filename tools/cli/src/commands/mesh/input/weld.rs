//! Gaps between faces that should be neighbours: corners that nearly coincide, and corners on the
//! inside of another face's edge.
//!
//! ```text
//!    d-----------c-------g        The edge b-c of the large quad has no neighbour: the small quads have b-e and
//!    |           |       |        e-c. The corner e hangs on it. Where the large quad's edge has other points than
//!    |           e-------f        the small ones', a crack opens.
//!    |           |       |
//!    a-----------b-------h        Splitting the edge at e makes a, b, e, c, d a polygon, which is cut into triangles.
//! ```
//! Only edges without a neighbour can have a gap, so closed models cost nothing here.
//! Only edges without a neighbour can have a gap, so that closed models cost nothing here.

use super::draft::Draft;
use super::polygon::{Corner, corners, triangles};
use super::tally::Tally;
use glam::Vec3;
use std::collections::{BTreeMap, HashMap, HashSet};
use tess_surface::sides::edge_corners;
use tess_surface::{HalfEdge, Model, PolygonMesh};

/// Gaps smaller than this part of the model's diagonal are closed if no width is given.
const PART_OF_DIAGONAL: f32 = 1e-6;

/// So are gaps of this many units in the last place of the largest coordinate.
const UNITS: f32 = 4.0;

/// The largest number of rounds in which edges are split. Splitting an edge can bring it close to
/// another corner.
const MOST_ROUNDS: usize = 8;

/// The coordinates of a place as a key, in which -0 equals 0.
type Place = [u32; 3];

fn key(position: Vec3) -> Place {
    (position + Vec3::ZERO).to_array().map(f32::to_bits)
}

/// The gaps of a model.
#[derive(Debug, Default)]
pub(super) struct Gaps {
    /// The largest distance that counts as a gap.
    reach: f32,
    /// Pairs of a corner and the corner that it nearly coincides with, each with the number of a
    /// face that has the first.
    near: Vec<(Vec3, Vec3, usize)>,
    /// Edges with the corners that hang on them, in the order of the face's corners.
    hanging: Vec<(HalfEdge, Vec<Vec3>)>,
}

impl Gaps {
    /// The gaps of a model made from `mesh`, up to `reach` wide, or up to the width that rounding
    /// causes.
    pub(super) fn of(model: &Model, mesh: &PolygonMesh, reach: Option<f32>) -> Self {
        let edges = OpenEdges::of(model, mesh);
        if edges.0.is_empty() {
            return Self::default();
        }
        let reach = reach.unwrap_or_else(|| rounding(mesh));
        let (near, hanging) = (edges.near(reach), edges.hanging(mesh, reach));
        Self { reach, near, hanging }
    }

    /// Adds notes about gaps that stay open.
    pub(super) fn warn(&self, draft: &mut Draft) {
        let crack = "a crack may open there, --weld ";
        self.note(draft, &format!("{crack}joins them"), &format!("{crack}splits the edge"));
    }

    fn note(&self, draft: &mut Draft, joined: &str, split: &str) {
        let Self { reach, near, hanging } = self;
        let first = || {
            let (from, _, face) = near[0];
            format!("{} at {}", shown(from), draft.place(face))
        };
        let rest = format!(" within {reach:.1e} of another");
        let near = Tally::of(near.len(), first).note("corner", &rest, joined);
        let first = || {
            let (half, corners) = &hanging[0];
            format!("{} on an edge at {}", shown(corners[0]), draft.place(half.patch))
        };
        let count = hanging.iter().map(|(_, corners)| corners.len()).sum();
        let hanging = Tally::of(count, first).note("corner", " on another face's edge", split);
        draft.note(near);
        draft.note(hanging);
    }
}

/// Closes the gaps of a mesh. `model` makes a model from it, of which only the neighbours matter.
pub(super) fn weld<E>(
    draft: &mut Draft,
    reach: Option<f32>,
    model: impl Fn(&PolygonMesh) -> Result<Model, E>,
) -> Result<(), E> {
    let gaps = Gaps::of(&model(&draft.mesh)?, &draft.mesh, reach);
    let joined = Gaps { hanging: Vec::new(), ..gaps };
    joined.note(draft, "moved onto it", "");
    let moves: HashMap<Place, Vec3> =
        joined.near.iter().map(|&(from, to, _)| (key(from), to)).collect();
    if !moves.is_empty() {
        for position in &mut draft.mesh.positions {
            *position = moves.get(&key(*position)).copied().unwrap_or(*position);
        }
        super::collapsed::repair(draft);
    }
    for round in 0..MOST_ROUNDS {
        let gaps = Gaps::of(&model(&draft.mesh)?, &draft.mesh, reach);
        if gaps.hanging.is_empty() {
            break;
        }
        if round == 0 {
            let hanging = Gaps { near: Vec::new(), ..gaps };
            hanging.note(draft, "", "the edge is split there");
            split(draft, &hanging.hanging);
        } else {
            split(draft, &gaps.hanging);
        }
    }
    Ok(())
}

/// Splits edges at the corners that hang on them, and cuts their faces.
fn split(draft: &mut Draft, hanging: &[(HalfEdge, Vec<Vec3>)]) {
    let mesh = &mut draft.mesh;
    let positions = mesh.positions.iter().zip(0u32..).map(|(&at, number)| (key(at), number));
    let number_of: HashMap<Place, u32> = positions.collect();
    // The corners to insert after each corner of each face.
    let mut inserted: BTreeMap<usize, BTreeMap<usize, Vec<Corner>>> = BTreeMap::new();
    for (half, places) in hanging {
        let face = mesh.faces[half.patch];
        let around = corners(&face);
        let [from, to] = onwards(&face.positions, half.edge);
        let ends = [around[from], around[to]];
        let between = places.iter().map(|&at| corner_between(mesh, ends, at, number_of[&key(at)]));
        let between = between.collect();
        inserted.entry(half.patch).or_default().insert(from, between);
    }
    let mut number = 0..;
    draft.replace_faces(|mesh, face, _| {
        let Some(inserted) = number.next().and_then(|face: usize| inserted.get(&face)) else {
            return vec![*face];
        };
        let mut polygon = Vec::new();
        for (k, corner) in corners(face).into_iter().enumerate() {
            polygon.push(corner);
            polygon.extend(inserted.get(&k).into_iter().flatten());
        }
        triangles(&polygon, &mesh.positions)
    });
    super::collapsed::repair(draft);
}

/// The corner of a split edge at a place. Its texture coordinates and normal are interpolated
/// between those of the edge's ends.
fn corner_between(mesh: &mut PolygonMesh, ends: [Corner; 2], at: Vec3, position: u32) -> Corner {
    let [a, b] = ends.map(|corner| mesh.positions[corner.position as usize]);
    let t = (at - a).dot(b - a) / (b - a).length_squared();
    let last = |length: usize| u32::try_from(length - 1).unwrap_or(u32::MAX);
    let [a, b] = ends;
    let texcoord = a.texcoord.zip(b.texcoord).map(|(a, b)| {
        let between = mesh.texcoords[a as usize].lerp(mesh.texcoords[b as usize], t);
        mesh.texcoords.push(between);
        last(mesh.texcoords.len())
    });
    let normal = a.normal.zip(b.normal).map(|(a, b)| {
        let [a, b] = [a, b].map(|normal| mesh.normals[normal as usize].normalize_or_zero());
        mesh.normals.push(a.lerp(b, t));
        last(mesh.normals.len())
    });
    Corner { position, texcoord, normal }
}

/// The corners at the ends of an edge, in the order of the face's corners.
fn onwards<T>(sides: &tess_surface::Sides<T>, edge: usize) -> [usize; 2] {
    let [start, end] = edge_corners(sides)[edge];
    let follows = end == (start + 1) % sides.as_slice().len();
    if follows { [start, end] } else { [end, start] }
}

/// The largest gap that rounding can cause.
fn rounding(mesh: &PolygonMesh) -> f32 {
    let empty = (Vec3::INFINITY, Vec3::NEG_INFINITY);
    let used = mesh.faces.iter().flat_map(|face| face.positions.as_slice());
    let used = used.map(|&index| mesh.positions[index as usize]);
    let (low, high) = used.fold(empty, |(low, high), at| (low.min(at), high.max(at)));
    let largest = low.abs().max(high.abs()).max_element();
    (high.distance(low) * PART_OF_DIAGONAL).max(largest * f32::EPSILON * UNITS)
}

fn shown(at: Vec3) -> String {
    format!("({}, {}, {})", at.x, at.y, at.z)
}

/// The edges without a neighbour, each from one corner to the next.
struct OpenEdges(Vec<(HalfEdge, [Vec3; 2])>);

impl OpenEdges {
    fn of(model: &Model, mesh: &PolygonMesh) -> Self {
        let faces = mesh.faces.iter().enumerate();
        let is_seam: HashSet<HalfEdge> = model.seams().iter().flatten().copied().collect();
        let open = faces.flat_map(|(patch, face)| {
            let halves =
                (0..face.positions.as_slice().len()).map(move |edge| HalfEdge { patch, edge });
            let alone =
                halves.filter(|&half| model.twin(half).is_none() && !is_seam.contains(&half));
            alone.map(|half| {
                let corners = mesh.corners(face);
                (half, onwards(&corners, half.edge).map(|corner| corners.as_slice()[corner]))
            })
        });
        Self(open.collect())
    }

    /// The places of all ends in the order of the edges, each once, with the number of the first
    /// face that has it.
    fn ends(&self) -> Vec<(Vec3, usize)> {
        let mut seen = HashSet::new();
        // The first edge of a face ends at the face's first corner.
        let ends = self.0.iter().flat_map(|&(half, [a, b])| [(b, half.patch), (a, half.patch)]);
        ends.filter(|&(end, _)| seen.insert(key(end))).collect()
    }

    /// See [`Gaps::near`].
    fn near(&self, reach: f32) -> Vec<(Vec3, Vec3, usize)> {
        let ends = self.ends();
        let numbered = ends.iter().zip(0usize..).map(|(&(end, _), number)| (key(end), number));
        let number_of: HashMap<Place, usize> = numbered.collect();
        let tree = PointTree::new(ends.iter().map(|&(end, _)| end).collect());
        // A short edge is a detail, not a gap.
        let edges: HashSet<[Place; 2]> =
            self.0.iter().flat_map(|&(_, [a, b])| [[key(a), key(b)], [key(b), key(a)]]).collect();
        let mut moved = vec![false; ends.len()];
        let mut near = Vec::new();
        for (number, &(end, face)) in ends.iter().enumerate() {
            let mut first: Option<usize> = None;
            tree.near([end; 2], reach, &mut |other| {
                let before = number_of[&key(other)];
                let is_near = before < number
                    && !moved[before]
                    && end.distance(other) <= reach
                    && !edges.contains(&[key(end), key(other)]);
                if is_near && first.is_none_or(|first| before < first) {
                    first = Some(before);
                }
            });
            if let Some(first) = first {
                moved[number] = true;
                near.push((end, ends[first].0, face));
            }
        }
        near
    }

    /// See [`Gaps::hanging`].
    fn hanging(&self, mesh: &PolygonMesh, reach: f32) -> Vec<(HalfEdge, Vec<Vec3>)> {
        let tree = PointTree::new(self.ends().into_iter().map(|(end, _)| end).collect());
        let mut hanging = Vec::new();
        for &(half, [a, b]) in &self.0 {
            let own = mesh.corners(&mesh.faces[half.patch]);
            let length = a.distance(b);
            let mut on_edge: Vec<(f32, Vec3)> = Vec::new();
            tree.near([a, b], reach, &mut |point| {
                let along = (point - a).dot(b - a) / length;
                let beside = (a + (b - a) * (along / length)).distance(point);
                let is_between = along > reach && length - along > reach;
                if is_between && beside <= reach && !own.as_slice().contains(&point) {
                    on_edge.push((along, point));
                }
            });
            on_edge.sort_by(|a, b| a.0.total_cmp(&b.0));
            if !on_edge.is_empty() {
                hanging.push((half, on_edge.into_iter().map(|(_, point)| point).collect()));
            }
        }
        hanging
    }
}

/// Points in an order in which those near a line are found quickly. The middle point splits the
/// others along x, the middle points of both halves split theirs along y, and so on (J. L. Bentley,
/// *Multidimensional Binary Search Trees Used for Associative Searching*, CACM 18(9), 1975).
struct PointTree(Vec<Vec3>);

impl PointTree {
    fn new(mut points: Vec<Vec3>) -> Self {
        sort(&mut points, 0);
        Self(points)
    }

    /// Passes all points within `reach` of a line, and some others, to `found`.
    fn near(&self, line: [Vec3; 2], reach: f32, found: &mut impl FnMut(Vec3)) {
        visit(&self.0, 0, line, reach, found);
    }
}

fn sort(points: &mut [Vec3], axis: usize) {
    if points.len() > 1 {
        let middle = points.len() / 2;
        let by_axis = |a: &Vec3, b: &Vec3| a[axis].total_cmp(&b[axis]);
        let (low, _, high) = points.select_nth_unstable_by(middle, by_axis);
        sort(low, (axis + 1) % 3);
        sort(high, (axis + 1) % 3);
    }
}

fn visit(points: &[Vec3], axis: usize, line: [Vec3; 2], reach: f32, found: &mut impl FnMut(Vec3)) {
    let (low, Some((&middle, high))) =
        (&points[..points.len() / 2], points[points.len() / 2..].split_first())
    else {
        return;
    };
    found(middle);
    let next = (axis + 1) % 3;
    if let Some(line) = part_below(line, axis, middle[axis] + 2.0 * reach) {
        visit(low, next, line, reach, found);
    }
    // The upper half is treated as a lower half with all signs changed.
    if let Some(line) = part_below(line.map(|end| -end), axis, 2.0 * reach - middle[axis]) {
        visit(high, next, line.map(|end| -end), reach, found);
    }
}

/// The part of a line whose coordinate along an axis is at most `limit`.
fn part_below([a, b]: [Vec3; 2], axis: usize, limit: f32) -> Option<[Vec3; 2]> {
    let cut = |from: Vec3, to: Vec3| {
        from + (to - from) * ((limit - from[axis]) / (to[axis] - from[axis]))
    };
    match (a[axis] <= limit, b[axis] <= limit) {
        (true, true) => Some([a, b]),
        (true, false) => Some([a, cut(a, b)]),
        (false, true) => Some([cut(b, a), b]),
        (false, false) => None,
    }
}
