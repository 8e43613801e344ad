//! Taps: they run a single stage or kernel over any input, for comparison and for timing. See
//! `dev/testkit/src/kernels.rs` of the repository.

mod words;

use crate::data::batch::Batch;
use crate::data::chunk::Chunk;
use crate::data::format::IndexFormat;
use crate::data::lanes::{Column, LANES, MAX_FACTORS};
use crate::data::output::{Numbering, PatchRange};
use crate::data::point_writer::PointRoom;
use crate::data::ranges::Ranges;
use crate::kernels::emit::{Caches, Offsets, OneWriters, Packets};
use crate::kernels::kernel_taps::{Kernel, TapInput, TapOutput};
use crate::kernels::repeat::Repeat;
use crate::levels;
use crate::stages::counts::PartCounts;
use crate::stages::packet::{OnePatch, Packet, pairs};
use crate::stages::points::Lookup;
use crate::stages::settings::Settings;
use alloc::vec::Vec;
use tess_core::fixed_point::ONE;
use tess_core::{
    Config, Counts, Domain, DomainPoint, FactorContext, FixedFactor, Order, Parity, PatchFactors,
};
use tess_level::{Level, LevelUnavailableError};

/// The formats that points and indices are written in.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[expect(missing_docs, reason = "as the formats are called")]
pub enum Format {
    #[default]
    FixedU32,
    F32U16,
    F32U32,
    ApartU32,
}

/// The input of a kernel.
#[derive(Clone, Debug)]
pub struct Input {
    /// The configuration.
    pub config: Config,
    /// The order of triangles.
    pub order: Order,
    /// The parity of factors that are given as numbers.
    pub parity: Parity,
    /// The number of the first point, with both numberings.
    pub base: u32,
    /// Whether indices count through the batch ([`Numbering::PerBatch`]).
    pub per_batch: bool,
    /// The formats of points and indices.
    pub format: Format,
    /// The numbers that a stage of numbers takes; their count is a multiple of 16. Other stages
    /// read fields from the bytes of a number, highest byte first:
    ///
    /// - stitches: the kind (0 transition, 1 ring, 2 strip, 3 strip except in the middle), outer
    ///   points, and inside points, inner points or quads;
    /// - rows, six numbers: a stitch; the first indices of the outer and of the inner row; then in
    ///   bytes whether both rows run up, the replaced entries of the outer and of the inner row
    ///   (255: none), and whether the inner row runs down; then the two indices that replace them;
    /// - writers: a method, the place of the first source, two bytes of the length;
    /// - repeating, three numbers: points, indices and times of each run.
    pub numbers: Vec<u32>,
    /// The patches that the remaining kernels take, at most 64 of one domain.
    pub patches: Vec<PatchFactors>,
    /// The sizes of the output: points, indices.
    pub sizes: [usize; 2],
}

/// A kernel at a level with its input, ready to run.
#[derive(Debug)]
pub struct KernelTap {
    kernel: Kernel,
    level: Level,
    format: Format,
    numbering: Numbering,
    work: TapInput,
    made: TapOutput,
    caches: Caches,
    kept: [Packet; Chunk::PACKETS],
    part: PartCounts,
    ones: Vec<Counts>,
    one: OnePatch,
}

impl KernelTap {
    /// Runs the stages that precede the kernel over the input.
    ///
    /// # Errors
    /// [`LevelUnavailableError`] if this machine cannot run the level.
    pub fn new(kernel: Kernel, level: Level, input: &Input) -> Result<Self, LevelUnavailableError> {
        level.require()?;
        let base_vertex = input.base;
        let mut tap = Self {
            kernel,
            level,
            format: input.format,
            numbering: if input.per_batch {
                Numbering::PerBatch { base_vertex }
            } else {
                Numbering::PerPatch
            },
            work: work(kernel, level, input),
            made: TapOutput::new(),
            caches: Caches::new(),
            kept: [Packet::EMPTY; _],
            part: PartCounts::default(),
            ones: Vec::new(),
            one: OnePatch::CULLED,
        };
        tap.make_room(input.sizes);
        Ok(tap)
    }

    /// Makes exactly the room that is written.
    fn make_room(&mut self, sizes: [usize; 2]) {
        let [points, indices] = sizes;
        let Self { kernel, format, made, .. } = self;
        // Repeating starts from elements that are their own numbers. For other kernels the elements
        // are numbers that no output has, so that unwritten ones show.
        let flip = if *kernel == Kernel::Repeat { 0 } else { u32::MAX };
        let number = |i: usize| u32::try_from(i).unwrap_or(u32::MAX) ^ flip;
        let points = 0..if *kernel == Kernel::Codes { 0 } else { points };
        match *format {
            Format::FixedU32 => {
                made.points = points.map(|i| DomainPoint::from_bits(number(i), ONE)).collect();
            }
            Format::F32U16 | Format::F32U32 => {
                made.floats = points.map(|i| [f32::from_bits(number(i)), 1.0]).collect();
            }
            Format::ApartU32 => {
                let ones = points.clone().map(|_| 1.0).collect();
                made.apart = [points.map(|i| f32::from_bits(number(i))).collect(), ones];
            }
        }
        let indices = (0..indices).map(number);
        if *format == Format::F32U16 || matches!(*kernel, Kernel::ConnectU16 | Kernel::RowsU16) {
            made.narrow = indices.map(u16::wrapping_from).collect();
        } else {
            made.indices = indices.collect();
        }
        if *kernel == Kernel::Codes {
            made.codes.resize(sizes[0], [u16::MAX; 2]);
        }
        let ranges = if *kernel == Kernel::Repeat {
            self.work.numbers.as_chunks::<3>().0.iter().map(|[.., times]| *times as usize).sum()
        } else {
            self.work.patches.len()
        };
        made.ranges.resize(ranges, PatchRange::default());
    }

    /// Runs the kernel over the input.
    pub fn run(&mut self) {
        let Self { kernel, level, work, made, .. } = self;
        let (kernel, level) = (*kernel, *level);
        if kernel == Kernel::CompactPoints {
            levels::compact_points(level, work, made);
        } else if !levels::of_numbers(level, kernel, work, made)
            && !levels::of_patches(level, kernel, work, made)
        {
            self.run_kernel();
        }
    }

    fn run_kernel(&mut self) {
        let Self { kernel, level, work, kept, part, .. } = self;
        let (config, batch) = (work.settings.config, Batch::from(&work.patches));
        match *kernel {
            Kernel::Process => levels::process(*level, config, &batch, kept),
            Kernel::Count => *part = levels::count(*level, config, &batch),
            Kernel::CountAndKeep => {
                let counted = levels::count_and_keep(*level, config, &batch, kept);
                *part = counted.unwrap_or_else(|| levels::count(*level, config, &batch));
                // If a batch begins with a run, the kernel keeps one patch or none.
                if part.run > 1 {
                    levels::process(*level, config, &batch, kept);
                }
            }
            Kernel::ProcessOne => {
                self.ones.clear();
                for factors in &work.patches {
                    let (domain, [a, b, c]) = (factors.domain(), pairs(factors));
                    let one = &mut self.one;
                    let counts = levels::process_one(*level, one, config, domain, a, b, c);
                    self.ones.push(counts);
                }
            }
            _ => self.write(),
        }
    }

    /// Writes points and indices in their formats.
    fn write(&mut self) {
        let Self { kernel, level, format, numbering, work, made, one, caches, .. } = self;
        let (kernel, level, numbering) = (*kernel, *level, *numbering);
        let TapOutput { points, floats, apart, indices, narrow, ranges, lookup, words, .. } = made;
        let mut to = TapTarget { kernel, level, numbering, work, one, caches, lookup, ranges };
        let end = match format {
            Format::FixedU32 => to.write(&mut points[..], indices),
            Format::F32U32 => to.write(&mut floats[..], indices),
            Format::F32U16 => to.write(&mut floats[..], narrow),
            Format::ApartU32 => to.write(apart.each_mut().map(|array| &mut array[..]), indices),
        };
        words.clear();
        if matches!(kernel, Kernel::Emit | Kernel::Repeat) {
            words.extend([end.points, end.indices]);
        }
    }
}

/// The arguments of kernels that write, except for the buffers in their formats.
struct TapTarget<'a> {
    kernel: Kernel,
    level: Level,
    numbering: Numbering,
    work: &'a TapInput,
    one: &'a mut OnePatch,
    caches: &'a mut Caches,
    lookup: &'a mut Lookup,
    ranges: &'a mut [PatchRange],
}

impl TapTarget<'_> {
    /// Runs the kernel; returns where its output ends.
    fn write<I: IndexFormat>(
        &mut self,
        mut points: impl PointRoom,
        mut indices: &mut [I],
    ) -> Offsets {
        let Self { kernel, level, numbering, work, one, caches, lookup, ranges } = self;
        let (settings, packets) = (&work.settings, &work.packets[..]);
        let mut end = Offsets::default();
        match kernel {
            Kernel::WritePoints => levels::of_points(*level, work, points.writer()),
            Kernel::WriteIndices => levels::of_indices(*level, work, indices),
            Kernel::EmitOne => {
                for patch in &work.patches {
                    let (domain, [a, b, c]) = (patch.domain(), pairs(patch));
                    {
                        let most_points = points.len();
                        let (points, indices) = (points.writer(), &mut *indices);
                        let to = &mut OneWriters {
                            settings,
                            domain,
                            points,
                            most_points,
                            indices,
                            one,
                            caches,
                        };
                        levels::emit_one(*level, to, a, b, c, lookup);
                    }
                    let counts = one.counts();
                    points = points.split_at(counts.points as usize).1;
                    indices = indices.split_at_mut(counts.indices as usize).1;
                }
            }
            Kernel::Repeat => {
                let mut done = 0;
                for &[point_count, index_count, times] in work.numbers.as_chunks::<3>().0 {
                    let range = PatchRange {
                        first_point: end.points,
                        points: point_count,
                        first_index: end.indices,
                        indices: index_count,
                    };
                    let times = times as usize;
                    let repeat = Repeat { range, times, numbering: *numbering };
                    let room = (points.writer(), &mut *indices);
                    ranges[done] = range;
                    let mut rest = Ranges::new(Some(&mut ranges[done + 1..done + times]));
                    end = levels::repeat(*level, repeat, room, &mut rest);
                    done += times;
                    points = points.split_at(point_count as usize * times).1;
                    indices = indices.split_at_mut(index_count as usize * times).1;
                }
            }
            _ => {
                let packets = Packets { packets, first: end, numbering: *numbering, ranges };
                let room = (points.writer(), indices);
                end = levels::emit(*level, settings, packets, room, caches, lookup);
            }
        }
        end
    }
}

/// The data that the kernel reads: the input, after the stages that precede the kernel.
fn work(kernel: Kernel, level: Level, input: &Input) -> TapInput {
    let Input { config, order, parity, base, numbers, patches, .. } = input.clone();
    let settings = Settings { order, ..Settings::new(config) };
    let domain = patches.first().map_or(Domain::Quad, PatchFactors::domain);
    let context =
        |&bits: &u32| FactorContext::new(FixedFactor::from_bits(bits), parity, config.split);
    let contexts = if matches!(kernel, Kernel::Place | Kernel::PlaceInHalf) {
        numbers.iter().map(context).collect()
    } else {
        Vec::new()
    };
    let raw = patches.chunks(LANES).map(raw_column).collect();
    let packets = patches.chunks(Chunk::PATCHES).flat_map(|patches| {
        let mut packets = [Packet::EMPTY; Chunk::PACKETS];
        levels::process(level, config, &Batch::from(patches), &mut packets);
        packets.into_iter().take(patches.len().div_ceil(LANES))
    });
    let packets = packets.collect();
    TapInput { settings, parity, numbers, contexts, domain, patches, raw, packets, base }
}

/// The raw factors of up to sixteen patches, factor by factor.
fn raw_column(patches: &[PatchFactors]) -> Column<f32> {
    let mut column = [[0.0; LANES]; MAX_FACTORS];
    for (lane, patch) in patches.iter().enumerate() {
        patch.iter().enumerate().for_each(|(i, factor)| column[i][lane] = factor);
    }
    column
}
