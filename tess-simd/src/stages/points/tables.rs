//! Tables of locations, kept from patch to patch.

use crate::data::lanes::MAX_FACTORS;
use crate::stages::packet::PacketPatch;
use crate::stages::place::{Locations, Spacing};
use alloc::vec::Vec;

/// Point counts of edges are below this.
const COUNTS: usize = 66;
/// A table for each factor, then one for each point count.
const SLOTS: usize = MAX_FACTORS + COUNTS;

/// The tables from which the locations of points are read. Up to 32 KiB.
///
/// With integer factors there is a table for each point count. Otherwise there is one for each
/// factor of a patch, computed again only if the factor differs from the previous patch's.
#[derive(Clone, Debug)]
pub(crate) struct LocationTables {
    /// Each table's key: a point count or [`PacketPatch::key`]; 0 if the table is unused.
    keys: [u32; SLOTS],
    /// The tables up to the last slot in use.
    tables: Vec<Locations>,
}

/// The locations along each factor's edge or axis, in the order of the factors.
pub(crate) type FactorLocations<'a> = [&'a Locations; MAX_FACTORS];

impl LocationTables {
    pub(crate) const EMPTY: Self = Self { keys: [0; SLOTS], tables: Vec::new() };

    /// Bytes of heap memory.
    pub(crate) const fn bytes(&self) -> usize {
        self.tables.capacity() * size_of::<Locations>()
    }

    /// Allocates the memory of all tables.
    pub(crate) fn reserve(&mut self) {
        self.tables.resize(SLOTS, Locations::EMPTY);
    }

    /// The locations of a patch, computed if they are not in a table yet.
    #[inline(always)]
    pub(crate) fn of(&mut self, patch: PacketPatch<'_>) -> FactorLocations<'_> {
        let integer = patch.integer();
        let slot = |factor| {
            if integer { MAX_FACTORS + patch.edge_points(factor) as usize % COUNTS } else { factor }
        };
        // Integer factors: a table is made once for each point count and never again. Fractional
        // factors: comparing keys costs little, and saves each table that the previous patch had.
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
