//! Comparison of outputs whose order is free.

use super::Elements;
use crate::case::Case;
use crate::vectors::primitive_size;
use std::iter::Peekable;
use tess_core::Tessellation;

/// An element that one output has more often than the other may.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Difference {
    /// The domain points of the element: one, or a primitive's vertices; 16.16 bits of u and v.
    pub(crate) vertices: Vec<[u32; 2]>,
    /// How often the observed output has it.
    pub(crate) observed: usize,
    /// How often it should.
    pub(crate) expected: usize,
}

/// The first point, else the first primitive, that is not in both outputs as often as it must be.
///
/// Points are compared as a set of places. Where primitives count, a place may be listed more often
/// than the model lists it only as far as primitives use each of its points; and primitives are
/// compared by the places of their vertices, the leading vertex of a triangle being free.
pub(crate) fn first_difference(
    elements: Elements,
    case: &Case,
    observed: &Tessellation,
    expected: &Tessellation,
) -> Option<Difference> {
    if elements == Elements::Primitives && observed == expected {
        return None;
    }
    match elements {
        Elements::Points => points(observed, expected, |_| true),
        Elements::Primitives => points(observed, expected, |place| all_used(observed, place))
            .or_else(|| primitives(case, observed, expected)),
    }
}

/// The first place that only one output has, or that the observed one lists more often and
/// `may_repeat` refuses.
fn points(
    observed: &Tessellation,
    expected: &Tessellation,
    may_repeat: impl Fn(u64) -> bool,
) -> Option<Difference> {
    let sorted = |output: &Tessellation| {
        let mut places: Vec<u64> = places(output).collect();
        places.sort_unstable();
        places
    };
    let (observed, expected) = (sorted(observed), sorted(expected));
    let wrong = |(place, observed, expected): &(u64, usize, usize)| {
        let missing = *observed == 0 || *expected == 0;
        missing || (observed > expected && !may_repeat(*place))
    };
    let (place, observed, expected) = counts(&observed, &expected).find(wrong)?;
    Some(Difference { vertices: vec![[high(place), low(place)]], observed, expected })
}

/// Whether primitives use every point at `place`.
fn all_used(output: &Tessellation, place: u64) -> bool {
    let mut used = vec![false; output.points.len()];
    for &index in &output.indices {
        if let Some(used) = used.get_mut(index as usize) {
            *used = true;
        }
    }
    places(output).zip(used).all(|(other, used)| used || other != place)
}

/// The first primitive that is not in both outputs equally often. Where points are the primitives,
/// coinciding ones may have been merged.
fn primitives(case: &Case, observed: &Tessellation, expected: &Tessellation) -> Option<Difference> {
    let size = primitive_size(case);
    let (observed, expected) =
        (sorted_primitives(observed, size), sorted_primitives(expected, size));
    if observed == expected {
        return None;
    }
    let wrong = |&(_, observed, expected): &(u128, usize, usize)| match size {
        1 => observed == 0 || observed > expected,
        _ => observed != expected,
    };
    let (key, observed, expected) = counts(&observed, &expected).find(wrong)?;
    Some(Difference { vertices: vertices(key, size), observed, expected })
}

/// Bits of a place in a primitive's key: 17 of u, 17 of v. All places are the model's by now, which
/// are at most 2^16.
const COORDINATE: u32 = 17;
const VERTEX: u32 = 2 * COORDINATE;
/// Stands for the vertex of an index that is out of range: no point lies there.
const NOWHERE: u128 = (1 << VERTEX) - 1;

/// The primitives of an output as sorted keys: equal keys are equal primitives.
fn sorted_primitives(output: &Tessellation, size: usize) -> Vec<u128> {
    let key = |place: u64| u128::from(high(place)) << COORDINATE | u128::from(low(place));
    let keys: Vec<u128> = places(output).map(key).collect();
    let vertex = |index: u32| keys.get(index as usize).copied().unwrap_or(NOWHERE);
    let mut primitives: Vec<u128> = output
        .indices
        .chunks(size)
        .map(|primitive| match *primitive {
            [a, b, c] => triangle([a, b, c].map(vertex)),
            ref other => other.iter().fold(0, |key, &index| key << VERTEX | vertex(index)),
        })
        .collect();
    primitives.sort_unstable();
    primitives
}

/// The smallest of the three keys that a triangle has, depending on the vertex that leads.
fn triangle([a, b, c]: [u128; 3]) -> u128 {
    let key = |a, b, c| a << (2 * VERTEX) | b << VERTEX | c;
    key(a, b, c).min(key(b, c, a)).min(key(c, a, b))
}

/// What [`sorted_primitives`] made a key of.
fn vertices(key: u128, size: usize) -> Vec<[u32; 2]> {
    let coordinate = |vertex: u128, shift: u32| {
        u32::try_from(vertex >> shift & ((1 << COORDINATE) - 1)).unwrap_or(u32::MAX)
    };
    let vertex = |number: usize| {
        let vertex = key >> (VERTEX as usize * (size - 1 - number)) & NOWHERE;
        [coordinate(vertex, COORDINATE), coordinate(vertex, 0)]
    };
    (0..size).map(vertex).collect()
}

/// The places of an output's points in their order: bits of u above bits of v.
fn places(output: &Tessellation) -> impl Iterator<Item = u64> {
    output.points.iter().map(|p| u64::from(p.u.to_bits()) << 32 | u64::from(p.v.to_bits()))
}

fn high(place: u64) -> u32 {
    (place >> 32) as u32
}

#[expect(clippy::cast_possible_truncation, reason = "the lower half is wanted")]
const fn low(place: u64) -> u32 {
    place as u32
}

/// Each element of two sorted lists with the number of times that each of them has it.
fn counts<T: Copy + Ord>(a: &[T], b: &[T]) -> impl Iterator<Item = (T, usize, usize)> {
    let (mut a, mut b) = (a.iter().copied().peekable(), b.iter().copied().peekable());
    std::iter::from_fn(move || {
        let next = [a.peek(), b.peek()].into_iter().flatten().min().copied()?;
        Some((next, take(&mut a, next), take(&mut b, next)))
    })
}

/// Takes the elements equal to `element` and counts them.
fn take<T: Ord>(list: &mut Peekable<impl Iterator<Item = T>>, element: T) -> usize {
    std::iter::from_fn(|| list.next_if(|next| *next == element)).count()
}
