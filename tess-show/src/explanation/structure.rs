//! The edges, rings and stitches of a patch, as the model walks them (spec sections 6 to 8).

use super::point;
use tess_core::{Patch, PrimitiveOrigin, Side, Step, StitchKind};

/// Consecutive points of one line, edge of a ring, or centre.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) struct PointRun {
    pub(super) place: String,
    pub(super) first: u32,
    pub(super) count: u32,
}

/// Consecutive primitives of one line, stitch or centre.
#[derive(Clone, Debug, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) struct Stitch {
    pub(super) place: String,
    pub(super) first: u32,
    pub(super) count: u32,
    /// The indices of the outer row; empty if no two rings are stitched here.
    pub(super) outer_row: Vec<u32>,
    /// The indices of the inner row.
    pub(super) inner_row: Vec<u32>,
    /// One letter per triangle: `O` advances on the outer row, `I` on the inner one.
    pub(super) steps: String,
}

/// The points, run by run.
pub(super) fn point_runs(patch: &Patch) -> Vec<PointRun> {
    let place = |i| Some(point::place(patch.locate_point(i)?, patch.processed().factors()));
    let places = (0..patch.counts().points).filter_map(place);
    let run = |(place, first, count)| PointRun { place, first, count };
    runs(places).into_iter().map(run).collect()
}

/// The primitives, run by run.
pub(super) fn stitches(patch: &Patch) -> Vec<Stitch> {
    let mut rows = Vec::new();
    patch.stitches(|stitch| rows.push(stitch));
    let places = (0..patch.counts().primitives).filter_map(|t| patch.locate_primitive(t));
    let stitch = |(place, first, count)| {
        let kind = patch.locate_primitive(first).and_then(kind);
        match rows.iter().find(|stitch| Some(stitch.kind) == kind) {
            Some(stitch) => Stitch {
                place,
                first,
                count,
                outer_row: (0..stitch.outer_points).map(|k| stitch.outer.index(k)).collect(),
                inner_row: (0..stitch.inner_points).map(|k| stitch.inner.index(k)).collect(),
                steps: letters(patch, stitch),
            },
            None => Stitch { place, first, count, ..Stitch::default() },
        }
    };
    runs(places.map(describe)).into_iter().map(stitch).collect()
}

fn letters(patch: &Patch, stitch: &tess_core::Stitch) -> String {
    let mut letters = String::new();
    stitch.steps(patch.config().split, |step: Step| {
        letters.push(match step.advances {
            Side::Outer => 'O',
            Side::Inner => 'I',
        });
    });
    letters
}

/// Runs of equal adjacent places: each with the place, the number of its first element, and its
/// length.
fn runs(places: impl Iterator<Item = String>) -> Vec<(String, u32, u32)> {
    let mut runs: Vec<(String, u32, u32)> = Vec::new();
    for (position, place) in (0..).zip(places) {
        match runs.last_mut() {
            Some((last, _, count)) if *last == place => *count += 1,
            _ => runs.push((place, position, 1)),
        }
    }
    runs
}

/// The stitch between two rings to which a primitive belongs.
const fn kind(origin: PrimitiveOrigin) -> Option<StitchKind> {
    match origin {
        PrimitiveOrigin::Transition { edge, .. } => Some(StitchKind::Transition { edge }),
        PrimitiveOrigin::Ring { ring, edge, .. } => Some(StitchKind::Ring { ring, edge }),
        _ => None,
    }
}

/// A description of a primitive's place, without its number there.
pub(super) fn describe(origin: PrimitiveOrigin) -> String {
    match origin {
        PrimitiveOrigin::Sequence { .. } => "in order".to_owned(),
        PrimitiveOrigin::Line { line, .. } => format!("line {line}"),
        PrimitiveOrigin::Minimum { .. } => "minimum patch".to_owned(),
        PrimitiveOrigin::Transition { edge, .. } => format!("transition, edge {edge}"),
        PrimitiveOrigin::Ring { ring, edge, .. } => format!("ring {ring}, edge {edge}"),
        PrimitiveOrigin::Centre { .. } => "centre".to_owned(),
    }
}
