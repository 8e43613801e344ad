//! Numbers as strokes, so that pictures look the same in every format. A font would need a crate
//! that reads it, and its licence in every archive, for ten glyphs.
#![expect(clippy::float_arithmetic, reason = "positions of a drawing, in pixels")]

use super::Position;

/// Digits on a grid 4 wide and 6 high, with y pointing down: x and y of each corner. A comma
/// separates two lines.
const STROKES: [&str; 10] = [
    "10 30 41 45 36 16 05 01 10",
    "11 20 26, 16 36",
    "01 10 30 41 42 06 46",
    "00 40 22 32 43 45 36 16 05",
    "36 30 04 44",
    "40 00 03 12 32 43 45 36 16 05",
    "41 30 10 01 05 16 36 45 44 33 13 04",
    "00 40 16",
    "13 02 01 10 30 41 42 33 13 04 05 16 36 45 44 33",
    "05 16 36 45 41 30 10 01 02 13 33 42",
];

/// The grid units from one digit to the next.
const ADVANCE: f64 = 6.0;
/// The width of a digit in grid units.
const WIDTH: f64 = 4.0;
/// The height of a digit in grid units.
const HEIGHT: f64 = 6.0;

/// The lines of a number, centred at a position.
pub(super) fn strokes(number: u32, centre: Position, height: f64) -> Vec<Vec<Position>> {
    let unit = height / HEIGHT;
    let mut left = centre[0] - width(number, height) / 2.0;
    let top = centre[1] - height / 2.0;
    let mut lines = Vec::new();
    for digit in number.to_string().bytes().map(|byte| usize::from(byte - b'0')) {
        let units = |byte: u8| unit * f64::from(byte - b'0');
        let place = |corner: &str| {
            let [x, y] = [0, 1].map(|axis| units(corner.as_bytes()[axis]));
            [left + x, top + y]
        };
        let line = |line: &str| line.split_whitespace().map(place).collect();
        lines.extend(STROKES[digit].split(',').map(line));
        left += unit * ADVANCE;
    }
    lines
}

/// The width of a number whose digits have this height.
pub(crate) fn width(number: u32, height: f64) -> f64 {
    let gaps = f64::from(number.checked_ilog10().unwrap_or(0));
    (gaps * ADVANCE + WIDTH) * height / HEIGHT
}

/// The stroke width for digits of this height.
pub(super) fn stroke_width(height: f64) -> f64 {
    height / 7.5
}
