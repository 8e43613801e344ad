//! Displacement along the normal by a height image.
//!
//! Neighbours may disagree about the normal and, on a seam of the image, about the texture
//! coordinates. A shared edge therefore takes the mean of both sides' normals as its direction, and
//! the texture coordinates of one side. A corner has one direction and one pair of coordinates for
//! all patches of a sheet (`sheets.rs`) that meet there. This follows I. Castaño, *Tessellation of
//! Displaced Subdivision Surfaces in DX11*, Gamefest 2008. Shading follows J. F. Blinn, *Simulation
//! of Wrinkled Surfaces*, SIGGRAPH 1978.

use crate::boundary::running;
use crate::curve::{Direction, Edge};
use crate::formulas::Formulas;
use crate::frame::Tangents;
use crate::height::Displacement;
use crate::lanes::{INSIDE, LANES, Lanes2, Lanes3, Vertices};
use crate::math::{length, plain_zero, select, unit, unit_or_not};
use crate::model::Model;
use crate::patch::{Sample, SurfacePatch};
use crate::sheets::{fans, mixed};
use crate::sides::{Place, Sides, corner_coordinates, edge_corners};
use crate::topology::{HalfEdge, weld};
use alloc::vec;
use alloc::vec::Vec;
use glam::{Vec2, Vec3};

/// A direction and texture coordinates that several patches share.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Anchor {
    direction: Vec3,
    texcoord: Vec2,
}

impl Anchor {
    /// The anchor at `t` between this one and `end`.
    fn towards(self, end: Self, t: f32) -> Self {
        let direction = self.direction + (end.direction - self.direction) * t;
        let texcoord = self.texcoord + (end.texcoord - self.texcoord) * t;
        Self { direction: unit(direction).unwrap_or(Vec3::ZERO), texcoord }
    }
}

/// The corners of a model, each with one direction and one pair of texture coordinates.
#[derive(Clone, Debug, PartialEq)]
struct Anchors {
    anchors: Vec<Anchor>,
    /// The number of each corner's anchor, four per patch.
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
            // The fourth corner of a triangle repeats the first and is not used.
            for corner in 0..4 {
                let sample = samples.get(corner).unwrap_or(&samples[0]);
                positions.push(sample.position);
                corners.push((corner < samples.len()).then_some(*sample));
            }
        }
        // First guess: one anchor for each place. Sheets that only touch there get their own.
        let mut of_corner = weld(&positions);
        let mut anchors = sums(&corners, &of_corner);
        if separate_sheets(model, &corners, &anchors, &mut of_corner) {
            anchors = sums(&corners, &of_corner);
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

/// For the first corner of each anchor, the sum of the normals of the anchor's corners, and this
/// corner's texture coordinates.
fn sums(corners: &[Option<Sample>], of_corner: &[u32]) -> Vec<Anchor> {
    let none = Anchor { direction: Vec3::ZERO, texcoord: Vec2::ZERO };
    let mut anchors = vec![none; corners.len()];
    for (slot, corner) in corners.iter().enumerate() {
        let (first, Some(sample)) = (of_corner[slot] as usize, corner) else { continue };
        anchors[first].direction += sample.normal;
        if first == slot {
            anchors[first].texcoord = sample.texcoord;
        }
    }
    anchors
}

/// Gives each sheet its own anchor at corners where sheets with different normals meet. Returns
/// whether there is such a corner.
fn separate_sheets(
    model: &Model,
    corners: &[Option<Sample>],
    sums: &[Anchor],
    of_corner: &mut [u32],
) -> bool {
    // Where a corner's normal points away from the sum, the place has more than one sheet.
    let mut is_mixed = vec![false; corners.len()];
    for (corner, &place) in corners.iter().zip(&*of_corner) {
        if let Some(sample) = corner {
            let agrees = sample.normal.dot(sums[place as usize].direction) > 0.0;
            is_mixed[place as usize] |= !agrees;
        }
    }
    if !is_mixed.contains(&true) {
        return false;
    }
    let slots = (0u32..).zip(corners).zip(&*of_corner);
    let slots = slots.filter(|((_, corner), _)| corner.is_some());
    let mixed = mixed(slots.map(|((slot, _), &place)| (place, slot)), &is_mixed);
    for place in mixed.chunk_by(|a, b| a.0 == b.0) {
        let slots: Vec<u32> = place.iter().map(|&(_, slot)| slot).collect();
        let fans = fans(&slots, |patch| model.sides(patch), |half| model.topology().others(half));
        for (&slot, fan) in slots.iter().zip(fans) {
            of_corner[slot as usize] = slots[fan];
        }
    }
    true
}

/// A model and its displacement.
#[derive(Clone, Debug)]
pub struct DisplacedModel<'a> {
    model: &'a Model,
    displacement: &'a Displacement,
    anchors: Anchors,
}

impl<'a> DisplacedModel<'a> {
    /// Finds the directions and texture coordinates that patches share at their corners. This
    /// evaluates every patch at its corners.
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
                is_seam: !model.topology().seam(half).is_empty(),
                leads: twin.is_none_or(|twin| half < twin),
            }
        });
        DisplacedPatch { displacement, patch, sides }
    }
}

/// A patch with its displacement, and the data that it shares with its neighbours.
#[derive(Clone, Debug)]
pub struct DisplacedPatch<'a> {
    displacement: &'a Displacement,
    patch: SurfacePatch,
    sides: Sides<Side>,
}

/// Data shared at one edge and at the corner of the same number.
#[derive(Clone, Debug)]
struct Side {
    corner: Anchor,
    /// The patch beyond the edge, and the edge's number there.
    beyond: Option<(SurfacePatch, usize)>,
    /// Whether the edge has no single other side; then its displacement depends only on its ends.
    is_seam: bool,
    /// Whether the edge takes this patch's texture coordinates, not those of the patch beyond.
    leads: bool,
}

impl DisplacedPatch<'_> {
    /// The direction and the texture coordinates of the displacement at eight points.
    #[inline(always)]
    fn anchors(&self, beyond: &Sides<Option<Formulas<'_>>>, vertices: &Vertices) -> Anchors8 {
        let mut anchors = Anchors8 { direction: vertices.normal, texcoord: vertices.texcoord };
        // Most blocks are inside: there the patch's own normals and coordinates do.
        if vertices.on_edges == [0; LANES] {
            return anchors;
        }
        for (edge, beyond) in beyond.as_slice().iter().enumerate() {
            if vertices.any_on(edge) {
                self.edge_anchors(edge, beyond.as_ref(), vertices, &mut anchors);
            }
        }
        for lane in 0..LANES {
            if !vertices.is_corner(lane) {
                continue;
            }
            if let Place::Corner(corner) = self.patch.place(vertices.u[lane], vertices.v[lane]) {
                anchors.set(lane, self.sides.as_slice()[corner].corner);
            }
        }
        anchors
    }

    /// Replaces the normals and texture coordinates of points on an edge by the edge's anchors.
    #[inline(always)]
    fn edge_anchors(
        &self,
        edge: usize,
        beyond: Option<&Formulas<'_>>,
        vertices: &Vertices,
        anchors: &mut Anchors8,
    ) {
        let side = &self.sides.as_slice()[edge];
        let direction = self.patch.edges().as_slice()[edge].direction;
        if direction == Direction::Symmetric || side.is_seam {
            self.anchors_between_ends(edge, vertices, anchors);
            return;
        }
        let (Some((patch, their_edge)), Some(formulas)) = (&side.beyond, beyond) else { return };
        // The same places on the other side: own coordinate, canonical one, theirs. Both changes of
        // direction are exact, so both patches evaluate the same two points.
        let theirs = patch.edges().as_slice()[*their_edge].direction;
        let own = running(self.patch.edges(), edge, vertices);
        let mut points = [INSIDE; LANES];
        for (lane, (point, own)) in points.iter_mut().zip(own).enumerate() {
            if vertices.is_on(edge, lane) {
                let t = theirs.canonical(direction.canonical(own));
                *point = edge_point(patch.edges(), *their_edge, t);
            }
        }
        let mut beyond = Vertices::at(&points);
        formulas.evaluate(&mut beyond);
        for lane in 0..LANES {
            // The sum of both sides' normals, which is the same bits from either side.
            let (sum, exists) = unit_or_not(anchors.direction.get(lane) + beyond.normal.get(lane));
            let sum = select(exists, sum, Vec3::ZERO);
            let shared = vertices.is_on(edge, lane);
            anchors.direction.set(lane, select(shared, sum, anchors.direction.get(lane)));
            if shared & !side.leads {
                anchors.texcoord.set(lane, beyond.texcoord.get(lane));
            }
        }
    }

    /// Gives points on an edge an anchor between those of its ends.
    fn anchors_between_ends(&self, edge: usize, vertices: &Vertices, anchors: &mut Anchors8) {
        let ends = edge_corners(&self.sides)[edge];
        let [start, end] = ends.map(|corner| self.sides.as_slice()[corner].corner);
        let direction = self.patch.edges().as_slice()[edge].direction;
        let own = running(self.patch.edges(), edge, vertices);
        for lane in (0..LANES).filter(|&lane| vertices.is_on(edge, lane)) {
            let t = direction.canonical(own[lane]);
            let anchor = match direction {
                // The edge is collapsed or has no canonical direction: all of it has one anchor.
                Direction::Symmetric => start,
                Direction::Along => start.towards(end, t),
                Direction::Against => end.towards(start, t),
            };
            anchors.set(lane, anchor);
        }
    }

    /// Moves the vertices along their anchors' directions, and turns their normals.
    #[inline(always)]
    fn displace(&self, vertices: &mut Vertices, anchors: &Anchors8) {
        let Displacement { map, scale } = self.displacement;
        let (heights, slopes) = map.samples(&anchors.texcoord);
        for (lane, height) in heights.iter().enumerate() {
            let offset = anchors.direction.get(lane) * (height * scale);
            let position = plain_zero(vertices.position.get(lane) + offset);
            vertices.position.set(lane, position);
        }
        // The slope along u is the slope of the image times the way that u moves in it.
        let texcoords = self.patch.texcoords();
        for lane in 0..LANES {
            let (u, v) = (vertices.u[lane], vertices.v[lane]);
            let (tu, tv) = texcoord_derivatives(texcoords, u, v);
            let slope = slopes.get(lane) * *scale;
            let tangents = Tangents { du: vertices.du.get(lane), dv: vertices.dv.get(lane) };
            let normal = vertices.normal.get(lane);
            let normal = wrinkled_normal(normal, tangents, [slope.dot(tu), slope.dot(tv)]);
            vertices.normal.set(lane, normal);
        }
    }
}

/// [`DisplacedPatch::samples`], compiled for the level of the function that it is inlined into.
#[inline(always)]
pub(crate) fn samples(patch: &DisplacedPatch<'_>, points: &[[f32; 2]], samples: &mut [Sample]) {
    let formulas = Formulas::of(&patch.patch);
    let beyond = beyond(&patch.sides);
    for (points, samples) in points.chunks(LANES).zip(samples.chunks_mut(LANES)) {
        let mut vertices = Vertices::at(points);
        formulas.evaluate(&mut vertices);
        let anchors = patch.anchors(&beyond, &vertices);
        patch.displace(&mut vertices, &anchors);
        vertices.store(samples);
    }
}

/// The formulas of the patches beyond the edges.
#[inline(always)]
fn beyond<'a>(sides: &'a Sides<Side>) -> Sides<Option<Formulas<'a>>> {
    let of = |side: &'a Side| side.beyond.as_ref().map(|(patch, _)| Formulas::of(patch));
    match sides {
        Sides::Triangle([a, b, c]) => Sides::Triangle([of(a), of(b), of(c)]),
        Sides::Quad([a, b, c, d]) => Sides::Quad([of(a), of(b), of(c), of(d)]),
    }
}

/// The anchors of eight points.
struct Anchors8 {
    direction: Lanes3,
    texcoord: Lanes2,
}

impl Anchors8 {
    #[inline(always)]
    const fn set(&mut self, lane: usize, anchor: Anchor) {
        self.direction.set(lane, anchor.direction);
        self.texcoord.set(lane, anchor.texcoord);
    }
}

/// 2^-45: with this unit, fourth powers of tangents of 2^32 to 2^58 are in range.
const SMALLER: f32 = 1.0 / 35_184_372_088_832.0;

/// The normal over heights with these slopes along u and v: Blinn's N' = N + hu (n x Sv) + hv (Su x
/// n), with N = Su x Sv taken along the shading normal.
#[inline(always)]
fn wrinkled_normal(normal: Vec3, Tangents { du, dv }: Tangents, [hu, hv]: [f32; 2]) -> Vec3 {
    // The area is a square root of fourth powers. If these overflow, the area does, and everything
    // is computed in smaller numbers.
    let units = if length(du.cross(dv)) < f32::INFINITY { 1.0 } else { SMALLER };
    let (du, dv, hu, hv) = (du * units, dv * units, hu * units, hv * units);
    let area = length(du.cross(dv));
    let is_flat = area <= 1e-6 * du.dot(du).max(dv.dot(dv));
    let (wrinkled, exists) =
        unit_or_not(normal * area + normal.cross(dv) * hu + du.cross(normal) * hv);
    select(exists & !is_flat, wrinkled, normal)
}

/// The domain point on an edge at its running coordinate `t`.
#[inline(always)]
fn edge_point(edges: &Sides<Edge>, edge: usize, t: f32) -> [f32; 2] {
    match (edges, edge) {
        (Sides::Triangle(_), 0) | (Sides::Quad(_), 0) => [0.0, t],
        (Sides::Triangle(_), 1) | (Sides::Quad(_), 1) => [t, 0.0],
        (Sides::Triangle(_), _) => [t, 1.0 - t],
        (Sides::Quad(_), 2) => [1.0, t],
        (Sides::Quad(_), _) => [t, 1.0],
    }
}

#[inline(always)]
fn texcoord_derivatives(texcoords: &Sides<Vec2>, u: f32, v: f32) -> (Vec2, Vec2) {
    match *texcoords {
        Sides::Triangle([a, b, c]) => (a - c, b - c),
        Sides::Quad([a, b, c, d]) => {
            ((b - a) * (1.0 - v) + (c - d) * v, (d - a) * (1.0 - u) + (c - b) * u)
        }
    }
}
