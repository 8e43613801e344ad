//! Tables of locations, kept from patch to patch.

use crate::data::lanes::MAX_FACTORS;
use crate::stages::packet::PacketPatch;
use crate::stages::place::{Locations, Spacing};
use alloc::vec::Vec;

/// Point counts of edges are below this.
const COUNTS: usize = 66;
/// A table for each factor, then one for each point count.
const SLOTS: usize = MAX_FACTORS + COUNTS;

/// The tables of locations that points are read from.
///
/// Where factors are integers there is a table for each point count; otherwise one for each factor
/// of a patch, computed again only where that factor differs from the patch before. Up to 32 KiB.
#[derive(Clone, Debug)]
pub(crate) struct LocationTables {
    /// Each table's key: a point count or [`PacketPatch::key`]; 0 at first.
    keys: [u32; SLOTS],
    /// As many as slots are in use; empty at first.
    tables: Vec<Locations>,
}

/// The locations along each factor's edge or axis, in the order of the factors.
pub(crate) type FactorLocations<'a> = [&'a Locations; MAX_FACTORS];

impl LocationTables {
    pub(crate) const EMPTY: Self = Self { keys: [0; SLOTS], tables: Vec::new() };

    /// Bytes of memory that they take on the heap.
    pub(crate) const fn bytes(&self) -> usize {
        self.tables.capacity() * size_of::<Locations>()
    }

    /// Takes the memory of all tables.
    pub(crate) fn reserve(&mut self) {
        self.tables.resize(SLOTS, Locations::EMPTY);
    }

    /// The locations of a patch, computed where they are not there yet.
    #[inline(always)]
    pub(crate) fn of(&mut self, patch: PacketPatch<'_>) -> FactorLocations<'_> {
        let integer = patch.integer();
        let slot = |factor| {
            if integer { MAX_FACTORS + patch.edge_points(factor) as usize % COUNTS } else { factor }
        };
        for factor in 0..patch.domain().factors() {
            let slot = slot(factor);
            let key = if integer { patch.edge_points(factor) } else { patch.key(factor) };
            if self.keys[slot] != key {
                self.keys[slot] = key;
                self.fill(slot, &patch.spacing(factor));
            }
        }
        // Factors that the domain lacks may have no table.
        let table = |factor| self.tables.get(slot(factor)).unwrap_or(&Locations::EMPTY);
        [table(0), table(1), table(2), table(3), table(4), table(5)]
    }

    #[inline(always)]
    fn fill(&mut self, slot: usize, spacing: &Spacing) {
        if slot >= self.tables.len() {
            self.grow(slot);
        }
        if let Some(table) = self.tables.get_mut(slot) {
            table.fill(spacing);
        }
    }

    /// Makes the tables up to a slot.
    #[cold]
    #[inline(never)]
    fn grow(&mut self, slot: usize) {
        self.tables.resize(slot + 1, Locations::EMPTY);
    }
}
