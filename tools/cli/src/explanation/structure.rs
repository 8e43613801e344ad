//! The rings and stitches of a patch, as runs of the points and primitives that were walked.

use super::processed;
use serde::Serialize;
use tess_core::{Patch, PatchFactors, PointOrigin, Primitive, PrimitiveOrigin};

/// Consecutive points of one line, edge of a ring, or centre.
#[derive(Clone, Debug, Serialize)]
pub(super) struct PointRun {
    pub(super) place: String,
    pub(super) first: u32,
    pub(super) count: u32,
}

/// Consecutive primitives of one line, stitch or centre.
#[derive(Clone, Debug, Serialize)]
pub(super) struct Stitch {
    pub(super) place: String,
    pub(super) first: u32,
    pub(super) count: u32,
    /// The indices of the row outside; empty where there are no two rows.
    pub(super) outer_row: Vec<u32>,
    /// The indices of the row inside.
    pub(super) inner_row: Vec<u32>,
    /// One letter a triangle: `O` advances on the outer row, `I` on the inner one.
    pub(super) steps: String,
}

/// The points, run by run.
pub(super) fn point_runs(patch: &Patch) -> Vec<PointRun> {
    let mut runs: Vec<PointRun> = Vec::new();
    let mut last = None;
    for i in 0..patch.counts().points {
        let place = patch.locate_point(i).map(|location| point_place(location, patch));
        if let (true, Some(run)) = (place == last, runs.last_mut()) {
            run.count += 1;
        } else {
            runs.push(PointRun { place: place.clone().unwrap_or_default(), first: i, count: 1 });
        }
        last = place;
    }
    runs
}

fn point_place(location: PointOrigin, patch: &Patch) -> String {
    let whole = super::point::describe(location, patch);
    whole.split(", point").next().unwrap_or_default().to_owned()
}

/// The primitives, run by run.
pub(super) fn stitches(patch: &Patch) -> Vec<Stitch> {
    let mut stitches: Vec<Stitch> = Vec::new();
    let mut last = None;
    for t in 0..patch.counts().primitives {
        let (Some(location), Some(primitive)) = (patch.locate_primitive(t), patch.primitive(t))
        else {
            continue;
        };
        let place = describe(location);
        if last.as_ref() != Some(&place) {
            stitches.push(Stitch::starting(place.clone(), t));
        }
        if let Some(stitch) = stitches.last_mut() {
            stitch.count += 1;
            if let Some(ring) = inner_ring(location) {
                stitch.follow(patch, primitive, ring);
            }
        }
        last = Some(place);
    }
    stitches
}

/// A primitive's location in words, without its number.
pub(super) fn describe(location: PrimitiveOrigin) -> String {
    match location {
        PrimitiveOrigin::Sequence { .. } => "in order".to_owned(),
        PrimitiveOrigin::Line { line, .. } => format!("line {line}"),
        PrimitiveOrigin::Minimum { .. } => "minimum patch".to_owned(),
        PrimitiveOrigin::Transition { edge, .. } => format!("transition, edge {edge}"),
        PrimitiveOrigin::Ring { ring, edge, .. } => format!("ring {ring}, edge {edge}"),
        PrimitiveOrigin::Centre { .. } => "centre".to_owned(),
    }
}

/// The ring inside of a stitch.
const fn inner_ring(location: PrimitiveOrigin) -> Option<u32> {
    match location {
        PrimitiveOrigin::Transition { .. } => Some(1),
        PrimitiveOrigin::Ring { ring, .. } => Some(ring),
        _ => None,
    }
}

impl Stitch {
    const fn starting(place: String, first: u32) -> Self {
        Self {
            place,
            first,
            count: 0,
            outer_row: Vec::new(),
            inner_row: Vec::new(),
            steps: String::new(),
        }
    }

    /// Sorts a triangle's indices onto the rows; the side with two of them is the one that advances.
    fn follow(&mut self, patch: &Patch, primitive: Primitive, inner_ring: u32) {
        let (inner, outer): (Vec<u32>, Vec<u32>) =
            primitive.indices().iter().partition(|&&index| ring_of(patch, index) >= inner_ring);
        self.steps.push(if outer.len() == 2 { 'O' } else { 'I' });
        extend_row(&mut self.outer_row, &outer);
        extend_row(&mut self.inner_row, &inner);
    }
}

/// Appends what a triangle adds to a row: of two indices, one is the row's end already.
fn extend_row(row: &mut Vec<u32>, indices: &[u32]) {
    if row.is_empty() {
        row.extend(indices);
        return;
    }
    let end = row.last().copied();
    row.extend(indices.iter().filter(|&&index| Some(index) != end));
}

/// The ring that a point lies on: 0 for the outer one; the centre is the innermost of all.
pub(super) fn ring_of(patch: &Patch, index: u32) -> u32 {
    match patch.locate_point(index) {
        Some(PointOrigin::Ring { ring, .. }) => ring,
        Some(PointOrigin::Centre { .. }) => centre_ring(patch),
        _ => 0,
    }
}

fn centre_ring(patch: &Patch) -> u32 {
    match processed(patch) {
        Some(PatchFactors::Triangle(factors)) => factors.inside.context.points / 2,
        Some(PatchFactors::Quad(factors)) => {
            let [u, v] = factors.inside().map(|factor| factor.context.points);
            u.min(v) / 2
        }
        _ => 0,
    }
}
