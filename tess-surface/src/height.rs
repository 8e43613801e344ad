//! Height images, and heights in the units of a model.

use crate::error::{HeightError, MAX_COORDINATE};
use crate::lanes::{LANES, Lanes, Lanes2};
use crate::math::{floor, is_in_range, round};
use alloc::vec::Vec;
use glam::Vec2;

/// A grey image of heights over the plane of texture coordinates, whose unit square it fills.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    width: usize,
    height: usize,
    texels: Vec<f32>,
    address: Address,
}

/// Heights beyond the image, by the names that samplers have.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Address {
    /// The image again.
    #[default]
    Repeat,
    /// The outermost texels, for ever.
    Clamp,
}

impl HeightMap {
    /// The image with these texels, row by row from the top. It repeats.
    ///
    /// # Errors
    /// [`HeightError::WrongLength`] unless there are `width * height` texels and at least one,
    /// [`HeightError::NotFinite`], [`HeightError::TooLarge`].
    pub fn new(width: usize, height: usize, texels: Vec<f32>) -> Result<Self, HeightError> {
        if texels.is_empty() || width.checked_mul(height) != Some(texels.len()) {
            return Err(HeightError::WrongLength { texels: texels.len(), width, height });
        }
        if let Some(index) = texels.iter().position(|texel| !texel.is_finite()) {
            return Err(HeightError::NotFinite { index });
        }
        if let Some(index) = texels.iter().position(|&texel| !is_in_range(&[texel])) {
            return Err(HeightError::TooLarge { index });
        }
        Ok(Self { width, height, texels, address: Address::Repeat })
    }

    /// The same image with something else beyond it.
    #[must_use]
    pub fn with_address(self, address: Address) -> Self {
        Self { address, ..self }
    }

    /// The texels, row by row from the top.
    #[must_use]
    pub fn texels(&self) -> &[f32] {
        &self.texels
    }

    /// The height and its derivatives by the texture coordinates, bilinear between texel centres. (0, 0) is the
    /// lower left corner of the image.
    #[must_use]
    pub fn sample(&self, texcoord: Vec2) -> (f32, Vec2) {
        self.at(Vec2::new(texcoord.x, 1.0 - texcoord.y), |texels| texels)
    }

    /// The height at a place that is counted from the top: (0, 0) is the upper left corner of the image, (1, 1) the lower
    /// right one. The place is rounded to 1/256 of a texel, the precision of samplers, as `tess_sample` of
    /// tess-gpu's `surfaces::HEIGHT` does, which clamps. Beyond a clamped image every place has a height,
    /// infinity too; an image that repeats has none there: NaN.
    #[must_use]
    pub fn height_at(&self, place: Vec2) -> f32 {
        self.at(place, |texels| round(texels * 256.0) / 256.0).0
    }

    /// [`HeightMap::sample`] at a place that is counted from the top, in texels rounded by `precision`.
    fn at(&self, place: Vec2, precision: fn(f32) -> f32) -> (f32, Vec2) {
        let (corners, part) = match self.address {
            Address::Repeat => {
                let (column, fx) = cell(place.x, self.width, precision);
                let (row, fy) = cell(place.y, self.height, precision);
                (self.corners(column, row), [fx, fy])
            }
            Address::Clamp => {
                let (columns, fx) = clamped_cell(place.x, self.width, precision);
                let (rows, fy) = clamped_cell(place.y, self.height, precision);
                let at = |row: usize, column: usize| {
                    self.texels[rows[row] * self.width + columns[column]]
                };
                ([at(0, 0), at(0, 1), at(1, 0), at(1, 1)], [fx, fy])
            }
        };
        bilinear(corners, part, self.size())
    }

    /// [`HeightMap::sample`] at the lanes' texture coordinates.
    #[inline(always)]
    pub(crate) fn samples(&self, texcoords: &Lanes2) -> (Lanes, Lanes2) {
        if self.address == Address::Clamp {
            return self.samples_one_by_one(texcoords);
        }
        let (mut columns, mut fx) = ([0; LANES], [0.0; LANES]);
        let (mut rows, mut fy) = ([0; LANES], [0.0; LANES]);
        for lane in 0..LANES {
            let texcoord = texcoords.get(lane);
            (columns[lane], fx[lane]) = cell(texcoord.x, self.width, |texels| texels);
            (rows[lane], fy[lane]) = cell(1.0 - texcoord.y, self.height, |texels| texels);
        }
        let mut corners = [[0.0; LANES]; 4];
        for lane in 0..LANES {
            let [a, b, c, d] = self.corners(columns[lane], rows[lane]);
            (corners[0][lane], corners[1][lane]) = (a, b);
            (corners[2][lane], corners[3][lane]) = (c, d);
        }
        let (size, [a, b, c, d]) = (self.size(), &corners);
        let (mut heights, mut slopes) = ([0.0; LANES], Lanes2::ZERO);
        for lane in 0..LANES {
            let corners = [a[lane], b[lane], c[lane], d[lane]];
            let (height, slope) = bilinear(corners, [fx[lane], fy[lane]], size);
            heights[lane] = height;
            slopes.set(lane, slope);
        }
        (heights, slopes)
    }

    fn samples_one_by_one(&self, texcoords: &Lanes2) -> (Lanes, Lanes2) {
        let (mut heights, mut slopes) = ([0.0; LANES], Lanes2::ZERO);
        for (lane, height) in heights.iter_mut().enumerate() {
            let slope;
            (*height, slope) = self.sample(texcoords.get(lane));
            slopes.set(lane, slope);
        }
        (heights, slopes)
    }

    /// The texels around a point, from the numbers of the column and the row before it.
    #[inline(always)]
    fn corners(&self, column: u32, row: u32) -> [f32; 4] {
        let (column, row) = (column as usize, row as usize);
        let next = if column + 1 == self.width { 0 } else { column + 1 };
        let below = if row + 1 == self.height { 0 } else { row + 1 };
        let (row, below) = (row * self.width, below * self.width);
        let at = |index: usize| self.texels[index];
        [at(row + column), at(row + next), at(below + column), at(below + next)]
    }

    /// Width and height in texels.
    #[inline(always)]
    fn size(&self) -> [f32; 2] {
        [texels(self.width), texels(self.height)]
    }
}

/// The height between four texels and its derivatives by the texture coordinates.
#[inline(always)]
fn bilinear([a, b, c, d]: [f32; 4], [fx, fy]: [f32; 2], [width, height]: [f32; 2]) -> (f32, Vec2) {
    let (top, bottom) = (a + (b - a) * fx, c + (d - c) * fx);
    let along_x = (b - a) + ((d - c) - (b - a)) * fy;
    (top + (bottom - top) * fy, Vec2::new(along_x * width, (top - bottom) * height))
}

#[expect(clippy::cast_precision_loss, reason = "images are far smaller than 2^24")]
#[inline(always)]
fn texels(size: usize) -> f32 {
    size as f32
}

/// The texel whose centre lies before a coordinate, wrapped around, and the fraction beyond it.
#[inline(always)]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "the value is in 0..size, and images are far smaller than 2^24"
)]
fn cell(coordinate: f32, size: usize, precision: impl Fn(f32) -> f32) -> (u32, f32) {
    let scaled = precision((coordinate - floor(coordinate)) * texels(size) - 0.5);
    let before = floor(scaled);
    let last = size as i32 - 1;
    // `before` is -1 on the first half texel, which wraps to the last one.
    let texel = if before < 0.0 { last } else { (before as i32).min(last) };
    (texel as u32, scaled - before)
}

/// The texels whose centres lie before and behind a coordinate, both within the image, and the fraction from the first to
/// the second. Beyond the image both are the outermost texel.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "casts of floats saturate, and images are far smaller than 2^24"
)]
fn clamped_cell(coordinate: f32, size: usize, precision: fn(f32) -> f32) -> ([usize; 2], f32) {
    // Within a texel of the image, so that the fraction is a number; further out both texels are the same.
    let scaled = precision(coordinate * texels(size) - 0.5).max(-1.0).min(texels(size));
    let before = floor(scaled);
    // Casts turn NaN and what is below 0 to 0.
    let texel = |number: f32| (number as usize).min(size - 1);
    ([texel(before), texel(before + 1.0)], scaled - before)
}

/// Heights in the units of a model, to displace its surface along the normal.
#[derive(Clone, Debug, PartialEq)]
pub struct Displacement {
    pub(crate) map: HeightMap,
    pub(crate) scale: f32,
}

impl Displacement {
    /// The heights of an image, times `scale` units of the model.
    ///
    /// # Errors
    /// [`HeightError::TooHigh`] if one of the products is NaN or beyond [`MAX_COORDINATE`].
    pub fn new(map: HeightMap, scale: f32) -> Result<Self, HeightError> {
        let height = map.texels.iter().fold(0.0f32, |highest, t| highest.max(t.abs()));
        let is_evaluable = (height * scale).abs() <= MAX_COORDINATE;
        if is_evaluable {
            Ok(Self { map, scale })
        } else {
            Err(HeightError::TooHigh { height, scale })
        }
    }
}
