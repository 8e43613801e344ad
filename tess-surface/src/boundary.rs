//! Vertices on edges and corners, eight at a time.
//!
//! A point on an edge must be computed from only the edge. Otherwise two patches that share it
//! round differently and a crack opens. [`SurfacePatch::boundary`] therefore replaces the results
//! of the formulas of the inside there. `Formulas::evaluate` calls it once per eight points, after
//! the inside; `SurfacePatch::sample` has the same rules for one point, with branches.
//!
//! # The data
//!
//! A block has eight lanes with a point in each, and all eight go through the same operations.
//! `on_edges` has a word for each lane, with a bit for each edge that the point is on:
//!
//! ```text
//!   bit            3        2        1        0
//!   quad         v = 1    u = 1    v = 0    u = 0        written by `edges_of`; read here (`is_on`, `is_corner`)
//!   triangle       -      w = 0    v = 0    u = 0        and in displaced.rs
//!
//!   no bit: inside     one bit: an edge without its ends     two bits: a corner
//! ```
//!
//! # One block
//!
//! A bilinear quad with corners (0,0,0), (4,0,0), (4,4,2), (0,4,0), at eight points. The edge u = 1
//! runs from (4,0,0) to (4,4,2), which is also its canonical direction, so a lane's parameter on it
//! is v.
//!
//! ```text
//!   lane          0         1         2         3         4         5         6         7
//!   u, v       .5, .5    0, .25    1, .25    .5, 0      1, 1      .5, 1     1, .75   .25, .5
//!   on_edges    0000      0001      0100      0010      1100      1000      0100      0000
//!   pass 0                  x                                                                  u = 0
//!   pass 1                                      x                                              v = 0
//!   pass 2                            x                                       x                u = 1, at v = .25, .75
//!   pass 3                                                          x                          v = 1
//!   corners                                               x                                    corner 2
//!   position   2,2,.5    0,1,0     4,1,.5    2,0,0     4,4,2     2,4,1     4,3,1.5   1,2,.25
//! ```
//!
//! Pass 2 computes all eight lanes at t = v, then selects lanes 2 and 6. The same block in code:
//!
//! ```
//! use tess_surface::glam::Vec3;
//! use tess_surface::{SurfacePatch, Sample, Surface};
//!
//! let corners = [[0., 0., 0.], [4., 0., 0.], [4., 4., 2.], [0., 4., 0.]].map(Vec3::from_array);
//! let points = [[0.5, 0.5], [0., 0.25], [1., 0.25], [0.5, 0.], [1., 1.], [0.5, 1.], [1., 0.75], [0.25, 0.5]];
//! let mut samples = [Sample::default(); 8];
//! SurfacePatch::new(Surface::Bilinear(corners)).samples(&points, &mut samples);
//! assert_eq!(samples.map(|sample| sample.position.to_array()), [
//!     [2., 2., 0.5], [0., 1., 0.], [4., 1., 0.5], [2., 0., 0.],
//!     [4., 4., 2.], [2., 4., 1.], [4., 3., 1.5], [1., 2., 0.25],
//! ]);
//! ```
//!
//! # What must hold
//!
//! - A lane's result depends only on its own point, not on the other lanes or on the lane's number.
//!   Otherwise a block of another length would give other bits (`tests/surfaces/samples.rs`
//!   compares blocks of 1, 3, 8 and 13 points).
//! - On an edge the only inputs are the edge's control points in canonical direction, and the
//!   parameter in that direction. If anything of the patch itself were used, the two sides would
//!   differ.
//! - The parameter of the other direction, 1 - t, is exact, because domain points are multiples of
//!   2^-16.
//! - At t = 0 and t = 1 the position is the end control point itself, not the rounded result of the
//!   formula, because a corner belongs to more than one edge.
//! - Zeros are positive in the results, because equal positions must have equal bits.
//! - Code that runs in lanes has no branch that depends on a lane, and is `#[inline(always)]` from
//!   the level's function down to here. Otherwise the compiler makes no vectors, or only those of
//!   the baseline.
//!
//! # The simpler form
//!
//! Only the inside in lanes, and the points of edges one by one, as in `SurfacePatch::sample`. At
//! factor 8, where 32 of 81 points are on the boundary, that took 27 ns per vertex on bicubic
//! patches and 29 on PN triangles; with edges in lanes it takes 17 and 12 (docs/experiments.md,
//! "Evaluation in lanes"). Corners are still computed one by one, because a patch has only three or
//! four.

use crate::curve::{Curve, Direction, Edge};
use crate::lanes::{LANES, Lanes, Vertices};
use crate::math::{Homogeneous, de_casteljau, lerp, plain_zero, select, unit_or_not};
use crate::patch::{Surface, SurfacePatch, along_edge, normal_in_direction};
use crate::sides::{Sides, edge_corners};
use glam::{Vec3, Vec4};

/// A curve in canonical direction, without branches.
trait Along {
    /// [`Curve::position`].
    fn position(&self, t: f32) -> Vec3;
}

/// The ends of a line.
impl Along for [Vec3; 2] {
    #[inline(always)]
    fn position(&self, t: f32) -> Vec3 {
        let [a, b] = *self;
        at_ends(t, a, lerp(a, b, t), b)
    }
}

/// The control points of a cubic whose weights are all 1.
impl Along for [Vec3; 4] {
    #[inline(always)]
    fn position(&self, t: f32) -> Vec3 {
        let [a, .., d] = *self;
        at_ends(t, a, de_casteljau(*self, t).0, d)
    }
}

/// The control points of any cubic.
impl Along for [Homogeneous; 4] {
    #[inline(always)]
    fn position(&self, t: f32) -> Vec3 {
        let [a, .., d] = *self;
        let point = de_casteljau(*self, t).0;
        at_ends(t, a.xyz / a.w, point.xyz / point.w, d.xyz / d.w)
    }
}

/// `start` for t <= 0, `end` for t >= 1, otherwise `between`.
#[inline(always)]
fn at_ends(t: f32, start: Vec3, between: Vec3, end: Vec3) -> Vec3 {
    let inner = select(t >= 1.0, end, between);
    select(t <= 0.0, start, inner)
}

/// The edges that each lane's point is on, a bit for each edge.
#[inline(always)]
fn edges_of<T>(sides: &Sides<T>, u: &Lanes, v: &Lanes) -> Lanes<u32> {
    let mut edges = [0; LANES];
    for (lane, edges) in edges.iter_mut().enumerate() {
        let (u, v) = (u[lane], v[lane]);
        let low = u32::from(u <= 0.0) | u32::from(v <= 0.0) << 1;
        *edges = match sides {
            Sides::Triangle(_) => low | u32::from(1.0 - u - v <= 0.0) << 2,
            Sides::Quad(_) => low | u32::from(u >= 1.0) << 2 | u32::from(v >= 1.0) << 3,
        };
    }
    edges
}

/// The lanes' running coordinates on an edge.
#[inline(always)]
pub(crate) const fn running<T>(sides: &Sides<T>, edge: usize, vertices: &Vertices) -> Lanes {
    match (sides, edge) {
        (_, 1 | 3) | (Sides::Triangle(_), 2) => vertices.u,
        _ => vertices.v,
    }
}

impl Vertices {
    /// Whether a lane's point is on an edge, but not at its ends.
    #[inline(always)]
    pub(crate) const fn is_on(&self, edge: usize, lane: usize) -> bool {
        self.on_edges[lane] == 1 << edge
    }

    /// Whether any lane's point is on an edge, but not at its ends.
    #[inline(always)]
    pub(crate) fn any_on(&self, edge: usize) -> bool {
        self.on_edges.contains(&(1 << edge))
    }

    /// Whether a lane's point is on a corner.
    #[inline(always)]
    pub(crate) const fn is_corner(&self, lane: usize) -> bool {
        self.on_edges[lane].count_ones() > 1
    }
}

impl SurfacePatch {
    /// Replaces the values of points on edges and corners by values that depend only on the edge or
    /// the corner.
    #[inline(always)]
    pub(crate) fn boundary(&self, vertices: &mut Vertices) {
        // All eight lanes run through each edge that one of them is on; `is_on` selects which keep
        // the result.
        vertices.on_edges = edges_of(self.edges(), &vertices.u, &vertices.v);
        if vertices.on_edges == [0; LANES] {
            return;
        }
        for (number, edge) in self.edges().as_slice().iter().enumerate() {
            if vertices.any_on(number) {
                let t = running(self.edges(), number, vertices);
                curve_positions(vertices, number, edge, &t);
                self.edge_texcoords(vertices, number, edge.direction, &t);
                self.edge_normals(vertices, number, edge.direction, &t);
            }
        }
        for lane in 0..LANES {
            if vertices.is_corner(lane) {
                self.corner_vertex(lane, vertices);
            }
        }
    }

    /// Sets the texture coordinates of points on an edge.
    #[inline(always)]
    fn edge_texcoords(
        &self,
        vertices: &mut Vertices,
        edge: usize,
        direction: Direction,
        t: &Lanes,
    ) {
        let [start, end] = edge_corners(self.edges())[edge];
        let ends = [self.texcoords().as_slice()[start], self.texcoords().as_slice()[end]];
        for (lane, &t) in t.iter().enumerate() {
            let texcoord = along_edge(direction, ends, t);
            if vertices.is_on(edge, lane) {
                vertices.texcoord.set(lane, texcoord);
            }
        }
    }

    /// Sets the normals of points on an edge, for surfaces whose normals there depend only on the
    /// edge.
    #[inline(always)]
    fn edge_normals(&self, vertices: &mut Vertices, edge: usize, direction: Direction, t: &Lanes) {
        let along = match self.surface() {
            Surface::PnTriangle(triangle) => triangle.boundary_normals()[edge],
            Surface::PnQuad(quad) => quad.boundary_normals()[edge],
            _ => return,
        };
        for (lane, &t) in t.iter().enumerate() {
            let (normal, exists) = unit_or_not(normal_in_direction(direction, along, t));
            let is_on = vertices.is_on(edge, lane);
            vertices.normal.set(lane, select(is_on, normal, vertices.normal.get(lane)));
            let inside = vertices.has_normal[lane];
            vertices.has_normal[lane] = if is_on { u32::from(exists) } else { inside };
        }
    }

    /// Sets the vertex of a lane whose point is on a corner.
    fn corner_vertex(&self, lane: usize, vertices: &mut Vertices) {
        let (u, v) = (vertices.u[lane], vertices.v[lane]);
        let place = self.place(u, v);
        if let Some(position) = self.boundary_position(place) {
            vertices.position.set(lane, position);
        }
        vertices.texcoord.set(lane, self.texcoord(place, u, v));
        if matches!(self.surface(), Surface::PnTriangle(_) | Surface::PnQuad(_)) {
            vertices.normal.set(lane, self.normal([u, v]));
            vertices.has_normal[lane] = 1;
        }
    }
}

/// Sets the positions of points on an edge.
#[inline(always)]
fn curve_positions(vertices: &mut Vertices, number: usize, edge: &Edge, t: &Lanes) {
    let is_one = |point: &Vec4| point.w.to_bits() == 1.0f32.to_bits();
    match edge.curve {
        Curve::Line(ends) => along(vertices, number, edge.direction, t, &ends),
        Curve::Cubic(points) if points.iter().all(is_one) => {
            along(vertices, number, edge.direction, t, &points.map(Vec4::truncate));
        }
        Curve::Cubic(points) => {
            along(vertices, number, edge.direction, t, &points.map(Homogeneous::from));
        }
    }
}

/// Sets the positions of points on a curve.
#[inline(always)]
fn along(
    vertices: &mut Vertices,
    edge: usize,
    direction: Direction,
    t: &Lanes,
    curve: &impl Along,
) {
    for (lane, &t) in t.iter().enumerate() {
        let point = plain_zero(curve.position(direction.canonical(t)));
        let inside = vertices.position.get(lane);
        vertices.position.set(lane, select(vertices.is_on(edge, lane), point, inside));
    }
}
