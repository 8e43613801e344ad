//! Templates of compact patches: thousands of topologies, with indices of one byte.
//!
//! A compact patch's indices follow from its topology, and so do its points (integer factors) or their codes
//! (fractional ones). `kernels/emit` looks the topology up and copies; a topology that is new is made once, by the
//! stages that larger patches go through.
//!
//! # Data
//!
//! ```text
//! sets (32, 256, 2048)  topology * 2^64 / golden ratio, upper 5, 8, 11 bits
//!  +--------------------------------+--------------------------------------+
//!  | topologies: 4 x u64, 0 = empty | starts: 4 x (point: u32, index: u32) |
//!  +--------------------------------+--------------|-------------|---------+
//!                                                  v             |
//! points (64 Ki of [u16; 2])  [ ... | patch's coordinates, or what CompactPoints keeps of codes | ... ]
//!                                                                v
//! indices (224 Ki of u8)      [ ... | indices from the patch's first point, in the order to write | ... ]
//! ```
//!
//! Memory is taken as templates are made: the first one makes 32 sets and a kilobyte or four of either room. A room
//! that is full doubles. Where a topology finds its set full, there are eight times as many sets from then on, as
//! long as there are fewer than 2048.
//!
//! Both rooms are filled from front to back. [`CompactTemplates::make_room`], before each packet, forgets
//! everything if the largest sixteen patches might not fit. Coordinates of integer factors are 16.16 numbers with
//! `ONE` as 0xFFFF ([`short`], [`long`]).
//!
//! # One patch
//!
//! The quad (3, 4.5, 5, 6; 4, 7) of `docs/tour-cpu.md`, clockwise triangles:
//!
//! ```text
//! topology 0x850_E1C3_8512    set 6 of 32 (55 of 256, 444 of 2048), slot 0
//! 43 codes                    [0000, 8000] [0000, 8020] [0000, 8040] ...
//! 186 indices                 0 1 22  22 1 23  23 1 24 ...
//! ```
//!
//! # What must hold
//!
//! - `make_room` is called before a packet's first [`CompactTemplates::find`], and a [`Start`] is used before the
//!   next `make_room`. Otherwise a template is cut off, or read after others have overwritten it.
//! - [`PADDING`] elements behind the last template can be read: whole blocks are copied.
//! - `forget` empties the sets and both rooms together. With the sets kept, old topologies would find new
//!   templates.
//! - A set is the upper bits of one number, so that the topologies of a set share no new set with others when sets
//!   become more, and all of them find a slot.
//! - Whatever changes templates without changing the topology (order of triangles, [`Kept`]) belongs to one
//!   tessellator for good, or `Workspaces::forget` is called.
//! - An index is below 256: a compact patch has at most 16 by 16 points.
//!
//! # The simpler form
//!
//! The templates of larger patches (`template.rs`) have 1024 slots, a 16-bit index and one way. `mosaic` has 4096
//! topologies, which then replace each other. A triangle's inside is compact up to 13 points only, so that its
//! codes have room for all rings. With AVX2, templates whose points are still copied in runs were slower than
//! none: `character` took 1.4 times as long (`docs/experiments.md`).

use super::room::Room;
use super::write_minimum;
use crate::data::format::OutputPoint;
use crate::data::lanes::LANES;
use crate::data::writer::Writer;
use crate::stages::connect::{self, cache_order};
use crate::stages::packet::COMPACT_EDGE;
use crate::stages::packet::PacketPatch;
use crate::stages::points::{self, LocationTables, corner};
use crate::stages::settings::Settings;
use alloc::vec::Vec;
use tess_core::{Domain, DomainPoint};

/// The most points and indices of a compact patch: a quad's whose edges have [`COMPACT_EDGE`] points.
const POINTS: usize = COMPACT_EDGE * COMPACT_EDGE;
const INDICES: usize = 6 * (COMPACT_EDGE - 1) * (COMPACT_EDGE - 1);

/// The most sets of slots. A topology belongs to one of them, and may be in any slot of it.
const SETS: usize = 2048;
/// Sets at first, and by how much they become more.
const FIRST_SETS: usize = 32;
const MORE_SETS: usize = 8;
/// Slots of a set. Topologies that find none free replace each other.
const WAYS: usize = 4;
/// Indices of all templates.
const INDEX_ROOM: usize = 224 << 10;
/// Points of all templates.
const POINT_ROOM: usize = 64 << 10;

/// The templates of one configuration. They take memory as they are made, at most 608 KiB.
#[derive(Clone, Debug)]
pub(crate) struct CompactTemplates {
    /// None before the first template, then a power of two.
    sets: Vec<Set>,
    /// Bits of a topology's number that say nothing about its set.
    other_bits: u32,
    /// The slot that is filled next, of any set that is full.
    way: usize,
    indices: Room<u8, INDEX_ROOM>,
    points: Room<CompactPoint, POINT_ROOM>,
}

/// Where the templates of some topologies begin.
#[derive(Clone, Copy, Debug)]
struct Set {
    /// See [`PacketPatch::topology`]; 0 if there is none.
    topologies: [u64; WAYS],
    starts: [Start; WAYS],
}

/// What is kept of a code: see [`points::CompactPoints::kept`].
pub(crate) type Kept = fn(Domain, u16) -> u16;

/// A point of a template: its coordinates if factors are integers ([`short`]), otherwise its code.
type CompactPoint = [u16; 2];

/// Where a template begins.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Start {
    point: u32,
    index: u32,
}

impl Set {
    const EMPTY: Self =
        Self { topologies: [0; WAYS], starts: [Start { point: 0, index: 0 }; WAYS] };

    /// The slot of a topology; [`WAYS`] or more if it has none.
    #[inline(always)]
    fn find(&self, topology: u64) -> usize {
        let mut found = 0_u32;
        for (way, &other) in self.topologies.iter().enumerate() {
            found |= u32::from(other == topology) << way;
        }
        found.trailing_zeros() as usize
    }

    /// A slot that no topology has.
    fn free(&self) -> Option<usize> {
        self.topologies.iter().position(|&topology| topology == 0)
    }
}

/// One patch's template.
#[derive(Clone, Copy, Debug)]
pub(crate) struct CompactTemplate<'a> {
    /// Indices counted from the patch's first point, and then unspecified ones.
    pub(crate) indices: &'a [u8],
    /// Points, and then unspecified ones.
    pub(crate) points: &'a [CompactPoint],
}

impl CompactTemplates {
    /// No templates, and no memory for any.
    pub(crate) const fn new() -> Self {
        let other_bits = u64::BITS - FIRST_SETS.ilog2();
        Self { sets: Vec::new(), other_bits, way: 0, indices: Room::new(), points: Room::new() }
    }

    /// Bytes of memory that they take on the heap.
    pub(crate) const fn bytes(&self) -> usize {
        self.sets.capacity() * size_of::<Set>() + self.indices.bytes() + self.points.bytes()
    }

    /// Takes all the memory that they may ever need.
    pub(crate) fn reserve(&mut self) {
        while self.sets.len() < SETS {
            self.make_sets();
        }
        self.indices.reserve();
        self.points.reserve();
    }

    /// Makes room for the templates of a packet; if there is none, all others are forgotten.
    #[inline(always)]
    pub(crate) fn make_room(&mut self) {
        if !(self.indices.fits(LANES * INDICES) && self.points.fits(LANES * POINTS)) {
            self.forget();
        }
    }

    #[cold]
    fn forget(&mut self) {
        self.sets.fill(Set::EMPTY);
        self.indices.clear();
        self.points.clear();
    }

    /// Where the template of a compact patch that is not culled begins. It is made if there is none.
    #[inline(always)]
    pub(crate) fn find(
        &mut self,
        settings: &Settings,
        patch: PacketPatch<'_>,
        tables: &mut LocationTables,
        kept: Kept,
    ) -> Start {
        let topology = patch.topology();
        let set = self.sets.get(self.set(topology));
        match set.and_then(|set| set.starts.get(set.find(topology))) {
            Some(&start) => start,
            None => self.make(settings, patch, tables, kept),
        }
    }

    /// The set of a topology, if there are sets.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "the upper eleven bits at most")]
    const fn set(&self, topology: u64) -> usize {
        (number(topology) >> self.other_bits) as usize
    }

    /// The template that begins here, found since there was room made last.
    #[inline(always)]
    pub(crate) fn get(&self, Start { point, index }: Start) -> CompactTemplate<'_> {
        CompactTemplate { indices: self.indices.from(index), points: self.points.from(point) }
    }

    /// Makes a template, for which there is room.
    #[cold]
    #[inline(never)]
    #[expect(clippy::cast_possible_truncation, reason = "indices below 256")]
    fn make(
        &mut self,
        settings: &Settings,
        patch: PacketPatch<'_>,
        tables: &mut LocationTables,
        kept: Kept,
    ) -> Start {
        let (points, indices) = (patch.points() as usize, patch.indices() as usize);
        let mut wide = [0_u16; INDICES.next_multiple_of(32)];
        self.write_points(settings, patch, tables, &mut wide);
        if !patch.integer() {
            let codes = &mut self.points.free(points)[..points];
            for coordinate in codes.as_flattened_mut() {
                *coordinate = kept(patch.domain(), *coordinate);
            }
        }
        if !patch.is_minimum() {
            connect::emit(settings, patch, 0, &mut Writer::new(&mut wide));
        }
        let mut to = self.indices.free(indices).iter_mut();
        cache_order::runs(settings, patch, |run| {
            for (wide, narrow) in wide[run].iter().zip(to.by_ref()) {
                *narrow = *wide as u8;
            }
        });
        let start = Start { point: self.points.take(points), index: self.indices.take(indices) };
        self.enter(patch.topology(), start);
        start
    }

    /// Enters a topology that has no slot. There are more sets afterwards if its set is full and there can be.
    fn enter(&mut self, topology: u64, start: Start) {
        let free = loop {
            let set = self.sets.get(self.set(topology));
            let free = set.and_then(|set| set.free());
            if free.is_some() || self.sets.len() == SETS {
                break free;
            }
            self.make_sets();
        };
        let way = free.unwrap_or(self.way);
        self.way = (way + 1) % WAYS;
        let set = self.set(topology);
        self.sets[set].topologies[way] = topology;
        self.sets[set].starts[way] = start;
    }

    /// Makes the first sets, or more of them, and enters the topologies that there are.
    fn make_sets(&mut self) {
        let sets = (self.sets.len() * MORE_SETS).max(FIRST_SETS);
        let before = core::mem::replace(&mut self.sets, alloc::vec![Set::EMPTY; sets]);
        self.other_bits = u64::BITS - sets.ilog2();
        for Set { topologies, starts } in before {
            for (topology, start) in topologies.into_iter().zip(starts).filter(|entry| entry.0 != 0)
            {
                self.enter(topology, start);
            }
        }
    }

    /// Writes a patch's points or their codes, and a minimum patch's indices.
    fn write_points(
        &mut self,
        settings: &Settings,
        patch: PacketPatch<'_>,
        tables: &mut LocationTables,
        indices: &mut [u16],
    ) {
        let count = patch.points() as usize;
        let mut made = [DomainPoint::default(); POINTS + COMPACT_EDGE];
        if patch.is_minimum() {
            write_minimum(settings.config, patch.domain(), &mut made, indices);
        } else if patch.integer() {
            points::emit(patch, tables, &mut Writer::new(&mut made));
        }
        let (to, domain) = (&mut self.points.free(count)[..count], patch.domain());
        if patch.integer() {
            for (to, point) in to.iter_mut().zip(made) {
                *to = short(point);
            }
            return;
        }
        if patch.is_minimum() {
            for (to, point) in to.iter_mut().zip(made) {
                *to = corner(domain, point);
            }
        } else {
            points::codes(domain, &patch.edges(), to);
        }
    }
}

/// A point of a compact patch of integer factors in half the room. `ONE` becomes the largest number, which
/// no coordinate is.
#[expect(clippy::cast_possible_truncation, reason = "16.16 numbers up to ONE")]
fn short(point: DomainPoint) -> CompactPoint {
    [point.u, point.v].map(|coordinate| coordinate.to_bits().min(u32::from(u16::MAX)) as u16)
}

/// The point that [`short`] shortened.
#[inline(always)]
pub(crate) fn long<P: OutputPoint>(point: CompactPoint) -> P {
    let [u, v] = point.map(|coordinate| {
        let bits = u32::from(coordinate);
        bits + ((bits + 1) >> 16)
    });
    P::from_bits(u, v)
}

/// The number of which a topology's set is the upper bits: a product with 2^64 over the golden ratio, into
/// which the outer factors' bits are folded first.
#[inline(always)]
const fn number(topology: u64) -> u64 {
    (topology ^ (topology >> 21)).wrapping_mul(0x9E37_79B9_7F4A_7C15)
}

#[cfg(all(test, feature = "std"))]
mod tests {
    use super::*;
    use crate::stages::settings::Settings;
    use crate::tour;

    /// The numbers at the head of this file.
    #[test]
    fn the_worked_patch() {
        let packet = tour::packet();
        let patch = packet.patch(0);
        let settings = Settings::new(tour::CONFIG);
        let mut tables = LocationTables::EMPTY;
        let mut templates = CompactTemplates::new();
        let start = templates.find(&settings, patch, &mut tables, |_, code| code);
        for (set, sets) in [(6, 32), (55, 256), (444, 2048)] {
            assert_eq!(templates.sets.len(), sets, "sets");
            assert_eq!(templates.set(patch.topology()), set, "its set");
            assert_eq!(templates.sets[set].find(patch.topology()), 0, "its slot");
            if sets < SETS {
                templates.make_sets();
            }
        }
        let template = templates.get(start);
        assert_eq!(template.points[..43], tour::all_codes()[..], "codes");
        assert_eq!(template.indices[..9], [0, 1, 22, 22, 1, 23, 23, 1, 24], "indices");
        let used = (templates.points.used(), templates.indices.used());
        assert_eq!(used, (43, 186), "room that is used");
        templates.forget();
        assert_eq!(templates.sets[444].find(patch.topology()), 32, "forgotten");
    }

    /// Coordinates of integer factors keep their bits in half the room. 0xFFFF is none of them.
    #[test]
    fn shortened_points() {
        for bits in [0, 0x0444, 0x8000, 0xFBBC, 0x1_0000] {
            let point = DomainPoint::from_bits(bits, 0x1_0000 - bits);
            assert_eq!(long::<DomainPoint>(short(point)), point, "{bits:#x}");
        }
    }
}
