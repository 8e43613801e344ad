//! Rules of Direct3D, which specifies the place of each vertex and the primitives (specification,
//! sections 5 to 7).
//!
//! The order of primitives is free, and so is the leading vertex of a triangle (section 13). The
//! specified answer is the model's, or one with another legal conversion of its levels. There is
//! none if the patch is culled.

use super::Judged;
use super::answer::{Answer, Place, show};
use crate::strength::{Alternatives, Conversion};
use tess_core::Domain;

/// The answer that Direct3D specifies for a case, if it is not empty.
///
/// A level may have two legal conversions to 16 fraction bits (section 13). Of the specified
/// answers that these give, this is one that agrees with the device's in as much as any does.
pub(super) fn specified(answer: &Answer) -> Option<Answer> {
    let legal = Alternatives::new(&answer.case, Conversion::Within06Ulp);
    let of = |choice| {
        let output = legal.case(choice).patch().tessellate();
        Answer::new(&answer.case, &output, answer.specification).ok()
    };
    let agrees = |judge: fn(&Answer, Option<&Answer>) -> Judged, other: &Answer| {
        judge(answer, Some(other)).is_none_or(|result| result.is_ok())
    };
    let mut best = of(0).filter(|own| !own.is_empty())?;
    for choice in legal.choices().skip(1) {
        if agrees(primitives, &best) && agrees(places, &best) {
            break;
        }
        let other = of(choice)?;
        if agrees(places, &other) && (!agrees(places, &best) || agrees(primitives, &other)) {
            best = other;
        }
    }
    Some(best)
}

/// There are as many primitives as in the specified answer; coinciding points may be merged.
pub(super) fn counts(answer: &Answer, specified: Option<&Answer>) -> Judged {
    let size = answer.case.primitive_size();
    let (found, asked) = (answer.size() / size, specified?.size() / size);
    let least = if answer.has_points() { specified?.places.len() } else { asked };
    (!answer.is_empty()).then(|| match found {
        _ if (least..=asked).contains(&found) => Ok(()),
        _ => Err(format!("{found} primitives, its levels ask for {asked}")),
    })
}

/// The vertices are at the specified places.
pub(super) fn places(answer: &Answer, specified: Option<&Answer>) -> Judged {
    let specified = specified?;
    if answer.is_empty() {
        return None;
    }
    let first_of = |these: &Answer, others: &Answer| {
        let mut own = these.places.iter();
        own.find(|place| others.places.binary_search(place).is_err()).map(|place| show(*place))
    };
    Some(match (first_of(answer, specified), first_of(specified, answer)) {
        (None, None) => Ok(()),
        (Some(extra), None) => Err(format!("a vertex is at {extra}, where none is specified")),
        (None, Some(missing)) => Err(format!("no vertex is at {missing}, where one is specified")),
        (Some(extra), Some(missing)) => {
            Err(format!("a vertex is at {extra}, and none at {missing}, which is specified"))
        }
    })
}

/// A primitive's vertices; the places of fewer than three are followed by zeros.
type Primitive = [Place; 3];

/// The primitives by their vertices, ascending. A triangle starts with its smallest vertex.
fn primitives_of(answer: &Answer) -> Vec<Primitive> {
    let of = |vertices: &[Place]| {
        let mut primitive = Primitive::default();
        primitive[..vertices.len()].copy_from_slice(vertices);
        let [a, b, c] = primitive;
        let turns = [[a, b, c], [b, c, a], [c, a, b]];
        if vertices.len() == 3 { turns.into_iter().min().unwrap_or(primitive) } else { primitive }
    };
    let size = answer.case.primitive_size();
    let mut primitives: Vec<_> = answer.vertices.chunks(size).map(of).collect();
    primitives.sort_unstable();
    primitives
}

/// How often a primitive occurs in an ascending list.
fn times(list: &[Primitive], primitive: Primitive) -> usize {
    let first = list.partition_point(|own| *own < primitive);
    list[first..].iter().take_while(|own| **own == primitive).count()
}

/// The primitives are the specified ones, in any order; coinciding points may be merged. Lines of
/// triangles and quads are not compared: they join the points in their order, which is free.
pub(super) fn primitives(answer: &Answer, specified: Option<&Answer>) -> Judged {
    let is_view = answer.case.primitive_size() == 2 && answer.case.domain() != Domain::Isoline;
    let specified = specified?;
    if answer.is_empty() || is_view {
        return None;
    }
    // The same list needs no sorting.
    if answer.vertices == specified.vertices {
        return Some(Ok(()));
    }
    let (own, right) = (primitives_of(answer), primitives_of(specified));
    let size = answer.case.primitive_size();
    let text = |primitive: &Primitive| {
        primitive[..size].iter().map(|place| show(*place)).collect::<Vec<_>>().join(" ")
    };
    let extra = own.iter().find(|one| times(&own, **one) > times(&right, **one));
    let missing = right.iter().find(|one| match times(&own, **one) {
        0 => true,
        found => found < times(&right, **one) && !answer.has_points(),
    });
    Some(match (extra, missing) {
        (None, None) => Ok(()),
        (Some(extra), None) => Err(format!("{} comes more often than specified", text(extra))),
        (None, Some(missing)) => Err(format!("{} comes less often than specified", text(missing))),
        (Some(extra), Some(missing)) => {
            Err(format!("{} is not specified, and {} is missing", text(extra), text(missing)))
        }
    })
}
