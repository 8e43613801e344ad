//! Rules about the vertices of a single line.

use super::Judged;
use super::answer::{Answer, TOLERANCE};
use super::levels::Level;
use super::lines::{Line, outer_lines, outline};
use std::collections::BTreeSet;
use tess_core::Domain;
use tess_core::fixed_point::ONE;

/// A level up to this many units of 2^-16 above a number of segments counts as just above it: the
/// shorter segments are then at most 1/[`VANISHING`] of a longer one.
const JUST_ABOVE: u32 = 256;
/// The divisor that bounds a shorter segment just above a number of segments. A length proportional
/// to the level's excess is at most 1/512 of a longer one there.
pub(super) const VANISHING: u32 = 16;

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

/// The fault in a line's lengths, if there is one.
#[expect(clippy::float_cmp, reason = "a level is the integer itself, or is not")]
#[expect(clippy::cast_precision_loss, reason = "at most 64")]
pub(super) fn unequal(along: &[u32], level: Level) -> Option<String> {
    let is_integer = level.clamped() == level.segments() as f32;
    if !level.is_fractional() || is_integer {
        return equally_spaced(along);
    }
    let lengths: Vec<u32> = along.windows(2).map(|pair| pair[1] - pair[0]).collect();
    two_lengths(&lengths).or_else(|| not_vanishing(&lengths, level))
}

/// The first vertex that is too far from its place k/n.
fn equally_spaced(along: &[u32]) -> Option<String> {
    let n = u64::try_from(along.len().checked_sub(1)?).ok()?;
    (0..).zip(along).find_map(|(k, &x)| {
        // Multiplied by n, so that nothing is rounded.
        let off = (u64::from(x) * n).abs_diff(k * u64::from(ONE));
        (off > u64::from(TOLERANCE) * n)
            .then(|| format!("vertex {k} of {n} is at {x:05x}, more than 16 units from {k}/{n}"))
    })
}

/// The fault of a fractional division whose segments are not all of one length, except for a
/// mirrored pair of shorter ones.
fn two_lengths(lengths: &[u32]) -> Option<String> {
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
        [a, b] => Some(format!("segments {a} and {b} are shorter, and are not a mirrored pair")),
        _ => Some(format!("{} of {} segments are shorter, not two", short.len(), lengths.len())),
    }
}

/// The fault of shorter segments that are too long for a level just above the next lower number of
/// segments.
fn not_vanishing(lengths: &[u32], level: Level) -> Option<String> {
    let excess = level.fixed().checked_sub((level.segments().checked_sub(2)?) << 16)?;
    let (short, long) = (*lengths.iter().min()?, *lengths.iter().max()?);
    (lengths.len() > 2 && excess <= JUST_ABOVE && short > long / VANISHING + TOLERANCE).then(|| {
        let fewer = level.segments() - 2;
        let level = level.raw;
        format!(
            "its level {level} is just above {fewer}, and its shorter segments are {short:05x} of {long:05x}"
        )
    })
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

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers in `docs/rules.md` are those of the code.
    #[test]
    fn the_tolerance_is_the_documented_one() {
        let page = include_str!("../../../docs/rules.md");
        assert!(page.contains(&format!("{TOLERANCE}/65536 from its place")));
        assert!(page.contains(&format!("off by {}/65536", 2 * TOLERANCE)));
        assert!(page.contains(&format!("up to {JUST_ABOVE}/65536 above")));
        assert!(page.contains(&format!("1/{VANISHING} of")));
    }
}
