//! A packet: sixteen patches side by side after factor processing, as in ray packets.
//!
//! The front end turns raw factors into what every later stage asks of a patch: point counts,
//! spacings, output sizes, topology. It does so for sixteen patches at a time, one patch in each
//! vector lane. `kernels/front_end` fills packets, `kernels/emit` takes them apart again, patch by
//! patch.
//!
//! # Data
//!
//! A *column* has one number for each factor of each lane, factor by factor, so that one factor of
//! all patches is one vector. *Lanes* have one number for each patch.
//!
//! ```text
//! Column: fixed, points, and of Spacings           Lanes: minimum, compact, counts, topologies,
//!         split, step, lag                                small
//!            lane 0   1      15                            lane 0   1      15
//! factor 0  [     0][ 1] .. [15]   quads: u = 0           [     0][ 1] .. [15]
//! factor 1  [    16][17] .. [31]          v = 0
//! factor 2  [    32][33] .. [47]          u = 1
//! factor 3  [    48][49] .. [63]          v = 1
//! factor 4  [    64][65] .. [79]          inside u
//! factor 5  [    80][81] .. [95]          inside v
//! ```
//!
//! The topology is one 64-bit number. Connectivity depends on nothing else; with integer factors
//! neither do points.
//!
//! ```text
//! bit    43   42..36    35..29    28..22    21..15    14..8     7..1        0
//!       +---+---------+---------+---------+---------+---------+---------+---------+
//!       | 1 | points of factor 0    2         3         4         5     | minimum |
//!       |   |         |    1    |         |         |         |         |  patch  |
//!       +---+---------+---------+---------+---------+---------+---------+---------+
//! ```
//!
//! # One patch
//!
//! The quad (3, 4.5, 5, 6; 4, 7) of `docs/tour-cpu.md`, `fractional_even`, in lane 0:
//!
//! ```text
//! factor       0        1        2        3        4        5
//! fixed    0x30000  0x48000  0x50000  0x60000  0x40000  0x70000
//! points       5        7        7        7        5        9     43 points, 186 indices, compact
//! topology 0x850_E1C3_8512 = 1 0000101 0000111 0000111 0000111 0000101 0001001 0
//! ```
//!
//! # What must hold
//!
//! - Factors that a domain lacks have no points, so topologies of two domains differ.
//! - A lane without a patch is culled: its raw factors are 0. Its counts are 0; everything else in
//!   it is unspecified, so callers skip lanes without points.
//! - [`PacketPatch::key`] tells two factors apart by their lowest bit too: location tables are
//!   reused by it.
//! - Compact patches have at most [`COMPACT_EDGE`] points along each edge; codes and templates have
//!   room for no more.
//!
//! # The simpler form
//!
//! Eight patches a packet were slower: half of the vector loads waited for two narrower stores. The
//! vector types of the crate `wide` take two to three times as long, because they choose their
//! instructions when they are compiled (`docs/experiments.md`). So lanes are plain arrays, and the
//! compiler makes vectors of each level's width.

mod one;

#[cfg(all(feature = "taps", feature = "apart"))]
pub(crate) use one::ROWS;
pub(crate) use one::{OnePatch, one_counts, pairs};

use crate::data::lanes::{Column, EdgePoints, Lanes, MAX_FACTORS, is_odd, set, set_rows};
use crate::stages::counts::{PacketCounts, counts};
use crate::stages::factor_context::{PlainContext, point_counts};
use crate::stages::factors::{Processed, process};
use crate::stages::place::{Spacing, Spacings};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};

/// The most points of an edge, or of a quad's inside factor, of a compact patch.
pub(crate) const COMPACT_EDGE: usize = 16;

/// The most points of the inside factor of a compact triangle.
pub(crate) const COMPACT_TRIANGLE_INSIDE: usize = 13;

/// Bits of the counts of a small topology.
const SMALL_BITS: u32 = 12;
/// Numbers of small topologies of both domains.
pub(crate) const SMALL_TOPOLOGIES: usize = 2 << SMALL_BITS;

/// Sixteen patches of one domain after factor processing, their output sizes known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Packet {
    config: Config,
    domain: Domain,
    fixed: Column,
    points: Column,
    /// Unspecified where factors are integers: see [`PacketPatch::spacing`].
    spacings: Spacings,
    minimum: Lanes,
    topologies: Lanes<u64>,
    /// See [`PacketPatch::small_topology`].
    small: Lanes,
    /// See [`PacketPatch::is_compact`].
    compact: Lanes,
    pub(crate) counts: PacketCounts,
}

impl Packet {
    /// A packet of culled patches.
    pub(crate) const EMPTY: Self = Self {
        config: Config::new(Partitioning::Integer, OutputPrimitive::Point),
        domain: Domain::Quad,
        fixed: [[0; _]; _],
        points: [[0; _]; _],
        spacings: Spacings::NONE,
        minimum: [0; _],
        topologies: [0; _],
        small: [0; _],
        compact: [0; _],
        counts: PacketCounts { points: [0; _], indices: [0; _] },
    };

    /// Processes the raw factors of a packet; zeros count as culled.
    ///
    /// Written in place; returning it would copy the packet.
    #[inline(always)]
    pub(crate) fn process(&mut self, config: Config, domain: Domain, raw: &Column<f32>) {
        use Domain::{Isoline, Quad, Triangle};
        // In each arm the domain and the number of rows are constants.
        match (domain, raw) {
            (Isoline, &[a, b, ..]) => self.process_lanes(config, Isoline, &[a, b]),
            (Triangle, &[a, b, c, d, ..]) => self.process_lanes(config, Triangle, &[a, b, c, d]),
            (Quad, all) => self.process_lanes(config, Quad, all),
        }
    }

    #[inline(always)]
    fn process_lanes<const F: usize>(
        &mut self,
        config: Config,
        domain: Domain,
        raw: &[Lanes<f32>; F],
    ) {
        self.counts = self.keep(config, domain, 0, &process(config.partitioning, domain, raw));
    }

    /// Makes all lanes, or the one with this number, from processed factors, but for their sizes,
    /// which it returns.
    #[inline(always)]
    fn keep<const L: usize, const F: usize>(
        &mut self,
        config: Config,
        domain: Domain,
        lane: usize,
        processed: &Processed<L, F>,
    ) -> PacketCounts<L> {
        let Processed { fixed, odd, minimum, .. } = processed;
        // Where factors are integers, few spacings are ever needed.
        let points = if config.partitioning.has_integer_factors() {
            point_counts(fixed, odd)
        } else {
            self.spacings.keep(lane, processed, config.split)
        };
        let mut edges = [[0; L]; MAX_FACTORS];
        edges[..domain.factors()].copy_from_slice(&points[..domain.factors()]);
        (self.config, self.domain) = (config, domain);
        set(&mut self.topologies, lane, topologies(&edges, minimum));
        set(&mut self.small, lane, small_topologies(config, domain, &edges, minimum));
        set(&mut self.compact, lane, compact(domain, &edges));
        set(&mut self.minimum, lane, *minimum);
        set_rows(&mut self.fixed, lane, fixed);
        set_rows(&mut self.points, lane, &edges);
        counts(config, domain, processed, &points)
    }

    /// Whether all of its patches are compact.
    #[inline(always)]
    pub(crate) fn all_compact(&self) -> bool {
        self.compact.iter().fold(1, |all, compact| all & compact) == 1
    }

    /// One of its patches.
    #[inline(always)]
    pub(crate) const fn patch(&self, lane: usize) -> PacketPatch<'_> {
        PacketPatch { packet: self, lane }
    }
}

/// Only the output sizes of a packet.
#[inline(always)]
pub(crate) fn packet_counts(config: Config, domain: Domain, raw: &Column<f32>) -> PacketCounts {
    #[inline(always)]
    fn of<const F: usize>(config: Config, domain: Domain, raw: &[Lanes<f32>; F]) -> PacketCounts {
        let processed = process(config.partitioning, domain, raw);
        let points = point_counts(&processed.fixed, &processed.odd);
        counts(config, domain, &processed, &points)
    }
    use Domain::{Isoline, Quad, Triangle};
    match (domain, raw) {
        (Isoline, &[a, b, ..]) => of(config, Isoline, &[a, b]),
        (Triangle, &[a, b, c, d, ..]) => of(config, Triangle, &[a, b, c, d]),
        (Quad, all) => of(config, Quad, all),
    }
}

/// One patch of a packet. Factors are numbered in the core's order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PacketPatch<'a> {
    packet: &'a Packet,
    lane: usize,
}

impl PacketPatch<'_> {
    /// Its domain.
    #[inline(always)]
    pub(crate) const fn domain(self) -> Domain {
        self.packet.domain
    }

    /// The number of its points; 0 if it is culled.
    #[inline(always)]
    pub(crate) const fn points(self) -> u32 {
        self.packet.counts.points[self.lane]
    }

    /// The number of its indices; 0 if it is culled.
    #[inline(always)]
    pub(crate) const fn indices(self) -> u32 {
        self.packet.counts.indices[self.lane]
    }

    /// Whether all factors are integers, so that a point count says all about a factor.
    #[inline(always)]
    pub(crate) const fn integer(self) -> bool {
        self.packet.config.partitioning.has_integer_factors()
    }

    /// Whether it is a minimum patch.
    #[inline(always)]
    pub(crate) const fn is_minimum(self) -> bool {
        self.packet.minimum[self.lane] == 1
    }

    /// Whether it is a quad or a triangle of which no edge has more than [`COMPACT_EDGE`] points;
    /// nor has a triangle's inside more than [`COMPACT_TRIANGLE_INSIDE`].
    #[inline(always)]
    pub(crate) const fn is_compact(self) -> bool {
        self.packet.compact[self.lane] == 1
    }

    /// A number for each topology of a domain, not 0.
    #[inline(always)]
    pub(crate) const fn topology(self) -> u64 {
        self.packet.topologies[self.lane]
    }

    /// Below [`SMALL_TOPOLOGIES`], another number for each topology, if each factor of a quad has
    /// one of the first four counts of its parity, of a triangle one of the first eight; others
    /// have larger numbers.
    #[inline(always)]
    pub(crate) const fn small_topology(self) -> usize {
        self.packet.small[self.lane] as usize
    }

    /// The point counts of its factors.
    #[inline(always)]
    pub(crate) const fn edges(self) -> EdgePoints {
        let Self { packet: Packet { points: [a, b, c, d, e, f], .. }, lane: i } = self;
        [a[i], b[i], c[i], d[i], e[i], f[i]]
    }

    /// The point count of one factor.
    #[inline(always)]
    pub(crate) const fn edge_points(self, factor: usize) -> u32 {
        self.packet.points[factor][self.lane]
    }

    /// A number, not 0, that differs for different contexts of one split order.
    #[inline(always)]
    pub(crate) const fn key(self, factor: usize) -> u32 {
        let Packet { fixed, points, .. } = self.packet;
        (fixed[factor][self.lane] << 1) | (points[factor][self.lane] & 1)
    }

    /// The spacing of one factor's points.
    #[inline(always)]
    pub(crate) fn spacing(self, factor: usize) -> Spacing {
        if self.integer() {
            let Packet { config, fixed, points, .. } = self.packet;
            let odd = u32::from(is_odd(points[factor][self.lane]));
            Spacing::new(&PlainContext::new(fixed[factor][self.lane], odd, config.split))
        } else {
            self.fractional_spacing(factor)
        }
    }

    /// [`Self::spacing`] where the partitioning is fractional.
    #[inline(always)]
    pub(crate) const fn fractional_spacing(self, factor: usize) -> Spacing {
        self.packet.spacings.get(factor, self.lane, self.edge_points(factor))
    }
}

/// A number for each topology: the point counts of all factors, after a leading 1, and whether it
/// is a minimum patch.
#[inline(always)]
fn topologies<const L: usize>(points: &[[u32; L]; MAX_FACTORS], minimum: &[u32; L]) -> [u64; L] {
    let mut topologies = [1; L];
    for points in points {
        for lane in 0..L {
            topologies[lane] = (topologies[lane] << 7) | u64::from(points[lane]);
        }
    }
    for lane in 0..L {
        topologies[lane] = (topologies[lane] << 1) | u64::from(minimum[lane]);
    }
    topologies
}

/// Two or three bits for each factor, the rank of its count among those that a factor can have;
/// then a bit for the domain, and bits that make the number too large. A minimum patch has ranks of
/// 0, which no other patch with the count of its inside has.
#[inline(always)]
fn small_topologies<const L: usize>(
    config: Config,
    domain: Domain,
    points: &[[u32; L]; MAX_FACTORS],
    minimum: &[u32; L],
) -> [u32; L] {
    let (bits, quad) = if domain == Domain::Quad { (2, 1 << SMALL_BITS) } else { (3, 0) };
    let fractional = u32::from(!config.partitioning.has_integer_factors());
    let mut small = [0; L];
    for points in &points[..domain.factors()] {
        for lane in 0..L {
            let place = points[lane].wrapping_sub(2) >> fractional;
            small[lane] = (small[lane] << bits) | place | ((place >> bits) << (SMALL_BITS + 1));
        }
    }
    for lane in 0..L {
        small[lane] = (small[lane] & minimum[lane].wrapping_sub(1)) | quad;
    }
    small
}

/// 1 where a patch is compact.
#[inline(always)]
fn compact<const L: usize>(domain: Domain, points: &[[u32; L]; MAX_FACTORS]) -> [u32; L] {
    let mut compact = [u32::from(domain != Domain::Isoline); L];
    for (factor, points) in points.iter().enumerate() {
        let inside = domain == Domain::Triangle && factor >= Domain::Triangle.outer_factors();
        let most = if inside { COMPACT_TRIANGLE_INSIDE } else { COMPACT_EDGE };
        for lane in 0..L {
            compact[lane] &= u32::from(points[lane] as usize <= most);
        }
    }
    compact
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::data::lanes::LANES;
    use crate::tour;
    use tess_core::QuadFactors;

    /// The numbers at the head of this file.
    #[test]
    fn the_worked_patch() {
        let packet = tour::packet();
        let patch = packet.patch(0);
        let fixed = packet.fixed.map(|lanes| lanes[0]);
        assert_eq!(fixed, [0x30000, 0x48000, 0x50000, 0x60000, 0x40000, 0x70000], "15.16");
        assert_eq!(patch.edges(), [5, 7, 7, 7, 5, 9], "points of the factors");
        assert_eq!((patch.points(), patch.indices()), (43, 186), "sizes");
        assert_eq!(patch.topology(), 0x850_E1C3_8512, "{:#b}", patch.topology());
        let parts = [1, 5, 7, 7, 7, 5, 9].into_iter().fold(0, |all, part| (all << 7) | part) << 1;
        assert_eq!(patch.topology(), parts, "a leading 1, the point counts, no minimum patch");
        assert!(patch.is_compact() && !patch.is_minimum(), "compact");
        assert_eq!(packet.patch(1).points(), 0, "a lane without a patch is culled");
    }

    /// A compact patch has at most 16 points along each edge, a triangle at most 13 inside.
    #[test]
    fn the_largest_compact_patches() {
        let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
        let is_compact = |domain, outer: f32, inside: f32| {
            let mut raw = [[0.0; LANES]; MAX_FACTORS];
            let outer_factors = if domain == Domain::Quad { 4 } else { 3 };
            for (factor, lanes) in raw.iter_mut().enumerate() {
                lanes[0] = if factor < outer_factors { outer } else { inside };
            }
            let mut packet = Packet::EMPTY;
            packet.process(config, domain, &raw);
            packet.patch(0).is_compact()
        };
        assert!(is_compact(Domain::Quad, 15.0, 15.0), "16 by 16 points");
        assert!(!is_compact(Domain::Quad, 16.0, 2.0) && !is_compact(Domain::Quad, 2.0, 16.0), "17");
        assert!(is_compact(Domain::Triangle, 15.0, 12.0), "13 points inside");
        assert!(!is_compact(Domain::Triangle, 2.0, 13.0), "14 points inside");
        assert!(!is_compact(Domain::Isoline, 2.0, 2.0), "isolines are not");
    }

    /// Topologies of two domains differ, even where all factors that both have are alike.
    #[test]
    fn topologies_of_domains_differ() {
        let [triangle, quad] = [Domain::Triangle, Domain::Quad].map(|domain| {
            let mut packet = Packet::EMPTY;
            packet.process(tour::CONFIG, domain, &[[4.0; LANES]; MAX_FACTORS]);
            packet.patch(0).topology()
        });
        assert_ne!(triangle, quad, "{:?}", QuadFactors::uniform(4.0));
    }
}
