//! Evaluation at a CPU level: each kernel is compiled once for every level, and one is chosen at
//! run time.

use crate::displaced::{self, DisplacedPatch};
use crate::patch::{Sample, SurfacePatch};
use crate::samples;
use tess_level::{Level, LevelUnavailableError, at_each_level};

at_each_level! {
    /// [`samples::samples`] at a level.
    fn plain(patch: &SurfacePatch, points: &[[f32; 2]], samples: &mut [Sample]) = samples::samples;
}

at_each_level! {
    /// [`displaced::samples`] at a level.
    fn of_displaced(patch: &DisplacedPatch<'_>, points: &[[f32; 2]], samples: &mut [Sample])
        = displaced::samples;
}

impl SurfacePatch {
    /// The vertices at these domain points: the same bits as [`SurfacePatch::sample`] at each, but
    /// several times as fast. If one slice is longer, the rest of it is ignored.
    pub fn samples(&self, points: &[[f32; 2]], samples: &mut [Sample]) {
        plain(Level::detect(), self, points, samples);
    }

    /// [`SurfacePatch::samples`] with the instructions of a CPU level. All levels give the same
    /// bits.
    ///
    /// # Errors
    /// [`LevelUnavailableError`] if this machine cannot run the level.
    pub fn samples_at_level(
        &self,
        level: Level,
        points: &[[f32; 2]],
        samples: &mut [Sample],
    ) -> Result<(), LevelUnavailableError> {
        level.require()?;
        plain(level, self, points, samples);
        Ok(())
    }
}

impl DisplacedPatch<'_> {
    /// The displaced vertex at the domain point (u, v), each coordinate in 0..=1 as a tessellator
    /// outputs it.
    #[must_use]
    pub fn sample(&self, point: [f32; 2]) -> Sample {
        let mut sample = [Sample::default()];
        self.samples(&[point], &mut sample);
        sample[0]
    }

    /// The displaced vertices at these domain points: the same bits as [`DisplacedPatch::sample`]
    /// at each, but several times as fast. If one slice is longer, the rest of it is ignored.
    pub fn samples(&self, points: &[[f32; 2]], samples: &mut [Sample]) {
        of_displaced(Level::detect(), self, points, samples);
    }

    /// [`DisplacedPatch::samples`] with the instructions of a CPU level. All levels give the same
    /// bits.
    ///
    /// # Errors
    /// [`LevelUnavailableError`] if this machine cannot run the level.
    pub fn samples_at_level(
        &self,
        level: Level,
        points: &[[f32; 2]],
        samples: &mut [Sample],
    ) -> Result<(), LevelUnavailableError> {
        level.require()?;
        of_displaced(level, self, points, samples);
        Ok(())
    }
}
