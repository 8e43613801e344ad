//! The lines of a patch that its levels divide.
//!
//! ```text
//! isolines: the patch by its density, each line by the detail
//! outline:  each edge by its own level
//! inside:   a quad's columns and rows, a triangle's rings, by the inner levels
//! ```
//!
//! A quad's inner levels divide the whole domain: its columns run from u = 0 to u = 1, and the
//! vertices inside show all places except the two ends. A triangle's inner level divides each edge
//! temporarily, to place the rings; see `rings.rs`.

use super::answer::Answer;
use super::division::divisions;
use super::levels::{TessellationLevel, is_minimum};
use super::rings::Rings;
use std::collections::BTreeMap;
use tess_core::Domain;
use tess_core::fixed_point::ONE;

/// A divided line of a patch.
#[derive(Debug)]
pub(super) struct Line {
    /// Which line: `edge u0`, `line 0`, `the columns`.
    pub(super) name: String,
    /// The level that divides it; `None` if the level is NaN.
    pub(super) level: Option<TessellationLevel>,
    /// The places of its vertices, ascending and including both ends: 16.16 numbers from 0 to 1.
    pub(super) along: Vec<u32>,
    /// Whether these are its own vertices for certain. They are not if vertices of the inside are
    /// among them and cannot be told apart.
    pub(super) is_sure: bool,
}

impl Line {
    /// A line whose vertices are known.
    const fn sure(name: String, level: Option<TessellationLevel>, along: Vec<u32>) -> Self {
        Self { name, level, along, is_sure: true }
    }

    /// How many segments it has.
    pub(super) const fn segments(&self) -> usize {
        self.along.len().saturating_sub(1)
    }

    /// Its level, if the line has as many segments as the level asks for, and its vertices are
    /// known.
    pub(super) fn level_if_right(&self) -> Option<TessellationLevel> {
        let is_right = |level: &TessellationLevel| level.segments() as usize == self.segments();
        self.level.filter(is_right).filter(|_| self.is_sure)
    }

    /// The lengths of its segments.
    pub(super) fn lengths(&self) -> Vec<u32> {
        self.along.windows(2).map(|pair| pair[1] - pair[0]).collect()
    }
}

/// The lines that outer levels divide: the outer edges, or for isolines the line of the density and
/// each isoline.
pub(super) fn outer_lines(answer: &Answer) -> Vec<Line> {
    let case = &answer.case;
    if answer.is_empty() {
        return Vec::new();
    }
    if case.domain() != Domain::Isoline {
        return (0..case.domain().outer_factors()).map(|edge| outline(answer, edge)).collect();
    }
    let mut by_v: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for &[u, v] in &answer.places {
        by_v.entry(v).or_default().push(u);
    }
    // No isoline is drawn at v = 1, where the density's line ends.
    let mut along: Vec<u32> = by_v.keys().copied().collect();
    along.push(ONE);
    along.dedup();
    let density = Line::sure("the patch".to_owned(), TessellationLevel::outer(case, 0), along);
    let line = |(number, along)| {
        Line::sure(format!("line {number}"), TessellationLevel::outer(case, 1), along)
    };
    [density].into_iter().chain(by_v.into_values().enumerate().map(line)).collect()
}

/// An outer edge of a triangle or quad, with its own vertices.
///
/// Where vertices of the inside are on the outline, the edge's own ones are those that its level
/// may place.
pub(super) fn outline(answer: &Answer, edge: usize) -> Line {
    let case = &answer.case;
    let name = format!("edge {}", case.domain().factor_names()[edge]);
    let level = TessellationLevel::outer(case, edge);
    let line = Line::sure(name, level, answer.along(edge));
    match level {
        Some(level) if answer.touches && line.segments() > level.segments() as usize => {
            let mut found = divisions(&line.along, level);
            let is_sure = found.len() == 1;
            let along = if found.is_empty() { line.along } else { found.swap_remove(0) };
            Line { along, is_sure, ..line }
        }
        _ => line,
    }
}

/// The lines that inner levels divide, as far as the vertices inside show them: a quad's columns
/// and rows, or a triangle's edges as the outermost ring divides them.
pub(super) fn inner_lines(answer: &Answer) -> Vec<Line> {
    let case = &answer.case;
    if is_minimum(case) || answer.is_empty() {
        return Vec::new();
    }
    match case.domain() {
        Domain::Isoline => Vec::new(),
        Domain::Quad => {
            let Grid { columns, rows, .. } = Grid::new(answer);
            let axes = [("the columns", columns), ("the rows", rows)];
            let line = |(axis, (name, inside)): (usize, (&str, Vec<u32>))| {
                Line::sure(name.to_owned(), TessellationLevel::inner(case, axis), with_ends(inside))
            };
            axes.into_iter().enumerate().map(line).collect()
        }
        Domain::Triangle => {
            let level = TessellationLevel::inner(case, 0);
            let rings = level.and_then(|level| Rings::new(answer.inside(), level.segments()));
            let along = rings.as_ref().map(Rings::outermost).map(with_ends);
            let line = |along| Line::sure("the rings".to_owned(), level, along);
            along.map(line).into_iter().collect()
        }
    }
}

/// The places between the ends, with both ends added.
pub(super) fn with_ends(inside: Vec<u32>) -> Vec<u32> {
    [0].into_iter().chain(inside).chain([ONE]).collect()
}

/// The columns and rows that a quad's vertices inside form.
#[derive(Debug)]
pub(super) struct Grid {
    /// The distinct u of vertices inside, ascending.
    pub(super) columns: Vec<u32>,
    /// The distinct v of vertices inside, ascending.
    pub(super) rows: Vec<u32>,
    /// The number of vertices inside.
    pub(super) vertices: usize,
}

impl Grid {
    pub(super) fn new(answer: &Answer) -> Self {
        let inside = answer.inside();
        let axis = |axis: usize| {
            let mut along: Vec<u32> = inside.iter().map(|place| place[axis]).collect();
            along.sort_unstable();
            along.dedup();
            along
        };
        Self { columns: axis(0), rows: axis(1), vertices: inside.len() }
    }
}
