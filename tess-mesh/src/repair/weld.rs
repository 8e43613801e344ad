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
//! A corner can hang only if an edge that ends at it has no neighbour, so that closed models cost
//! nothing here. The edge on which it hangs may have one.

use crate::repair::draft::Draft;
use crate::repair::polygon::{Corner, Place, corners, place as key, triangles};
use crate::repair::tally::Tally;
use glam::Vec3;
use rayon::prelude::*;
use std::collections::{BTreeMap, HashMap, HashSet};
use tess_surface::sides::edge_corners;
use tess_surface::{Face, HalfEdge, Model, PolygonMesh, Sides};

/// Gaps smaller than this part of the model's diagonal are closed if no width is given.
const PART_OF_DIAGONAL: f32 = 1e-6;

/// So are gaps of this many units in the last place of the largest coordinate.
const UNITS: f32 = 4.0;

/// The largest number of rounds in which edges are split. Splitting an edge can bring it close to
/// another corner.
const MOST_ROUNDS: usize = 8;

/// The gaps of a model.
#[derive(Debug, Default)]
pub(crate) struct Gaps {
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
    pub(crate) fn of(model: &Model, mesh: &PolygonMesh, reach: Option<f32>) -> Self {
        let edges = OpenEdges::of(model, mesh);
        if edges.0.is_empty() {
            return Self::default();
        }
        let reach = reach.unwrap_or_else(|| rounding(mesh));
        let (near, hanging) = (edges.near(reach), edges.hanging(mesh, reach));
        Self { reach, near, hanging }
    }

    /// Adds notes about gaps that stay open.
    pub(crate) fn warn(&self, draft: &mut Draft) {
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
        let places: HashSet<Place> =
            hanging.iter().flat_map(|(_, corners)| corners).map(|&at| key(at)).collect();
        let hanging =
            Tally::of(places.len(), first).note("corner", " on another face's edge", split);
        draft.note(near);
        draft.note(hanging);
    }
}

/// Closes the gaps of a mesh. `model` makes a model from it, of which only the neighbours matter.
pub(crate) fn weld<E>(
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
        crate::repair::collapsed::repair(draft);
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
    // The corners to insert after each corner of each face.
    let mut inserted: BTreeMap<usize, BTreeMap<usize, Vec<Corner>>> = BTreeMap::new();
    for (half, places) in hanging {
        let face = draft.mesh.faces[half.patch];
        let around = corners(&face);
        let [from, to] = onwards(&face.positions, half.edge);
        let ends = [around[from], around[to]];
        let between = places.iter().map(|&at| draft.corner_between(ends, at)).collect();
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
        triangles(&polygon, &mesh.positions).faces
    });
    crate::repair::collapsed::repair(draft);
}

/// The number of edges along which both neighbours run in the same way, and a face at the first. A
/// surface has its outside on the other side there.
pub(crate) fn turned_over(model: &Model, mesh: &PolygonMesh) -> Option<(usize, usize)> {
    let direction = |half: HalfEdge| {
        let corners = mesh.corners(&mesh.faces[half.patch]);
        onwards(&corners, half.edge).map(|corner| key(corners.as_slice()[corner]))
    };
    let turned = |patch: usize| {
        let halves = (0..4).map(move |edge| HalfEdge { patch, edge });
        let pairs = halves.filter_map(|half| Some((half, model.twin(half)?)));
        pairs.filter(|&(half, twin)| half < twin && direction(half) == direction(twin)).count()
    };
    let counts = (0..mesh.faces.len()).into_par_iter().map(|face| (turned(face), face));
    let found = counts.filter(|&(count, _)| count > 0);
    found.reduce_with(|a, b| (a.0 + b.0, a.1.min(b.1)))
}

/// The corners at the ends of an edge, in the order of the face's corners.
fn onwards<T>(sides: &Sides<T>, edge: usize) -> [usize; 2] {
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
        let points: Vec<Vec3> = self.ends().into_iter().map(|(end, _)| end).collect();
        let none = (Vec3::INFINITY, Vec3::NEG_INFINITY);
        let bounds = points.iter().fold(none, |(low, high), &at| (low.min(at), high.max(at)));
        let (low, high) = (bounds.0 - reach, bounds.1 + reach);
        let tree = PointTree::new(points);
        let of_face = |(patch, face): (usize, &Face)| {
            let own = mesh.corners(face);
            let edges = (0..own.as_slice().len()).filter_map(|edge| {
                let ends = onwards(&own, edge).map(|corner| own.as_slice()[corner]);
                let is_near =
                    ends[0].min(ends[1]).cmple(high).all() && ends[0].max(ends[1]).cmpge(low).all();
                let on_edge = if is_near { on_edge(&tree, ends, &own, reach) } else { Vec::new() };
                (!on_edge.is_empty()).then_some((HalfEdge { patch, edge }, on_edge))
            });
            edges.collect::<Vec<_>>()
        };
        mesh.faces.par_iter().enumerate().flat_map_iter(of_face).collect()
    }
}

/// The points on an edge, from its first end to its second. Both faces of the edge get the same
/// points in opposite orders.
fn on_edge(tree: &PointTree, ends: [Vec3; 2], own: &Sides<Vec3>, reach: f32) -> Vec<Vec3> {
    let is_onwards = key(ends[0]) < key(ends[1]);
    let [a, b] = if is_onwards { ends } else { [ends[1], ends[0]] };
    let length = a.distance(b);
    let mut found: Vec<(f32, Vec3)> = Vec::new();
    tree.near([a, b], reach, &mut |point| {
        let along = (point - a).dot(b - a) / length;
        let beside = (a + (b - a) * (along / length)).distance(point);
        let is_between = along > reach && length - along > reach;
        if is_between && beside <= reach && !own.as_slice().contains(&point) {
            found.push((along, point));
        }
    });
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    if !is_onwards {
        found.reverse();
    }
    found.into_iter().map(|(_, point)| point).collect()
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
