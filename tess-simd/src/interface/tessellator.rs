//! The entry point: a configuration that is ready to tessellate batches.

use crate::data::batch::Batch;
use crate::data::chunk::Chunk;
use crate::data::error::Error;
use crate::data::format::{IndexFormat, OutputPoint};
#[cfg(feature = "apart")]
use crate::data::output::ApartBuffers;
use crate::data::output::{BatchCounts, Buffers, Numbering, Output};
use crate::interface::counted::Counted;
use crate::levels;
use crate::stages::counts::PartCounts;
use crate::stages::packet::Packet;
use crate::stages::settings::Settings;
#[cfg(feature = "rayon")]
use crate::threads::MAX_THREADS;
use crate::threads::Workspaces;
#[cfg(feature = "rayon")]
use crate::threads::process::{self, ThreadsError};
use crate::threads::sizes::Slicing;
use crate::threads::slices::CountShare;
use alloc::boxed::Box;
use alloc::vec::Vec;
use tess_core::{Config, Order};
use tess_level::{Level, LevelUnavailableError};

/// Tessellates batches of patches in one configuration.
///
/// Making one is cheap: it takes less than a microsecond and a kilobyte. Tables that depend only on
/// the configuration (0.2 to 0.9 MB) are made once per process, by the first tessellator that needs
/// them, in about a millisecond; without the feature `std` each tessellator makes its own.
///
/// A tessellator's memory ([`Tessellator::memory`]) grows with use: 12 to 17 KB with the first
/// small patch, 20 KB more with the first batch, and at most 1.2 MB per thread. It allocates if a
/// patch has point counts that are new to it, which is rare after the first frames.
/// [`Tessellator::reserve`] allocates all of it in advance. The only other allocations are the
/// growth of an [`Output`] and, with several threads, a short list per batch.
#[derive(Clone, Debug)]
pub struct Tessellator {
    pub(super) level: Level,
    pub(super) settings: Settings,
    pub(super) workspaces: Workspaces,
    /// The counts of each slice of the batch that was counted last; there may be stale ones after
    /// them.
    slices: Vec<PartCounts>,
    /// The packets of the batch that was counted last, if it had at most one chunk.
    kept: Option<Box<[Packet; Chunk::PACKETS]>>,
    /// Whether all memory was reserved ([`Tessellator::reserve`]).
    reserved: bool,
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
    /// [`LevelUnavailableError`] if this machine or this build cannot run the level.
    pub fn with_level(config: Config, level: Level) -> Result<Self, LevelUnavailableError> {
        level.require()?;
        Ok(Self::at(config, level))
    }

    /// A tessellator at a CPU level that this machine can run.
    fn at(config: Config, level: Level) -> Self {
        Self {
            level,
            settings: Settings::new(config),
            workspaces: Workspaces::new(),
            slices: Vec::new(),
            kept: None,
            reserved: false,
        }
    }

    /// Spreads batches over up to `threads` threads: [`Tessellator::set_threads`] as a builder
    /// method.
    #[cfg(feature = "rayon")]
    #[must_use]
    pub fn with_threads(mut self, threads: usize) -> Self {
        self.set_threads(threads);
        self
    }

    /// Spreads later batches over up to `threads` threads, clamped to
    /// 1..=[`Tessellator::MAX_THREADS`]; a new tessellator has one. The output stays the same.
    /// Cached templates are dropped.
    ///
    /// A batch uses one thread for each 256 KiB of its output, so a second thread joins at 512 KiB.
    /// The threads belong to the rayon pool that the caller runs in. Outside any pool they belong
    /// to a pool that all tessellators of the process share, with one thread per processor or as
    /// many as `RAYON_NUM_THREADS` asks for. The first large batch starts that pool; if it cannot
    /// be started, batches are written on the calling thread. A forked child starts its own.
    ///
    /// Each thread that writes keeps up to 1.2 MB in this tessellator; 300 threads are clamped to
    /// 256 and take up to 310 MB. The memory is taken as threads meet new point counts, and freed
    /// when the threads are set again. [`Tessellator::reserve`] takes all of it at once, and later
    /// calls keep it.
    #[cfg(feature = "rayon")]
    pub fn set_threads(&mut self, threads: usize) {
        self.workspaces = Workspaces::of_threads(threads);
        self.reserve_as_before();
    }

    /// Starts the threads that all tessellators of the process share. Call it so that no batch has
    /// to start them, or to learn whether they can be started. Does nothing if they are running.
    ///
    /// # Errors
    /// [`ThreadsError`] if the system refuses.
    #[cfg(feature = "rayon")]
    pub fn start_threads() -> Result<(), ThreadsError> {
        process::start()
    }

    /// The most threads that [`Tessellator::set_threads`] uses.
    #[cfg(feature = "rayon")]
    pub const MAX_THREADS: usize = MAX_THREADS;

    /// Writes triangles in this order: [`Tessellator::set_order`] as a builder method.
    #[must_use]
    pub fn with_order(mut self, order: Order) -> Self {
        self.set_order(order);
        self
    }

    /// Writes the triangles of later batches in this order; a new tessellator uses
    /// [`Order::Specification`]. Cached templates are dropped.
    ///
    /// [`Order::VertexCache`] is for renderers. It writes the same points and the same triangles,
    /// in an order that suits vertex caches. Patches of more than about 300 points take 1.2 to 2
    /// times as long, unless they have the same point counts as the previous large patch.
    pub fn set_order(&mut self, order: Order) {
        self.settings.order = order;
        // The templates have their triangles in the previous order.
        self.workspaces.forget();
        self.reserve_as_before();
    }

    /// Reserves the memory of new workspaces if the old ones were reserved.
    fn reserve_as_before(&mut self) {
        if self.reserved {
            self.reserve();
        }
    }

    /// The configuration that the tessellator was made with.
    #[must_use]
    pub const fn config(&self) -> Config {
        self.settings.config
    }

    /// The CPU level that the tessellator runs at.
    #[must_use]
    pub const fn level(&self) -> Level {
        self.level
    }

    /// Allocates all the memory that patches may ever need, 1.2 MB per thread. It stays allocated
    /// through [`Tessellator::set_order`], `set_threads` and clones. Afterwards no call on one
    /// thread allocates, and [`Tessellator::memory`] does not change. For programs that must not
    /// allocate later; other programs are faster without it.
    pub fn reserve(&mut self) {
        self.reserved = true;
        self.workspaces.reserve();
        first(&mut self.slices, Slicing::most(self.workspaces.threads()));
        self.kept.get_or_insert_with(no_packets);
    }

    /// Bytes of heap memory in use so far, without the tables that all tessellators share.
    #[must_use]
    pub fn memory(&self) -> usize {
        let kept = self.kept.as_deref().map_or(0, size_of_val);
        let slices = self.slices.capacity() * size_of::<PartCounts>();
        self.settings.stitches.bytes() + self.workspaces.bytes() + kept + slices
    }

    /// Counts a batch. The result has the buffer sizes that the batch needs, and writes into such
    /// buffers.
    ///
    /// # Errors
    /// [`Error::UnevenColumns`], [`Error::MixedDomains`], [`Error::BatchTooLarge`].
    pub fn count<'a>(&'a mut self, batch: impl Into<Batch<'a>>) -> Result<Counted<'a>, Error> {
        self.counted(batch.into())
    }

    /// Counts a batch. If the batch has at most one chunk, its front end runs here and the write
    /// reuses the packets. A batch of one patch takes the way of calls for one patch: it needs no
    /// chunk, whose sixteen lanes cost more than the patch.
    fn counted<'a>(&'a mut self, batch: Batch<'a>) -> Result<Counted<'a>, Error> {
        batch.check()?;
        let Self { level, ref settings, ref mut workspaces, ref mut slices, ref mut kept, .. } =
            *self;
        let slicing = Slicing::new(batch.len(), workspaces.threads());
        let keep = slicing.slices <= 1 && batch.len() <= Chunk::PATCHES;
        let slices = first(slices, slicing.slices.max(1));
        // Allocated by the first batch of any size, so that no later batch allocates.
        let packets = kept.get_or_insert_with(no_packets);
        let one = if batch.len() == 1 { batch.patch(0) } else { None };
        if let Some(patch) = &one {
            slices[0] = workspaces.one().count_one(level, settings.config, patch).into();
        } else if keep {
            let config = settings.config;
            slices[0] = levels::count_and_keep(level, config, &batch, packets)
                .unwrap_or_else(|| levels::count(level, config, &batch));
        } else {
            let share = CountShare { batch, slice: slicing.patches, counts: slices };
            workspaces.count(level, settings.config, share);
        }
        let total = PartCounts::sum(slices);
        if total.points.max(total.indices) > u64::from(u32::MAX) {
            return Err(Error::BatchTooLarge { points: total.points, indices: total.indices });
        }
        // A batch that begins with a run, but has other patches after it, was not kept.
        let run = slices[0].run;
        let is_kept = keep && one.is_none() && (run <= 1 || run == batch.len());
        let kept = is_kept.then_some(&**packets);
        Ok(Counted { level, settings, workspaces, batch, slicing, slices, total, kept, one })
    }

    /// Tessellates a batch into the caller's buffers: [`Tessellator::count`] and [`Counted::write`]
    /// in one call.
    ///
    /// # Errors
    /// Any [`Error`]; then nothing is written.
    pub fn write<'a, P: OutputPoint, I: IndexFormat>(
        &'a mut self,
        batch: impl Into<Batch<'a>>,
        numbering: Numbering,
        buffers: Buffers<'_, P, I>,
    ) -> Result<BatchCounts, Error> {
        self.count(batch)?.write(numbering, buffers)
    }

    /// [`Tessellator::write`] with points in two arrays.
    ///
    /// # Errors
    /// As for [`Tessellator::write`].
    #[cfg(feature = "apart")]
    pub fn write_apart<'a, I: IndexFormat>(
        &'a mut self,
        batch: impl Into<Batch<'a>>,
        numbering: Numbering,
        buffers: ApartBuffers<'_, I>,
    ) -> Result<BatchCounts, Error> {
        self.count(batch)?.write_apart(numbering, buffers)
    }

    /// Tessellates a batch into an output object, which grows if needed.
    ///
    /// # Errors
    /// Any [`Error`] except [`Error::BufferTooSmall`]; then the output keeps its contents.
    pub fn tessellate<'a, P: OutputPoint, I: IndexFormat>(
        &'a mut self,
        batch: impl Into<Batch<'a>>,
        numbering: Numbering,
        output: &mut Output<P, I>,
    ) -> Result<BatchCounts, Error> {
        self.count(batch)?.tessellate(numbering, output)
    }
}

/// The first `needed` elements, after the vector has grown to have them.
fn first(slices: &mut Vec<PartCounts>, needed: usize) -> &mut [PartCounts] {
    if let Some(more) = needed.checked_sub(slices.len()) {
        slices.reserve_exact(more);
        slices.resize(needed, PartCounts::default());
    }
    &mut slices[..needed]
}

#[cold]
fn no_packets() -> Box<[Packet; Chunk::PACKETS]> {
    Box::new([Packet::EMPTY; _])
}
