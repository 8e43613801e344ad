//! Displacement along the normal by a height image.
//!
//! Neighbours may disagree about the normal and, on a seam of the image, about the texture
//! coordinates. So on a shared edge the direction is the mean of both sides' normals and the
//! texture coordinates are those of one of them; on a corner there is one direction and one
//! pair of coordinates for all patches that meet there (as in I. Castaño, *Tessellation of
//! Displaced Subdivision Surfaces in DX11*, Gamefest 2008). Shading follows J. F. Blinn,
//! *Simulation of Wrinkled Surfaces*, SIGGRAPH 1978.

use crate::curve::Direction;
use crate::error::MAX_COORDINATE;
use crate::frame::Tangents;
use crate::lanes::LANES;
use crate::math::{is_in_range, plain_zero, unit};
use crate::model::Model;
use crate::patch::{Patch, Sample};
use crate::sides::{Place, Sides, corner_coordinates, edge_corners};
use crate::topology::{HalfEdge, weld};
use alloc::vec;
use alloc::vec::Vec;
use glam::{Vec2, Vec3};

/// A grey image of heights, repeated over the plane of texture coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    width: usize,
    height: usize,
    texels: Vec<f32>,
}

impl HeightMap {
    /// The image with these texels, row by row from the top. `None` unless there are
    /// `width * height` of them, at least one, none NaN or beyond [`MAX_COORDINATE`].
    #[must_use]
    pub fn new(width: usize, height: usize, texels: Vec<f32>) -> Option<Self> {
        let fits = !texels.is_empty() && width.checked_mul(height) == Some(texels.len());
        (fits && is_in_range(&texels)).then_some(Self { width, height, texels })
    }

    /// The height and its derivatives by the texture coordinates, bilinear between texel centres.
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

/// Heights in the units of a model, to displace its surface along the normal.
#[derive(Clone, Debug, PartialEq)]
pub struct Displacement {
    map: HeightMap,
    scale: f32,
}

impl Displacement {
    /// The heights of an image, times `scale` units of the model. `None` if one of the products is
    /// NaN or beyond [`MAX_COORDINATE`].
    #[must_use]
    pub fn new(map: HeightMap, scale: f32) -> Option<Self> {
        let highest = map.texels.iter().fold(0.0f32, |highest, t| highest.max(t.abs()));
        ((highest * scale).abs() <= MAX_COORDINATE).then_some(Self { map, scale })
    }
}

/// A direction and texture coordinates that several patches share.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Anchor {
    direction: Vec3,
    texcoord: Vec2,
}

/// The corners of a model, each with one direction and one pair of texture coordinates.
#[derive(Clone, Debug, PartialEq)]
struct Anchors {
    anchors: Vec<Anchor>,
    /// The anchor of each corner, four numbers per patch.
    of_corner: Vec<u32>,
}

impl Anchors {
    /// The anchors of a model: sums of its patches' normals, in their order.
    fn of(model: &Model) -> Self {
        let mut positions = Vec::with_capacity(model.len() * 4);
        let mut corners = Vec::with_capacity(model.len() * 4);
        for number in 0..model.len() {
            let patch = model.patch(number);
            let samples = corner_coordinates(patch.edges()).map(|at| patch.sample(at));
            let samples = samples.as_slice();
            // The fourth corner of a triangle is its first one again, and is not used.
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

/// A model and its displacement.
#[derive(Clone, Debug)]
pub struct DisplacedModel<'a> {
    model: &'a Model,
    displacement: &'a Displacement,
    anchors: Anchors,
}

impl<'a> DisplacedModel<'a> {
    /// Finds the directions and texture coordinates that patches share at their corners, which
    /// evaluates every patch there.
    #[must_use]
    pub fn new(model: &'a Model, displacement: &'a Displacement) -> Self {
        Self { model, displacement, anchors: Anchors::of(model) }
    }

    /// The model without its displacement.
    #[must_use]
    pub const fn model(&self) -> &'a Model {
        self.model
    }

    /// Patch `number`, ready for evaluation.
    ///
    /// # Panics
    /// If there is no such patch.
    #[must_use]
    pub fn patch(&self, number: usize) -> DisplacedPatch<'a> {
        let Self { model, displacement, anchors } = self;
        let patch = model.patch(number);
        let sides = patch.edges().map_numbered(|edge, _| {
            let half = HalfEdge { patch: number, edge };
            let twin = model.twin(half);
            Side {
                corner: anchors.at(number, edge),
                beyond: twin.map(|twin| (model.patch(twin.patch), twin.edge)),
                leads: twin.is_none_or(|twin| half < twin),
            }
        });
        DisplacedPatch { displacement, patch, sides }
    }
}

/// A patch with its displacement and with what it shares with its neighbours.
#[derive(Clone, Debug)]
pub struct DisplacedPatch<'a> {
    displacement: &'a Displacement,
    patch: Patch,
    sides: Sides<Side>,
}

/// What is shared at one edge and at the corner of the same number.
#[derive(Clone, Debug)]
struct Side {
    corner: Anchor,
    /// The patch beyond the edge, and the edge's number there.
    beyond: Option<(Patch, usize)>,
    /// Whether the edge has this patch's texture coordinates, not those of the patch beyond.
    leads: bool,
}

impl DisplacedPatch<'_> {
    /// The displaced vertex at the domain point (u, v), in 0..=1 as a tessellator outputs it.
    #[must_use]
    pub fn sample(&self, point: [f32; 2]) -> Sample {
        let mut sample = [Sample::default()];
        self.samples(&[point], &mut sample);
        sample[0]
    }

    /// The displaced vertices at these domain points: the bits of [`DisplacedPatch::sample`] at each,
    /// for a fraction of the time. Vertices or points that the other slice has no partner for are left
    /// alone.
    pub fn samples(&self, points: &[[f32; 2]], samples: &mut [Sample]) {
        for (points, samples) in points.chunks(LANES).zip(samples.chunks_mut(LANES)) {
            let tangents = self.patch.eight(points, samples).all_tangents();
            let anchors = self.anchors(points, samples);
            for (lane, (&[u, v], sample)) in points.iter().zip(samples).enumerate() {
                let (height, slope) = self.displacement.map.sample(anchors[lane].texcoord);
                let offset = anchors[lane].direction * (height * self.displacement.scale);
                let slope = slope * self.displacement.scale;
                sample.position = plain_zero(sample.position + offset);
                sample.normal = self.wrinkled_normal(&tangents[lane], sample.normal, slope, u, v);
            }
        }
    }

    /// Direction and texture coordinates of the displacement at up to eight points, from the vertices
    /// that are not displaced.
    fn anchors(&self, points: &[[f32; 2]], samples: &[Sample]) -> [Anchor; LANES] {
        let mut anchors = [Anchor { direction: Vec3::ZERO, texcoord: Vec2::ZERO }; LANES];
        let mut on_edges = [false; 4];
        for (lane, (&[u, v], sample)) in points.iter().zip(samples).enumerate() {
            let own = Anchor { direction: sample.normal, texcoord: sample.texcoord };
            anchors[lane] = match self.patch.place(u, v) {
                Place::Inside => own,
                Place::Corner(corner) => self.sides.as_slice()[corner].corner,
                Place::Edge(edge, _) => {
                    on_edges[edge] = true;
                    own
                }
            };
        }
        for (edge, _) in on_edges.iter().enumerate().filter(|&(_, &has_points)| has_points) {
            self.edge_anchors(edge, points, &mut anchors);
        }
        anchors
    }

    /// The anchors of those points that are on an edge, in place of their own normals and texture
    /// coordinates.
    fn edge_anchors(&self, edge: usize, points: &[[f32; 2]], anchors: &mut [Anchor; LANES]) {
        let side = &self.sides.as_slice()[edge];
        let direction = self.patch.edges().as_slice()[edge].direction;
        let on_edge =
            points.iter().enumerate().filter_map(|(lane, &[u, v])| match self.patch.place(u, v) {
                Place::Edge(on, t) if on == edge => Some((lane, t)),
                _ => None,
            });
        if direction == Direction::Symmetric {
            // Collapsed, or without a canonical direction: the whole edge has those of one corner.
            let corner = self.sides.as_slice()[edge_corners(&self.sides)[edge][0]].corner;
            on_edge.for_each(|(lane, _)| anchors[lane] = corner);
            return;
        }
        let Some((beyond, their_edge)) = &side.beyond else { return };
        let theirs = beyond.edges().as_slice()[*their_edge].direction;
        let (mut lanes, mut places, mut count) = ([0; LANES], [[0.0; 2]; LANES], 0);
        for (lane, t) in on_edge {
            lanes[count] = lane;
            places[count] =
                edge_point(beyond, *their_edge, theirs.canonical(direction.canonical(t)));
            count += 1;
        }
        let mut their_samples = [Sample::default(); LANES];
        beyond.samples(&places[..count], &mut their_samples);
        for (&lane, their_sample) in lanes[..count].iter().zip(&their_samples) {
            let Anchor { direction, texcoord } = anchors[lane];
            anchors[lane] = Anchor {
                direction: unit(direction + their_sample.normal).unwrap_or(Vec3::ZERO),
                texcoord: if side.leads { texcoord } else { their_sample.texcoord },
            };
        }
    }

    fn wrinkled_normal(
        &self,
        &Tangents { du, dv }: &Tangents,
        normal: Vec3,
        slope: Vec2,
        u: f32,
        v: f32,
    ) -> Vec3 {
        let (tu, tv) = texcoord_derivatives(self.patch.texcoords(), u, v);
        let slopes = (slope.dot(tu), slope.dot(tv));
        // The area is a square root of fourth powers. Where these overflow, so does it, and the
        // whole is computed in smaller units of length.
        let units = if du.cross(dv).length() < f32::INFINITY { 1.0 } else { SMALLER };
        wrinkled(normal, [du * units, dv * units], [slopes.0 * units, slopes.1 * units])
    }
}

/// 2^-45, which brings the fourth powers of tangents of 2^32 to 2^58 into range.
const SMALLER: f32 = 1.0 / 35_184_372_088_832.0;

/// Blinn's N' = N + hu (n x Sv) + hv (Su x n), with N = Su x Sv taken along the shading normal.
fn wrinkled(normal: Vec3, [du, dv]: [Vec3; 2], [hu, hv]: [f32; 2]) -> Vec3 {
    let area = du.cross(dv).length();
    if area <= 1e-6 * du.length_squared().max(dv.length_squared()) {
        return normal;
    }
    unit(normal * area + normal.cross(dv) * hu + du.cross(normal) * hv).unwrap_or(normal)
}

/// The domain point on an edge at its running coordinate `t`.
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
