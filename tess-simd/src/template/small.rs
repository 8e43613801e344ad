//! Templates of small patches, of which many topologies are kept.
//!
//! Indices are bytes. Points are copied where the topology decides them, else looked up
//! ([`Coordinates`](crate::points::Coordinates)).

use super::{PADDING, write_minimum};
use crate::block::BlockPatch;
use crate::connect;
use crate::points::{self, Code, EDGE, LocationTables, fixed_code};
use crate::setup::Setup;
use crate::writer::Writer;
use alloc::vec::Vec;
use tess_core::{Config, DomainPoint};

/// The most points and indices of a small patch: a quad's whose edges have [`EDGE`] points.
const POINTS: usize = EDGE * EDGE;
const INDICES: usize = 6 * (EDGE - 1) * (EDGE - 1);

/// Sets of slots. A topology belongs to one of them, and may be in any slot of it.
const SETS: usize = 2048;
/// Slots of a set. Topologies that find none free replace each other.
const WAYS: usize = 4;
/// Indices of all templates.
const INDEX_ROOM: usize = 224 << 10;
/// Points of all templates.
const POINT_ROOM: usize = 64 << 10;

/// The templates of one configuration. 864 KiB for integer partitionings, 480 KiB for others.
#[derive(Clone, Debug)]
pub(crate) struct SmallTemplates {
    sets: Vec<Set>,
    /// The slot that is filled next, of any set.
    way: usize,
    indices: Vec<u8>,
    indices_used: usize,
    /// Points of integer partitionings.
    points: Vec<DomainPoint>,
    /// Codes of points of the others.
    codes: Vec<Code>,
    points_used: usize,
}

/// Where the templates of some topologies begin.
#[derive(Clone, Copy, Debug)]
struct Set {
    /// See [`BlockPatch::topology`]; 0 if there is none.
    topologies: [u64; WAYS],
    starts: [Start; WAYS],
}

/// Where a template begins.
#[derive(Clone, Copy, Debug)]
struct Start {
    point: u32,
    index: u32,
}

impl Set {
    const EMPTY: Self =
        Self { topologies: [0; WAYS], starts: [Start { point: 0, index: 0 }; WAYS] };

    /// The slot of a topology, without branches; [`WAYS`] if it has none.
    #[inline(always)]
    fn find(&self, topology: u64) -> usize {
        let mut found = WAYS;
        for (way, &other) in self.topologies.iter().enumerate() {
            found = if other == topology { way } else { found };
        }
        found
    }
}

/// One patch's template.
#[derive(Clone, Copy, Debug)]
pub(crate) struct SmallTemplate<'a> {
    /// Indices counted from the patch's first point, and then unspecified ones.
    pub(crate) indices: &'a [u8],
    /// Points, and then unspecified ones; only if the partitioning is integer.
    pub(crate) points: &'a [DomainPoint],
    /// Codes of points, and then unspecified ones; only if the partitioning is not.
    pub(crate) codes: &'a [Code],
}

impl SmallTemplates {
    pub(crate) fn new(config: Config) -> Self {
        let integer = config.partitioning.has_integer_factors();
        let (points, codes) = if integer { (POINT_ROOM, 0) } else { (0, POINT_ROOM) };
        Self {
            sets: alloc::vec![Set::EMPTY; SETS],
            way: 0,
            indices: alloc::vec![0; INDEX_ROOM],
            indices_used: 0,
            points: alloc::vec![DomainPoint::default(); points],
            codes: alloc::vec![Code::default(); codes],
            points_used: 0,
        }
    }

    /// Bytes of memory that they take on the heap.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(&self.sets[..])
            + self.indices.len()
            + size_of_val(&self.points[..])
            + size_of_val(&self.codes[..])
    }

    /// The template of a small patch that is not culled.
    #[inline(always)]
    pub(crate) fn get(
        &mut self,
        setup: &Setup,
        patch: BlockPatch<'_>,
        tables: &mut LocationTables,
    ) -> SmallTemplate<'_> {
        let topology = patch.topology();
        let set = set(topology);
        let Start { point, index } = match self.sets[set].starts.get(self.sets[set].find(topology))
        {
            Some(&start) => start,
            None => self.make(setup, patch, tables),
        };
        SmallTemplate {
            indices: self.indices.get(index as usize..).unwrap_or_default(),
            points: self.points.get(point as usize..).unwrap_or_default(),
            codes: self.codes.get(point as usize..).unwrap_or_default(),
        }
    }

    /// Makes a template; if there is no room, all others are forgotten.
    #[cold]
    #[inline(never)]
    #[expect(clippy::cast_possible_truncation, reason = "places in the room; indices below 256")]
    fn make(&mut self, setup: &Setup, patch: BlockPatch<'_>, tables: &mut LocationTables) -> Start {
        let (points, indices) = (patch.points() as usize, patch.indices() as usize);
        let full = self.indices_used + indices + PADDING > INDEX_ROOM
            || self.points_used + points + PADDING > POINT_ROOM;
        if full {
            self.sets.fill(Set::EMPTY);
            (self.indices_used, self.points_used) = (0, 0);
        }
        let mut wide = [0_u16; INDICES.next_multiple_of(32)];
        self.write_points(setup, patch, tables, &mut wide);
        if !patch.is_minimum() {
            connect::emit(setup, patch, 0, &mut Writer::new(&mut wide));
        }
        for (narrow, wide) in self.indices[self.indices_used..].iter_mut().zip(&wide[..indices]) {
            *narrow = *wide as u8;
        }
        let start = Start { point: self.points_used as u32, index: self.indices_used as u32 };
        let set = &mut self.sets[set(patch.topology())];
        let way = set.topologies.iter().position(|&topology| topology == 0).unwrap_or(self.way);
        set.topologies[way] = patch.topology();
        set.starts[way] = start;
        self.way = (way + 1) % WAYS;
        self.indices_used += indices;
        self.points_used += points;
        start
    }

    /// Writes a patch's points or their codes, and a minimum patch's indices.
    fn write_points(
        &mut self,
        setup: &Setup,
        patch: BlockPatch<'_>,
        tables: &mut LocationTables,
        indices: &mut [u16],
    ) {
        let (used, count) = (self.points_used, patch.points() as usize);
        let mut made = [DomainPoint::default(); POINTS + EDGE];
        if patch.is_minimum() {
            write_minimum(setup.config, patch.domain(), &mut made, indices);
        } else if patch.integer() {
            points::emit(patch, tables, &mut Writer::new(&mut made));
        }
        if patch.integer() {
            self.points[used..used + count].copy_from_slice(&made[..count]);
        } else if patch.is_minimum() {
            for (code, corner) in self.codes[used..].iter_mut().zip(&made[..count]) {
                *code = fixed_code([corner.u.to_bits(), corner.v.to_bits()]);
            }
        } else {
            points::codes(&patch.edges(), &mut self.codes[used..]);
        }
    }
}

/// The set of a topology: the upper bits of a product with 2^64 over the golden ratio, into which the
/// outer factors' bits are folded first.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the upper eleven bits")]
const fn set(topology: u64) -> usize {
    let folded = topology ^ (topology >> 21);
    (folded.wrapping_mul(0x9E37_79B9_7F4A_7C15) >> (64 - SETS.ilog2())) as usize % SETS
}
