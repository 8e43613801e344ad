//! Tables of locations, kept from patch to patch.

use crate::data::lanes::MAX_FACTORS;
use crate::stages::packet::PacketPatch;
use crate::stages::place::Locations;

/// Point counts of edges are below this.
const COUNTS: usize = 66;
/// A table for each point count, then one for each factor.
const SLOTS: usize = COUNTS + MAX_FACTORS;

/// The tables of locations that points are read from.
///
/// Where factors are integers there is a table for each point count; otherwise one for each factor
/// of a patch, computed again only where that factor differs from the patch before. 32 KiB.
#[derive(Clone, Debug)]
pub(crate) struct LocationTables {
    /// What each table was computed for: a point count or [`PacketPatch::key`]; 0 at first.
    keys: [u32; SLOTS],
    tables: [Locations; SLOTS],
}

/// The locations along each factor's edge or axis, in the order of the factors.
pub(super) type FactorLocations<'a> = [&'a Locations; MAX_FACTORS];

impl LocationTables {
    #[expect(clippy::large_stack_arrays, reason = "32 KiB, moved to its place once")]
    pub(crate) const EMPTY: Self = Self { keys: [0; SLOTS], tables: [Locations::EMPTY; SLOTS] };

    /// The locations of a patch, computed where they are not there yet.
    #[inline(always)]
    pub(super) fn of(&mut self, patch: PacketPatch<'_>) -> FactorLocations<'_> {
        let integer = patch.integer();
        let slot = |factor| {
            if integer { patch.edge_points(factor) as usize % COUNTS } else { COUNTS + factor }
        };
        for factor in 0..patch.domain().factors() {
            let slot = slot(factor);
            let key = if integer { patch.edge_points(factor) } else { patch.key(factor) };
            if self.keys[slot] != key {
                self.keys[slot] = key;
                self.tables[slot].fill(&patch.spacing(factor));
            }
        }
        let table = |factor| &self.tables[slot(factor)];
        [table(0), table(1), table(2), table(3), table(4), table(5)]
    }
}
