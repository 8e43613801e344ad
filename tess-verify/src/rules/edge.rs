//! Rules about the vertices of a single line.

use super::Judged;
use super::answer::Answer;
use super::lengths::unequal;
use super::lines::{Line, outer_lines, outline};
use std::collections::BTreeSet;
use tess_core::Domain;
use tess_core::fixed_point::ONE;

/// Each line has as many segments as the specified answer, or as its level asks for if there is no
/// specified answer.
pub(super) fn segments(answer: &Answer, specified: Option<&Answer>) -> Judged {
    if answer.is_exact() && specified.is_none() {
        return None;
    }
    let lines = outer_lines(answer);
    let specified = specified.map(outer_lines);
    let asked = |number: usize, line: &Line| match &specified {
        Some(lines) => lines.get(number).map(Line::segments),
        None => line.level.map(|level| level.segments() as usize),
    };
    let wrong = lines.iter().enumerate().find_map(|(number, line)| {
        let (asked, found) = (asked(number, line)?, line.segments());
        let is_density = answer.case.domain() == Domain::Isoline && number == 0;
        let what = if is_density { "isolines" } else { "segments" };
        let (name, level) = (&line.name, line.level?.raw);
        (found != asked)
            .then(|| format!("{name} has {found} {what}, its level {level} asks for {asked}"))
    });
    (!lines.is_empty()).then(|| wrong.map_or(Ok(()), Err))
}

/// Each line with the right number of segments is spaced as its level asks.
pub(super) fn spacing(answer: &Answer) -> Judged {
    spaced(&outer_lines(answer))
}

/// The first fault in the lengths of those lines that have the right number of segments.
pub(super) fn spaced(lines: &[Line]) -> Judged {
    let mut right = lines.iter().filter_map(|line| Some((line, line.level_if_right()?))).peekable();
    right.peek()?;
    let wrong = right.find_map(|(line, level)| {
        let what = unequal(&line.along, level);
        what.map(|what| format!("{}: {what}", line.name))
    });
    Some(wrong.map_or(Ok(()), Err))
}

/// The length of the two shorter segments of a fractional line; `None` below three segments.
pub(super) fn shorter(line: &Line) -> Option<u32> {
    let lengths = line.lengths();
    (lengths.len() >= 3).then(|| lengths.into_iter().min()).flatten()
}

/// The outer edges of a triangle or quad whose own vertices are known, each with these.
pub(super) fn known_edges(answer: &Answer) -> impl Iterator<Item = (usize, Vec<u32>)> {
    let edges = match answer.case.domain() {
        Domain::Isoline => 0,
        domain => domain.outer_factors(),
    };
    let lines = (0..edges).map(|edge| (edge, outline(answer, edge)));
    lines.filter(|(_, line)| line.is_sure).map(|(edge, line)| (edge, line.along))
}

/// Each outer edge has both of its ends, and the mirror image of each of its vertices. Isolines
/// have the mirror image of each vertex at u = 0, except that of the one at v = 0.
pub(super) fn symmetric(answer: &Answer) -> Judged {
    let domain = answer.case.domain();
    if answer.is_empty() {
        return None;
    }
    let edges = match domain {
        Domain::Isoline => vec![(0, answer.along(0))],
        _ => known_edges(answer).collect(),
    };
    let mut edges = edges.into_iter().peekable();
    edges.peek()?;
    let wrong = edges.find_map(|(edge, along)| {
        let mut along: BTreeSet<u32> = along.into_iter().collect();
        let name = domain.factor_names()[edge];
        if domain == Domain::Isoline {
            along.remove(&ONE); // v = 0
        } else if !(along.contains(&0) && along.contains(&ONE)) {
            return Some(format!("edge {name} lacks an end"));
        }
        let lonely = along.iter().find(|x| !along.contains(&(ONE - **x)))?;
        Some(format!("edge {name} has a vertex at {lonely:05x} and none at {:05x}", ONE - lonely))
    });
    Some(wrong.map_or(Ok(()), Err))
}
