//! Many vertices of a patch, eight at a time.
//!
//! A vertex has the bits that [`Patch::sample`] gives it: the same formulas run in every lane, and what
//! belongs to an edge or a corner alone is computed from those alone.

use crate::lanes::{Frames, LANES, normal};
use crate::patch::{Patch, Sample, Surface};
use crate::sides::Place;
use glam::{Vec2, Vec3};
use wide::f32x8;

/// What eight points have by the formulas of the inside.
struct Inside {
    positions: [Vec3; LANES],
    normals: [Vec3; LANES],
    texcoords: [Vec2; LANES],
    /// A bit for each lane whose normal exists.
    has_normal: u32,
}

impl Patch {
    /// The vertices at these domain points: the bits of [`Patch::sample`] at each, for a fraction of
    /// the time. Vertices or points that the other slice has no partner for are left alone.
    pub fn samples(&self, points: &[[f32; 2]], samples: &mut [Sample]) {
        for (points, samples) in points.chunks(LANES).zip(samples.chunks_mut(LANES)) {
            self.eight(points, samples);
        }
    }

    /// [`Patch::samples`] of up to eight points. Gives what [`Patch::frame`] does at each.
    #[inline(always)]
    pub(crate) fn eight(&self, points: &[[f32; 2]], samples: &mut [Sample]) -> Frames<f32x8> {
        let (u, v) = columns(points);
        let frames = self.frames(u, v);
        let inside = self.inside(&frames, u, v);
        for (lane, (&[u, v], sample)) in points.iter().zip(samples).enumerate() {
            *sample = self.vertex(&inside, lane, [u, v]);
        }
        frames
    }

    /// One of eight vertices.
    #[inline(always)]
    fn vertex(&self, inside: &Inside, lane: usize, [u, v]: [f32; 2]) -> Sample {
        let place = self.place(u, v);
        let has_normal = inside.has_normal >> lane & 1 == 1;
        let of_place = place != Place::Inside && self.has_boundary_normals();
        let normal =
            if has_normal && !of_place { inside.normals[lane] } else { self.normal([u, v]) };
        match self.boundary_position(place) {
            None => Sample {
                position: inside.positions[lane],
                normal,
                texcoord: inside.texcoords[lane],
            },
            Some(position) => Sample { position, normal, texcoord: self.texcoord(place, u, v) },
        }
    }

    /// Whether normals on edges and corners follow from those alone.
    const fn has_boundary_normals(&self) -> bool {
        matches!(self.surface(), Surface::PnTriangle(_) | Surface::PnQuad(_))
    }

    /// What eight points of these frames have by the formulas of the inside.
    #[inline(always)]
    fn inside(&self, frames: &Frames<f32x8>, u: f32x8, v: f32x8) -> Inside {
        let (normals, has_normal) = match self.surface() {
            Surface::PnTriangle(triangle) => triangle.normals(u, v).unit(),
            Surface::PnQuad(quad) => quad.normals(u, v).unit(),
            _ => normal(frames.du, frames.dv),
        };
        Inside {
            positions: frames.position.to_array(),
            normals: normals.to_array(),
            texcoords: self.inside_texcoords(u, v).to_array().map(Vec3::truncate),
            has_normal: has_normal.to_bitmask(),
        }
    }
}

/// The coordinates of up to eight points; lanes without a point have one of the inside.
#[inline(always)]
fn columns(points: &[[f32; 2]]) -> (f32x8, f32x8) {
    let (mut u, mut v) = ([0.5; LANES], [0.25; LANES]);
    for (lane, &[at_u, at_v]) in points.iter().enumerate().take(LANES) {
        (u[lane], v[lane]) = (at_u, at_v);
    }
    (u.into(), v.into())
}
