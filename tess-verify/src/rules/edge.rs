//! Rules about the vertices of one edge.

use super::Judged;
use super::answer::Answer;
use super::levels::{may_touch_outline, segments as asked};
use super::standard::Specification;
use std::collections::{BTreeMap, BTreeSet};
use tess_core::fixed_point::ONE;
use tess_core::{Domain, Partitioning};

/// How far a vertex may lie from where equal lengths put it, in units of 2^-16. No standard gives a number: the
/// model's largest deviation from k/n is 12.26 units, at n = 53. A length has two ends, so it may be off by twice
/// as much.
pub(super) const TOLERANCE: u32 = 16;

/// A subdivided line of a patch.
pub(super) struct Line {
    /// Which: `edge 2`, `line 0`, `the lines`.
    name: String,
    /// The outer level that divides it.
    pub(super) position: usize,
    /// Where its vertices lie, ascending; the end of the density's line, v = 1, has none.
    pub(super) along: Vec<u32>,
}

/// The lines of a patch that a level divides: outer edges, or for isolines the density's and each line.
pub(super) fn lines(answer: &Answer<'_>) -> Vec<Line> {
    let domain = answer.case.domain();
    if answer.vertices.is_empty() {
        return Vec::new();
    }
    if domain != Domain::Isoline {
        let edge = |edge| Line {
            name: format!("edge {}", domain.factor_names()[edge]),
            position: edge,
            along: answer.along(edge),
        };
        return (0..domain.outer_factors()).map(edge).collect();
    }
    let mut by_v: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for &[u, v] in &answer.places {
        by_v.entry(v).or_default().push(u);
    }
    let mut along: Vec<u32> = by_v.keys().copied().collect();
    along.push(ONE);
    along.dedup();
    let density = Line { name: "the patch".to_owned(), position: 0, along };
    let line = |(number, along)| Line { name: format!("line {number}"), position: 1, along };
    [density].into_iter().chain(by_v.into_values().enumerate().map(line)).collect()
}

/// Each line has as many segments as its level asks for.
pub(super) fn segments(answer: &Answer<'_>, specification: Specification) -> Judged {
    if may_touch_outline(answer.case, specification) {
        return None;
    }
    let lines = lines(answer);
    let wrong = lines.iter().find_map(|line| {
        let asked = asked(answer.case, line.position)? as usize;
        let found = line.along.len().saturating_sub(1);
        let level = answer.case.factors.outer().nth(line.position)?;
        let what = if line.position == 0 && answer.case.domain() == Domain::Isoline {
            "isolines"
        } else {
            "segments"
        };
        let name = &line.name;
        (asked != found)
            .then(|| format!("{name} has {found} {what}, its level {level} asks for {asked}"))
    });
    (!lines.is_empty()).then(|| wrong.map_or(Ok(()), Err))
}

/// On each line with the segments that it should have, they are equally long, but for two that lie
/// symmetrically under fractional spacing.
pub(super) fn spacing(answer: &Answer<'_>, specification: Specification) -> Judged {
    if may_touch_outline(answer.case, specification) {
        return None;
    }
    let lines: Vec<Line> = lines(answer)
        .into_iter()
        .filter(|line| {
            let asked = asked(answer.case, line.position);
            asked.is_some_and(|asked| line.along.len() == asked as usize + 1)
        })
        .collect();
    let is_density = |line: &Line| answer.case.domain() == Domain::Isoline && line.position == 0;
    let wrong = lines.iter().find_map(|line| {
        let equal = answer.case.config.partitioning.has_integer_factors() || is_density(line);
        let what = if equal { equally_spaced(&line.along) } else { two_lengths(&line.along) };
        what.map(|what| format!("{}: {what}", line.name))
    });
    (!lines.is_empty()).then(|| wrong.map_or(Ok(()), Err))
}

/// How far a point is from k/n, if it is too far.
fn equally_spaced(along: &[u32]) -> Option<String> {
    let n = u64::try_from(along.len().checked_sub(1)?).ok()?;
    (0..).zip(along).find_map(|(k, &x)| {
        // Times n, so that nothing is rounded.
        let off = (u64::from(x) * n).abs_diff(k * u64::from(ONE));
        (off > u64::from(TOLERANCE) * n)
            .then(|| format!("vertex {k} of {n} lies at {x:05x}, more than 16 units from {k}/{n}"))
    })
}

/// The fault of the lengths of a fractional division.
fn two_lengths(along: &[u32]) -> Option<String> {
    let lengths = lengths(along);
    let longest = *lengths.iter().max()?;
    let short: Vec<usize> =
        (0..lengths.len()).filter(|&k| lengths[k] + 2 * TOLERANCE < longest).collect();
    match short[..] {
        [] => None,
        [a, b]
            if a + b == lengths.len() - 1 && lengths[a].abs_diff(lengths[b]) <= 2 * TOLERANCE =>
        {
            None
        }
        [a, b] => Some(format!("segments {a} and {b} are shorter, and are no mirrored pair")),
        _ => Some(format!("{} of {} segments are shorter, not two", short.len(), lengths.len())),
    }
}

fn lengths(along: &[u32]) -> Vec<u32> {
    along.windows(2).map(|pair| pair[1] - pair[0]).collect()
}

/// The length of the shorter pair of a fractional line, which has at least three segments.
pub(super) fn shorter(along: &[u32]) -> Option<u32> {
    let lengths = lengths(along);
    (lengths.len() >= 3).then(|| lengths.into_iter().min()).flatten()
}

/// Each outer edge has both ends, and with each vertex its mirror image; isolines have the mirror images of
/// those at u = 0 but for v = 0.
pub(super) fn symmetric(answer: &Answer<'_>, specification: Specification) -> Judged {
    let domain = answer.case.domain();
    if answer.vertices.is_empty() || may_touch_outline(answer.case, specification) {
        return None;
    }
    let edges = if domain == Domain::Isoline { 1 } else { domain.outer_factors() };
    let wrong = (0..edges).find_map(|edge| {
        let mut along: BTreeSet<u32> = answer.along(edge).into_iter().collect();
        if domain == Domain::Isoline {
            along.remove(&ONE); // v = 0
        } else if !(along.contains(&0) && along.contains(&ONE)) {
            return Some(format!("edge {} lacks an end", domain.factor_names()[edge]));
        }
        let lonely = along.iter().find(|x| !along.contains(&(ONE - **x)))?;
        let name = domain.factor_names()[edge];
        Some(format!("edge {name} has a vertex at {lonely:05x} and none at {:05x}", ONE - lonely))
    });
    Some(wrong.map_or(Ok(()), Err))
}

/// Whether a line's spacing is fractional, so that its level moves its vertices.
pub(super) fn is_fractional(answer: &Answer<'_>, line: &Line) -> bool {
    let partitioning = answer.case.config.partitioning;
    let is_density = answer.case.domain() == Domain::Isoline && line.position == 0;
    matches!(partitioning, Partitioning::FractionalOdd | Partitioning::FractionalEven)
        && !is_density
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The sentences of docs/rules.md on lengths.
    #[test]
    fn the_tolerance_is_the_documented_one() {
        let page = include_str!("../../../docs/rules.md");
        assert!(page.contains(&format!("A vertex may lie {TOLERANCE}/65536")));
        assert!(page.contains(&format!("may be off by {}/65536", 2 * TOLERANCE)));
    }
}
