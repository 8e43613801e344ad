//! The origin of the model's side of a difference.

use super::{PointReport, PrimitiveReport};
use tess_core::{Patch, Tessellation};
use tess_verify::check::{Difference, Element};

/// The origin of the model's element of a difference, with the values that led to it; `None` if the
/// model has no such element. An element given by its vertices is the model's first one that has
/// them, whatever its leading vertex.
#[must_use]
pub fn origin(difference: &Difference) -> Option<String> {
    let patch = difference.case?.patch();
    match &difference.mismatch.element {
        Element::Point { index, .. } => point(&patch, *index),
        Element::Index { primitive: t, .. } | Element::Third { primitive: t, .. } => {
            primitive(&patch, *t)
        }
        Element::Vertices(places) => match &places[..] {
            [place] => {
                let output = patch.tessellate();
                let mut points = 0..output.points.len();
                point(&patch, points.find(|i| place_of(&output, *i) == Some(*place))?)
            }
            _ => primitive(&patch, with_vertices(&patch.tessellate(), places)?),
        },
        _ => None,
    }
}

fn point(patch: &Patch, i: usize) -> Option<String> {
    Some(PointReport::new(patch, u32::try_from(i).ok()?)?.to_string())
}

fn primitive(patch: &Patch, t: usize) -> Option<String> {
    Some(PrimitiveReport::new(patch, u32::try_from(t).ok()?)?.to_string())
}

fn place_of(output: &Tessellation, i: usize) -> Option<[u32; 2]> {
    output.points.get(i).map(|point| [point.u.to_bits(), point.v.to_bits()])
}

/// The number of the first primitive with these vertices, whatever its leading vertex.
fn with_vertices(output: &Tessellation, places: &[[u32; 2]]) -> Option<usize> {
    let size = places.len();
    let is_same = |primitive: &[u32]| {
        (0..size).any(|lead| {
            let turned = places.iter().cycle().skip(lead).take(size);
            let vertices = primitive.iter().map(|&index| place_of(output, index as usize));
            vertices.eq(turned.map(|place| Some(*place)))
        })
    };
    output.indices.chunks(size.max(1)).position(is_same)
}
