//! The domain points of a patch, in order (spec section 6).
//!
//! Every run of points along an edge is one coordinate held and the other read from a table of
//! locations; seen from the other end a location is `ONE` minus itself.

mod isoline;
mod quad;
mod triangle;

use crate::block::Block;
use crate::emit::Writer;
use crate::factor_context::Contexts;
use crate::format::PointFormat;
use crate::lanes::{EdgePoints, MAX_FACTORS, factors};
use crate::place::Locations;
use tess_core::Domain;

/// Points written at a time.
const STEP: usize = 8;

/// Point counts of edges are below this.
const COUNTS: usize = 66;
/// A table for each point count, then one for each factor.
const SLOTS: usize = COUNTS + MAX_FACTORS;

/// Tables of locations that points are read from, kept from patch to patch.
///
/// Where factors are integers there is a table for each point count; otherwise one for each factor
/// of a patch, computed again only where that factor differs from the patch before. 27 KiB.
#[derive(Clone, Debug)]
pub(crate) struct LocationTables {
    /// What each table was computed for: see [`Block::key`]; 0 at first.
    keys: [u32; SLOTS],
    tables: [Locations; SLOTS],
}

/// The location tables of a patch's factors, in the order of the factors.
type Tables<'a> = [&'a Locations; MAX_FACTORS];

impl LocationTables {
    #[expect(clippy::large_stack_arrays, reason = "27 KiB, moved to its place once")]
    pub(crate) const EMPTY: Self = Self { keys: [0; SLOTS], tables: [Locations::EMPTY; SLOTS] };

    /// The number of the table that holds a factor's locations.
    #[inline(always)]
    fn prepare(
        &mut self,
        (block, contexts): (&Block, &Contexts),
        factor: usize,
        lane: usize,
    ) -> usize {
        let points = block.edge_points(factor, lane);
        let (slot, key) = if block.integer() {
            (points as usize % COUNTS, points)
        } else {
            (COUNTS + factor, block.key(factor, lane))
        };
        if self.keys[slot] != key {
            self.keys[slot] = key;
            self.tables[slot].fill(&block.context(contexts, factor, lane));
        }
        slot
    }
}

/// Emits the points of a regular patch of a block.
#[inline(always)]
pub(crate) fn emit<P: PointFormat>(
    (block, contexts): (&Block, &Contexts),
    lane: usize,
    edges: &EdgePoints,
    tables: &mut LocationTables,
    out: &mut Writer<'_, P>,
) {
    let domain = block.domain();
    let mut slots = [0; MAX_FACTORS];
    for (factor, slot) in slots.iter_mut().enumerate().take(factors(domain)) {
        *slot = tables.prepare((block, contexts), factor, lane);
    }
    let slot = |factor: usize| &tables.tables[slots[factor]];
    let tables = [slot(0), slot(1), slot(2), slot(3), slot(4), slot(5)];
    match domain {
        Domain::Isoline => isoline::emit(edges, tables, out),
        Domain::Triangle => triangle::emit(edges, tables, out),
        Domain::Quad => quad::emit(edges, tables, out),
    }
}

/// Emits `length` points made from consecutive locations.
#[inline(always)]
fn run<P: PointFormat>(
    out: &mut Writer<'_, P>,
    length: u32,
    locations: &[u32],
    point: impl Fn(u32) -> P,
) {
    out.map::<_, STEP>(length as usize, locations, point);
}
