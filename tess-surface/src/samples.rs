//! The kernel of [`SurfacePatch::samples`]: many vertices of a patch, eight at a time.
//!
//! A vertex has the same bits as from [`SurfacePatch::sample`]: the same formulas run in every
//! lane, and vertices on an edge or a corner are computed from only that edge or corner.

use crate::formulas::Formulas;
use crate::lanes::{LANES, Vertices};
use crate::patch::{Sample, SurfacePatch};

/// [`SurfacePatch::samples`], compiled for the level of the function that it is inlined into.
#[inline(always)]
pub(crate) fn samples(patch: &SurfacePatch, points: &[[f32; 2]], samples: &mut [Sample]) {
    let formulas = Formulas::of(patch);
    for (points, samples) in points.chunks(LANES).zip(samples.chunks_mut(LANES)) {
        let mut vertices = Vertices::at(points);
        formulas.evaluate(&mut vertices);
        vertices.store(samples);
    }
}
