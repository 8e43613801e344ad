//! One result over another, what differs in red.

use super::colours::{DIFFERENT, DIFFERENT_FILL, GRID};
use super::layout::{self, Layout};
use super::{DrawOptions, Drawing, corners};
use crate::formats::OnePatch;
use crate::picture::{Position, Shape};

/// How many elements differ between two results of one case.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Differences {
    /// Points whose bits differ, and points that one result lacks.
    pub(crate) points: usize,
    /// Primitives whose indices differ, and primitives that one result lacks.
    pub(crate) primitives: usize,
}

/// Draws the expected result in grey and what is observed differently in red.
#[must_use]
pub(crate) fn overlay(
    expected: &OnePatch,
    observed: &OnePatch,
    options: &DrawOptions,
) -> (Drawing, Differences) {
    let layout = Layout::new(expected.case().domain(), options.size);
    let expected_points = layout.place_all(&expected.output().points);
    let observed_points = layout.place_all(&observed.output().points);
    let mut drawing = super::draw(expected, options);
    let primitives = different(expected.primitives(), observed.primitives());
    let points = different(expected.output().points.iter(), observed.output().points.iter());
    let shapes = &mut drawing.picture.shapes;
    for &t in &primitives {
        if let Some(primitive) = observed.primitives().nth(t) {
            shapes.extend(red_primitive(primitive, &observed_points));
        }
    }
    for &i in &points {
        let radius = layout::mark_radius(expected_points.len());
        let (from, to) = (expected_points.get(i), observed_points.get(i));
        if let (Some(&from), Some(&to)) = (from, to) {
            shapes.push(Shape::Line { points: vec![from, to], width: 2.0, stroke: DIFFERENT });
        }
        if let Some(&centre) = to.or(from) {
            let fill = if to.is_some() { DIFFERENT } else { GRID };
            shapes.push(Shape::Disc { centre, radius, fill, rim: DIFFERENT });
        }
    }
    (drawing, Differences { points: points.len(), primitives: primitives.len() })
}

/// The positions at which two lists differ; those that one of them lacks differ.
fn different<T: PartialEq>(
    mut expected: impl Iterator<Item = T>,
    mut observed: impl Iterator<Item = T>,
) -> Vec<usize> {
    let mut positions = Vec::new();
    for k in 0.. {
        match (expected.next(), observed.next()) {
            (None, None) => break,
            (a, b) if a != b => positions.push(k),
            _ => {}
        }
    }
    positions
}

/// A primitive in red; one that names points that are not there cannot be drawn.
fn red_primitive(primitive: &[u32], points: &[Position]) -> Vec<Shape> {
    let Some(mut line) = corners(primitive, points) else {
        return Vec::new();
    };
    let mut shapes = Vec::new();
    if line.len() == 3 {
        shapes.push(Shape::Polygon { corners: line.clone(), fill: DIFFERENT_FILL });
        line.extend(line.first().copied());
    }
    shapes.push(Shape::Line { points: line, width: 2.0, stroke: DIFFERENT });
    shapes
}
