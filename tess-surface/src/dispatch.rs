//! The kernels, compiled once for each CPU level and chosen at run time.

use crate::displaced::DisplacedPatch;
use crate::patch::{Patch, Sample};
use crate::{displaced, samples};
use tess_simd::at_each_level;

at_each_level! {
    /// [`Patch::samples`] at a level.
    fn samples(patch: &Patch, points: &[[f32; 2]], samples: &mut [Sample]) = samples::samples;
}

at_each_level! {
    /// [`DisplacedPatch::samples`] at a level.
    fn displaced_samples(
        patch: &DisplacedPatch<'_>,
        points: &[[f32; 2]],
        samples: &mut [Sample],
    ) = displaced::samples;
}
