//! Writes packets of patches into buffers.
//!
//! Each patch takes the cheapest of four ways to its output. `threads/part` calls this through
//! `levels` for each chunk; the result is the core's output, patch after patch, in order.
//!
//! # Data
//!
//! ```text
//!                      points from                         indices from
//! compact, integer     template: [u16; 2] widened          template: u8 + base
//! compact, fractional  template: codes, CompactPoints      template: u8 + base
//! up to 289 points, or like the large patch before:
//!                      template if integer, else stages    template: u16 + base
//! larger               stages/points                       stages/connect, cache_order
//! ```
//!
//! ```text
//! ranges   [ patch 0 | patch 1 | ...  ]   first_point, points, first_index, indices
//! points   [ patch 0    | patch 1 | ... ]<- a writer's position; blocks may reach past it
//! indices  [ patch 0  | patch 1       ...]
//! ```
//!
//! # One packet
//!
//! Two patches in one packet: the quad (3, 4.5, 5, 6; 4, 7) of `docs/tour-cpu.md` with 43 points
//! and 186 indices, and after it a culled one and the same quad again, numbered through the batch
//! from 100 on:
//!
//! ```text
//! lane  first_point  points  first_index  indices   base
//!   0        0         43         0         186      100
//!   1       43          0       186           0
//!   2       43         43       186         186      143
//! ```
//!
//! # What must hold
//!
//! - Buffers have exactly the room that the counts predict, or more; a patch writes whole blocks,
//!   and what a block writes past its patch is overwritten by the next one or cut at the buffer's
//!   end ([`Writer`]). So patches are written in order.
//! - A packet's patches are looked up after one `make_room` and before the next.
//! - Lanes without points are skipped: their other numbers are unspecified.
//!
//! # The simpler form
//!
//! Sizes of blocks: one for every level. Long blocks, which AVX-512 gains from, took one patch of
//! factor 4 from 50 to 75 ns at the baseline ([`CompactPoints::LONG_BLOCKS`]).
//!
//! A packet of compact patches alone goes stage by stage: all look-ups, then, with integer factors,
//! all points before all indices. Patch by patch, a branch that is predicted wrongly in one stage
//! also discards the begun work of the next. Together with permutes this took `meshes/quads` from
//! 0.16 to 0.25 of a fill (`docs/experiments.md`). Fractional points take so long to compute that
//! the stores of the indices before them cost nothing meanwhile.

use crate::data::format::{IndexFormat, OutputPoint};
use crate::data::lanes::LANES;
use crate::data::output::{Numbering, PatchRange};
use crate::data::point_writer::PointWriter;
use crate::data::writer::Writer;
use crate::stages::connect::{self, cache_order};
use crate::stages::packet::{OnePatch, Packet, PacketPatch};
use crate::stages::points::{self, CompactPoints, LocationTables};
use crate::stages::settings::Settings;
use crate::stages::template::{CompactPoint, Start, Template, Templates, long};
use tess_core::{Domain, DomainPoint};

/// Packets to write.
#[derive(Debug)]
pub(crate) struct Packets<'a> {
    pub(crate) packets: &'a [Packet],
    pub(crate) first: Offsets,
    pub(crate) numbering: Numbering,
    /// Receives where each patch's output lies. As long as there are patches; the packets may have
    /// more lanes.
    pub(crate) ranges: &'a mut [PatchRange],
}

/// The output of a batch before some patch of it: where that patch's output begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Offsets {
    pub(crate) points: u32,
    pub(crate) indices: u32,
}

/// Tables and templates, kept from patch to patch and from batch to batch. All of it follows from
/// the configuration and the patches' factors.
#[derive(Clone, Debug)]
pub(crate) struct Caches {
    tables: LocationTables,
    templates: Templates,
}

impl Caches {
    /// Empty ones, which grow as they are used.
    pub(crate) const fn new() -> Self {
        Self { tables: LocationTables::EMPTY, templates: Templates::new() }
    }

    /// Bytes of memory that they take on the heap.
    pub(crate) const fn bytes(&self) -> usize {
        self.tables.bytes() + self.templates.bytes()
    }

    /// Takes all the memory that they may ever need.
    pub(crate) fn reserve(&mut self) {
        self.tables.reserve();
        self.templates.reserve();
    }
}

/// Writers of both kinds of output.
struct Writers<'a, W, I> {
    points: W,
    indices: Writer<'a, I>,
}

/// Writes packets; returns where their output ends in the batch. Points and indices have room for
/// the packets' output, or more; what follows it may be overwritten.
#[inline(always)]
pub(crate) fn emit<W: PointWriter, I: IndexFormat, M: CompactPoints<W>>(
    settings: &Settings,
    packets: Packets<'_>,
    (points, indices): (W, &mut [I]),
    caches: &mut Caches,
    compact_points: &mut M,
) -> Offsets {
    let Packets { packets, mut first, numbering, ranges } = packets;
    let mut out = Writers { points, indices: Writer::new(indices) };
    for (packet, ranges) in packets.iter().zip(ranges.chunks_mut(LANES)) {
        for (lane, range) in ranges.iter_mut().enumerate() {
            let patch = packet.patch(lane);
            *range = PatchRange {
                first_point: first.points,
                points: patch.points(),
                first_index: first.indices,
                indices: patch.indices(),
            };
            first.points += range.points;
            first.indices += range.indices;
        }
        caches.templates.make_room();
        // One patch's lane was written a moment ago: all lanes together would wait for it.
        if ranges.len() > 1 && packet.all_compact() {
            emit_compact(settings, (packet, ranges), numbering, caches, &mut out, compact_points);
            continue;
        }
        for (lane, range) in ranges.iter().enumerate().filter(|(_, range)| range.points != 0) {
            let patch = packet.patch(lane);
            let base = numbering.base(range.first_point);
            if patch.is_compact() {
                let Caches { tables, templates } = &mut *caches;
                let template = templates.find(patch, (settings, tables), M::kept);
                let template = templates.get(template);
                points_of(patch, template, &mut out.points, compact_points);
                indices_of::<_, W, M>(patch, template, base, &mut out.indices);
            } else {
                emit_patch::<_, _, M>(settings, patch, base, caches, &mut out);
            }
        }
    }
    first
}

/// Where a single patch goes, and what is kept from patch to patch: together, so that calls pass
/// few arguments.
pub(crate) struct OneWriters<'a, W, I> {
    pub(crate) settings: &'a Settings,
    pub(crate) domain: Domain,
    pub(crate) points: W,
    /// As many as `points` has room for.
    pub(crate) most_points: usize,
    pub(crate) indices: &'a mut [I],
    pub(crate) one: &'a mut OnePatch,
    pub(crate) caches: &'a mut Caches,
}

/// Takes one patch ([`pairs`](crate::stages::packet::pairs)) through the front end and writes it,
/// its indices counted from its own first point. Returns whether it was written: it is if it is
/// compact, not culled, and has room.
///
/// [`emit`] would be correct, but sets up state that only large patches use.
#[inline(always)]
pub(crate) fn emit_one<W: PointWriter, I: IndexFormat, M: CompactPoints<W>>(
    to: &mut OneWriters<'_, W, I>,
    a: u64,
    b: u64,
    c: u64,
    compact_points: &mut M,
) -> bool {
    let OneWriters { settings, domain, points, most_points, indices, one, caches } = to;
    let Caches { tables, templates } = &mut **caches;
    let counts = one.process(settings.config, *domain, a, b, c);
    let patch = one.packet().patch(0);
    let has_room =
        counts.points as usize <= *most_points && counts.indices as usize <= indices.len();
    if !has_room || counts.points == 0 || !patch.is_compact() {
        return false;
    }
    templates.make_room();
    let template = templates.find(patch, (settings, tables), M::kept);
    let template = templates.get(template);
    points_of(patch, template, points, compact_points);
    indices_of::<_, W, M>(patch, template, 0, &mut Writer::new(indices));
    true
}

/// Writes a packet of compact patches that are all looked up first, so that a wrongly predicted
/// branch discards no look-up.
#[inline(always)]
fn emit_compact<W: PointWriter, I: IndexFormat, M: CompactPoints<W>>(
    settings: &Settings,
    (packet, ranges): (&Packet, &[PatchRange]),
    numbering: Numbering,
    caches: &mut Caches,
    out: &mut Writers<'_, W, I>,
    compact_points: &mut M,
) {
    let Caches { tables, templates } = caches;
    let mut starts = [Start::default(); LANES];
    let lanes = ranges.iter().enumerate().filter(|(_, range)| range.points != 0);
    for (lane, _) in lanes.clone() {
        starts[lane] = templates.find(packet.patch(lane), (settings, tables), M::kept);
    }
    // Apart, so that neither loop keeps the other's constants.
    if packet.patch(0).integer() {
        for (lane, _) in lanes.clone() {
            let (patch, points) = (packet.patch(lane), templates.get(starts[lane]).points);
            integer_points::<W, M>(patch, points, &mut out.points);
        }
        for (lane, range) in lanes {
            let base = numbering.base(range.first_point);
            let patch = packet.patch(lane);
            indices_of::<_, W, M>(patch, templates.get(starts[lane]), base, &mut out.indices);
        }
    } else {
        for (lane, range) in lanes {
            let (patch, template) = (packet.patch(lane), templates.get(starts[lane]));
            compact_points.emit(patch, template.points, &mut out.points);
            let base = numbering.base(range.first_point);
            indices_of::<_, W, M>(patch, template, base, &mut out.indices);
        }
    }
}

/// Writes the points of a compact patch.
#[inline(always)]
fn points_of<W: PointWriter, M: CompactPoints<W>>(
    patch: PacketPatch<'_>,
    Template { points, .. }: Template<'_, u8, CompactPoint>,
    out: &mut W,
    compact_points: &mut M,
) {
    if patch.integer() {
        integer_points::<W, M>(patch, points, out);
    } else {
        compact_points.emit(patch, points, out);
    }
}

/// Writes the points of a compact patch of integer factors.
#[inline(always)]
fn integer_points<W: PointWriter, M: CompactPoints<W>>(
    patch: PacketPatch<'_>,
    points: &[CompactPoint],
    out: &mut W,
) {
    let length = patch.points() as usize;
    if M::LONG_BLOCKS {
        out.map_least::<_, 24, 24>(length, points, long);
    } else {
        out.map_least::<_, 8, 24>(length, points, long);
    }
}

/// Writes the indices of a compact patch whose first point is number `base`.
#[inline(always)]
fn indices_of<I: IndexFormat, W, M: CompactPoints<W>>(
    patch: PacketPatch<'_>,
    Template { indices, .. }: Template<'_, u8, CompactPoint>,
    base: u32,
    out: &mut Writer<'_, I>,
) {
    let (length, base) = (patch.indices() as usize, I::wrapping_from(base));
    let index = |index: u8| base.wrapping_add(I::wrapping_from(index.into()));
    if M::LONG_BLOCKS {
        out.map_least::<_, 64, 64>(length, indices, index);
    } else {
        out.map_least::<_, 16, 64>(length, indices, index);
    }
}

/// Writes any other patch that is not culled and whose first point is number `base`.
#[inline(always)]
fn emit_patch<W: PointWriter, I: IndexFormat, M: CompactPoints<W>>(
    settings: &Settings,
    patch: PacketPatch<'_>,
    base: u32,
    caches: &mut Caches,
    out: &mut Writers<'_, W, I>,
) {
    let Caches { tables, templates } = caches;
    let add = I::wrapping_from(base);
    let add = |index: u16| add.wrapping_add(I::wrapping_from(index.into()));
    let Some(template) = templates.other(patch, (settings, tables)) else {
        points::emit(patch, tables, &mut out.points);
        if cache_order::reorders(settings, patch) {
            let specified = templates.specified(settings, patch);
            cache_order::emit(settings, patch, specified, &mut out.indices, add);
        } else {
            connect::emit(settings, patch, base, &mut out.indices);
        }
        return;
    };
    if patch.integer() {
        out.points.map::<_, 8>(patch.points() as usize, template.points, |point: DomainPoint| {
            W::Point::from_bits(point.u.to_bits(), point.v.to_bits())
        });
    } else {
        points::emit(patch, tables, &mut out.points);
    }
    let length = patch.indices() as usize;
    if M::LONG_BLOCKS {
        out.indices.map_least::<_, 64, 64>(length, template.indices, add);
    } else {
        out.indices.map_least::<_, 16, 128>(length, template.indices, add);
    }
}
