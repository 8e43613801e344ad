//! What the pixels must be, by the model and exact arithmetic.

use crate::scene::{Pixel, SIZE};
use tess_core::{Config, Patch, PatchFactors};

/// Pixels across and down of one patch.
pub(crate) const PATCH: u32 = 64;
/// A pixel whose centre is so near to an edge of a triangle, in pixels, can be either triangle's: devices
/// round positions to 1/256 of a pixel.
const MARGIN: f64 = 1.0 / 64.0;

/// The pixels of some patches, `None` where the model does not say. Each says where the corner `flat` of its
/// triangle is.
pub(crate) fn pixels(config: Config, patches: &[PatchFactors], flat: usize) -> Vec<Option<Pixel>> {
    let mut all = vec![Some([0; 4]); (SIZE[0] * SIZE[1]) as usize];
    for (number, &factors) in (0_u32..).zip(patches) {
        let whole = Patch::new(config, factors).tessellate();
        let uvs: Vec<[f32; 2]> = whole.points.iter().map(|point| point.to_f32()).collect();
        for triangle in whole.indices.chunks_exact(3) {
            let corners = [0, 1, 2].map(|k| uvs[triangle[k] as usize]);
            fill(&mut all, corners, corners[flat], number);
        }
    }
    all
}

/// Fills a triangle of a patch with what `flat`, one of its corners, says.
fn fill(all: &mut [Option<Pixel>], corners: [[f32; 2]; 3], flat: [f32; 2], number: u32) {
    let at = corners.map(|uv| uv.map(|c| f64::from(c) * f64::from(PATCH)));
    for y in 0..PATCH {
        for x in 0..PATCH {
            let distance = distance(at, [f64::from(x) + 0.5, f64::from(y) + 0.5]);
            let column = number % 4 * PATCH + x;
            let row = number / 4 * PATCH + y;
            let pixel = &mut all[(row * SIZE[0] + column) as usize];
            if distance > MARGIN {
                let [u, v] = flat.map(f32::to_bits);
                *pixel = Some([u, v, number, 1]);
            } else if distance > -MARGIN {
                *pixel = None;
            }
        }
    }
}

/// How far inside a triangle a point is; negative outside. A triangle without area has no inside.
fn distance(corners: [[f64; 2]; 3], point: [f64; 2]) -> f64 {
    let cross = |a: [f64; 2], b: [f64; 2], c: [f64; 2]| {
        (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0])
    };
    let [a, b, c] = corners;
    let area = cross(a, b, c);
    if area.abs() < 1e-9 {
        return f64::NEG_INFINITY;
    }
    let to = |from: [f64; 2], to: [f64; 2]| {
        let length = ((to[0] - from[0]).powi_2() + (to[1] - from[1]).powi_2()).sqrt();
        cross(from, to, point) * area.signum() / length
    };
    to(a, b).min(to(b, c)).min(to(c, a))
}

/// A square, which `powi` would leave to the platform.
trait Square {
    fn powi_2(self) -> Self;
}

impl Square for f64 {
    fn powi_2(self) -> Self {
        self * self
    }
}

/// The first pixel that differs from the model, or too few to compare.
pub(crate) fn compare(observed: &[Pixel], expected: &[Option<Pixel>]) -> Result<(), String> {
    let known = expected.iter().flatten().count();
    if known < expected.len() / 2 {
        return Err(format!("the model says only {known} pixels"));
    }
    let differs = |&(_, (&observed, &expected)): &(usize, (&Pixel, &Option<Pixel>))| {
        expected.is_some_and(|expected| expected != observed)
    };
    match observed.iter().zip(expected).enumerate().find(differs) {
        None => Ok(()),
        Some((number, (observed, expected))) => {
            let width = SIZE[0] as usize;
            let at = [number % width, number / width];
            Err(format!("pixel {at:?} is {observed:x?}, not {expected:x?}"))
        }
    }
}

/// How many pixels show a patch.
pub(crate) fn drawn(pixels: &[Pixel]) -> usize {
    pixels.iter().filter(|pixel| pixel[3] == 1).count()
}
