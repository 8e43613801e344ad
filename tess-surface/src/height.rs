//! Displacement along the normal by a height image.
//!
//! Neighbours may disagree about the normal and, on a seam of the image, about the texture
//! coordinates. So on a shared edge the direction is the mean of both sides' normals and the
//! texture coordinates are those of one of them; on a corner there is one direction and one
//! pair of coordinates for all patches that meet there (as in I. Castaño, *Tessellation of
//! Displaced Subdivision Surfaces in DX11*, Gamefest 2008). Shading follows J. F. Blinn,
//! *Simulation of Wrinkled Surfaces*, SIGGRAPH 1978.

use crate::curve::Direction;
use crate::frame::Tangents;
use crate::math::{plain_zero, unit};
use crate::model::Model;
use crate::patch::{Patch, Sample};
use crate::sides::{Place, Sides, edge_corners};
use crate::topology::{HalfEdge, weld};
use alloc::vec;
use alloc::vec::Vec;
use glam::{Vec2, Vec3};

/// A grey image as heights, repeated over the plane of texture coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    width: usize,
    height: usize,
    texels: Vec<f32>,
}

impl HeightMap {
    /// An image from its texels, row by row from the top; `None` unless there are
    /// `width * height`, at least one, all finite.
    #[must_use]
    pub fn new(width: usize, height: usize, texels: Vec<f32>) -> Option<Self> {
        let fits = !texels.is_empty() && width.checked_mul(height) == Some(texels.len());
        (fits && texels.iter().all(|t| t.is_finite())).then_some(Self { width, height, texels })
    }

    /// Height and its derivatives by the texture coordinates, bilinear between texel centres.
    #[must_use]
    pub fn sample(&self, texcoord: Vec2) -> (f32, Vec2) {
        let (x, fx) = cell(texcoord.x, self.width);
        let (y, fy) = cell(1.0 - texcoord.y, self.height);
        let (x1, y1) = ((x + 1) % self.width, (y + 1) % self.height);
        let at = |x: usize, y: usize| self.texels[y * self.width + x];
        let (a, b, c, d) = (at(x, y), at(x1, y), at(x, y1), at(x1, y1));
        let (top, bottom) = (a + (b - a) * fx, c + (d - c) * fx);
        let along_x = (b - a) + ((d - c) - (b - a)) * fy;
        let slope = Vec2::new(along_x * texels(self.width), (top - bottom) * texels(self.height));
        (top + (bottom - top) * fy, slope)
    }
}

#[expect(clippy::cast_precision_loss, reason = "images are far smaller than 2^24")]
fn texels(size: usize) -> f32 {
    size as f32
}

/// The texel whose centre lies before a coordinate, wrapped around, and the fraction beyond it.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "the value is in 0..size"
)]
fn cell(coordinate: f32, size: usize) -> (usize, f32) {
    let scaled = (coordinate - libm::floorf(coordinate)) * texels(size) - 0.5;
    let below = libm::floorf(scaled);
    // `below` is -1 on the first half texel, which wraps to the last one.
    let texel = if below < 0.0 { size - 1 } else { (below as usize).min(size - 1) };
    (texel, scaled - below)
}

/// What displaces a surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Displacement {
    /// The heights.
    pub map: HeightMap,
    /// Units of the model per unit of height, along the normal.
    pub scale: f32,
}

/// Direction and texture coordinates where they are shared.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Anchor {
    direction: Vec3,
    texcoord: Vec2,
}

/// The corners of a model, each with one direction and one pair of texture coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct Anchors {
    anchors: Vec<Anchor>,
    /// The anchor of each corner, four numbers per patch.
    of_corner: Vec<u32>,
}

impl Anchors {
    /// The anchors of a model: sums of its patches' normals, in their order.
    #[must_use]
    pub fn of(model: &Model) -> Self {
        let mut positions = Vec::with_capacity(model.len() * 4);
        let mut corners = Vec::with_capacity(model.len() * 4);
        for number in 0..model.len() {
            let patch = model.patch(number);
            let samples = corner_coordinates(patch.edges()).map(|at| patch.sample(at));
            let samples = samples.as_slice();
            // Triangles fill their fourth place with their first corner, which nobody asks for.
            for corner in 0..4 {
                let sample = samples.get(corner).unwrap_or(&samples[0]);
                positions.push(sample.position);
                corners.push((corner < samples.len()).then_some(*sample));
            }
        }
        let of_corner = weld(&positions);
        let none = Anchor { direction: Vec3::ZERO, texcoord: Vec2::ZERO };
        let mut anchors = vec![none; positions.len()];
        for (slot, corner) in corners.iter().enumerate() {
            let (first, Some(sample)) = (of_corner[slot] as usize, corner) else { continue };
            anchors[first].direction += sample.normal;
            if first == slot {
                anchors[first].texcoord = sample.texcoord;
            }
        }
        for anchor in &mut anchors {
            anchor.direction = unit(anchor.direction).unwrap_or(Vec3::ZERO);
        }
        Self { anchors, of_corner }
    }

    fn at(&self, patch: usize, corner: usize) -> Anchor {
        self.anchors[self.of_corner[patch * 4 + corner] as usize]
    }
}

fn corner_coordinates<T>(sides: &Sides<T>) -> Sides<[f32; 2]> {
    match sides {
        Sides::Triangle(_) => Sides::Triangle([[1.0, 0.0], [0.0, 1.0], [0.0, 0.0]]),
        Sides::Quad(_) => Sides::Quad([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]),
    }
}

/// A patch with what its neighbours have to say about its boundary.
#[derive(Clone, Debug)]
pub struct DisplacedPatch<'a> {
    displacement: &'a Displacement,
    patch: Patch,
    sides: Sides<Side>,
}

/// One edge and the corner of the same number.
#[derive(Clone, Debug)]
struct Side {
    corner: Anchor,
    /// The patch beyond the edge and which of its edges it is.
    beyond: Option<(Patch, usize)>,
    /// Whether this patch's texture coordinates are the edge's.
    leads: bool,
}

impl<'a> DisplacedPatch<'a> {
    /// Patch `number` of a model with its anchors.
    ///
    /// # Panics
    /// If there is no such patch, or the anchors are another model's.
    #[must_use]
    pub fn new(
        model: &Model,
        anchors: &Anchors,
        number: usize,
        displacement: &'a Displacement,
    ) -> Self {
        let patch = model.patch(number);
        let sides = patch.edges().map_numbered(|edge, _| {
            let half = HalfEdge { patch: number, edge };
            let twin = model.twin(half);
            let corner = anchors.at(number, edge);
            Side {
                corner,
                beyond: twin.map(|twin| (model.patch(twin.patch), twin.edge)),
                leads: twin.is_none_or(|twin| half < twin),
            }
        });
        Self { displacement, patch, sides }
    }

    /// The displaced point at domain coordinates (u, v).
    #[must_use]
    pub fn sample(&self, [u, v]: [f32; 2]) -> Sample {
        let sample = self.patch.sample([u, v]);
        let anchor = self.anchor(&sample, u, v);
        let (height, slope) = self.displacement.map.sample(anchor.texcoord);
        let offset = anchor.direction * (height * self.displacement.scale);
        let slope = slope * self.displacement.scale;
        Sample {
            position: plain_zero(sample.position + offset),
            normal: self.wrinkled_normal(sample.normal, slope, u, v),
            texcoord: sample.texcoord,
        }
    }

    /// Direction and texture coordinates of the displacement: shared on the boundary.
    fn anchor(&self, sample: &Sample, u: f32, v: f32) -> Anchor {
        match self.patch.place(u, v) {
            Place::Inside => Anchor { direction: sample.normal, texcoord: sample.texcoord },
            Place::Corner(corner) => self.sides.as_slice()[corner].corner,
            Place::Edge(edge, t) => self.edge_anchor(sample, edge, t),
        }
    }

    fn edge_anchor(&self, sample: &Sample, edge: usize, t: f32) -> Anchor {
        let side = &self.sides.as_slice()[edge];
        let direction = self.patch.edges().as_slice()[edge].direction;
        if direction == Direction::Symmetric {
            // Collapsed, or no telling which end is which: one place for the whole edge.
            return self.sides.as_slice()[edge_corners(&self.sides)[edge][0]].corner;
        }
        let Some((beyond, their_edge)) = &side.beyond else {
            return Anchor { direction: sample.normal, texcoord: sample.texcoord };
        };
        let canonical = direction.canonical(t);
        let theirs = beyond.edges().as_slice()[*their_edge].direction;
        let their_sample =
            beyond.sample(edge_point(beyond, *their_edge, theirs.canonical(canonical)));
        Anchor {
            direction: unit(sample.normal + their_sample.normal).unwrap_or(Vec3::ZERO),
            texcoord: if side.leads { sample.texcoord } else { their_sample.texcoord },
        }
    }

    /// Blinn's N' = N + hu (n x Sv) + hv (Su x n), with N = Su x Sv taken along the shading normal.
    fn wrinkled_normal(&self, normal: Vec3, slope: Vec2, u: f32, v: f32) -> Vec3 {
        let Tangents { du, dv } = self.patch.frame(u, v).tangents;
        let area = du.cross(dv).length();
        let (tu, tv) = texcoord_derivatives(self.patch.texcoords(), u, v);
        let (hu, hv) = (slope.dot(tu), slope.dot(tv));
        if area <= 1e-6 * du.length_squared().max(dv.length_squared()) {
            return normal;
        }
        unit(normal * area + normal.cross(dv) * hu + du.cross(normal) * hv).unwrap_or(normal)
    }
}

/// The domain point of an edge at its running coordinate `t`.
fn edge_point(patch: &Patch, edge: usize, t: f32) -> [f32; 2] {
    match (patch.edges(), edge) {
        (Sides::Triangle(_), 0) | (Sides::Quad(_), 0) => [0.0, t],
        (Sides::Triangle(_), 1) | (Sides::Quad(_), 1) => [t, 0.0],
        (Sides::Triangle(_), _) => [t, 1.0 - t],
        (Sides::Quad(_), 2) => [1.0, t],
        (Sides::Quad(_), _) => [t, 1.0],
    }
}

fn texcoord_derivatives(texcoords: &Sides<Vec2>, u: f32, v: f32) -> (Vec2, Vec2) {
    match *texcoords {
        Sides::Triangle([a, b, c]) => (a - c, b - c),
        Sides::Quad([a, b, c, d]) => {
            ((b - a) * (1.0 - v) + (c - d) * v, (d - a) * (1.0 - u) + (c - b) * u)
        }
    }
}
