//! Height images, and their use as displacements in the units of a model.

use crate::error::{HeightError, MAX_COORDINATE};
use crate::lanes::{LANES, Lanes, Lanes2};
use crate::math::{floor, is_in_range, round};
use alloc::vec::Vec;
use glam::Vec2;

/// A grey image of heights that fills the unit square of texture coordinates.
#[derive(Clone, Debug, PartialEq)]
pub struct HeightMap {
    width: usize,
    height: usize,
    texels: Vec<f32>,
    /// The continuation to the left and right, and up and down.
    address: [Address; 2],
}

/// The continuation of the heights beyond the image, named as in samplers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub enum Address {
    /// The image repeats.
    #[default]
    Repeat,
    /// The outermost texels continue without end.
    Clamp,
    /// The image repeats, every second time reversed, so that copies meet at equal heights.
    Mirror,
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
        Ok(Self { width, height, texels, address: [Address::Repeat; 2] })
    }

    /// The same image with another continuation in all directions.
    #[must_use]
    pub fn with_address(self, address: Address) -> Self {
        self.with_addresses([address; 2])
    }

    /// The same image with other continuations along u and v. On a planet u goes round and v ends
    /// at the poles: `[Address::Repeat, Address::Clamp]`.
    #[must_use]
    pub fn with_addresses(self, address: [Address; 2]) -> Self {
        Self { address, ..self }
    }

    /// The texels, row by row from the top.
    #[must_use]
    pub fn texels(&self) -> &[f32] {
        &self.texels
    }

    /// The height and its derivatives by the texture coordinates, bilinear between texel centres.
    /// (0, 0) is the lower left corner of the image.
    #[must_use]
    pub fn sample(&self, texcoord: Vec2) -> (f32, Vec2) {
        self.at(Vec2::new(texcoord.x, 1.0 - texcoord.y), |texels| texels)
    }

    /// The height at a place that is counted from the top: (0, 0) is the upper left corner of the
    /// image, (1, 1) the lower right one. The place is rounded to 1/256 of a texel, the precision
    /// of samplers, as in `tess_sample` of tess-gpu's `surfaces::HEIGHT`, which clamps. At infinity
    /// a clamped image still has a height; an image that repeats or is mirrored gives NaN.
    #[must_use]
    pub fn height_at(&self, place: Vec2) -> f32 {
        self.at(place, |texels| round(texels * 256.0) / 256.0).0
    }

    /// [`HeightMap::sample`] at a place that is counted from the top, in texels rounded by
    /// `precision`.
    fn at(&self, place: Vec2, precision: fn(f32) -> f32) -> (f32, Vec2) {
        let cell = |address: Address, place, size| match address {
            Address::Repeat => repeated(place, size, precision),
            Address::Clamp => clamped(place, size, precision),
            Address::Mirror => mirrored(place, size, precision),
        };
        let column = cell(self.address[0], place.x, self.width);
        let row = cell(self.address[1], place.y, self.height);
        bilinear(self.corners(&column, &row), [&column, &row], self.size())
    }

    /// [`HeightMap::sample`] at the lanes' texture coordinates.
    #[inline(always)]
    pub(crate) fn samples(&self, texcoords: &Lanes2) -> (Lanes, Lanes2) {
        // In three loops: cells and heights become vectors, and only the four loads of each lane
        // between them do not.
        let [across, down] = self.address;
        let mut columns = [Cell::default(); LANES];
        let mut rows = [Cell::default(); LANES];
        cells(across, self.width, &mut columns, |lane| texcoords.get(lane).x);
        cells(down, self.height, &mut rows, |lane| 1.0 - texcoords.get(lane).y);
        let mut corners = [[0.0; LANES]; 4];
        for lane in 0..LANES {
            let [a, b, c, d] = self.corners(&columns[lane], &rows[lane]);
            (corners[0][lane], corners[1][lane]) = (a, b);
            (corners[2][lane], corners[3][lane]) = (c, d);
        }
        let (size, [a, b, c, d]) = (self.size(), &corners);
        let (mut heights, mut slopes) = ([0.0; LANES], Lanes2::ZERO);
        for lane in 0..LANES {
            let corners = [a[lane], b[lane], c[lane], d[lane]];
            let (height, slope) = bilinear(corners, [&columns[lane], &rows[lane]], size);
            heights[lane] = height;
            slopes.set(lane, slope);
        }
        (heights, slopes)
    }

    /// The texels at the corners of a cell: those of the upper row, then those of the lower row.
    #[inline(always)]
    fn corners(&self, columns: &Cell, rows: &Cell) -> [f32; 4] {
        let [left, right] = columns.texels.map(|column| column as usize);
        let [upper, lower] = rows.texels.map(|row| row as usize * self.width);
        [upper + left, upper + right, lower + left, lower + right].map(|texel| self.texels[texel])
    }

    /// Width and height in texels.
    #[inline(always)]
    fn size(&self) -> [f32; 2] {
        [texels(self.width), texels(self.height)]
    }
}

/// The cells of the lanes' coordinates along one axis.
#[inline(always)]
fn cells(
    address: Address,
    size: usize,
    cells: &mut [Cell; LANES],
    coordinate: impl Fn(usize) -> f32,
) {
    let exact = |texels| texels;
    // One loop for each continuation, so that none of them branches.
    match address {
        Address::Repeat => {
            for (lane, cell) in cells.iter_mut().enumerate() {
                *cell = repeated(coordinate(lane), size, exact);
            }
        }
        Address::Clamp => {
            for (lane, cell) in cells.iter_mut().enumerate() {
                *cell = clamped(coordinate(lane), size, exact);
            }
        }
        Address::Mirror => {
            for (lane, cell) in cells.iter_mut().enumerate() {
                *cell = mirrored(coordinate(lane), size, exact);
            }
        }
    }
}

/// Two neighbouring texels of a row or column, and a place between their centres.
#[derive(Clone, Copy, Default)]
struct Cell {
    texels: [u32; 2],
    /// The fraction of the way from the first texel to the second, 0 to 1.
    part: f32,
    /// The derivative of the place in the image by the coordinate: 1, or -1 if the image is
    /// reversed here.
    way: f32,
}

/// The height between four texels and its derivatives by the texture coordinates.
#[inline(always)]
fn bilinear(
    [a, b, c, d]: [f32; 4],
    [column, row]: [&Cell; 2],
    [width, height]: [f32; 2],
) -> (f32, Vec2) {
    let (top, bottom) = (a + (b - a) * column.part, c + (d - c) * column.part);
    let along_x = (b - a) + ((d - c) - (b - a)) * row.part;
    let slope = Vec2::new(along_x * width * column.way, (top - bottom) * height * row.way);
    (top + (bottom - top) * row.part, slope)
}

#[expect(clippy::cast_precision_loss, reason = "images are far smaller than 2^24")]
#[inline(always)]
fn texels(size: usize) -> f32 {
    size as f32
}

/// The cell of a coordinate in an image that repeats.
#[inline(always)]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "the value is in 0..size, and images are far smaller than 2^24"
)]
fn repeated(coordinate: f32, size: usize, precision: impl Fn(f32) -> f32) -> Cell {
    let scaled = precision((coordinate - floor(coordinate)) * texels(size) - 0.5);
    let before = floor(scaled);
    let last = size as i32 - 1;
    // `before` is -1 on the first half texel, which wraps to the last texel.
    let texel = if before < 0.0 { last } else { (before as i32).min(last) };
    let after = if texel == last { 0 } else { texel + 1 };
    Cell { texels: [texel as u32, after as u32], part: scaled - before, way: 1.0 }
}

/// The cell of a coordinate in an image that is clamped. Beyond the image both texels are the
/// outermost one.
#[inline(always)]
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "casts of floats saturate, and images are far smaller than 2^24"
)]
fn clamped(coordinate: f32, size: usize, precision: impl Fn(f32) -> f32) -> Cell {
    // Limited to one texel around the image, so that the fraction is a number. Further out both
    // texels are the same.
    let scaled = precision(coordinate * texels(size) - 0.5).max(-1.0).min(texels(size));
    let before = floor(scaled);
    // Casts turn NaN and numbers below 0 to 0.
    let texel = |number: f32| (number as u32).min(size as u32 - 1);
    Cell { texels: [texel(before), texel(before + 1.0)], part: scaled - before, way: 1.0 }
}

/// The cell of a coordinate in an image that is mirrored: the cell of the coordinate folded to
/// 0..=1.
#[inline(always)]
fn mirrored(coordinate: f32, size: usize, precision: impl Fn(f32) -> f32) -> Cell {
    // 0 to 2, and exact, because halving a binary number keeps its digits.
    let in_pair = coordinate - 2.0 * floor(0.5 * coordinate);
    let is_reversed = in_pair > 1.0;
    let folded = if is_reversed { 2.0 - in_pair } else { in_pair };
    let cell = clamped(folded, size, precision);
    // Infinity has no place in the image.
    let part = if folded.is_nan() { f32::NAN } else { cell.part };
    Cell { part, way: if is_reversed { -1.0 } else { 1.0 }, ..cell }
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
