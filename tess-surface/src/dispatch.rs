//! Evaluation at a CPU level: each kernel is compiled once for every level, and one is chosen at run time.

use crate::displaced::{self, DisplacedPatch};
use crate::patch::{Sample, SurfacePatch};
use crate::samples;
#[cfg(target_arch = "x86_64")]
use multiversion::target::match_target;
use tess_simd::{Level, LevelUnavailable};

/// Work that is compiled for the level of the function that it is inlined into.
trait Kernel {
    /// Does it. `#[inline(always)]` in every implementation, or else it is compiled for the baseline alone.
    fn run(self);
}

/// Runs a kernel at a level that this machine can run. Each instance asks for the instructions that make the level
/// available ([`Level::is_available`]).
fn at_level(level: Level, kernel: impl Kernel) {
    #[cfg(target_arch = "x86_64")]
    #[multiversion::multiversion(targets("x86_64+avx2+bmi1+bmi2+lzcnt+popcnt"))]
    fn avx2<K: Kernel>(kernel: K) {
        match_target! {
            "x86_64+avx2+bmi1+bmi2+lzcnt+popcnt" => kernel.run(),
            // For processors without the level's instructions. It never runs, so it need not be an instance
            // of the kernel.
            _ => at_level(Level::Baseline, kernel),
        }
    }

    #[cfg(target_arch = "x86_64")]
    #[multiversion::multiversion(targets(
        "x86_64+avx2+bmi1+bmi2+lzcnt+popcnt+avx512f+avx512bw+avx512cd+avx512dq+avx512vl"
    ))]
    fn avx512<K: Kernel>(kernel: K) {
        match_target! {
            "x86_64+avx2+bmi1+bmi2+lzcnt+popcnt+avx512f+avx512bw+avx512cd+avx512dq+avx512vl"
                => kernel.run(),
            _ => at_level(Level::Baseline, kernel),
        }
    }

    match level {
        #[cfg(target_arch = "x86_64")]
        Level::Avx2 => avx2(kernel),
        #[cfg(target_arch = "x86_64")]
        Level::Avx512 => avx512(kernel),
        // Elsewhere it is the only level that is available.
        _ => kernel.run(),
    }
}

/// Points of a patch, and where their vertices go.
struct SampleJob<'a, P> {
    patch: &'a P,
    points: &'a [[f32; 2]],
    samples: &'a mut [Sample],
}

impl Kernel for SampleJob<'_, SurfacePatch> {
    #[inline(always)]
    fn run(self) {
        samples::samples(self.patch, self.points, self.samples);
    }
}

impl Kernel for SampleJob<'_, DisplacedPatch<'_>> {
    #[inline(always)]
    fn run(self) {
        displaced::samples(self.patch, self.points, self.samples);
    }
}

impl SurfacePatch {
    /// The vertices at these domain points: the bits of [`SurfacePatch::sample`] at each, several times as fast. Vertices or
    /// points that the other slice has no partner for are left alone.
    pub fn samples(&self, points: &[[f32; 2]], samples: &mut [Sample]) {
        at_level(Level::detect(), SampleJob { patch: self, points, samples });
    }

    /// [`SurfacePatch::samples`] with the instructions of a CPU level, which gives the same bits as every other.
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
        at_level(level, SampleJob { patch: self, points, samples });
        Ok(())
    }
}

impl DisplacedPatch<'_> {
    /// The displaced vertex at the domain point (u, v), in 0..=1 as a tessellator outputs it.
    #[must_use]
    pub fn sample(&self, point: [f32; 2]) -> Sample {
        let mut sample = [Sample::default()];
        self.samples(&[point], &mut sample);
        sample[0]
    }

    /// The displaced vertices at these domain points: the bits of [`DisplacedPatch::sample`] at each, several times as
    /// fast. Vertices or points that the other slice has no partner for are left alone.
    pub fn samples(&self, points: &[[f32; 2]], samples: &mut [Sample]) {
        at_level(Level::detect(), SampleJob { patch: self, points, samples });
    }

    /// [`DisplacedPatch::samples`] with the instructions of a CPU level, which gives the same bits as every other.
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
        at_level(level, SampleJob { patch: self, points, samples });
        Ok(())
    }
}
