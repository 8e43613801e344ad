//! One result drawn over another, with differences in red.

use super::colours::{DIFFERENT, DIFFERENT_FILL, GRID};
use super::layout::{self, Layout};
use super::{DrawOptions, Drawing, corners};
use crate::picture::{Colour, Position, Shape};
use tess_verify::vectors::Listing;

/// The number of elements that differ between two results of one case.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Differences {
    /// Points whose bits differ, and points that one result lacks.
    pub points: usize,
    /// Primitives whose indices differ, and primitives that one result lacks.
    pub primitives: usize,
    /// Differences that a picture cannot show as they are, one line each: primitives that are
    /// missing, have no extent, or name points that do not exist.
    pub in_words: Vec<String>,
}

/// Draws the expected result in grey, and the differences of the observed one in red.
///
/// A primitive that is missing or cannot be drawn is marked by a red outline of the expected one. A
/// primitive without extent is marked by discs at its corners.
#[must_use]
pub fn overlay(
    expected: &Listing,
    observed: &Listing,
    options: &DrawOptions,
) -> (Drawing, Differences) {
    let mut drawing = super::draw(expected, options);
    let layout = Layout::new(expected.case.domain(), options.size);
    let both = [expected, observed].map(|patch| layout.place_all(&patch.output.points));
    let shapes = &mut drawing.picture.shapes;
    let mut differences = Differences::default();
    for_each_difference(expected.primitives(), observed.primitives(), |t, from, to| {
        differences.primitives += 1;
        let (marks, words) = mark_primitive(t, from, to, &both);
        shapes.extend(marks);
        differences.in_words.extend(words);
    });
    let points = |patch: &Listing| patch.output.points.clone();
    for_each_difference(points(expected), points(observed), |i, _, _| {
        differences.points += 1;
        shapes.extend(mark_point(both[0].get(i).copied(), both[1].get(i).copied(), both[0].len()));
    });
    (drawing, differences)
}

/// The numbers of the points and of the primitives that differ between two results.
#[must_use]
pub fn differing(expected: &Listing, observed: &Listing) -> [Vec<usize>; 2] {
    let [mut points, mut primitives] = [vec![], vec![]];
    let places = |patch: &Listing| patch.output.points.clone();
    for_each_difference(places(expected), places(observed), |i, _, _| points.push(i));
    for_each_difference(expected.primitives(), observed.primitives(), |t, _, _| primitives.push(t));
    [points, primitives]
}

/// Calls `each` with each position at which two lists differ, and with their elements there.
fn for_each_difference<T: PartialEq>(
    expected: impl IntoIterator<Item = T>,
    observed: impl IntoIterator<Item = T>,
    mut each: impl FnMut(usize, Option<T>, Option<T>),
) {
    let (mut expected, mut observed) = (expected.into_iter(), observed.into_iter());
    for k in 0.. {
        match (expected.next(), observed.next()) {
            (None, None) => break,
            (a, b) if a != b => each(k, a, b),
            _ => {}
        }
    }
}

fn mark_point(from: Option<Position>, to: Option<Position>, points: usize) -> Vec<Shape> {
    let mut shapes = Vec::new();
    if let (Some(from), Some(to)) = (from, to) {
        shapes.push(Shape::Line { points: vec![from, to], width: 2.0, stroke: DIFFERENT });
    }
    let fill = if to.is_some() { DIFFERENT } else { GRID };
    shapes.extend(to.or(from).map(|centre| disc(centre, points, fill)));
    shapes
}

fn disc(centre: Position, points: usize, fill: Colour) -> Shape {
    Shape::Disc { centre, radius: layout::mark_radius(points), fill, rim: DIFFERENT }
}

/// The shapes that mark primitive `t`, and a description of the fault if they do not show it.
fn mark_primitive(
    t: usize,
    expected: Option<&[u32]>,
    observed: Option<&[u32]>,
    [expected_points, observed_points]: &[Vec<Position>; 2],
) -> (Vec<Shape>, Option<String>) {
    let outline = || {
        let corners = expected.and_then(|primitive| corners(primitive, expected_points));
        corners.map_or_else(Vec::new, |corners| red(corners, None, expected_points.len()))
    };
    let Some(observed) = observed else {
        return (outline(), Some(format!("primitive {t} is missing")));
    };
    let Some(corners) = corners(observed, observed_points) else {
        let count = observed_points.len();
        let words =
            format!("primitive {t} is {}, but there are {count} points, from 0", indices(observed));
        return (outline(), Some(words));
    };
    let repeats = (1..observed.len()).any(|k| observed[..k].contains(&observed[k]));
    let words = repeats
        .then(|| format!("primitive {t} is {}, which names a point twice", indices(observed)));
    let mut shapes = red(corners.clone(), Some(DIFFERENT_FILL), observed_points.len());
    if repeats {
        let discs = corners.iter().map(|&place| disc(place, observed_points.len(), DIFFERENT));
        shapes.extend(discs);
    }
    (shapes, words)
}

fn indices(primitive: &[u32]) -> String {
    let words: Vec<_> = primitive.iter().map(u32::to_string).collect();
    format!("`{}`", words.join(" "))
}

/// A primitive in red: an outline, filled if it is a triangle and a colour is given; or a disc if
/// it is a point.
fn red(mut corners: Vec<Position>, fill: Option<Colour>, points: usize) -> Vec<Shape> {
    let mut shapes = Vec::new();
    match (corners.len(), fill) {
        (1, _) => return vec![disc(corners[0], points, fill.unwrap_or(GRID))],
        (3, Some(fill)) => shapes.push(Shape::Polygon { corners: corners.clone(), fill }),
        _ => {}
    }
    if corners.len() == 3 {
        corners.extend(corners.first().copied());
    }
    shapes.push(Shape::Line { points: corners, width: 2.0, stroke: DIFFERENT });
    shapes
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A primitive that is a point is marked by a disc, because a line of one point would be
    /// invisible.
    #[test]
    fn points_are_marked_by_discs() {
        let line = "case tri integer point ruler 40000000 40000000 40000000 40000000";
        let expected = Listing::of_model(line.parse().expect("a case"));
        let mut observed = expected.clone();
        observed.output.indices[2] = 0;
        let (drawing, differences) = overlay(&expected, &observed, &DrawOptions::default());
        assert_eq!((differences.points, differences.primitives), (0, 1), "{differences:?}");
        let shapes = &drawing.picture.shapes;
        let is_mark = |shape: &&Shape| matches!(shape, Shape::Disc { rim: DIFFERENT, .. });
        assert_eq!(shapes.iter().filter(is_mark).count(), 1, "{shapes:?}");
        let is_dot =
            |shape: &Shape| matches!(shape, Shape::Line { points, .. } if points.len() == 1);
        assert!(!shapes.iter().any(is_dot), "{shapes:?}");
    }
}
