//! Templates of patches.
//!
//! A patch's indices, counted from its first point, depend on its point counts alone. With integer factors so do its
//! points. So a topology's output is kept and copied for later patches: always up to 289 points, and for larger
//! patches if the large patch before had the same topology. The stages that write large patches make the
//! templates. Compact patches have templates in another form (`compact`).

mod compact;
mod room;

pub(crate) use compact::{CompactTemplate, CompactTemplates, Start, long};

use crate::data::writer::Writer;
use crate::stages::connect::{self, cache_order};
use crate::stages::packet::PacketPatch;
use crate::stages::points::{self, LocationTables};
use crate::stages::settings::Settings;
use alloc::vec::Vec;
use room::Room;
use tess_core::{Config, Domain, DomainPoint, Patch, PatchFactors};

/// The most points of a patch whose template is kept from the first one on: a quad of factor 16 has this many.
const ALWAYS_KEPT: usize = 17 * 17;

/// Templates kept at a time. Two topologies that share a slot replace each other.
const SLOTS: usize = 1024;
/// Indices of all templates.
const INDEX_ROOM: usize = 96 << 10;
/// Points of all templates.
const POINT_ROOM: usize = 24 << 10;
/// The templates of one configuration. They take memory as they are made, at most 400 KiB.
#[derive(Clone, Debug)]
pub(crate) struct Templates {
    /// [`SLOTS`], but none before the first template.
    slots: Vec<Slot>,
    /// Topology of the last large patch that had no template.
    last_large: u64,
    indices: Room<u16, INDEX_ROOM>,
    points: Room<DomainPoint, POINT_ROOM>,
}

/// Where a template begins.
#[derive(Clone, Copy, Debug)]
struct Slot {
    /// See [`PacketPatch::topology`]; 0 if there is none.
    topology: u64,
    point: u32,
    index: u32,
}

impl Slot {
    const EMPTY: Self = Self { topology: 0, point: 0, index: 0 };
}

/// One patch's template.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Template<'a> {
    /// Indices counted from the patch's first point, and then unspecified ones.
    pub(crate) indices: &'a [u16],
    /// Points, and then unspecified ones; only if the topology decides them.
    pub(crate) points: Option<&'a [DomainPoint]>,
}

impl Templates {
    /// No templates, and no memory for any.
    pub(crate) const fn new() -> Self {
        Self { slots: Vec::new(), last_large: 0, indices: Room::new(), points: Room::new() }
    }

    /// Bytes of memory that they take on the heap.
    pub(crate) const fn bytes(&self) -> usize {
        self.slots.capacity() * size_of::<Slot>() + self.indices.bytes() + self.points.bytes()
    }

    /// Takes all the memory that they may ever need.
    pub(crate) fn reserve(&mut self) {
        self.slots.resize(SLOTS, Slot::EMPTY);
        self.indices.reserve();
        self.points.reserve();
    }

    /// The template of a patch that is not culled, if there is one or should be.
    #[inline(always)]
    pub(crate) fn get(
        &mut self,
        settings: &Settings,
        patch: PacketPatch<'_>,
        tables: &mut LocationTables,
    ) -> Option<Template<'_>> {
        let topology = patch.topology();
        let found = self.slots.get(slot(topology)).copied();
        let Slot { point, index, .. } = match found.filter(|slot| slot.topology == topology) {
            Some(slot) => slot,
            None if self.wanted(patch) => self.make(settings, patch, tables),
            None => return None,
        };
        let decided = patch.integer() || patch.is_minimum();
        Some(Template {
            indices: self.indices.from(index),
            points: decided.then(|| self.points.from(point)),
        })
    }

    /// Whether a patch is not large or like the large patch before.
    #[inline(always)]
    fn wanted(&mut self, patch: PacketPatch<'_>) -> bool {
        let topology = patch.topology();
        patch.points() as usize <= ALWAYS_KEPT
            || core::mem::replace(&mut self.last_large, topology) == topology
    }

    /// The indices of a patch without a template, counted from its first point and in the specification's
    /// order, and then unspecified ones.
    #[inline(never)]
    pub(crate) fn specified(&mut self, settings: &Settings, patch: PacketPatch<'_>) -> &[u16] {
        self.make_room(0, patch.indices() as usize);
        let room = self.indices.free(patch.indices() as usize);
        connect::emit(settings, patch, 0, &mut Writer::new(room));
        room
    }

    /// Makes room for a template; if there is none, all others are forgotten.
    fn make_room(&mut self, points: usize, indices: usize) {
        if !(self.indices.fits(indices) && self.points.fits(points)) {
            self.slots.iter_mut().for_each(|slot| slot.topology = 0);
            self.indices.clear();
            self.points.clear();
        }
    }

    /// Makes a template.
    #[cold]
    #[inline(never)]
    fn make(
        &mut self,
        settings: &Settings,
        patch: PacketPatch<'_>,
        tables: &mut LocationTables,
    ) -> Slot {
        let (points, indices) = (patch.points() as usize, patch.indices() as usize);
        self.make_room(points, 2 * indices);
        let index_room = self.indices.free(2 * indices);
        let point_room = self.points.free(points);
        if patch.is_minimum() {
            write_minimum(settings.config, patch.domain(), point_room, index_room);
        } else {
            write_indices(settings, patch, index_room);
            if patch.integer() {
                points::emit(patch, tables, &mut Writer::new(point_room));
            }
        }
        let topology = patch.topology();
        let made =
            Slot { topology, point: self.points.take(points), index: self.indices.take(indices) };
        self.slots.resize(SLOTS, Slot::EMPTY);
        self.slots[slot(topology)] = made;
        made
    }
}

/// Writes a patch's indices in their order; the room behind them is overwritten.
fn write_indices(settings: &Settings, patch: PacketPatch<'_>, room: &mut [u16]) {
    if !cache_order::reorders(settings, patch) {
        return connect::emit(settings, patch, 0, &mut Writer::new(room));
    }
    let (ordered, specified) = room.split_at_mut(patch.indices() as usize);
    connect::emit(settings, patch, 0, &mut Writer::new(specified));
    cache_order::emit(settings, patch, specified, &mut Writer::new(ordered), |index| index);
}

/// Where a topology's template is kept: the upper bits of a product with 2^64 over the golden ratio.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the upper ten bits")]
const fn slot(topology: u64) -> usize {
    (topology.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> (64 - SLOTS.ilog2())) as usize % SLOTS
}

/// Writes the minimum patch of a domain, as the core makes it.
#[expect(clippy::cast_possible_truncation, reason = "indices of at most 4 points")]
fn write_minimum(config: Config, domain: Domain, points: &mut [DomainPoint], indices: &mut [u16]) {
    let mut wide = [0; 8];
    let written = Patch::new(config, PatchFactors::uniform(domain, 1.0)).write(points, &mut wide);
    debug_assert!(written.is_ok(), "a minimum patch has at most 4 points and 6 indices");
    for (narrow, wide) in indices.iter_mut().zip(wide) {
        *narrow = wide as u16;
    }
}
