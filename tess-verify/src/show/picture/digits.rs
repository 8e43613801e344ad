//! Numbers as strokes, so that every form of a picture looks the same without a font.
#![expect(clippy::float_arithmetic, reason = "positions of a drawing, in pixels")]

use super::Position;

/// Digits on a grid 4 wide and 6 high, y down; lines of one digit are separated by empty spots.
const STROKES: [&[&[(u8, u8)]]; 10] = [
    &[&[(1, 0), (3, 0), (4, 1), (4, 5), (3, 6), (1, 6), (0, 5), (0, 1), (1, 0)]],
    &[&[(1, 1), (2, 0), (2, 6)], &[(1, 6), (3, 6)]],
    &[&[(0, 1), (1, 0), (3, 0), (4, 1), (4, 2), (0, 6), (4, 6)]],
    &[&[(0, 0), (4, 0), (2, 2), (3, 2), (4, 3), (4, 5), (3, 6), (1, 6), (0, 5)]],
    &[&[(3, 6), (3, 0), (0, 4), (4, 4)]],
    &[&[(4, 0), (0, 0), (0, 3), (1, 2), (3, 2), (4, 3), (4, 5), (3, 6), (1, 6), (0, 5)]],
    &[&[
        (4, 1),
        (3, 0),
        (1, 0),
        (0, 1),
        (0, 5),
        (1, 6),
        (3, 6),
        (4, 5),
        (4, 4),
        (3, 3),
        (1, 3),
        (0, 4),
    ]],
    &[&[(0, 0), (4, 0), (1, 6)]],
    &[&[
        (1, 3),
        (0, 2),
        (0, 1),
        (1, 0),
        (3, 0),
        (4, 1),
        (4, 2),
        (3, 3),
        (1, 3),
        (0, 4),
        (0, 5),
        (1, 6),
        (3, 6),
        (4, 5),
        (4, 4),
        (3, 3),
    ]],
    &[&[
        (0, 5),
        (1, 6),
        (3, 6),
        (4, 5),
        (4, 1),
        (3, 0),
        (1, 0),
        (0, 1),
        (0, 2),
        (1, 3),
        (3, 3),
        (4, 2),
    ]],
];

/// Grid units from one digit to the next.
const ADVANCE: f64 = 6.0;
/// Grid units across a digit.
const WIDTH: f64 = 4.0;
/// Grid units from top to bottom.
const HEIGHT: f64 = 6.0;

/// The lines of a number, centred at a position.
pub(super) fn strokes(number: u32, centre: Position, height: f64) -> Vec<Vec<Position>> {
    let unit = height / HEIGHT;
    let mut left = centre[0] - width(number, height) / 2.0;
    let top = centre[1] - height / 2.0;
    let mut lines = Vec::new();
    for digit in number.to_string().bytes().map(|byte| usize::from(byte - b'0')) {
        let place = |&(x, y): &(u8, u8)| [left + unit * f64::from(x), top + unit * f64::from(y)];
        lines.extend(STROKES[digit].iter().map(|line| line.iter().map(place).collect()));
        left += unit * ADVANCE;
    }
    lines
}

/// The width of a number whose digits have this height.
pub(super) fn width(number: u32, height: f64) -> f64 {
    let gaps = f64::from(number.checked_ilog10().unwrap_or(0));
    (gaps * ADVANCE + WIDTH) * height / HEIGHT
}

/// A pen that suits digits of this height.
pub(super) fn stroke_width(height: f64) -> f64 {
    height / 7.5
}
