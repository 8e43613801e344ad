//! The expected pixels, by the model and exact arithmetic.

use crate::scene::{Pixel, SIZE};
use tess_core::{Config, Patch, PatchFactors};
use tess_gpu::layout::factor_words;

/// The width and height of one patch in pixels.
pub(crate) const PATCH: u32 = 64;
/// A pixel whose centre is nearer than this to an edge of a triangle, in pixels, can belong to
/// either triangle: devices round positions to 1/256 of a pixel.
const MARGIN: f64 = 1.0 / 64.0;

/// The pixels of some patches, `None` where the model leaves it open. Each holds the place of the
/// corner `flat` of its triangle.
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

/// Fills a triangle of a patch with the values of `flat`, one of its corners.
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

/// The distance of a point from the nearest edge of a triangle, negative outside. A triangle
/// without area has no inside.
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

/// The first pixel that differs from the model, or the fault that too few can be compared.
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
            let patch = at[1] / PATCH as usize * 4 + at[0] / PATCH as usize;
            let (is, right) = (shown(*observed), expected.map_or_else(String::new, shown));
            Err(format!("pixel {at:?}, where patch {patch} lies, shows {is}, not {right}"))
        }
    }
}

/// A pixel's text, in decimal and in bits.
fn shown([u, v, number, is_drawn]: Pixel) -> String {
    let [a, b] = [u, v].map(f32::from_bits);
    match is_drawn {
        0 => "nothing".into(),
        _ => format!(
            "the triangle of patch {number} with its corner at ({a}, {b}) = ({u:08x}, {v:08x})"
        ),
    }
}

/// The first factor of a buffer that differs from these patches'.
pub(crate) fn compare_factors(observed: &[u32], patches: &[PatchFactors]) -> Result<(), String> {
    let expected = factor_words(patches);
    let each = expected.len() / patches.len().max(1);
    let mut pairs = observed.iter().zip(&expected).enumerate();
    if let Some((i, (is, right))) = pairs.find(|(_, (is, right))| is != right) {
        let (patch, factor) = (i / each, i % each);
        let [a, b] = [is, right].map(|bits| f32::from_bits(*bits));
        return Err(format!(
            "factor {factor} of patch {patch} is {a} = {is:08x}, not {b} = {right:08x}"
        ));
    }
    let lengths = [observed.len(), expected.len()];
    if lengths[0] == lengths[1] {
        Ok(())
    } else {
        Err(format!("words and expected ones: {lengths:?}"))
    }
}

#[test]
fn differences_are_told_in_words() {
    let pixel = |bits: u32, patch| Some([0.25_f32.to_bits() ^ bits, 0, patch, 1]);
    let mut expected = vec![Some([0; 4]); (SIZE[0] * SIZE[1]) as usize];
    let mut observed = vec![[0; 4]; expected.len()];
    let at = (PATCH * SIZE[0] + PATCH + 3) as usize;
    (expected[at], observed[at]) = (pixel(0, 5), pixel(1, 5).expect("a pixel"));
    let difference = compare(&observed, &expected).expect_err("a bit");
    let words = "pixel [67, 64], where patch 5 lies, shows the triangle of patch 5 with its corner at (0.25000003, 0) = (3e800001, 00000000), not ";
    assert!(difference.starts_with(words), "{difference}");
    let patches = [3.0, 5.0].map(|factor| PatchFactors::uniform(tess_core::Domain::Quad, factor));
    let mut words = factor_words(&patches);
    assert_eq!(compare_factors(&words, &patches), Ok(()), "as they are");
    words[8] ^= 1;
    let difference = compare_factors(&words, &patches).expect_err("a bit");
    assert_eq!(difference, "factor 2 of patch 1 is 5.0000005 = 40a00001, not 5 = 40a00000");
}

/// The number of pixels that show a patch.
pub(crate) fn drawn(pixels: &[Pixel]) -> usize {
    pixels.iter().filter(|pixel| pixel[3] == 1).count()
}
