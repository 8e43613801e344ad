//! The domain points of a patch, in order (spec section 6).
//!
//! Every run of points along an edge is one coordinate held and the other read from a table of
//! locations; seen from the other end a location is `ONE` minus itself.

mod isoline;
mod quad;
mod triangle;

use crate::block::Block;
use crate::emit::Writer;
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
/// of a patch, computed again only where that factor differs from the patch before. 32 KiB.
#[derive(Clone, Debug)]
pub(crate) struct LocationTables {
    /// What each table was computed for: a point count or [`Block::key`]; 0 at first.
    keys: [u32; SLOTS],
    tables: [Locations; SLOTS],
}

/// The location tables of a patch's factors, in the order of the factors.
type Tables<'a> = [&'a Locations; MAX_FACTORS];

impl LocationTables {
    #[expect(clippy::large_stack_arrays, reason = "32 KiB, moved to its place once")]
    pub(crate) const EMPTY: Self = Self { keys: [0; SLOTS], tables: [Locations::EMPTY; SLOTS] };

    /// Computes those tables of a patch that are not there yet.
    #[inline(always)]
    fn prepare(&mut self, block: &Block, lane: usize) {
        for factor in 0..factors(block.domain()) {
            let slot = slot(block, factor, lane);
            let key = if block.integer() {
                block.edge_points(factor, lane)
            } else {
                block.key(factor, lane)
            };
            if self.keys[slot] != key {
                self.keys[slot] = key;
                self.tables[slot].fill(&block.spacing(factor, lane));
            }
        }
    }
}

/// The number of the table that holds a factor's locations.
#[inline(always)]
fn slot(block: &Block, factor: usize, lane: usize) -> usize {
    if block.integer() {
        block.edge_points(factor, lane) as usize % COUNTS
    } else {
        COUNTS + factor
    }
}

/// Emits the points of a regular patch of a block.
#[inline(always)]
pub(crate) fn emit<P: PointFormat>(
    (block, lane): (&Block, usize),
    edges: &EdgePoints,
    tables: &mut LocationTables,
    out: &mut Writer<'_, P>,
) {
    tables.prepare(block, lane);
    let table = |factor: usize| &tables.tables[slot(block, factor, lane)];
    let tables = [table(0), table(1), table(2), table(3), table(4), table(5)];
    match block.domain() {
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
