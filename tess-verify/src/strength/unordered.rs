//! Comparison of outputs whose order is free.

use crate::case::Case;
use crate::vectors::primitive_size;
use std::collections::BTreeMap;
use tess_core::Tessellation;

/// The 16.16 bits of a domain point.
type Point = [u32; 2];

/// An element that one output has more often than the other.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Missing {
    /// The domain points of the element: one, or a primitive's vertices.
    pub vertices: Vec<Point>,
    /// How often the observed output has it.
    pub observed: usize,
    /// How often it should.
    pub expected: usize,
}

/// The first distinct point that only one output has.
pub(super) fn points(observed: &Tessellation, expected: &Tessellation) -> Option<Missing> {
    let distinct = |output: &Tessellation| {
        let points = all_points(output).into_iter().map(|point| (vec![point], 1));
        points.collect::<BTreeMap<_, usize>>()
    };
    first_difference(&distinct(observed), &distinct(expected))
}

/// The first primitive that the outputs have a different number of times, vertices being compared
/// by their places and a triangle's leading vertex being free.
pub(super) fn primitives(
    case: &Case,
    observed: &Tessellation,
    expected: &Tessellation,
) -> Option<Missing> {
    let size = primitive_size(case);
    first_difference(&count_primitives(observed, size), &count_primitives(expected, size))
}

fn all_points(output: &Tessellation) -> Vec<Point> {
    output.points.iter().map(|point| [point.u.to_bits(), point.v.to_bits()]).collect()
}

fn count_primitives(output: &Tessellation, size: usize) -> BTreeMap<Vec<Point>, usize> {
    /// Stands for the vertex of an index that is out of range: no point lies there.
    const NOWHERE: Point = [u32::MAX; 2];
    let points = all_points(output);
    let mut counts = BTreeMap::new();
    for primitive in output.indices.chunks(size) {
        let vertex = |&index: &u32| points.get(index as usize).copied().unwrap_or(NOWHERE);
        let mut vertices: Vec<Point> = primitive.iter().map(vertex).collect();
        if size == 3 {
            lead_with_smallest(&mut vertices);
        }
        *counts.entry(vertices).or_insert(0) += 1;
    }
    counts
}

/// Turns a triangle so that equal triangles are equal lists. With two equal vertices in it, the
/// smallest list of the three decides.
fn lead_with_smallest(vertices: &mut [Point]) {
    let turned = |by: usize| {
        let mut list = vertices.to_vec();
        list.rotate_left(by);
        list
    };
    let smallest = (0..vertices.len()).map(turned).min();
    if let Some(smallest) = smallest {
        vertices.copy_from_slice(&smallest);
    }
}

fn first_difference(
    observed: &BTreeMap<Vec<Point>, usize>,
    expected: &BTreeMap<Vec<Point>, usize>,
) -> Option<Missing> {
    let elements = expected.keys().chain(observed.keys());
    elements
        .map(|vertices| Missing {
            vertices: vertices.clone(),
            observed: observed.get(vertices).copied().unwrap_or(0),
            expected: expected.get(vertices).copied().unwrap_or(0),
        })
        .find(|missing| missing.observed != missing.expected)
}
