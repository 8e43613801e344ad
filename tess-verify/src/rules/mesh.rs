//! Rules about the primitives of one patch.

use super::Judged;
use super::answer::{Answer, Place, TOLERANCE, distance_along, show};
use super::levels::inside_asked;
use std::collections::{BTreeMap, BTreeSet};
use tess_core::fixed_point::ONE;
use tess_core::{Domain, OutputPrimitive};

/// Twice the signed area; positive for triangles that are clockwise as seen with v pointing down.
fn doubled_area([a, b, c]: [Place; 3]) -> i128 {
    let [(au, av), (bu, bv), (cu, cv)] = [a, b, c].map(|[u, v]| (i128::from(u), i128::from(v)));
    (bu - au) * (cv - av) - (cu - au) * (bv - av)
}

/// 1 if the patch's triangles are clockwise, else -1.
const fn turn(answer: &Answer) -> i32 {
    if matches!(answer.case.config.output, OutputPrimitive::TriangleCw) { 1 } else { -1 }
}

/// No triangle turns the wrong way. A triangle without area turns neither way.
pub(super) fn orientation(answer: &Answer) -> Judged {
    let clockwise = i128::from(turn(answer));
    let mut triangles = answer.triangles().peekable();
    triangles.peek()?;
    let wrong = triangles.enumerate().find(|(_, t)| doubled_area(*t) * clockwise < 0);
    Some(wrong.map_or(Ok(()), |(number, [a, b, c])| {
        let places = format!("{} {} {}", show(a), show(b), show(c));
        Err(format!("triangle {number} turns the other way: {places}"))
    }))
}

/// The triangles cover the domain once, as far as their directed edges show: after the edges that
/// are walked in both directions are removed, the rest is one walk around the outline.
pub(super) fn cover(answer: &Answer) -> Judged {
    let net = walked(answer.numbered_triangles())?;
    let domain = answer.case.domain();
    let mut outline = vec![BTreeMap::<u32, i32>::new(); domain.outer_factors()];
    for (ends, count) in net {
        let [from, to] = ends.map(|number| answer.places[number as usize]);
        let on = |edge: &usize| {
            Some((distance_along(domain, *edge, from)?, distance_along(domain, *edge, to)?))
        };
        let Some((edge, (start, end))) =
            (0..domain.outer_factors()).find_map(|edge| Some((edge, on(&edge)?)))
        else {
            let places = format!("{} {}", show(from), show(to));
            return Some(Err(format!("the edge {places} within the domain is not shared by two")));
        };
        *outline[edge].entry(start).or_default() += count;
        *outline[edge].entry(end).or_default() -= count;
    }
    let whole = BTreeMap::from([(0, turn(answer)), (ONE, -turn(answer))]);
    let walk = |flow: &BTreeMap<u32, i32>| -> BTreeMap<u32, i32> {
        flow.iter().filter(|(_, step)| **step != 0).map(|(x, step)| (*x, *step)).collect()
    };
    let wrong = outline.iter().position(|flow| walk(flow) != whole);
    Some(wrong.map_or(Ok(()), |edge| {
        Err(format!("outer edge {} is not walked once", domain.factor_names()[edge]))
    }))
}

/// The edges of triangles that are walked more often in one direction than in the other, ascending:
/// the smaller end first, and how much more often the edge is walked from it. `None` if there are
/// no triangles.
fn walked(triangles: impl Iterator<Item = [u32; 3]>) -> Option<Vec<([u32; 2], i32)>> {
    let edges = triangles.flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
    // Both ends, and whether the larger one comes first, in a word that sorts fast. There are fewer
    // than 2^31 places.
    let directed = |[from, to]: [u32; 2]| {
        let [low, high] = [from.min(to), from.max(to)].map(u64::from);
        low << 33 | high << 1 | u64::from(from > to)
    };
    let mut edges: Vec<u64> = edges.map(directed).collect();
    edges.sort_unstable();
    let sum = |walks: &[u64]| {
        let [low, high] = [walks[0] >> 33, walks[0] << 31 >> 32];
        let count = walks.iter().map(|walk| if walk & 1 == 0 { 1 } else { -1 }).sum::<i32>();
        ([low, high].map(|end| u32::try_from(end).unwrap_or(u32::MAX)), count)
    };
    let sums = edges.chunk_by(|a, b| a >> 1 == b >> 1).map(sum);
    let net = sums.filter(|([from, to], count)| *count != 0 && from != to).collect();
    (!edges.is_empty()).then_some(net)
}

/// Each segment of an isoline keeps its v, each line is walked once from u = 0 to u = 1, no line is
/// at v = 1, and the lines are equally spaced. In Direct3D, rounding may make a line go backwards
/// on the way.
pub(super) fn isolines(answer: &Answer) -> Judged {
    if answer.case.domain() != Domain::Isoline || answer.has_points() {
        return None;
    }
    let mut lines: BTreeMap<u32, Vec<[u32; 2]>> = BTreeMap::new();
    let (segments, _) = answer.vertices.as_chunks::<2>();
    for &[from, to] in segments {
        if from[1] != to[1] {
            return Some(Err(format!("the segment {} {} changes v", show(from), show(to))));
        }
        lines.entry(from[1]).or_default().push([from[0].min(to[0]), from[0].max(to[0])]);
    }
    let n = u64::try_from(lines.len()).unwrap_or(u64::MAX);
    for (k, (v, mut segments)) in (0..).zip(lines) {
        segments.sort_unstable();
        let is_chain = segments.windows(2).all(|pair| pair[0][1] == pair[1][0]);
        if !(is_chain || answer.is_exact()) || odd_ends(&segments) != [0, ONE] {
            return Some(Err(format!("the line at v = {v:05x} is not walked once from 0 to 1")));
        }
        let off = (u64::from(v) * n).abs_diff(k * u64::from(ONE));
        if v == ONE || off > u64::from(TOLERANCE) * n {
            return Some(Err(format!("line {k} of {n} is at v = {v:05x}")));
        }
    }
    (n > 0).then_some(Ok(()))
}

/// The places where an odd number of segments ends, which are the two ends of a walk.
fn odd_ends(segments: &[[u32; 2]]) -> Vec<u32> {
    let mut ends: BTreeSet<u32> = BTreeSet::new();
    for end in segments.as_flattened() {
        if !ends.remove(end) {
            ends.insert(*end);
        }
    }
    ends.into_iter().collect()
}

/// No place has two points, except where vertices of the inside are on the outline: there may be as
/// many points more as there are fewer vertices inside.
pub(super) fn points_once(answer: &Answer) -> Judged {
    if !answer.has_points() || answer.is_empty() {
        return None;
    }
    let mut vertices = answer.vertices.clone();
    vertices.sort_unstable();
    let twice = vertices.windows(2).filter(|pair| pair[0] == pair[1]).map(|pair| pair[0]);
    let (outline, inside): (Vec<_>, Vec<_>) = twice.partition(|p| answer.is_on_outline(*p));
    let asked = inside_asked(&answer.case).unwrap_or(usize::MAX);
    let spare = if answer.touches { asked.saturating_sub(answer.inside().len()) } else { 0 };
    let wrong = inside.first().or_else(|| outline.get(spare));
    Some(wrong.map_or(Ok(()), |place| Err(format!("{} is a point twice", show(*place)))))
}
