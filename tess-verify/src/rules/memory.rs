//! Rules that compare a patch with earlier ones.

use super::Judgement;
use super::answer::{Answer, Place, TOLERANCE, distance_along};
use super::edge::{known_edges, shorter};
use super::levels::{TessellationLevel, is_minimum};
use super::lines::{Line, inner_lines, outer_lines};
use crate::case::Case;
use crate::generate::SplitMix64;
use crate::vectors::words_digest;
use std::collections::{BTreeMap, HashMap};
use tess_core::fixed_point::ONE;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, SplitOrder};

/// How much shorter the shorter segments may become as the level grows, in units of 2^-16, because
/// each of a segment's two ends is rounded.
const ROUNDING: u32 = 2;
/// Levels at least this far apart, in units of 2^-16, must have shorter segments of different
/// lengths.
const APART: u32 = 1 << 13;

/// The state on which every rule depends: domain, spacing and split order.
type State = (Domain, Partitioning, SplitOrder);

/// The properties that two patches may have in common. Each variant names what such patches must
/// then share.
#[derive(Debug, PartialEq, Eq, Hash)]
enum Key {
    /// Equal cases share the sequence of vertices.
    Case(Case),
    /// Cases that differ only in winding share the set of triangles.
    Triangles(Case),
    /// Cases that differ only in the output share the set of places.
    Places(Case),
    /// An edge and its level determine its vertices.
    Edge(State, usize, u32),
    /// The inner levels determine the triangles without a vertex on the outline.
    Interior(State, Vec<u32>),
    /// An edge, its level and the inner levels determine the triangles at that edge.
    Transition(State, usize, u32, Vec<u32>),
}

/// The vertices of earlier patches' edges that have one level, each with the first patch that has
/// it.
type Edges = BTreeMap<(Domain, usize), (Vec<u32>, Case)>;

/// The length of the shorter segments by level, in units of 2^-16, each with the first patch of
/// that level. All of these levels round up to the same number.
type Shorter = BTreeMap<u32, (u32, Case)>;

/// The first line of a level: the places of its vertices, its name and its patch.
#[derive(Debug)]
struct Divided {
    along: Vec<u32>,
    name: String,
    case: Case,
}

/// Properties of earlier patches.
#[derive(Debug, Default)]
pub(super) struct Memory {
    /// A digest of the shared property, and the first patch that has it.
    known: HashMap<Key, (u64, Case)>,
    edges: HashMap<(Option<Domain>, Partitioning, SplitOrder, u32), Edges>,
    /// By state, by whether the level is an inner one, and by number of segments.
    shorter: HashMap<(State, bool, u32), Shorter>,
    /// By spacing, split order, bits of the clamped level and number of segments.
    divided: HashMap<(Partitioning, SplitOrder, u32, u32), Divided>,
}

fn state(answer: &Answer) -> State {
    let Config { partitioning, split, .. } = answer.case.config;
    (answer.case.domain(), partitioning, split)
}

fn inner(case: &Case) -> Vec<u32> {
    case.factors.inside().map(f32::to_bits).collect()
}

fn level(case: &Case, edge: usize) -> u32 {
    case.factors.outer().nth(edge).map_or(0, f32::to_bits)
}

/// The positions of a domain's inner levels, as bits.
fn inner_positions(domain: Domain) -> u8 {
    (domain.outer_factors()..domain.factors()).fold(0, |bits, position| bits | 1 << position)
}

/// Each of these judges a patch against earlier ones that it must agree with, and stores what later
/// patches must agree with.
impl Memory {
    pub(super) fn same(&mut self, answer: &Answer) -> Vec<Judgement> {
        let digest = words_digest(answer.vertices.as_flattened());
        self.compare(Key::Case(answer.case), digest, answer, u8::MAX, "another sequence")
    }

    pub(super) fn winding(&mut self, answer: &Answer) -> Vec<Judgement> {
        if answer.is_empty() || !answer.has_triangles() {
            return Vec::new();
        }
        let key = Key::Triangles(answer.case.with_output(OutputPrimitive::TriangleCw));
        let digest = triangles(answer.triangles());
        self.compare(key, digest, answer, u8::MAX, "another set of triangles")
    }

    pub(super) fn points_same(&mut self, answer: &Answer) -> Vec<Judgement> {
        if answer.is_empty() {
            return Vec::new();
        }
        let key = Key::Places(answer.case.with_output(OutputPrimitive::Point));
        let digest = words_digest(answer.places.as_flattened());
        self.compare(key, digest, answer, u8::MAX, "vertices at other places")
    }

    /// Compares a digest with that of the first patch that has the same key. Where the output is
    /// not part of the key, patches of equal output are not compared.
    fn compare(
        &mut self,
        key: Key,
        digest: u64,
        answer: &Answer,
        positions: u8,
        what: &str,
    ) -> Vec<Judgement> {
        match self.known.get(&key) {
            None => {
                self.known.insert(key, (digest, answer.case));
                Vec::new()
            }
            Some((_, case))
                if matches!(key, Key::Triangles(_) | Key::Places(_))
                    && case.config.output == answer.case.config.output =>
            {
                Vec::new()
            }
            Some(&(known, case)) => {
                let result = if known == digest { Ok(()) } else { Err(what.to_owned()) };
                vec![Judgement { other: Some(case), positions, result }]
            }
        }
    }

    pub(super) fn edge_level(&mut self, answer: &Answer) -> Vec<Judgement> {
        let each = |(edge, along): (usize, Vec<u32>)| {
            let key = Key::Edge(state(answer), edge, level(&answer.case, edge));
            let name = answer.case.domain().factor_names()[edge];
            let what = format!("edge {name} has other vertices");
            self.compare(key, words_digest(&along), answer, 1 << edge, &what)
        };
        known_edges(answer).filter(|_| !answer.is_empty()).flat_map(each).collect()
    }

    /// Compares each edge with the other edges of the same level, in either direction. In Direct3D,
    /// edges of different domains must agree too.
    pub(super) fn every_edge(&mut self, answer: &Answer) -> Vec<Judgement> {
        let (domain, partitioning, split) = state(answer);
        let own = (!answer.is_exact()).then_some(domain);
        let mut judgements = Vec::new();
        for (edge, along) in known_edges(answer).filter(|_| !answer.is_empty()) {
            let mirrored: Vec<u32> = along.iter().rev().map(|x| ONE - x).collect();
            let key = (own, partitioning, split, level(&answer.case, edge));
            let known = self.edges.entry(key).or_default();
            let others = known.iter().filter(|(other, _)| **other != (domain, edge));
            judgements.extend(others.map(|((other, number), (there, case))| {
                let is_same = *there == along || *there == mirrored;
                let names = [domain.factor_names()[edge], other.factor_names()[*number]];
                let what =
                    || format!("edge {} has other vertices than edge {}", names[0], names[1]);
                let result = if is_same { Ok(()) } else { Err(what()) };
                Judgement { other: Some(*case), positions: 1 << edge, result }
            }));
            known.entry((domain, edge)).or_insert((along, answer.case));
        }
        judgements
    }

    pub(super) fn interior(&mut self, answer: &Answer) -> Vec<Judgement> {
        if !has_own_inside(answer) {
            return Vec::new();
        }
        let is_inside = |triangle: &[Place; 3]| triangle.iter().all(|p| !answer.is_on_outline(*p));
        let digest = triangles(answer.triangles().filter(is_inside));
        let key = Key::Interior(state(answer), inner(&answer.case));
        let positions = inner_positions(answer.case.domain());
        self.compare(key, digest, answer, positions, "other triangles inside")
    }

    /// Compares the triangles with two vertices on an edge. Those with one are at a corner of two
    /// edges, or next to a triangle that has two.
    pub(super) fn transition(&mut self, answer: &Answer) -> Vec<Judgement> {
        if !has_own_inside(answer) {
            return Vec::new();
        }
        let domain = answer.case.domain();
        let each = |edge| {
            let is_on = |place: &&Place| distance_along(domain, edge, **place).is_some();
            let is_at = |triangle: &[Place; 3]| triangle.iter().filter(is_on).count() >= 2;
            let digest = triangles(answer.triangles().filter(is_at));
            let (name, level) = (domain.factor_names()[edge], level(&answer.case, edge));
            let key = Key::Transition(state(answer), edge, level, inner(&answer.case));
            let positions = inner_positions(domain) | 1 << edge;
            let what = format!("other triangles at edge {name}");
            self.compare(key, digest, answer, positions, &what)
        };
        (0..domain.outer_factors()).flat_map(each).collect()
    }

    /// Compares each line with the first line of its level, in any patch: an edge, an isoline, or
    /// the columns, rows or rings inside.
    pub(super) fn equal_levels(&mut self, answer: &Answer) -> Vec<Judgement> {
        let (_, partitioning, split) = state(answer);
        let mut judgements = Vec::new();
        for line in fractional_lines(answer) {
            let Some(level) = line.level_if_right() else { continue };
            let key = (partitioning, split, level.clamped().to_bits(), level.segments());
            let Line { name, along, .. } = line;
            let Some(first) = self.divided.get(&key) else {
                self.divided.insert(key, Divided { along, name, case: answer.case });
                continue;
            };
            let mut pairs = first.along.iter().zip(&along);
            let differs = pairs.find(|(there, here)| there.abs_diff(**here) > TOLERANCE);
            let what = differs.map(|(there, here)| {
                let [there, here] = [there, here].map(|x| format!("{x:05x}"));
                let level = level.raw;
                format!(
                    "level {level} puts a vertex at {here} of {name} and at {there} of {}",
                    first.name
                )
            });
            let result = what.map_or(Ok(()), Err);
            let positions = 1 << level.position;
            judgements.push(Judgement { other: Some(first.case), positions, result });
        }
        judgements
    }

    /// Compares lines whose levels round up to the same number: each with those of the next lower
    /// and the next higher level.
    pub(super) fn monotone(&mut self, answer: &Answer) -> Vec<Judgement> {
        let mut judgements = Vec::new();
        for line in fractional_lines(answer) {
            let (Some(level), Some(length)) = (line.level_if_right(), shorter(&line)) else {
                continue;
            };
            let positions = 1 << level.position;
            let (n, level, is_inner) = (level.segments(), level.fixed(), level.is_inner);
            let known = self.shorter.entry((state(answer), is_inner, n)).or_default();
            let below = known.range(..level).next_back();
            let above = known.range(level + 1..).next();
            let low = below.map(|(from, (there, case))| (*case, level - from, *there, length));
            let high = above.map(|(to, (there, case))| (*case, to - level, length, *there));
            let pairs = low.into_iter().chain(high);
            judgements.extend(pairs.map(|(case, apart, low, high)| {
                let result = growing(apart, low, high);
                Judgement { other: Some(case), positions, result }
            }));
            known.entry(level).or_insert((length, answer.case));
        }
        judgements
    }
}

/// Whether a patch has triangles inside that can be told from those at the outline.
fn has_own_inside(answer: &Answer) -> bool {
    answer.has_triangles()
        && !answer.is_empty()
        && !is_minimum(&answer.case)
        && !answer.touches
        && answer.case.domain() != Domain::Isoline
}

/// Whether the shorter segments grow from one level to another that is `apart` units of 2^-16
/// higher.
fn growing(apart: u32, low: u32, high: u32) -> Result<(), String> {
    match () {
        () if low > high + ROUNDING => {
            Err(format!("the shorter segments shrink from {low:05x} to {high:05x}"))
        }
        () if apart >= APART && low >= high => {
            Err(format!("the shorter segments stay {low:05x} from a level to a higher one"))
        }
        () => Ok(()),
    }
}

/// The lines whose vertices move with the level.
fn fractional_lines(answer: &Answer) -> impl Iterator<Item = Line> {
    let lines = outer_lines(answer).into_iter().chain(inner_lines(answer));
    lines.filter(|line| line.level.is_some_and(TessellationLevel::is_fractional))
}

/// A digest of triangles that does not depend on their order or on that of their vertices: the sum
/// of a hash of each.
fn triangles(triangles: impl Iterator<Item = [Place; 3]>) -> u64 {
    let sorted = |mut triangle: [Place; 3]| {
        triangle.sort_unstable();
        triangle
    };
    // A mixing function of the words so far and the next ones.
    let mix = |hash: u64, [u, v]: Place| {
        SplitMix64::new(hash ^ (u64::from(u) << 32 | u64::from(v))).next_u64()
    };
    let hash = |triangle| sorted(triangle).into_iter().fold(0, mix);
    triangles.map(hash).fold(0, u64::wrapping_add)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A digest depends on every triangle and on how often it occurs, and on no order.
    #[test]
    fn triangles_have_a_digest() {
        let [a, b, c, d] = [[0, 0], [1, 0], [0, 1], [1, 1]];
        let of = |list: &[[Place; 3]]| triangles(list.iter().copied());
        let both = of(&[[a, b, c], [b, c, d]]);
        assert_eq!(both, of(&[[c, d, b], [c, a, b]]), "another order");
        for other in [&[[a, b, c]][..], &[[a, b, c], [b, a, d]], &[[a, b, c], [b, c, d], [b, c, d]]]
        {
            assert_ne!(both, of(other), "{other:?}");
        }
        assert_ne!(of(&[[a, b, c]; 3]), of(&[[a, b, c]]), "three of them");
    }
}
