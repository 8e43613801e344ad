//! The edges, rings and stitches of a patch, as the model walks them (spec sections 6 to 8).

use super::point;
use tess_core::stitch::{Step, StitchKind};
use tess_core::{Patch, PointOrigin, PrimitiveOrigin, Side};

/// Consecutive points of one line, edge of a ring, or centre.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) struct PointRun {
    pub(super) place: String,
    pub(super) first: u32,
    pub(super) count: u32,
}

/// Consecutive primitives of one line, stitch or centre.
#[derive(Clone, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) struct Stitch {
    pub(super) place: String,
    pub(super) first: u32,
    pub(super) count: u32,
    /// The indices of the row outside; empty where no two rings are stitched.
    pub(super) outer_row: Vec<u32>,
    /// The indices of the row inside.
    pub(super) inner_row: Vec<u32>,
    /// One letter a triangle: `O` advances on the outer row, `I` on the inner one.
    pub(super) steps: String,
}

/// The points, run by run.
pub(super) fn point_runs(patch: &Patch) -> Vec<PointRun> {
    let origins = (0..patch.counts().points).filter_map(|i| patch.locate_point(i));
    let run = |(origin, first, count)| {
        let place = point::place(origin, patch.processed().factors());
        PointRun { place, first, count }
    };
    runs(origins.map(first_of_its_run)).into_iter().map(run).collect()
}

/// The primitives, run by run.
pub(super) fn stitches(patch: &Patch) -> Vec<Stitch> {
    let mut rows = Vec::new();
    patch.stitches(|stitch| rows.push(stitch));
    let origins = (0..patch.counts().primitives).filter_map(|t| patch.locate_primitive(t));
    let stitch = |(origin, first, count)| {
        let place = describe(origin);
        let kind = kind(origin);
        match rows.iter().find(|stitch| Some(stitch.kind) == kind) {
            Some(stitch) => Stitch {
                place,
                first,
                count,
                outer_row: (0..stitch.outer_points).map(|k| stitch.outer.index(k)).collect(),
                inner_row: (0..stitch.inner_points).map(|k| stitch.inner.index(k)).collect(),
                steps: letters(patch, stitch),
            },
            None => Stitch {
                place,
                first,
                count,
                outer_row: Vec::new(),
                inner_row: Vec::new(),
                steps: String::new(),
            },
        }
    };
    runs(origins.map(first_step)).into_iter().map(stitch).collect()
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

/// Equal values that follow each other: the value, the position of the first, how many.
fn runs<T: PartialEq + Copy>(values: impl Iterator<Item = T>) -> Vec<(T, u32, u32)> {
    let mut runs: Vec<(T, u32, u32)> = Vec::new();
    for (position, value) in (0..).zip(values) {
        match runs.last_mut() {
            Some((last, _, count)) if *last == value => *count += 1,
            _ => runs.push((value, position, 1)),
        }
    }
    runs
}

/// The first point of the line, edge or centre that a point lies on.
const fn first_of_its_run(origin: PointOrigin) -> PointOrigin {
    match origin {
        PointOrigin::Corner { corner } => PointOrigin::Corner { corner },
        PointOrigin::Line { line, .. } => PointOrigin::Line { line, p: 0 },
        PointOrigin::OuterEdge { edge, .. } => PointOrigin::OuterEdge { edge, p: 0 },
        PointOrigin::Ring { ring, edge, .. } => PointOrigin::Ring { ring, edge, p: 0 },
        PointOrigin::Centre { .. } => PointOrigin::Centre { p: 0 },
    }
}

/// The first primitive of the line, stitch or centre that a primitive belongs to.
const fn first_step(origin: PrimitiveOrigin) -> PrimitiveOrigin {
    use PrimitiveOrigin as Origin;
    match origin {
        Origin::Sequence { .. } => Origin::Sequence { step: 0 },
        Origin::Line { line, .. } => Origin::Line { line, segment: 0 },
        Origin::Minimum { .. } => Origin::Minimum { step: 0 },
        Origin::Transition { edge, .. } => Origin::Transition { edge, step: 0 },
        Origin::Ring { ring, edge, .. } => Origin::Ring { ring, edge, step: 0 },
        Origin::Centre { .. } => Origin::Centre { step: 0 },
    }
}

/// The stitch between two rings that a primitive belongs to.
const fn kind(origin: PrimitiveOrigin) -> Option<StitchKind> {
    match origin {
        PrimitiveOrigin::Transition { edge, .. } => Some(StitchKind::Transition { edge }),
        PrimitiveOrigin::Ring { ring, edge, .. } => Some(StitchKind::Ring { ring, edge }),
        _ => None,
    }
}

/// A primitive's place in words, without its number there.
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
