//! One patch per call, for callers that have no batch.
//!
//! Such a call uses no chunk, no slices and no pool. One kernel takes the patch through the front
//! end (`stages/packet/one`) and writes it if it is compact; the kernel of batches writes any other
//! patch. Both use the templates of batches. A patch with the same factors as the previous one
//! skips the front end, and so does a write after its count.

use crate::data::error::Error;
use crate::data::format::{IndexFormat, OutputPoint};
#[cfg(feature = "apart")]
use crate::data::output::ApartBuffers;
use crate::data::output::Buffers;
use crate::data::target::{AnyBuffers, with_types};
use crate::interface::tessellator::Tessellator;
use tess_core::{Counts, PatchFactors};

/// One patch whose output was counted, made by [`Tessellator::count_patch`]. It can be written any
/// number of times.
#[derive(Debug)]
#[must_use = "a count alone writes nothing"]
pub struct CountedPatch<'a> {
    tessellator: &'a mut Tessellator,
    factors: PatchFactors,
    counts: Counts,
}

impl Tessellator {
    /// Tessellates one patch into the caller's buffers: [`Tessellator::count_patch`] and
    /// [`CountedPatch::write`] in one call. Indices count from the patch's first point. Returns the
    /// output sizes.
    ///
    /// Up to [`CountedPatch::OVERRUN`] elements after the output are overwritten in each buffer, if
    /// the buffer is that large. Calls for batches do not overwrite them.
    ///
    /// For a few patches or more, [`Tessellator::write`] is faster. This call uses only the calling
    /// thread, and allocates only if the topology is new.
    ///
    /// ```
    /// use tess_simd::Tessellator;
    /// use tess_simd::tess_core::{Config, OutputPrimitive, Partitioning, QuadFactors};
    /// use tess_simd::tess_core::{MAX_INDICES, MAX_POINTS};
    ///
    /// let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    /// let mut tessellator = Tessellator::new(config);
    /// let (mut points, mut indices) = (vec![[0.0; 2]; MAX_POINTS], vec![0u16; MAX_INDICES]);
    ///
    /// let counts = tessellator.patch(QuadFactors::uniform(2.0), &mut points, &mut indices)?;
    /// assert_eq!((counts.points, counts.primitives, counts.indices), (9, 8, 24));
    /// assert_eq!(points[8], [0.5, 0.5]);
    /// # Ok::<(), tess_simd::Error>(())
    /// ```
    ///
    /// # Errors
    /// [`Error::BufferTooSmall`]; then nothing is written.
    pub fn patch<P: OutputPoint, I: IndexFormat>(
        &mut self,
        factors: impl Into<PatchFactors>,
        points: &mut [P],
        indices: &mut [I],
    ) -> Result<Counts, Error> {
        self.write_one(&factors.into(), Buffers::new(points, indices).into())
    }

    /// [`Tessellator::patch`] with points in two arrays, all u and all v.
    ///
    /// # Errors
    /// As for [`Tessellator::patch`].
    #[cfg(feature = "apart")]
    pub fn patch_apart<I: IndexFormat>(
        &mut self,
        factors: impl Into<PatchFactors>,
        u: &mut [f32],
        v: &mut [f32],
        indices: &mut [I],
    ) -> Result<Counts, Error> {
        self.write_one(&factors.into(), ApartBuffers::new(u, v, indices).into())
    }

    /// Counts one patch. The result has the sizes of the buffers that the patch needs, and writes
    /// into them.
    pub fn count_patch(&mut self, factors: impl Into<PatchFactors>) -> CountedPatch<'_> {
        let factors = factors.into();
        let counts = self.workspaces.one().count_one(self.level, self.settings.config, &factors);
        CountedPatch { tessellator: self, factors, counts }
    }

    fn write_one(
        &mut self,
        factors: &PatchFactors,
        buffers: AnyBuffers<'_>,
    ) -> Result<Counts, Error> {
        const MORE: usize = CountedPatch::OVERRUN;
        let (how, workspace) = ((self.level, &self.settings), self.workspaces.one());
        with_types!(buffers, |points, indices, _ranges| {
            workspace.emit_one::<_, MORE>(how, factors, points, indices)
        })
    }
}

impl CountedPatch<'_> {
    /// The number of elements after the output that may be overwritten in either buffer. Writing is
    /// fastest if the buffers have that much more room.
    pub const OVERRUN: usize = 64;

    /// The output sizes; zeros if the patch is culled.
    #[must_use]
    pub const fn counts(&self) -> Counts {
        self.counts
    }

    /// Writes the patch into the caller's buffers. Indices count from the patch's first point.
    /// Returns the output sizes. The first [`CountedPatch::OVERRUN`] elements after the output are
    /// unspecified afterwards.
    ///
    /// # Errors
    /// [`Error::BufferTooSmall`]; then nothing is written.
    pub fn write<P: OutputPoint, I: IndexFormat>(
        &mut self,
        points: &mut [P],
        indices: &mut [I],
    ) -> Result<Counts, Error> {
        self.tessellator.write_one(&self.factors, Buffers::new(points, indices).into())
    }

    /// [`CountedPatch::write`] with points in two arrays, all u and all v.
    ///
    /// # Errors
    /// As for [`CountedPatch::write`].
    #[cfg(feature = "apart")]
    pub fn write_apart<I: IndexFormat>(
        &mut self,
        u: &mut [f32],
        v: &mut [f32],
        indices: &mut [I],
    ) -> Result<Counts, Error> {
        self.tessellator.write_one(&self.factors, ApartBuffers::new(u, v, indices).into())
    }
}
