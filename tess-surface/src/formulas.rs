//! The formulas of a surface's inside, in the form that loops over lanes evaluate.
//!
//! They are methods of types and not closures, because only code that is inlined into a CPU level's
//! function is compiled for the level, and only functions can be marked as always inlined.

use crate::bezier::Net;
use crate::frame::{Frame, Frames, Tangents};
use crate::lanes::{LANES, Vertices};
use crate::math::{normal_or_not, plain_zero, unit_or_not};
use crate::patch::{Surface, SurfacePatch};
use crate::pn::{PnQuad, PnTriangle};
use glam::Vec3;

/// Position and tangents on the plane through three corners.
impl Frames for [Vec3; 3] {
    #[inline(always)]
    fn frame(&self, u: f32, v: f32) -> Frame {
        let [a, b, c] = *self;
        let tangents = Tangents { du: a - c, dv: b - c };
        Frame { position: c + (a - c) * u + (b - c) * v, tangents }
    }
}

/// Position and tangents on the bilinear surface of four corners.
impl Frames for [Vec3; 4] {
    #[inline(always)]
    fn frame(&self, u: f32, v: f32) -> Frame {
        let [a, b, c, d] = *self;
        let (low, high) = (a + (b - a) * u, d + (c - d) * u);
        let tangents = Tangents { du: (b - a) * (1.0 - v) + (c - d) * v, dv: high - low };
        Frame { position: low + (high - low) * v, tangents }
    }
}

impl Frames for PnTriangle {
    #[inline(always)]
    fn frame(&self, u: f32, v: f32) -> Frame {
        self.frame(u, v)
    }
}

/// A formula of the unit normal and whether it exists, without branches.
trait Normals {
    fn normal(&self, tangents: &Tangents, u: f32, v: f32) -> (Vec3, bool);
}

/// The normal of the plane that the tangents span.
struct Spanned;

impl Normals for Spanned {
    #[inline(always)]
    fn normal(&self, &Tangents { du, dv }: &Tangents, _: f32, _: f32) -> (Vec3, bool) {
        normal_or_not(du, dv)
    }
}

impl Normals for PnTriangle {
    #[inline(always)]
    fn normal(&self, _: &Tangents, u: f32, v: f32) -> (Vec3, bool) {
        unit_or_not(self.normal(u, v))
    }
}

impl Normals for PnQuad {
    #[inline(always)]
    fn normal(&self, _: &Tangents, u: f32, v: f32) -> (Vec3, bool) {
        unit_or_not(self.normal(u, v))
    }
}

/// The formulas of a patch, ready for many points.
#[derive(Debug)]
pub(crate) struct Formulas<'a> {
    patch: &'a SurfacePatch,
    /// The control points of a bicubic surface.
    net: Option<Net>,
}

impl<'a> Formulas<'a> {
    #[inline(always)]
    pub(crate) fn of(patch: &'a SurfacePatch) -> Self {
        let net = match patch.surface() {
            Surface::Bezier(patch) => Some(patch.net()),
            Surface::PnQuad(quad) => Some(quad.patch.net()),
            _ => None,
        };
        Self { patch, net }
    }

    /// Sets the values at the points of `vertices` by the formulas of the inside.
    #[inline(always)]
    pub(crate) fn inside(&self, vertices: &mut Vertices) {
        match (self.patch.surface(), &self.net) {
            (_, Some(Net::Polynomial(net))) => vertices.frames(net),
            (_, Some(Net::Rational(net))) => vertices.frames(net),
            (Surface::FlatTriangle(corners), _) => vertices.frames(corners),
            (Surface::Bilinear(corners), _) => vertices.frames(corners),
            (Surface::PnTriangle(triangle), _) => vertices.frames(triangle),
            (Surface::Bezier(_) | Surface::PnQuad(_), None) => {} // there is a net
        }
        match self.patch.surface() {
            Surface::PnTriangle(triangle) => vertices.normals(triangle),
            Surface::PnQuad(quad) => vertices.normals(quad),
            _ => vertices.normals(&Spanned),
        }
        for lane in 0..LANES {
            let texcoord = self.patch.inside_texcoord(vertices.u[lane], vertices.v[lane]);
            vertices.texcoord.set(lane, texcoord);
        }
    }

    /// Sets the vertices at these points: points inside by the formulas of the inside, the others
    /// by those of edges and corners.
    #[inline(always)]
    pub(crate) fn evaluate(&self, vertices: &mut Vertices) {
        self.inside(vertices);
        self.patch.boundary(vertices);
        if vertices.has_normal.contains(&0) {
            self.patch.other_normals(vertices);
        }
    }
}

impl Vertices {
    #[inline(always)]
    fn frames(&mut self, formulas: &impl Frames) {
        for lane in 0..LANES {
            let frame = formulas.frame(self.u[lane], self.v[lane]);
            self.position.set(lane, plain_zero(frame.position));
            self.du.set(lane, frame.tangents.du);
            self.dv.set(lane, frame.tangents.dv);
        }
    }

    #[inline(always)]
    fn normals(&mut self, formulas: &impl Normals) {
        for lane in 0..LANES {
            let tangents = Tangents { du: self.du.get(lane), dv: self.dv.get(lane) };
            let (normal, exists) = formulas.normal(&tangents, self.u[lane], self.v[lane]);
            self.normal.set(lane, normal);
            self.has_normal[lane] = u32::from(exists);
        }
    }
}

impl SurfacePatch {
    /// Sets the normals that the formulas do not give.
    fn other_normals(&self, vertices: &mut Vertices) {
        for lane in 0..LANES {
            if vertices.has_normal[lane] == 0 {
                vertices.normal.set(lane, self.normal([vertices.u[lane], vertices.v[lane]]));
            }
        }
    }
}
