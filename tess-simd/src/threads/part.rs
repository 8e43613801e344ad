//! Consecutive patches of a batch, written by one thread.

use crate::data::batch::Batch;
use crate::data::chunk::{Chunk, Stretch};
use crate::data::error::{BatchBuffer, Error};
use crate::data::format::IndexFormat;
use crate::data::output::{Numbering, PatchRange};
use crate::data::point_writer::PointRoom;
use crate::data::ranges::Ranges;
use crate::data::target::first;
use crate::kernels::emit::{Caches, Offsets, OneWriters, Packets};
use crate::kernels::repeat::Repeat;
use crate::levels;
use crate::stages::packet::{OnePatch, Packet, pairs};
use crate::stages::points::Lookup;
use crate::stages::settings::Settings;
use alloc::boxed::Box;
use core::slice::from_ref;
use tess_core::{Config, Counts, PatchFactors};
use tess_level::Level;

/// The settings of all parts of a batch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Job<'a> {
    pub(crate) level: Level,
    pub(crate) settings: &'a Settings,
    pub(crate) numbering: Numbering,
    /// The packets of the whole batch, if the count kept them; only one patch if all are equal.
    /// Such a batch is one part.
    pub(crate) kept: Option<&'a [Packet; Chunk::PACKETS]>,
}

/// Consecutive patches of a batch, and buffers for their output of exactly the sizes that the count
/// predicts.
#[derive(Debug)]
pub(crate) struct Part<'a, P, I> {
    pub(crate) batch: Batch<'a>,
    pub(crate) points: P,
    pub(crate) indices: &'a mut [I],
    pub(crate) ranges: Ranges<'a>,
    pub(crate) first: Offsets,
    /// [`PartCounts::run`](crate::stages::counts::PartCounts::run).
    pub(crate) run: usize,
}

/// The memory that a thread keeps from batch to batch, allocated on first use. Workspaces of
/// different threads share no cache lines.
#[derive(Clone, Debug)]
#[repr(align(128))]
pub(crate) struct Workspace(Option<Box<WorkspaceMemory>>);

/// A workspace that is in use.
#[derive(Clone, Debug)]
#[repr(align(128))]
struct WorkspaceMemory {
    /// The patch of calls for one patch.
    one: OnePatch,
    lookup: Lookup,
    caches: Caches,
    /// Allocated by the first batch.
    chunk: Option<Box<ChunkMemory>>,
}

/// The memory of a chunk of a batch.
#[derive(Clone, Debug)]
struct ChunkMemory {
    packets: [Packet; Chunk::PACKETS],
    /// The ranges of a chunk, used if the caller wants none.
    ranges: [PatchRange; Chunk::PATCHES],
}

impl Workspace {
    pub(crate) const fn new() -> Self {
        Self(None)
    }

    /// Bytes of heap memory.
    pub(crate) fn bytes(&self) -> usize {
        self.0.as_ref().map_or(0, |memory| {
            let chunk = memory.chunk.as_deref().map_or(0, size_of_val);
            size_of::<WorkspaceMemory>() + memory.caches.bytes() + chunk
        })
    }

    /// Allocates all the memory that the workspace may ever need.
    pub(crate) fn reserve(&mut self) {
        let WorkspaceMemory { caches, chunk, .. } = self.memory();
        caches.reserve();
        chunk.get_or_insert_with(ChunkMemory::new);
    }

    #[inline]
    fn memory(&mut self) -> &mut WorkspaceMemory {
        self.0.get_or_insert_with(WorkspaceMemory::new)
    }

    /// Takes one patch through the front end and returns its output sizes.
    pub(crate) fn count_one(
        &mut self,
        level: Level,
        config: Config,
        factors: &PatchFactors,
    ) -> Counts {
        let [a, b, c] = pairs(factors);
        levels::process_one(level, &mut self.memory().one, config, factors.domain(), a, b, c)
    }

    /// Writes one patch; may overwrite up to `MORE` elements after it in either buffer. Returns the
    /// output sizes.
    ///
    /// # Errors
    /// [`Error::BufferTooSmall`]; then nothing is written.
    pub(crate) fn emit_one<I: IndexFormat, const MORE: usize>(
        &mut self,
        (level, settings): (Level, &Settings),
        factors: &PatchFactors,
        mut points: impl PointRoom,
        indices: &mut [I],
    ) -> Result<Counts, Error> {
        let (domain, raw @ [a, b, c]) = (factors.domain(), pairs(factors));
        let WorkspaceMemory { one, lookup, caches, .. } = self.memory();
        // The kernel of one patch gives up on large patches after their front end. If the previous
        // patch was this one and large, it would compare factors and give up: it is not called.
        let written = !one.is_large_and_has(domain, raw) && {
            let most_points = points.len();
            let (points, indices) = (points.writer(), &mut *indices);
            let to =
                &mut OneWriters { settings, domain, points, most_points, indices, one, caches };
            levels::emit_one(level, to, a, b, c, lookup)
        };
        // In every case `one` now has this patch.
        let counts = one.counts();
        if written {
            return Ok(counts);
        }
        // Too little room, culled, or not compact. Nothing was written yet.
        let points = points.first(counts.points as usize, MORE)?;
        let indices = first(indices, BatchBuffer::Indices, counts.indices as usize, MORE)?;
        self.emit_kept((level, settings), Numbering::PerPatch, points, indices);
        Ok(counts)
    }

    /// Writes a batch of one patch, which [`Self::count_one`] has just counted, into buffers of
    /// exactly its size.
    ///
    /// # Errors
    /// None if the buffers have that size.
    pub(crate) fn emit_counted<I: IndexFormat>(
        &mut self,
        how: (Level, &Settings),
        (numbering, factors): (Numbering, &PatchFactors),
        points: impl PointRoom,
        indices: &mut [I],
    ) -> Result<Counts, Error> {
        // The kernel of one patch has no base vertex: calls for one patch number from 0.
        if numbering.base(0) == 0 {
            return self.emit_one::<I, 0>(how, factors, points, indices);
        }
        self.emit_kept(how, numbering, points, indices);
        Ok(self.memory().one.counts())
    }

    /// Writes the patch that went through the front end last, with the kernel of batches. The
    /// buffers have room for it.
    fn emit_kept<I: IndexFormat>(
        &mut self,
        (level, settings): (Level, &Settings),
        numbering: Numbering,
        mut points: impl PointRoom,
        indices: &mut [I],
    ) {
        let WorkspaceMemory { one, lookup, caches, .. } = self.memory();
        if one.counts().points == 0 {
            return;
        }
        let (first, ranges) = (Offsets::default(), &mut [PatchRange::default()]);
        let packets = Packets { packets: from_ref(one.packet()), first, numbering, ranges };
        levels::emit(level, settings, packets, (points.writer(), indices), caches, lookup);
    }
}

impl WorkspaceMemory {
    #[cold]
    fn new() -> Box<Self> {
        Box::new(Self {
            one: OnePatch::CULLED,
            lookup: Lookup::new(),
            caches: Caches::new(),
            chunk: None,
        })
    }
}

impl ChunkMemory {
    #[cold]
    fn new() -> Box<Self> {
        Box::new(Self { packets: [Packet::EMPTY; _], ranges: [PatchRange::default(); _] })
    }
}

/// Writes a part, a chunk at a time.
pub(crate) fn emit<P: PointRoom, I: IndexFormat>(
    job: Job<'_>,
    part: Part<'_, P, I>,
    workspace: &mut Workspace,
) {
    let Part { ref batch, mut points, mut indices, mut ranges, mut first, run } = part;
    let WorkspaceMemory { lookup, caches, chunk, .. } = workspace.memory();
    let own = &mut **chunk.get_or_insert_with(ChunkMemory::new);
    let Job { level, settings, numbering, kept } = job;
    let (mut start, all) = (0, batch.len());
    // In each turn: patches `start..` are unwritten, and the buffers begin with their output.
    while start < all {
        let (Stretch { patches, times }, packets) = if let Some(kept) = kept {
            // The count has already made the packets of the whole batch, or one patch's if all are
            // equal: this is the only turn.
            let (patches, times) = if run == all { (1, run) } else { (all, 1) };
            (Stretch { patches, times }, kept)
        } else {
            // The count measured the first run; later runs are looked for here.
            let stretch = if start == 0 && run > 1 {
                Stretch { patches: 1, times: run }
            } else {
                levels::stretch(level, batch, start)
            };
            let batch = batch.slice(&(start..start + stretch.patches));
            levels::process(level, settings.config, &batch, &mut own.packets);
            (stretch, &own.packets)
        };
        // `emit` reads the ranges, so they are written even if the caller wants none.
        let ranges_here = ranges.next_or(&mut own.ranges[..patches]);
        let packets = Packets { packets, first, numbering, ranges: &mut *ranges_here };
        let room = (points.writer(), &mut *indices);
        let mut end = levels::emit(level, settings, packets, room, caches, lookup);
        // The patch that was just written is the first of `times`; the others are copies of it.
        if times > 1 {
            let range = ranges_here[0];
            let room = (points.writer(), &mut *indices);
            let repeat = Repeat { range, times, numbering };
            end = levels::repeat(level, repeat, room, &mut ranges);
        }
        start += patches * times;
        // `emit` may have written past `end`, in whole blocks. The next turn overwrites that.
        points = points.split_at((end.points - first.points) as usize).1;
        indices = indices.split_at_mut((end.indices - first.indices) as usize).1;
        first = end;
    }
    debug_assert!(points.len() == 0, "the points were counted");
    debug_assert!(indices.is_empty(), "the indices were counted");
}
