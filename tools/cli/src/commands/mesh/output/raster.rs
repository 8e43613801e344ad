//! A rasteriser that draws triangles with a depth buffer, without a GPU.
//!
//! tiny-skia, which draws the other pictures, has neither a depth buffer nor attributes that are
//! interpolated over a triangle in perspective.

use glam::{Mat4, Vec2, Vec3, Vec4};
use tess_surface::Sample;

/// How much nearer triangles seen from behind would have to be. Where a sheet has one face per
/// side, the two are at the same place except for rounding, and the one that faces the eye is
/// drawn.
const BEHIND: f32 = 1.0 - 1.0 / 16384.0;

/// The point of a surface that a pixel shows.
#[derive(Clone, Copy, Debug)]
pub(super) struct Fragment {
    /// The interpolated unit normal of the surface.
    pub(super) normal: Vec3,
    /// The position on the surface.
    pub(super) position: Vec3,
    /// Whether the triangle is seen from the side that its normal points to.
    pub(super) front: bool,
    /// The distance to the nearest edge of the triangle, in pixels.
    pub(super) edge: f32,
}

/// A picture while it is being drawn.
pub(super) struct Raster {
    size: (usize, usize),
    clip: Mat4,
    /// 1 / distance of the nearest point, times [`BEHIND`] if it is seen from behind; 0 is the
    /// background.
    depth: Vec<f32>,
    colour: Vec<[u8; 3]>,
}

/// A corner in clip space.
#[derive(Clone, Copy)]
struct Corner {
    clip: Vec4,
    position: Vec3,
    normal: Vec3,
}

/// A corner on the screen: x and y in pixels, with y pointing down, and 1 / w.
#[derive(Clone, Copy)]
struct Pinned {
    at: Vec2,
    inverse: f32,
    corner: Corner,
}

impl Raster {
    pub(super) fn new(size: (usize, usize), clip: Mat4, background: [u8; 3]) -> Self {
        let pixels = size.0 * size.1;
        Self { size, clip, depth: vec![0.0; pixels], colour: vec![background; pixels] }
    }

    /// The colours, row by row from the top.
    pub(super) fn pixels(&self) -> &[[u8; 3]] {
        &self.colour
    }

    /// Draws one triangle with colours from `shade`.
    pub(super) fn triangle(&mut self, corners: [&Sample; 3], shade: impl Fn(&Fragment) -> [u8; 3]) {
        let corners = corners.map(|sample| Corner {
            clip: self.clip * sample.position.extend(1.0),
            position: sample.position,
            normal: sample.normal,
        });
        let in_front = clip_near(&corners);
        // The remaining part is a triangle fan of zero, one or two triangles.
        for k in 2..in_front.len() {
            let pinned = [in_front[0], in_front[k - 1], in_front[k]].map(|corner| self.pin(corner));
            self.pinned(pinned, &shade);
        }
    }

    fn pin(&self, corner: Corner) -> Pinned {
        let inverse = 1.0 / corner.clip.w;
        let (x, y) = (corner.clip.x * inverse, corner.clip.y * inverse);
        let (width, height) = (self.size.0 as f32, self.size.1 as f32);
        let at = Vec2::new((0.5 + 0.5 * x) * width, (0.5 - 0.5 * y) * height);
        Pinned { at, inverse, corner }
    }

    fn pinned(&mut self, corners: [Pinned; 3], shade: &impl Fn(&Fragment) -> [u8; 3]) {
        let [a, b, c] = corners.map(|corner| corner.at);
        // Twice the area; negative if the corners are counter-clockwise on the screen, where y
        // points down.
        let area = (b - a).perp_dot(c - a);
        if area == 0.0 || !area.is_finite() {
            return;
        }
        let low = a.min(b).min(c).max(Vec2::ZERO);
        let high = a.max(b).max(c).min(Vec2::new(self.size.0 as f32, self.size.1 as f32));
        let heights = [(b, c), (c, a), (a, b)].map(|(p, q)| area.abs() / p.distance(q));
        for y in pixel_range(low.y, high.y) {
            for x in pixel_range(low.x, high.x) {
                let at = Vec2::new(x as f32 + 0.5, y as f32 + 0.5);
                let weights =
                    [(b, c), (c, a), (a, b)].map(|(p, q)| (q - p).perp_dot(at - p) / area);
                if weights.iter().all(|&weight| weight >= 0.0) {
                    self.fragment(
                        y * self.size.0 + x,
                        &corners,
                        weights,
                        heights,
                        area < 0.0,
                        shade,
                    );
                }
            }
        }
    }

    fn fragment(
        &mut self,
        pixel: usize,
        corners: &[Pinned; 3],
        weights: [f32; 3],
        heights: [f32; 3],
        front: bool,
        shade: &impl Fn(&Fragment) -> [u8; 3],
    ) {
        // 1 / w is linear on the screen, and so are attributes divided by w.
        let [a, b, c] = [0, 1, 2].map(|k| corners[k].inverse * weights[k]);
        let inverse = a + b + c;
        let depth = if front { inverse } else { inverse * BEHIND };
        if depth <= self.depth[pixel] {
            return;
        }
        self.depth[pixel] = depth;
        let mix = |of: fn(&Corner) -> Vec3| {
            (of(&corners[0].corner) * a + of(&corners[1].corner) * b + of(&corners[2].corner) * c)
                / inverse
        };
        self.colour[pixel] = shade(&Fragment {
            normal: mix(|corner| corner.normal).normalize_or(Vec3::Z),
            position: mix(|corner| corner.position),
            front,
            edge: [0, 1, 2].map(|k| weights[k] * heights[k]).into_iter().fold(f32::MAX, f32::min),
        });
    }
}

/// The part of a triangle in front of the eye.
fn clip_near(corners: &[Corner; 3]) -> Vec<Corner> {
    // Clip z grows from 0 on the near plane.
    let beyond = |corner: &Corner| corner.clip.z;
    let mut kept = Vec::with_capacity(4);
    for (k, corner) in corners.iter().enumerate() {
        let next = &corners[(k + 1) % 3];
        let (here, there) = (beyond(corner), beyond(next));
        if here >= 0.0 {
            kept.push(*corner);
        }
        if (here >= 0.0) != (there >= 0.0) {
            let t = here / (here - there);
            kept.push(Corner {
                clip: corner.clip.lerp(next.clip, t),
                position: corner.position.lerp(next.position, t),
                normal: corner.normal.lerp(next.normal, t),
            });
        }
    }
    kept
}

/// The pixels whose centres may be between two coordinates on the screen.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to the screen"
)]
fn pixel_range(low: f32, high: f32) -> std::ops::Range<usize> {
    low.floor() as usize..high.ceil().max(0.0) as usize
}
