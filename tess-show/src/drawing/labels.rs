//! The places and sizes of numbers.
#![expect(clippy::float_arithmetic, reason = "positions of a drawing, in pixels")]

use crate::picture::{Position, number_width};

/// Digits of less than this height are unreadable.
const SMALLEST: f64 = 4.5;
/// Digits need not be higher than this.
const LARGEST: f64 = 13.0;

/// The radius of a disc around each point that leaves room for its nearest neighbour.
///
/// If points coincide in the picture, the first one gets the room and the others get none.
pub(super) fn disc_radii(points: &[Position]) -> Vec<f64> {
    const LARGEST_RADIUS: f64 = 15.0;
    const COINCIDE: f64 = 2.0;
    let radius = |i: usize| {
        let distances = || points.iter().map(|&other| distance(points[i], other));
        if distances().take(i).any(|distance| distance < COINCIDE) {
            return 0.0;
        }
        let others = distances().filter(|&distance| distance >= COINCIDE);
        (0.44 * others.fold(f64::INFINITY, f64::min)).min(LARGEST_RADIUS)
    };
    (0..points.len()).map(radius).collect()
}

/// The radius of a number's disc and the height of its digits; `None` if the disc cannot hold it.
pub(super) fn in_disc(number: u32, radius: f64) -> Option<(f64, f64)> {
    // Digits fit if their diagonal is at most the diameter. Room is made for two digits at least,
    // so that discs look the same.
    let diagonal_per_height = libm::hypot(number_width(number.max(10), 1.0), 1.0);
    let height = (1.7 * radius / diagonal_per_height).min(LARGEST);
    let needed = (height * diagonal_per_height / 1.7).max(6.0).min(radius);
    (height >= SMALLEST).then_some((needed, height))
}

/// The centre and height of a primitive's number: in the middle of its incircle or segment.
pub(super) fn in_primitive(number: u32, corners: &[Position]) -> Option<(Position, f64)> {
    let (centre, room) = match corners {
        [a, b] => (middle(*a, *b), distance(*a, *b) * 0.4),
        [a, b, c] => incircle(*a, *b, *c)?,
        _ => return None,
    };
    let height = (1.8 * room / libm::hypot(number_width(number, 1.0), 1.0)).min(LARGEST);
    (height >= SMALLEST).then_some((centre, height))
}

/// The corners of a plate behind a number.
pub(super) fn plate(number: u32, [x, y]: Position, height: f64) -> Vec<Position> {
    let (half_width, half_height) = (number_width(number, height) / 2.0 + 2.0, height / 2.0 + 2.0);
    [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)]
        .map(|(right, down)| [x + right * half_width, y + down * half_height])
        .to_vec()
}

fn middle(a: Position, b: Position) -> Position {
    [0, 1].map(|axis| (a[axis] + b[axis]) / 2.0)
}

fn distance(a: Position, b: Position) -> f64 {
    libm::hypot(a[0] - b[0], a[1] - b[1])
}

/// The centre and radius; `None` for a triangle without an inside.
fn incircle(a: Position, b: Position, c: Position) -> Option<(Position, f64)> {
    let sides = [distance(b, c), distance(c, a), distance(a, b)];
    let perimeter: f64 = sides.iter().sum();
    let area = ((b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])).abs() / 2.0;
    if area <= 0.0 {
        return None;
    }
    let coordinate =
        |axis: usize| (sides[0] * a[axis] + sides[1] * b[axis] + sides[2] * c[axis]) / perimeter;
    Some(([coordinate(0), coordinate(1)], 2.0 * area / perimeter))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn near(found: f64, expected: f64) -> bool {
        (found - expected).abs() < 1e-9
    }

    /// Points that coincide share one disc. Others have the room to their neighbours, up to 15
    /// pixels.
    #[test]
    fn discs_have_room() {
        let points = [[0.0, 0.0], [1.0, 0.0], [40.0, 0.0], [50.0, 0.0], [52.0, 0.0]];
        let expected = [15.0, 0.0, 4.4, 0.88, 0.88];
        let radii = disc_radii(&points);
        assert_eq!(radii.len(), expected.len());
        let all = radii.iter().zip(expected).all(|(found, expected)| near(*found, expected));
        assert!(all, "{radii:?}");
    }

    /// The incircle of a triangle of 30, 40 and 50 pixels has a radius of 10, and its centre is 10
    /// away from both legs.
    #[test]
    fn numbers_stand_in_the_middle() {
        let (centre, radius) = incircle([0.0, 0.0], [40.0, 0.0], [0.0, 30.0]).expect("an inside");
        assert!(near(centre[0], 10.0) && near(centre[1], 10.0) && near(radius, 10.0), "{centre:?}");
        assert!(incircle([0.0, 0.0], [40.0, 0.0], [20.0, 0.0]).is_none(), "no inside");
        let (centre, height) = in_primitive(7, &[[0.0, 4.0], [20.0, 8.0]]).expect("room");
        assert!(near(centre[0], 10.0) && near(centre[1], 6.0) && height > 10.0, "{height}");
        assert!(in_primitive(7, &[[0.0, 0.0], [5.0, 0.0]]).is_none(), "a segment of five pixels");
        assert!(in_primitive(7, &[[0.0, 0.0]]).is_none(), "a point");
    }
}
