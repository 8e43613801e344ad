//! Several points side by side.
//!
//! A formula is written once, for one point, as a branch-free function of numbers. The compiler
//! turns a loop over lanes that calls it into vectors of the CPU level's width. Every lane has the
//! same bits as a single point: both run the same additions, multiplications, divisions and square
//! roots, each correctly rounded, and no two are fused.

use crate::patch::Sample;
use glam::{Vec2, Vec3};

/// Points that are evaluated side by side.
pub(crate) const LANES: usize = 8;

/// A domain point inside the patch, for lanes that have no point.
pub(crate) const INSIDE: [f32; 2] = [0.5, 0.25];

/// A number for each of the points.
pub(crate) type Lanes<T = f32> = [T; LANES];

/// A vector for each of the points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes3 {
    x: Lanes,
    y: Lanes,
    z: Lanes,
}

impl Lanes3 {
    /// Zero for each of the points.
    pub(crate) const ZERO: Self = Self { x: [0.0; LANES], y: [0.0; LANES], z: [0.0; LANES] };

    #[inline(always)]
    pub(crate) const fn get(&self, lane: usize) -> Vec3 {
        Vec3::new(self.x[lane], self.y[lane], self.z[lane])
    }

    #[inline(always)]
    pub(crate) const fn set(&mut self, lane: usize, value: Vec3) {
        (self.x[lane], self.y[lane], self.z[lane]) = (value.x, value.y, value.z);
    }
}

/// Texture coordinates for each of the points.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Lanes2 {
    x: Lanes,
    y: Lanes,
}

impl Lanes2 {
    /// Zero for each of the points.
    pub(crate) const ZERO: Self = Self { x: [0.0; LANES], y: [0.0; LANES] };

    #[inline(always)]
    pub(crate) const fn get(&self, lane: usize) -> Vec2 {
        Vec2::new(self.x[lane], self.y[lane])
    }

    #[inline(always)]
    pub(crate) const fn set(&mut self, lane: usize, value: Vec2) {
        (self.x[lane], self.y[lane]) = (value.x, value.y);
    }
}

/// Eight vertices, and the tangents by the formulas of the inside.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Vertices {
    pub(crate) u: Lanes,
    pub(crate) v: Lanes,
    pub(crate) position: Lanes3,
    pub(crate) du: Lanes3,
    pub(crate) dv: Lanes3,
    pub(crate) normal: Lanes3,
    /// Not 0 if the normal's formula gives a normal.
    pub(crate) has_normal: Lanes<u32>,
    pub(crate) texcoord: Lanes2,
    /// The edges that the point is on, a bit for each edge.
    pub(crate) on_edges: Lanes<u32>,
}

impl Vertices {
    /// Vertices to be computed at up to eight domain points. Lanes without a point get [`INSIDE`].
    #[inline(always)]
    pub(crate) fn at(points: &[[f32; 2]]) -> Self {
        let (mut u, mut v) = ([INSIDE[0]; LANES], [INSIDE[1]; LANES]);
        for (lane, &[at_u, at_v]) in points.iter().enumerate().take(LANES) {
            (u[lane], v[lane]) = (at_u, at_v);
        }
        Self {
            u,
            v,
            position: Lanes3::ZERO,
            du: Lanes3::ZERO,
            dv: Lanes3::ZERO,
            normal: Lanes3::ZERO,
            has_normal: [0; LANES],
            texcoord: Lanes2::ZERO,
            on_edges: [0; LANES],
        }
    }

    /// Copies the vertices of the first lanes to `samples`.
    #[inline(always)]
    pub(crate) fn store(&self, samples: &mut [Sample]) {
        for (lane, sample) in samples.iter_mut().enumerate().take(LANES) {
            *sample = Sample {
                position: self.position.get(lane),
                normal: self.normal.get(lane),
                texcoord: self.texcoord.get(lane),
            };
        }
    }
}
