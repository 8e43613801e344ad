//! Point-normal surfaces: curved patches from the corners of a mesh and their normals.
//!
//! Triangles: A. Vlachos, J. Peters, C. Boyd, J. L. Mitchell, *Curved PN Triangles*, Symposium on
//! Interactive 3D Graphics 2001. Quads: the same edge curves and edge normals, as in J. Peters, *PN
//! quads*, University of Florida 2008; the interior is the bilinearly blended surface of the
//! boundary (S. A. Coons, MIT MAC-TR-41, 1967), which reproduces planar and bilinear quads. If the
//! two sides of an edge have different normals (a crease), the edge's control points are the means
//! of both sides' points, after *Crack-Free Point-Normal Triangles using Adjacent Edge Normals*,
//! NVIDIA 2010.

use crate::bezier::BezierPatch;
use crate::frame::{Frame, Tangents};
use crate::math::length;
use glam::Vec3;

/// A corner of a mesh face.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PnCorner {
    /// The corner's position.
    pub position: Vec3,
    /// The corner's unit normal.
    pub normal: Vec3,
}

/// The two inner control points of the edge from `a` to `b`: the points at its thirds, each moved
/// along the nearer end's normal into that end's tangent plane.
#[must_use]
pub fn edge_points(a: PnCorner, b: PnCorner) -> [Vec3; 2] {
    let inner = |from: PnCorner, to: PnCorner| {
        let out_of_plane = (to.position - from.position).dot(from.normal);
        (from.position * 2.0 + to.position - from.normal * out_of_plane) / 3.0
    };
    [inner(a, b), inner(b, a)]
}

/// A sixth of the largest second derivative of the edge between two corners, in units of their
/// positions. The order of the corners does not matter.
#[must_use]
pub fn edge_bend([a, b]: [PnCorner; 2]) -> f32 {
    let [near_a, near_b] = edge_points(a, b);
    let at_a = (a.position + near_b) - near_a * 2.0;
    let at_b = (near_a + b.position) - near_b * 2.0;
    length(at_a).max(length(at_b))
}

/// The middle coefficient of the quadratic normal along the edge from `a` to `b`: the mean of the
/// end normals, reflected at the plane perpendicular to the edge, of unit length. The order of the
/// ends does not matter.
#[must_use]
pub fn edge_normal(a: PnCorner, b: PnCorner) -> Vec3 {
    let (along, sum) = (b.position - a.position, a.normal + b.normal);
    let reflected = sum - along * (2.0 * along.dot(sum) / along.length_squared());
    crate::math::unit(reflected).unwrap_or(Vec3::ZERO)
}

/// The quadratic normal along an edge, not of unit length. The coefficients (first end, middle,
/// second end) have no binomial factors, as in the paper.
#[must_use]
#[inline(always)]
pub(crate) fn normal_along(along: [Vec3; 3], t: f32) -> Vec3 {
    let ([a, middle, b], s) = (along, 1.0 - t);
    a * (s * s) + middle * (s * t) + b * (t * t)
}

/// A cubic triangle with quadratic normals over (u, v, w), corner 0 at u = 1, 1 at v = 1,
/// 2 at w = 1.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PnTriangle {
    /// The corners.
    pub corners: [PnCorner; 3],
    /// Inner control points of the edges u = 0 (from corner 2 to 1), v = 0 (2 to 0) and w = 0
    /// (1 to 0).
    pub edges: [[Vec3; 2]; 3],
    /// The middle coefficients of the normals along those edges.
    pub edge_normals: [Vec3; 3],
    center: Vec3,
}

impl PnTriangle {
    /// The triangle whose edges have these inner control points: those of [`edge_points`], or the
    /// means of both sides' points.
    #[must_use]
    pub fn new(corners: [PnCorner; 3], edges: [[Vec3; 2]; 3]) -> Self {
        let [[b012, b021], [b102, b201], [b120, b210]] = edges;
        let [u, v, w] = corners;
        let e = (b012 + b021 + b102 + b201 + b120 + b210) / 6.0;
        let middle = (u.position + v.position + w.position) / 3.0;
        let edge_normals = [edge_normal(w, v), edge_normal(w, u), edge_normal(v, u)];
        Self { corners, edges, edge_normals, center: e + (e - middle) * 0.5 }
    }

    /// Position and partial derivatives at (u, v).
    #[must_use]
    #[inline(always)]
    pub fn frame(&self, u: f32, v: f32) -> Frame {
        let w = 1.0 - u - v;
        let [
            PnCorner { position: b300, .. },
            PnCorner { position: b030, .. },
            PnCorner { position: b003, .. },
        ] = self.corners;
        let [[b012, b021], [b102, b201], [b120, b210]] = self.edges;
        let b111 = self.center;
        let (uu, vv, ww) = (u * u, v * v, w * w);
        let (uv, uw, vw) = (2.0 * u * v, 2.0 * u * w, 2.0 * v * w);
        // A third of the derivatives by u, v and w, as if these were independent.
        let by_u = b300 * uu + b120 * vv + b102 * ww + b210 * uv + b201 * uw + b111 * vw;
        let by_v = b210 * uu + b030 * vv + b012 * ww + b120 * uv + b111 * uw + b021 * vw;
        let by_w = b201 * uu + b021 * vv + b003 * ww + b111 * uv + b102 * uw + b012 * vw;
        let tangents = Tangents { du: (by_u - by_w) * 3.0, dv: (by_v - by_w) * 3.0 };
        Frame { position: by_u * u + by_v * v + by_w * w, tangents }
    }

    /// The quadratic normal inside, not of unit length.
    #[must_use]
    #[inline(always)]
    pub fn normal(&self, u: f32, v: f32) -> Vec3 {
        let w = 1.0 - u - v;
        let [cu, cv, cw] = self.corners;
        let [nu, nv, nw] = [cu.normal, cv.normal, cw.normal];
        let [vw, uw, uv] = self.edge_normals;
        nu * (u * u) + nv * (v * v) + nw * (w * w) + uv * (u * v) + vw * (v * w) + uw * (u * w)
    }

    /// The quadratic normals along the edges u = 0, v = 0, w = 0.
    #[must_use]
    #[inline(always)]
    pub(crate) fn boundary_normals(&self) -> [[Vec3; 3]; 3] {
        let [cu, cv, cw] = self.corners;
        let [nu, nv, nw] = [cu.normal, cv.normal, cw.normal];
        let [vw, uw, uv] = self.edge_normals;
        [[nw, vw, nv], [nw, uw, nu], [nv, uv, nu]]
    }

    /// The control net, for bounds: corners, edges, centre.
    pub(crate) fn net(&self) -> ([Vec3; 3], [[Vec3; 2]; 3], Vec3) {
        (self.corners.map(|corner| corner.position), self.edges, self.center)
    }
}

/// A bicubic quad with blended quadratic normals, corners at (0,0), (1,0), (1,1), (0,1).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PnQuad {
    /// The positions.
    pub patch: BezierPatch,
    /// The corners' normals.
    pub corner_normals: [Vec3; 4],
    /// The middle coefficients of the normals along u = 0, v = 0, u = 1, v = 1.
    pub edge_normals: [Vec3; 4],
}

impl PnQuad {
    /// The quad whose edges u = 0, v = 0, u = 1, v = 1, each along its coordinate, have these inner
    /// control points: those of [`edge_points`], or the means of both sides' points.
    #[must_use]
    pub fn new(corners: [PnCorner; 4], edges: [[Vec3; 2]; 4]) -> Self {
        let [c00, c10, c11, c01] = corners;
        Self {
            patch: BezierPatch::polynomial(coons_net(corners.map(|c| c.position), edges)),
            corner_normals: corners.map(|corner| corner.normal),
            edge_normals: [
                edge_normal(c00, c01),
                edge_normal(c00, c10),
                edge_normal(c10, c11),
                edge_normal(c01, c11),
            ],
        }
    }

    /// The quadratic normals along the edges u = 0, v = 0, u = 1, v = 1.
    #[must_use]
    #[inline(always)]
    pub(crate) fn boundary_normals(&self) -> [[Vec3; 3]; 4] {
        let [n00, n10, n11, n01] = self.corner_normals;
        let [u0, v0, u1, v1] = self.edge_normals;
        [[n00, u0, n01], [n00, v0, n10], [n10, u1, n11], [n01, v1, n11]]
    }

    /// The blended normal inside, not of unit length.
    #[must_use]
    #[inline(always)]
    pub fn normal(&self, u: f32, v: f32) -> Vec3 {
        let [n00, n10, n11, n01] = self.corner_normals;
        let [u0, v0, u1, v1] = self.boundary_normals();
        let (not_u, not_v) = (1.0 - u, 1.0 - v);
        let along_v = normal_along(u0, v) * not_u + normal_along(u1, v) * u;
        let along_u = normal_along(v0, u) * not_v + normal_along(v1, u) * v;
        let corners = (n00 * not_u + n10 * u) * not_v + (n01 * not_u + n11 * u) * v;
        along_u + along_v - corners
    }
}

/// The bicubic control net of the bilinearly blended surface of four cubic boundaries: the sum of
/// the two ruled surfaces minus the bilinear surface, all three in bicubic form.
fn coons_net([c00, c10, c11, c01]: [Vec3; 4], edges: [[Vec3; 2]; 4]) -> [[Vec3; 4]; 4] {
    let [[u0a, u0b], [v0a, v0b], [u1a, u1b], [v1a, v1b]] = edges;
    let (left, right) = ([c00, u0a, u0b, c01], [c10, u1a, u1b, c11]);
    let (bottom, top) = ([c00, v0a, v0b, c10], [c01, v1a, v1b, c11]);
    let inner = |column: usize, row: usize, s: f32, t: f32| {
        let across = left[row] * (1.0 - s) + right[row] * s;
        let along = bottom[column] * (1.0 - t) + top[column] * t;
        let bilinear = (c00 * (1.0 - s) + c10 * s) * (1.0 - t) + (c01 * (1.0 - s) + c11 * s) * t;
        across + along - bilinear
    };
    const THIRD: f32 = 1.0 / 3.0;
    const TWO_THIRDS: f32 = 2.0 / 3.0;
    [
        bottom,
        [u0a, inner(1, 1, THIRD, THIRD), inner(2, 1, TWO_THIRDS, THIRD), u1a],
        [u0b, inner(1, 2, THIRD, TWO_THIRDS), inner(2, 2, TWO_THIRDS, TWO_THIRDS), u1b],
        top,
    ]
}
