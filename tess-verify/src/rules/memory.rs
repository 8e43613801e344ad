//! Rules that compare a patch with earlier ones.

use super::Judgement;
use super::answer::{Answer, Place, position};
use super::edge::{is_fractional, lines, shorter};
use super::levels::{clamped, is_minimum, may_touch_outline, segments};
use super::standard::{Rule, Specification};
use crate::case::Case;
use crate::vectors::words_digest;
use std::collections::{BTreeMap, HashMap};
use tess_core::fixed_point::ONE;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, SplitOrder};

/// How much shorter the short segments may become as the level grows, in units of 2^-16: each of their two
/// ends is rounded.
const ROUNDING: u32 = 2;

/// The state that every rule keeps equal: domain, spacing and split order.
type State = (Domain, Partitioning, SplitOrder);

/// Properties that patches may have in common; each says what these must then share.
#[derive(Debug, PartialEq, Eq, Hash)]
enum Key {
    /// Everything equal: the sequence of vertices.
    Case(Case),
    /// Everything but the winding: the set of triangles.
    Triangles(Case),
    /// Everything but the output: the set of places.
    Places(Case),
    /// An edge and its level: its vertices.
    Edge(State, usize, u32),
    /// The inner levels: the triangles without a vertex on the outline.
    Interior(State, Vec<u32>),
    /// An edge, its level and the inner levels: the triangles at that edge.
    Transition(State, usize, u32, Vec<u32>),
}

/// The edges of earlier patches that have one level, with the first patch of each.
type Edges = BTreeMap<(Domain, usize), (Vec<u32>, Case)>;

/// The short segments by level, with the first patch of each; all levels round up to one number.
type Shorter = BTreeMap<u32, (u32, Case)>;

/// Properties of earlier patches.
#[derive(Debug, Default)]
pub(super) struct Memory {
    /// A digest of what is shared, and the first patch that has it.
    known: HashMap<Key, (u64, Case)>,
    edges: HashMap<(Option<Domain>, Partitioning, SplitOrder, u32), Edges>,
    shorter: HashMap<(State, u32), Shorter>,
}

fn state(answer: &Answer<'_>) -> State {
    let Config { partitioning, split, .. } = answer.case.config;
    (answer.case.domain(), partitioning, split)
}

/// The case as it is for another output.
const fn with_output(case: &Case, output: OutputPrimitive) -> Case {
    Case { config: Config { output, ..case.config }, factors: case.factors }
}

fn inner(case: &Case) -> Vec<u32> {
    case.factors.inside().map(f32::to_bits).collect()
}

fn level(case: &Case, edge: usize) -> u32 {
    case.factors.outer().nth(edge).map_or(0, f32::to_bits)
}

impl Memory {
    /// Judges a patch beside each earlier one that it must agree with, and keeps what later
    /// patches must agree with.
    pub(super) fn judge(
        &mut self,
        rule: Rule,
        answer: &Answer<'_>,
        specification: Specification,
    ) -> Vec<Judgement> {
        if rule == Rule::Same {
            let digest = words_digest(answer.vertices.as_flattened());
            return self.compare(Key::Case(*answer.case), digest, answer, "another sequence");
        }
        let touches = may_touch_outline(answer.case, specification);
        let has_inside = answer.has_triangles() && !is_minimum(answer.case);
        match rule {
            _ if answer.vertices.is_empty() => Vec::new(),
            Rule::Winding if answer.has_triangles() => {
                let key = Key::Triangles(with_output(answer.case, OutputPrimitive::TriangleCw));
                let digest = triangles(answer.triangles());
                self.compare(key, digest, answer, "another set of triangles")
            }
            Rule::PointsSame => {
                let key = Key::Places(with_output(answer.case, OutputPrimitive::Point));
                let digest = words_digest(answer.places.as_flattened());
                self.compare(key, digest, answer, "vertices at other places")
            }
            _ if touches => Vec::new(),
            Rule::EdgeLevel => self.edge_level(answer),
            Rule::EveryEdge => self.every_edge(answer, specification),
            Rule::Interior if has_inside => self.interior(answer),
            Rule::Transition if has_inside => self.transition(answer),
            Rule::Monotone => self.monotone(answer),
            _ => Vec::new(),
        }
    }

    /// Compares a digest with the first patch that has the same key; where outputs are free, with one of another
    /// output.
    fn compare(
        &mut self,
        key: Key,
        digest: u64,
        answer: &Answer<'_>,
        what: &str,
    ) -> Vec<Judgement> {
        match self.known.get(&key) {
            None => {
                self.known.insert(key, (digest, *answer.case));
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
                vec![(Some(case), result)]
            }
        }
    }

    fn edge_level(&mut self, answer: &Answer<'_>) -> Vec<Judgement> {
        let each = |edge| {
            let key = Key::Edge(state(answer), edge, level(answer.case, edge));
            let name = answer.case.domain().factor_names()[edge];
            let digest = words_digest(&answer.along(edge));
            self.compare(key, digest, answer, &format!("edge {name} has other vertices"))
        };
        outer_edges(answer).flat_map(each).collect()
    }

    /// Each edge beside the other edges of the same level, in either direction. Direct3D's depend on no
    /// domain either.
    fn every_edge(&mut self, answer: &Answer<'_>, specification: Specification) -> Vec<Judgement> {
        let (domain, partitioning, split) = state(answer);
        let own = (specification != Specification::D3d11).then_some(domain);
        let mut judgements = Vec::new();
        for edge in outer_edges(answer) {
            let along = answer.along(edge);
            let mirrored: Vec<u32> = along.iter().rev().map(|x| ONE - x).collect();
            let key = (own, partitioning, split, level(answer.case, edge));
            let known = self.edges.entry(key).or_default();
            let others = known.iter().filter(|(other, _)| **other != (domain, edge));
            judgements.extend(others.map(|((other, number), (there, case))| {
                let is_same = *there == along || *there == mirrored;
                let names = [domain.factor_names()[edge], other.factor_names()[*number]];
                let what =
                    || format!("edge {} has other vertices than edge {}", names[0], names[1]);
                (Some(*case), if is_same { Ok(()) } else { Err(what()) })
            }));
            known.entry((domain, edge)).or_insert((along, *answer.case));
        }
        judgements
    }

    fn interior(&mut self, answer: &Answer<'_>) -> Vec<Judgement> {
        let is_inside = |triangle: &[Place; 3]| triangle.iter().all(|p| !answer.is_on_outline(*p));
        let digest = triangles(answer.triangles().filter(is_inside));
        let key = Key::Interior(state(answer), inner(answer.case));
        self.compare(key, digest, answer, "other triangles inside")
    }

    /// Triangles with two vertices on an edge. Those with one are at a corner of two edges, or beside one
    /// that has two.
    fn transition(&mut self, answer: &Answer<'_>) -> Vec<Judgement> {
        let domain = answer.case.domain();
        let each = |edge| {
            let is_on = |place: &&Place| position(domain, edge, **place).is_some();
            let is_at = |triangle: &[Place; 3]| triangle.iter().filter(is_on).count() >= 2;
            let digest = triangles(answer.triangles().filter(is_at));
            let (name, level) = (domain.factor_names()[edge], level(answer.case, edge));
            let key = Key::Transition(state(answer), edge, level, inner(answer.case));
            self.compare(key, digest, answer, &format!("other triangles at edge {name}"))
        };
        outer_edges(answer).flat_map(each).collect()
    }

    /// Lines whose levels round up to the same number, beside the next lower and the next higher level.
    fn monotone(&mut self, answer: &Answer<'_>) -> Vec<Judgement> {
        let mut judgements = Vec::new();
        for line in lines(answer).into_iter().filter(|line| is_fractional(answer, line)) {
            let asked = segments(answer.case, line.position);
            let Some(n) = asked.filter(|n| line.along.len() == *n as usize + 1) else { continue };
            let Some(length) = shorter(&line.along) else { continue };
            let level = answer.case.factors.outer().nth(line.position).unwrap_or_default();
            let level = clamped(answer.case.config.partitioning, level).to_bits();
            let known = self.shorter.entry((state(answer), n)).or_default();
            let below = known.range(..level).next_back();
            let above = known.range(level + 1..).next();
            let low = below.map(|(_, (there, case))| (*case, *there, length));
            let high = above.map(|(_, (there, case))| (*case, length, *there));
            judgements.extend(low.into_iter().chain(high).map(|(case, low, high)| {
                let what = || format!("the shorter segments shrink from {low:05x} to {high:05x}");
                (Some(case), if low <= high + ROUNDING { Ok(()) } else { Err(what()) })
            }));
            known.entry(level).or_insert((length, *answer.case));
        }
        judgements
    }
}

/// The outer edges; isolines have none.
fn outer_edges(answer: &Answer<'_>) -> std::ops::Range<usize> {
    match answer.case.domain() {
        Domain::Isoline => 0..0,
        domain => 0..domain.outer_factors(),
    }
}

/// A digest of a set of triangles, whatever their order and their vertices' order.
fn triangles(triangles: impl Iterator<Item = [Place; 3]>) -> u64 {
    let sorted = |mut triangle: [Place; 3]| {
        triangle.sort_unstable();
        triangle
    };
    let mut set: Vec<[Place; 3]> = triangles.map(sorted).collect();
    set.sort_unstable();
    words_digest(set.as_flattened().as_flattened())
}
