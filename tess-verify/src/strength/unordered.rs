//! Comparison of outputs in any order: as multisets of places and of primitives.
//!
//! The model's distinct places are sorted; the *rank* of a place is its position in that list. An
//! observed point has the rank of its place, or [`NOWHERE`] if the model has no such place. A
//! primitive becomes a key made of its vertices' ranks. Equal keys are equal primitives, so
//! comparing sorted keys compares the outputs.
//!
//! ```text
//! place (64 bits)   63..32  bits of u      31..0  bits of v       sorting it sorts by u, then v
//! key   (39 bits)   38..26  rank of the first vertex   25..13  second   12..0  third
//!                   lines: 25..13, 12..0       points: 12..0      NOWHERE is 8191; ranks are below 4225
//! ```
//!
//! Example: one triangle, (0, 1), (0, 0), (1, 0). The sorted places are (0, 0), (0, 1), (1, 0), so
//! the triangle's ranks are 1, 0, 2. Depending on the leading vertex, its key is 1-0-2, 0-2-1 or
//! 2-1-0; the smallest, 0-2-1, represents all three. With the other orientation the key is 0-1-2.
//!
//! - The leading vertex of a triangle is free; its orientation is not.
//! - A place may be listed more often than in the model if primitives use each of its points: a
//!   device without an index buffer lists a vertex for each use.
//! - Points that are primitives may be merged where they coincide, but may not be drawn more often
//!   than in the model.
//!
//! Comparing sets of coordinate tuples would be simpler. With ranks, a key fits into 64 bits, which
//! matters because level 2 has 207 million indices to sort.

use super::Elements;
use crate::case::Case;
use std::cmp::Reverse;
use std::collections::BTreeMap;
use std::iter::Peekable;
use tess_core::{DomainPoint, Tessellation};

/// An element that two outputs do not have equally often, as far as they must.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Difference {
    /// The vertices of the element, as 16.16 bits of u and v: one for a point, several for a
    /// primitive.
    pub(crate) vertices: Vec<[u32; 2]>,
    /// How often the observed output has the element.
    pub(crate) observed: usize,
    /// How often it should have it.
    pub(crate) expected: usize,
    /// The most similar element that is wrong in the opposite direction: too frequent if this one
    /// is too rare, or the reverse.
    pub(crate) instead: Option<Box<Difference>>,
}

/// The first point that is not in both outputs as often as it must be; if there is none, the first
/// such primitive.
///
/// Points are compared as a set of places. If primitives are compared too, a place may be listed
/// more often than in the model only if primitives use each of its points. Primitives are compared
/// by the places of their vertices, and the leading vertex of a triangle is free.
pub(crate) fn first_difference(
    elements: Elements,
    case: &Case,
    observed: &Tessellation,
    expected: &Tessellation,
) -> Option<Difference> {
    if elements == Elements::Primitives && observed == expected {
        return None;
    }
    let known = DistinctPlaces::of(expected);
    let ranks = [known.ranks(observed), known.ranks(expected)];
    points(elements, observed, &known, &ranks).or_else(|| match elements {
        Elements::Points => None,
        Elements::Primitives => {
            let size = case.primitive_size();
            primitives(size, &known, [(observed, &ranks[0]), (expected, &ranks[1])])
        }
    })
}

/// The first point that is not listed as often as it must be when primitives are compared.
pub(crate) fn first_stray(observed: &Tessellation, expected: &Tessellation) -> Option<Difference> {
    let known = DistinctPlaces::of(expected);
    let ranks = [known.ranks(observed), known.ranks(expected)];
    points(Elements::Primitives, observed, &known, &ranks)
}

/// The distinct places of the model's points, ascending; u is in the upper bits, v in the lower
/// ones.
struct DistinctPlaces(Vec<u64>);

/// The position of a place in the sorted list; [`NOWHERE`] for other places. A patch has at most
/// 4225 points.
type Rank = u16;
/// The number of bits of a rank in a primitive's key.
const RANK: u32 = 13;
const NOWHERE: Rank = (1 << RANK) - 1;

impl DistinctPlaces {
    fn of(output: &Tessellation) -> Self {
        let mut places: Vec<u64> = output.points.iter().map(place).collect();
        places.sort_unstable();
        places.dedup();
        Self(places)
    }

    /// The rank of each point.
    fn ranks(&self, output: &Tessellation) -> Vec<Rank> {
        let rank = |point| self.0.binary_search(&place(point)).ok();
        let bounded = |rank: Option<usize>| Rank::try_from(rank?).ok();
        output.points.iter().map(|point| bounded(rank(point)).unwrap_or(NOWHERE)).collect()
    }

    /// The number of occurrences of each place.
    fn times(&self, ranks: &[Rank]) -> Vec<usize> {
        let mut times = vec![0; self.0.len()];
        for &rank in ranks {
            if let Some(times) = times.get_mut(usize::from(rank)) {
                *times += 1;
            }
        }
        times
    }

    fn vertex(&self, rank: u64) -> [u32; 2] {
        let place = usize::try_from(rank).ok().and_then(|rank| self.0.get(rank));
        place.map_or([u32::MAX; 2], |&place| [high(place), low(place)])
    }
}

/// The first place that only one output has, or that the observed output lists too often.
fn points(
    elements: Elements,
    observed: &Tessellation,
    known: &DistinctPlaces,
    ranks: &[Vec<Rank>; 2],
) -> Option<Difference> {
    let times = ranks.each_ref().map(|ranks| known.times(ranks));
    let may_repeat = match elements {
        Elements::Points => vec![true; known.0.len()],
        Elements::Primitives => all_used(observed, &ranks[0], known.0.len()),
    };
    let mut wrong: BTreeMap<u64, (usize, usize)> = BTreeMap::new();
    for (rank, &place) in known.0.iter().enumerate() {
        let (observed, expected) = (times[0][rank], times[1][rank]);
        if observed == 0 || (observed > expected && !may_repeat[rank]) {
            wrong.insert(place, (observed, expected));
        }
    }
    let unknown = observed.points.iter().zip(&ranks[0]).filter(|(_, rank)| **rank == NOWHERE);
    for (point, _) in unknown {
        wrong.entry(place(point)).or_default().0 += 1;
    }
    let vertices = |place| vec![[high(place), low(place)]];
    Difference::first(wrong.into_iter().map(|(place, (o, e))| (vertices(place), o, e)))
}

/// For each place, whether primitives use every point there.
fn all_used(output: &Tessellation, ranks: &[Rank], places: usize) -> Vec<bool> {
    let mut is_used = vec![false; ranks.len()];
    for &index in &output.indices {
        if let Some(is_used) = is_used.get_mut(index as usize) {
            *is_used = true;
        }
    }
    let mut all_used = vec![true; places];
    for (_, &rank) in is_used.iter().zip(ranks).filter(|(is_used, _)| !**is_used) {
        if let Some(all_used) = all_used.get_mut(usize::from(rank)) {
            *all_used = false;
        }
    }
    all_used
}

/// The first primitive that is not in both outputs equally often. If the primitives are points,
/// coinciding ones may have been merged.
fn primitives(
    size: usize,
    known: &DistinctPlaces,
    outputs: [(&Tessellation, &Vec<Rank>); 2],
) -> Option<Difference> {
    let [observed, expected] =
        outputs.map(|(output, ranks)| sorted_primitives(output, ranks, size));
    if observed == expected {
        return None;
    }
    let wrong = |&(_, observed, expected): &(u64, usize, usize)| match size {
        1 => observed == 0 || observed > expected,
        _ => observed != expected,
    };
    let vertices = |key: u64| {
        let rank =
            |number: usize| key >> (RANK as usize * (size - 1 - number)) & u64::from(NOWHERE);
        (0..size).map(|number| known.vertex(rank(number))).collect()
    };
    let wrong = counts(&observed, &expected).filter(wrong);
    Difference::first(wrong.map(|(key, observed, expected)| (vertices(key), observed, expected)))
}

/// The primitives of an output as sorted keys made of ranks; equal keys are equal primitives.
fn sorted_primitives(output: &Tessellation, ranks: &[Rank], size: usize) -> Vec<u64> {
    let vertex = |&index: &u32| u64::from(ranks.get(index as usize).copied().unwrap_or(NOWHERE));
    let key = |primitive: &[u32]| match primitive {
        [a, b, c] => triangle([a, b, c].map(vertex)),
        other => other.iter().fold(0, |key, index| key << RANK | vertex(index)),
    };
    let mut primitives: Vec<u64> = output.indices.chunks(size).map(key).collect();
    primitives.sort_unstable();
    primitives
}

/// The smallest of a triangle's three keys, one for each leading vertex.
fn triangle([a, b, c]: [u64; 3]) -> u64 {
    let key = |a, b, c| a << (2 * RANK) | b << RANK | c;
    key(a, b, c).min(key(b, c, a)).min(key(c, a, b))
}

impl Difference {
    /// The first of the wrong elements, together with the one that replaces it. Each item is an
    /// element's vertices and its observed and expected number.
    fn first(wrong: impl Iterator<Item = (Vec<[u32; 2]>, usize, usize)>) -> Option<Self> {
        let difference =
            |(vertices, observed, expected)| Self { vertices, observed, expected, instead: None };
        let mut wrong = wrong.map(difference);
        let first = wrong.next()?;
        let others = wrong.filter(|other| other.is_missing() != first.is_missing());
        let nearest = others.min_by_key(|other| Reverse(other.likeness(&first)));
        Some(Self { instead: nearest.map(Box::new), ..first })
    }

    const fn is_missing(&self) -> bool {
        self.observed < self.expected
    }

    /// The similarity of two elements: first by the number of common vertices, then by the
    /// distances of the coordinates.
    fn likeness(&self, other: &Self) -> (usize, Reverse<u64>) {
        let common = self.vertices.iter().filter(|vertex| other.vertices.contains(vertex)).count();
        let coordinates = |one: &Self| one.vertices.as_flattened().to_vec();
        let distances = coordinates(self).into_iter().zip(coordinates(other));
        (common, Reverse(distances.map(|(a, b)| u64::from(a.abs_diff(b))).sum()))
    }
}

/// The place of a point: u in the upper bits, v in the lower ones.
fn place(point: &DomainPoint) -> u64 {
    u64::from(point.u.to_bits()) << 32 | u64::from(point.v.to_bits())
}

fn high(place: u64) -> u32 {
    (place >> 32) as u32
}

#[expect(clippy::cast_possible_truncation, reason = "the lower half is wanted")]
const fn low(place: u64) -> u32 {
    place as u32
}

/// Each element of two sorted lists, with its number of occurrences in each.
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

#[cfg(test)]
mod tests {
    use super::*;

    /// A missing point is shown with the nearest superfluous one.
    #[test]
    fn the_nearest_point_stands_instead() {
        let line =
            "case quad integer point ruler 40000000 40000000 40000000 40000000 40000000 40000000";
        let case: Case = line.parse().expect("a case");
        let output = |u: [u32; 2]| Tessellation {
            points: u.map(|u| DomainPoint::from_bits(u, 0)).to_vec(),
            indices: Vec::new(),
        };
        let (observed, expected) = (output([0x101, 0x9000]), output([0x100, 0x8000]));
        let first = first_difference(Elements::Points, &case, &observed, &expected);
        let first = first.expect("all four differ");
        assert_eq!(first.vertices, [[0x100, 0]], "the first one");
        assert_eq!(first.instead.map(|other| other.vertices), Some(vec![[0x101, 0]]), "beside it");
    }

    /// Each index of a patch is changed in turn. The difference then shows both primitives, the
    /// missing one and the one in its place, by their vertices.
    #[test]
    fn primitives_that_differ_are_shown_by_their_vertices() {
        let of = "40000000 40000000 40000000 40000000 40000000 40000000";
        for (line, size) in [
            (format!("case quad integer triangle_cw ruler {of}"), 3),
            ("case isoline integer line ruler 40000000 40800000".to_owned(), 2),
        ] {
            let case: Case = line.parse().expect("a case");
            let expected = case.patch().tessellate();
            let points = 0..u32::try_from(expected.points.len()).expect("few points");
            for at in 0..expected.indices.len() {
                let of_primitive = at / size * size..at / size * size + size;
                let mut observed = expected.clone();
                let unused =
                    points.clone().find(|i| !expected.indices[of_primitive.clone()].contains(i));
                observed.indices[at] = unused.expect("patches have more points than a primitive");
                let mut shown = [&observed, &expected].map(|output| {
                    let places = output.indices[of_primitive.clone()].iter().map(|&index| {
                        let point = output.points[index as usize];
                        [point.u.to_bits(), point.v.to_bits()]
                    });
                    least_turned(places.collect())
                });
                shown.sort();
                let first = first_difference(Elements::Primitives, &case, &observed, &expected);
                let first = first.unwrap_or_else(|| panic!("index {at} of {line}"));
                let instead =
                    first.instead.unwrap_or_else(|| panic!("index {at}: nothing instead"));
                let mut found = [first.vertices, instead.vertices];
                found.sort();
                assert_eq!(found, shown, "index {at} of {line}");
            }
        }
    }

    /// The vertices of a triangle, rotated so that the smallest comes first; those of a line
    /// unchanged.
    fn least_turned(mut vertices: Vec<[u32; 2]>) -> Vec<[u32; 2]> {
        if let [a, b, c] = vertices[..] {
            let turns = [[a, b, c], [b, c, a], [c, a, b]];
            vertices = turns.into_iter().min().map_or(vertices, Vec::from);
        }
        vertices
    }

    /// The triangle of the example at the head of this file.
    #[test]
    fn keys_of_one_triangle() {
        let points = [(0, 0x1_0000), (0, 0), (0x1_0000, 0)];
        let points = points.map(|(u, v)| DomainPoint::from_bits(u, v)).to_vec();
        let output = Tessellation { points, indices: vec![0, 1, 2] };
        let known = DistinctPlaces::of(&output);
        let ranks = known.ranks(&output);
        assert_eq!(ranks, [1, 0, 2], "by u, then v");
        let key = |[a, b, c]: [u64; 3]| a << 26 | b << 13 | c;
        assert_eq!(sorted_primitives(&output, &ranks, 3), [key([0, 2, 1])], "the smallest key");
        assert_eq!(triangle([1, 2, 0]), key([0, 1, 2]), "the other orientation");
        assert_eq!(u64::from(NOWHERE), 8191, "above every rank");
    }
}
