//! Evaluation of one patch, so that neighbours agree to the bit.
//!
//! A point inside is a function of the patch. A point on an edge is a function of only the edge, in
//! the edge's canonical direction ([`Edge`]), and a point on a corner is a function of only the
//! corner. Two patches that share an edge therefore give the same bits along it.

use crate::bezier::BezierPatch;
use crate::curve::{Curve, Direction, Edge};
use crate::error::WrongDomainError;
use crate::frame::{Frame, Frames, Tangents};
use crate::math::{plain_zero, unit};
use crate::pn::{PnQuad, PnTriangle, normal_along};
use crate::sides::{Place, Sides, corner_coordinates, edge_corners};
use glam::{Vec2, Vec3};
use tess_core::Domain;

/// The formula of a patch's inside.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Surface {
    /// The plane through three corners at u = 1, v = 1, w = 1.
    FlatTriangle([Vec3; 3]),
    /// The bilinear surface of four corners at (0,0), (1,0), (1,1), (0,1).
    Bilinear([Vec3; 4]),
    /// A bicubic patch.
    Bezier(BezierPatch),
    /// A cubic triangle with quadratic normals.
    PnTriangle(PnTriangle),
    /// A bicubic quad with quadratic normals.
    PnQuad(PnQuad),
}

/// A vertex of the tessellated surface.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Sample {
    /// Position, in the model's units.
    pub position: Vec3,
    /// Unit normal; (0, 0, 1) if the surface has no normal there.
    pub normal: Vec3,
    /// Texture coordinates, (0, 0) at the lower left of the image.
    pub texcoord: Vec2,
}

/// A surface over a triangle or quad domain, with its edges in canonical direction.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SurfacePatch {
    surface: Surface,
    edges: Sides<Edge>,
    texcoords: Sides<Vec2>,
}

impl SurfacePatch {
    /// Makes a patch from a surface. Its texture coordinates are its domain coordinates.
    ///
    /// Unlike [`Model`](crate::Model), this does not check control points: with coordinates beyond
    /// [`MAX_COORDINATE`](crate::MAX_COORDINATE), evaluation may overflow.
    #[must_use]
    pub fn new(surface: Surface) -> Self {
        let edges = boundary(&surface).map(Edge::new);
        let texcoords = corner_coordinates(&edges).map(Vec2::from_array);
        Self { surface, edges, texcoords }
    }

    /// The same patch with these texture coordinates at its corners.
    ///
    /// # Errors
    /// [`WrongDomainError`] if they are three for a quad or four for a triangle.
    pub fn with_texcoords(self, texcoords: Sides<Vec2>) -> Result<Self, WrongDomainError> {
        let (found, expected) = (texcoords.domain(), self.domain());
        if found == expected {
            Ok(Self { texcoords, ..self })
        } else {
            Err(WrongDomainError { found, expected })
        }
    }

    /// The domain whose points the patch is evaluated at.
    #[must_use]
    pub const fn domain(&self) -> Domain {
        self.edges.domain()
    }

    /// The formula of the inside.
    #[must_use]
    pub const fn surface(&self) -> &Surface {
        &self.surface
    }

    /// The edges, in the tessellator's order.
    #[must_use]
    pub const fn edges(&self) -> &Sides<Edge> {
        &self.edges
    }

    /// The texture coordinates of the corners.
    #[must_use]
    pub const fn texcoords(&self) -> &Sides<Vec2> {
        &self.texcoords
    }

    /// The corner, edge or inside that the domain point (u, v) belongs to.
    #[must_use]
    pub fn place(&self, u: f32, v: f32) -> Place {
        Place::of(&self.edges, u, v)
    }

    /// The vertex at the domain point (u, v), each coordinate in 0..=1 as a tessellator outputs it.
    #[must_use]
    pub fn sample(&self, [u, v]: [f32; 2]) -> Sample {
        let place = self.place(u, v);
        let frame = self.frame(u, v);
        Sample {
            position: self.boundary_position(place).unwrap_or(frame.position),
            normal: self.normal_in(|| frame.tangents, place, u, v),
            texcoord: self.texcoord(place, u, v),
        }
    }

    /// Only the position of [`SurfacePatch::sample`].
    #[must_use]
    pub fn position(&self, [u, v]: [f32; 2]) -> Vec3 {
        let place = self.place(u, v);
        self.boundary_position(place).unwrap_or_else(|| self.frame(u, v).position)
    }

    /// Only the unit normal of [`SurfacePatch::sample`].
    #[must_use]
    pub fn normal(&self, [u, v]: [f32; 2]) -> Vec3 {
        self.normal_in(|| self.frame(u, v).tangents, self.place(u, v), u, v)
    }

    /// Position and tangents by the formula of the inside. This formula is used also on edges,
    /// where neighbours may then differ.
    #[must_use]
    pub fn frame(&self, u: f32, v: f32) -> Frame {
        let frame = match &self.surface {
            Surface::FlatTriangle(corners) => corners.frame(u, v),
            Surface::Bilinear(corners) => corners.frame(u, v),
            Surface::Bezier(patch) => patch.frame(u, v),
            Surface::PnTriangle(triangle) => triangle.frame(u, v),
            Surface::PnQuad(quad) => quad.patch.frame(u, v),
        };
        Frame { position: plain_zero(frame.position), ..frame }
    }

    /// The position on the boundary, from only the edge or the corner; `None` inside.
    pub(crate) fn boundary_position(&self, place: Place) -> Option<Vec3> {
        match place {
            Place::Inside => None,
            Place::Edge(edge, t) => Some(self.edges.as_slice()[edge].position(t)),
            Place::Corner(corner) => Some(self.corner(corner)),
        }
    }

    /// The position of a corner, which is an end of an edge.
    fn corner(&self, corner: usize) -> Vec3 {
        let ends = edge_corners(&self.edges).iter().zip(self.edges.as_slice());
        let mut at_corner = ends.filter_map(|([start, end], edge)| match corner {
            c if c == *start => Some(edge.position(0.0)),
            c if c == *end => Some(edge.position(1.0)),
            _ => None,
        });
        at_corner.next().unwrap_or(Vec3::ZERO) // every corner ends two edges
    }

    fn normal_in(&self, tangents: impl Fn() -> Tangents, place: Place, u: f32, v: f32) -> Vec3 {
        let on_edge = |normals: &[[Vec3; 3]], edge: usize, t: f32| {
            normal_in_direction(self.edges.as_slice()[edge].direction, normals[edge], t)
        };
        let normal = match &self.surface {
            Surface::FlatTriangle(_) | Surface::Bilinear(_) => tangents().normal(),
            Surface::Bezier(patch) => tangents().normal().or_else(|| patch.limit_normal(u, v)),
            Surface::PnTriangle(triangle) => unit(match place {
                Place::Inside => triangle.normal(u, v),
                Place::Edge(edge, t) => on_edge(&triangle.boundary_normals(), edge, t),
                Place::Corner(corner) => triangle.corners[corner].normal,
            }),
            Surface::PnQuad(quad) => unit(match place {
                Place::Inside => quad.normal(u, v),
                Place::Edge(edge, t) => on_edge(&quad.boundary_normals(), edge, t),
                Place::Corner(corner) => quad.corner_normals[corner],
            }),
        };
        normal.or_else(|| tangents().normal()).unwrap_or(Vec3::Z)
    }

    pub(crate) fn texcoord(&self, place: Place, u: f32, v: f32) -> Vec2 {
        match (place, &self.texcoords) {
            (Place::Corner(corner), texcoords) => texcoords.as_slice()[corner],
            (Place::Edge(edge, t), texcoords) => {
                let [start, end] = edge_corners(texcoords)[edge];
                let ends = [texcoords.as_slice()[start], texcoords.as_slice()[end]];
                along_edge(self.edges.as_slice()[edge].direction, ends, t)
            }
            (Place::Inside, _) => self.inside_texcoord(u, v),
        }
    }

    /// Texture coordinates by the formula of the inside.
    #[inline(always)]
    pub(crate) fn inside_texcoord(&self, u: f32, v: f32) -> Vec2 {
        match self.texcoords {
            Sides::Triangle([a, b, c]) => a * u + b * v + c * (1.0 - u - v),
            Sides::Quad([a, b, c, d]) => {
                (a * (1.0 - u) + b * u) * (1.0 - v) + (d * (1.0 - u) + c * u) * v
            }
        }
    }
}

/// A quadratic normal along an edge, evaluated in its canonical direction.
#[inline(always)]
pub(crate) fn normal_in_direction(direction: Direction, along: [Vec3; 3], t: f32) -> Vec3 {
    let [a, middle, b] = along;
    match direction {
        Direction::Against => normal_along([b, middle, a], 1.0 - t),
        Direction::Along | Direction::Symmetric => normal_along(along, t),
    }
}

/// Texture coordinates on an edge, interpolated in its canonical direction.
#[inline(always)]
pub(crate) fn along_edge(direction: Direction, [start, end]: [Vec2; 2], t: f32) -> Vec2 {
    match direction {
        Direction::Against => end + (start - end) * (1.0 - t),
        Direction::Along | Direction::Symmetric => start + (end - start) * t,
    }
}

/// The boundary curves in the tessellator's order, each in the direction of its coordinate.
fn boundary(surface: &Surface) -> Sides<Curve> {
    match surface {
        Surface::FlatTriangle([u, v, w]) => {
            Sides::Triangle([[*w, *v], [*w, *u], [*v, *u]].map(Curve::Line))
        }
        Surface::Bilinear([a, b, c, d]) => {
            Sides::Quad([[*a, *d], [*a, *b], [*b, *c], [*d, *c]].map(Curve::Line))
        }
        Surface::Bezier(patch) => Sides::Quad(patch.boundary()),
        Surface::PnQuad(quad) => Sides::Quad(quad.patch.boundary()),
        Surface::PnTriangle(triangle) => {
            let ([u, v, w], [u0, v0, w0], _) = triangle.net();
            let curve = |a, [b, c]: [Vec3; 2], d| Curve::cubic([a, b, c, d]);
            Sides::Triangle([curve(w, u0, v), curve(w, v0, u), curve(v, w0, u)])
        }
    }
}
