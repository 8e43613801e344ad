//! The lines of a patch that levels divide.
//!
//! ```text
//! isolines: the patch by its density, each line by the detail
//! outline:  each edge by its own level
//! inside:   a quad's columns and rows, a triangle's rings, by the inner levels
//! ```
//!
//! A quad's inner levels divide the whole domain: its columns are those between u = 0 and u = 1, of
//! which vertices inside show all places but the ends. A triangle's inner level divides each edge
//! for the time being; see `rings.rs`.

use super::answer::Answer;
use super::levels::{Level, is_minimum};
use super::rings::Rings;
use std::collections::BTreeMap;
use tess_core::Domain;
use tess_core::fixed_point::ONE;

/// A divided line of a patch.
#[derive(Debug)]
pub(super) struct Line {
    /// Which line: `edge u0`, `line 0`, `the columns`.
    pub(super) name: String,
    /// The level that divides it; `None` if that is NaN.
    pub(super) level: Option<Level>,
    /// Places of its vertices, ascending, both ends included: 16.16 numbers from 0 to 1.
    pub(super) along: Vec<u32>,
}

impl Line {
    /// How many segments it has.
    pub(super) const fn segments(&self) -> usize {
        self.along.len().saturating_sub(1)
    }

    /// Its level, if it has as many segments as that asks for.
    pub(super) fn level_if_right(&self) -> Option<Level> {
        self.level.filter(|level| level.segments() as usize == self.segments())
    }

    /// The lengths of its segments.
    pub(super) fn lengths(&self) -> Vec<u32> {
        self.along.windows(2).map(|pair| pair[1] - pair[0]).collect()
    }
}

/// The lines that outer levels divide: outer edges; for isolines the density's and each line.
pub(super) fn outer_lines(answer: &Answer) -> Vec<Line> {
    let case = &answer.case;
    if answer.is_empty() {
        return Vec::new();
    }
    if case.domain() != Domain::Isoline {
        let edge = |edge| Line {
            name: format!("edge {}", case.domain().factor_names()[edge]),
            level: Level::outer(case, edge),
            along: answer.along(edge),
        };
        return (0..case.domain().outer_factors()).map(edge).collect();
    }
    let mut by_v: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for &[u, v] in &answer.places {
        by_v.entry(v).or_default().push(u);
    }
    // No line is drawn at v = 1, the end of the density's line.
    let mut along: Vec<u32> = by_v.keys().copied().collect();
    along.push(ONE);
    along.dedup();
    let density = Line { name: "the patch".to_owned(), level: Level::outer(case, 0), along };
    let line = |(number, along)| {
        let name = format!("line {number}");
        Line { name, level: Level::outer(case, 1), along }
    };
    [density].into_iter().chain(by_v.into_values().enumerate().map(line)).collect()
}

/// The lines that inner levels divide, if vertices inside show them: a quad's columns and rows, and
/// a triangle's edges by its outermost ring.
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
            let line = |(axis, (name, inside)): (usize, (&str, Vec<u32>))| Line {
                name: name.to_owned(),
                level: Level::inner(case, axis),
                along: with_ends(inside),
            };
            axes.into_iter().enumerate().map(line).collect()
        }
        Domain::Triangle => {
            let level = Level::inner(case, 0);
            let rings = level.and_then(|level| Rings::new(answer.inside(), level.segments()));
            let along = rings.as_ref().map(Rings::outermost).map(with_ends);
            let line = |along| Line { name: "the rings".to_owned(), level, along };
            along.map(line).into_iter().collect()
        }
    }
}

/// Places between the ends, with the ends.
fn with_ends(inside: Vec<u32>) -> Vec<u32> {
    [0].into_iter().chain(inside).chain([ONE]).collect()
}

/// The columns and rows of a quad's vertices inside.
#[derive(Debug)]
pub(super) struct Grid {
    /// Distinct u of vertices inside, ascending.
    pub(super) columns: Vec<u32>,
    /// Distinct v of vertices inside, ascending.
    pub(super) rows: Vec<u32>,
    /// How many vertices are inside.
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
