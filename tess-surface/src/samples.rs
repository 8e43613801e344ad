//! Many vertices of a patch, eight at a time.
//!
//! A vertex has the bits that [`Patch::sample`] gives it: the same formulas run in every lane, and what
//! belongs to an edge or a corner alone is computed from those alone.

use crate::dispatch;
use crate::formulas::Formulas;
use crate::lanes::{LANES, Vertices};
use crate::patch::{Patch, Sample};
use tess_simd::{Level, LevelUnavailable};

impl Patch {
    /// The vertices at these domain points: the bits of [`Patch::sample`] at each, for a fraction of
    /// the time. Vertices or points that the other slice has no partner for are left alone.
    pub fn samples(&self, points: &[[f32; 2]], samples: &mut [Sample]) {
        dispatch::samples(Level::detect(), self, points, samples);
    }

    /// [`Patch::samples`] with the instructions of a CPU level, which gives the same bits as every other.
    ///
    /// # Errors
    /// [`LevelUnavailable`] if this machine cannot run the level.
    pub fn samples_at_level(
        &self,
        level: Level,
        points: &[[f32; 2]],
        samples: &mut [Sample],
    ) -> Result<(), LevelUnavailable> {
        level.require()?;
        dispatch::samples(level, self, points, samples);
        Ok(())
    }
}

/// [`Patch::samples`], compiled for the level of the function that it is inlined into.
#[inline(always)]
pub(crate) fn samples(patch: &Patch, points: &[[f32; 2]], samples: &mut [Sample]) {
    let formulas = Formulas::of(patch);
    for (points, samples) in points.chunks(LANES).zip(samples.chunks_mut(LANES)) {
        let mut vertices = Vertices::at(points);
        formulas.evaluate(&mut vertices);
        vertices.store(samples);
    }
}
