//! Writes packets of patches into buffers.
//!
//! There are four ways to write a patch, and each patch takes the cheapest one. `threads/part`
//! calls this through `levels` for each chunk. The result is the core's output, patch by patch, in
//! order.
//!
//! # Data
//!
//! ```text
//!                      points from                         indices from
//! compact, integer     template: [u16; 2] widened          template: u8 + base
//! compact, fractional  template: codes, CompactPoints      template: u8 + base
//! up to 289 points, or equal in topology to the previous large patch:
//!                      template if integer, else stages    template: u16 + base
//! larger               stages/points                       stages/connect
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
//! Three patches in one packet: the quad (3, 4.5, 5, 6; 4, 7) of `docs/tour-cpu.md` with 43 points
//! and 186 indices, a culled patch, and the same quad again. The batch is numbered through,
//! beginning with 100:
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
//! - Buffers have at least the room that the counts predict. Patches are written in order and in
//!   whole blocks: elements that a block writes past its patch are overwritten by the next patch,
//!   or cut off at the buffer's end ([`Writer`]).
//! - All look-ups of a packet's patches happen after the same `make_room`.
//! - Lanes without points are skipped: their other numbers are unspecified.
//!
//! # The simpler form
//!
//! One block size for all levels: AVX-512 gains from long blocks, but at the baseline they slowed
//! one patch of factor 4 from 50 to 75 ns ([`CompactPoints::LONG_BLOCKS`]).
//!
//! One patch after another: a packet in which all patches are compact goes stage by stage instead,
//! with all look-ups first and, for integer factors, all points before all indices. Patch by patch,
//! a mispredicted branch in one stage also discards the work already begun on the next. Together
//! with permutes, stage by stage took `meshes/quads` from 0.16 to 0.25 of a fill
//! (`docs/experiments.md`). Fractional points take so long to compute that the stores of the
//! preceding indices are free.

use crate::data::format::{IndexFormat, OutputPoint};
use crate::data::lanes::LANES;
use crate::data::output::{Numbering, PatchRange};
use crate::data::point_writer::PointWriter;
use crate::data::writer::Writer;
use crate::stages::connect;
use crate::stages::packet::{OnePatch, Packet, PacketPatch, RawPair};
use crate::stages::points::{self, CompactPoints, LocationTables};
use crate::stages::settings::Settings;
use crate::stages::template::{CompactPoint, Start, Template, Templates, long, long_by_comparison};
use tess_core::{Domain, DomainPoint};

/// Packets to write.
#[derive(Debug)]
pub(crate) struct Packets<'a> {
    pub(crate) packets: &'a [Packet],
    pub(crate) first: Offsets,
    pub(crate) numbering: Numbering,
    /// Receives the place of each patch's output. Its length is the number of patches; the packets
    /// may have more lanes.
    pub(crate) ranges: &'a mut [PatchRange],
}

/// The points and indices of a batch before one of its patches: where that patch's output begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Offsets {
    pub(crate) points: u32,
    pub(crate) indices: u32,
}

/// Tables and templates, kept from patch to patch and from batch to batch. They depend only on the
/// configuration and the patches' factors.
#[derive(Clone, Debug)]
pub(crate) struct Caches {
    tables: LocationTables,
    templates: Templates,
}

impl Caches {
    /// Empty caches, which grow as they are used.
    pub(crate) const fn new() -> Self {
        Self { tables: LocationTables::EMPTY, templates: Templates::new() }
    }

    /// Bytes of heap memory.
    pub(crate) const fn bytes(&self) -> usize {
        self.tables.bytes() + self.templates.bytes()
    }

    /// Allocates all the memory that the caches may ever need.
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

/// Writes packets; returns where their output ends in the batch. The buffers have at least the room
/// for the packets' output; elements after it may be overwritten.
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
        // A single patch's lane was stored a moment ago: a load of all lanes would wait for it.
        if ranges.len() > 1 && packet.all_compact() {
            emit_compact(settings, (packet, ranges), numbering, caches, &mut out, compact_points);
            continue;
        }
        for (lane, range) in ranges.iter().enumerate().filter(|(_, range)| range.points != 0) {
            let patch = packet.patch(lane);
            let base = numbering.base(range.first_point);
            if patch.is_compact() {
                let Caches { tables, templates } = &mut *caches;
                let template = templates.find(patch, (settings, tables), M::stored);
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

/// The buffers of a single patch, and the state kept from patch to patch, in one structure so that
/// calls pass few arguments.
pub(crate) struct OneWriters<'a, W, I> {
    pub(crate) settings: &'a Settings,
    pub(crate) domain: Domain,
    pub(crate) points: W,
    /// The number of points that `points` has room for.
    pub(crate) most_points: usize,
    pub(crate) indices: &'a mut [I],
    pub(crate) one: &'a mut OnePatch,
    pub(crate) caches: &'a mut Caches,
}

/// Takes one patch ([`pairs`](crate::stages::packet::pairs)) through the front end, and writes it
/// if it is compact, not culled, and fits. Indices count from the patch's first point. Returns
/// whether it was written.
///
/// [`emit`] would give the same output, but sets up state that only large patches use.
#[inline(always)]
pub(crate) fn emit_one<W: PointWriter, I: IndexFormat, M: CompactPoints<W>>(
    to: &mut OneWriters<'_, W, I>,
    a: RawPair,
    b: RawPair,
    c: RawPair,
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
    let template = templates.find(patch, (settings, tables), M::stored);
    let template = templates.get(template);
    points_of(patch, template, points, compact_points);
    indices_of::<_, W, M>(patch, template, 0, &mut Writer::new(indices));
    true
}

/// Writes a packet of compact patches. All are looked up first, so that a mispredicted branch does
/// not discard a look-up.
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
    // `make_room` was called, so a template that is made here moves no other: all starts stay valid
    // to the end of this function.
    for (lane, _) in lanes.clone() {
        starts[lane] = templates.find(packet.patch(lane), (settings, tables), M::stored);
    }
    // Separate loops, so that neither keeps the other's constants in registers.
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
        out.map_least::<_, 24, 24>(length, points, long_by_comparison);
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

/// Writes a patch that is neither compact nor culled and whose first point is number `base`.
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
        connect::emit(settings, patch, base, &mut out.indices);
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
