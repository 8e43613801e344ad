//! The front door: a configuration, ready to take batches.

use crate::batch::Batch;
use crate::error::{Buffer, Error, LevelUnavailable};
use crate::format::{IndexFormat, PointFormat};
use crate::level::Level;
use crate::output::{BatchCounts, Buffers, Numbering, Output};
use crate::part::PartCounts;
use crate::share::{self, Plan, Share};
use crate::stitch::Stitches;
use crate::threads::Workspaces;
use alloc::vec::Vec;
use tess_core::Config;

/// Tessellates batches of patches in one configuration.
///
/// Making one reads its tables off the core, which takes a few milliseconds; it holds about 0.7 to
/// 1.3 MB ([`Tessellator::memory`]). Make it once and keep it. After its first batch it allocates nothing
/// but what an [`Output`] grows by.
#[derive(Clone, Debug)]
pub struct Tessellator {
    config: Config,
    level: Level,
    stitches: Stitches,
    workspaces: Workspaces,
    /// Of each slice of the batch at hand.
    counts: Vec<PartCounts>,
}

impl Tessellator {
    /// A tessellator at the most capable CPU level of this machine.
    #[must_use]
    pub fn new(config: Config) -> Self {
        Self::at(config, Level::detect())
    }

    /// A tessellator at a CPU level.
    ///
    /// # Errors
    /// [`LevelUnavailable`] if this machine or this build cannot run it.
    pub fn with_level(config: Config, level: Level) -> Result<Self, LevelUnavailable> {
        if level.is_available() {
            Ok(Self::at(config, level))
        } else {
            Err(LevelUnavailable(level))
        }
    }

    fn at(config: Config, level: Level) -> Self {
        let workspaces = Workspaces::new();
        Self { config, level, stitches: Stitches::new(config), workspaces, counts: Vec::new() }
    }

    /// The configuration that it was made with.
    #[must_use]
    pub const fn config(&self) -> Config {
        self.config
    }

    /// Spreads batches over this many threads of the current rayon pool, at least one. The output
    /// stays the same. Each thread takes about 450 KiB.
    #[cfg(feature = "rayon")]
    #[must_use]
    pub fn threads(mut self, threads: usize) -> Self {
        self.workspaces = Workspaces::of_threads(threads);
        self
    }

    /// Bytes of memory that its tables and workspaces take.
    #[must_use]
    pub fn memory(&self) -> usize {
        self.stitches.bytes() + self.workspaces.bytes()
    }

    /// The CPU level that it runs at.
    #[must_use]
    pub const fn level(&self) -> Level {
        self.level
    }

    /// Predicts the sizes of the buffers that a batch needs.
    ///
    /// # Errors
    /// [`Error::UnevenColumns`], [`Error::BatchTooLarge`].
    pub fn count<'a>(&mut self, batch: impl Into<Batch<'a>>) -> Result<BatchCounts, Error> {
        let batch = batch.into();
        self.check(&batch).map(|counts| sizes(&batch, counts))
    }

    /// Tessellates a batch into the caller's buffers, which may be larger than needed: what lies
    /// behind the output stays as it is.
    ///
    /// # Errors
    /// Any [`Error`]; then nothing is written.
    pub fn write<'a, P: PointFormat, I: IndexFormat>(
        &mut self,
        batch: impl Into<Batch<'a>>,
        numbering: Numbering,
        buffers: Buffers<'_, P, I>,
    ) -> Result<BatchCounts, Error> {
        let batch = batch.into();
        let counts = self.check(&batch)?;
        check_indices::<I>(counts, numbering)?;
        let sizes = sizes(&batch, counts);
        let buffers = Buffers {
            points: prefix(buffers.points, sizes.points, Buffer::Points)?,
            indices: prefix(buffers.indices, sizes.indices, Buffer::Indices)?,
            ranges: prefix(buffers.ranges, sizes.patches, Buffer::Ranges)?,
        };
        self.emit(batch, numbering, buffers);
        Ok(sizes)
    }

    /// Tessellates a batch into an output object, which grows if it must.
    ///
    /// # Errors
    /// Any [`Error`] but [`Error::BufferTooSmall`]; then the output stays as it was.
    pub fn tessellate<'a, P: PointFormat, I: IndexFormat>(
        &mut self,
        batch: impl Into<Batch<'a>>,
        numbering: Numbering,
        output: &mut Output<P, I>,
    ) -> Result<BatchCounts, Error> {
        let batch = batch.into();
        let counts = self.check(&batch)?;
        check_indices::<I>(counts, numbering)?;
        let sizes = sizes(&batch, counts);
        self.emit(batch, numbering, output.make_room(sizes));
        Ok(sizes)
    }

    /// Counts a batch whose columns are even and whose output is not too large, slice by slice.
    fn check(&mut self, batch: &Batch<'_>) -> Result<PartCounts, Error> {
        if !batch.is_even() {
            return Err(Error::UnevenColumns);
        }
        let (slice, slices) = share::slices(batch.len(), self.workspaces.threads());
        self.counts.clear();
        self.counts.resize(slices, PartCounts::default());
        let threads = self.workspaces.threads();
        share::count((self.level, self.config), *batch, slice, &mut self.counts, threads);
        let counts = self.counts.iter().copied().fold(PartCounts::default(), PartCounts::and);
        if counts.points.max(counts.indices) > u64::from(u32::MAX) {
            return Err(Error::BatchTooLarge { points: counts.points, indices: counts.indices });
        }
        Ok(counts)
    }

    /// Writes the batch that was checked last into buffers of exactly its sizes.
    fn emit<P: PointFormat, I: IndexFormat>(
        &mut self,
        batch: Batch<'_>,
        numbering: Numbering,
        buffers: Buffers<'_, P, I>,
    ) {
        let (slice, _) = share::slices(batch.len(), self.workspaces.threads());
        let Self { config, level, stitches, workspaces, counts } = self;
        let plan = Plan { level: *level, config: *config, stitches, numbering, slice };
        workspaces.emit(plan, Share { batch, counts, buffers, first: (0, 0) });
    }
}

#[expect(clippy::cast_possible_truncation, reason = "a checked batch's sizes fit 32 bits")]
fn sizes(batch: &Batch<'_>, counts: PartCounts) -> BatchCounts {
    BatchCounts {
        patches: batch.len(),
        points: counts.points as usize,
        indices: counts.indices as usize,
    }
}

/// Whether the largest index fits.
fn check_indices<I: IndexFormat>(counts: PartCounts, numbering: Numbering) -> Result<(), Error> {
    let end = match numbering {
        Numbering::PerPatch => u64::from(counts.largest),
        Numbering::Batch { .. } if counts.points == 0 => 0,
        Numbering::Batch { base_vertex } => u64::from(base_vertex) + counts.points,
    };
    let largest = end.saturating_sub(1);
    if largest > I::LARGEST {
        return Err(Error::IndexTooLarge { largest, format: I::LARGEST });
    }
    Ok(())
}

/// The first `needed` elements of a caller's buffer.
fn prefix<T>(slice: &mut [T], needed: usize, buffer: Buffer) -> Result<&mut [T], Error> {
    let got = slice.len();
    slice.get_mut(..needed).ok_or(Error::BufferTooSmall { buffer, needed, got })
}
