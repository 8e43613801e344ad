//! A packet: sixteen patches side by side after factor processing, as in ray packets.
//!
//! The front end turns raw factors into the numbers that every later stage needs of a patch: point
//! counts, spacings, output sizes, topology. It does so for sixteen patches at a time, one patch in
//! each vector lane. `kernels/front_end` fills packets; `kernels/emit` reads them patch by patch.
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
//! The topology is one 64-bit number. The connectivity depends on nothing else; with integer
//! factors, neither do the points.
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
//! - Factors that a domain lacks have 0 points, so topologies of different domains differ.
//! - A lane whose raw factors are 0 is culled. The counts of a culled lane are 0; everything else
//!   in it is unspecified, so callers skip lanes without points.
//! - [`PacketPatch::key`] differs even for factors that differ only in their lowest bit, because
//!   location tables are reused by key.
//! - Compact patches have at most [`COMPACT_EDGE`] points along each edge: codes and templates do
//!   not have room for more.
//!
//! # The simpler form
//!
//! Eight patches per packet were slower: half of the vector loads waited for two narrower stores.
//! Lanes are plain arrays, of which the compiler makes vectors of each level's width. The vectors
//! of the crate `wide` choose their instructions when they are compiled, so only factor processing
//! at the baseline uses them ([`Numbers`], `docs/experiments.md`).

mod one;

#[cfg(all(feature = "taps", feature = "apart"))]
pub(crate) use one::ROWS;
pub(crate) use one::{OnePatch, RawPair, one_counts, pairs};

use crate::data::lanes::{Column, EdgePoints, Lanes, MAX_FACTORS, is_odd, set, set_rows};
use crate::data::numbers::Numbers;
use crate::stages::counts::{PacketCounts, counts};
use crate::stages::factor_context::{PlainContext, point_counts};
use crate::stages::factors::{Processed, process};
use crate::stages::place::{Spacing, Spacings};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};

/// The most points of an edge, or of a quad's inside factor, of a compact patch.
pub(crate) const COMPACT_EDGE: usize = 16;

/// The most points of the inside factor of a compact triangle.
pub(crate) const COMPACT_TRIANGLE_INSIDE: usize = 13;

/// Bits of a small topology's number that hold the ranks of its point counts.
const SMALL_BITS: u32 = 12;
/// The number of small topologies of both domains.
pub(crate) const SMALL_TOPOLOGIES: usize = 2 << SMALL_BITS;

/// Sixteen patches of one domain after factor processing, their output sizes known.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Packet {
    config: Config,
    domain: Domain,
    fixed: Column,
    points: Column,
    /// Unspecified if factors are integers: see [`PacketPatch::spacing`].
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

    /// Processes the raw factors of a packet. Patches whose factors are zeros are culled.
    ///
    /// Writes to `self`, because returning a packet would copy it.
    #[inline(always)]
    pub(crate) fn process<V: Numbers>(
        &mut self,
        config: Config,
        domain: Domain,
        raw: &Column<f32>,
    ) {
        use Domain::{Isoline, Quad, Triangle};
        // In each arm the domain and the number of rows are constants.
        match (domain, raw) {
            (Isoline, &[a, b, ..]) => self.process_lanes::<V, _>(config, Isoline, &[a, b]),
            (Triangle, &[a, b, c, d, ..]) => {
                self.process_lanes::<V, _>(config, Triangle, &[a, b, c, d]);
            }
            (Quad, all) => self.process_lanes::<V, _>(config, Quad, all),
        }
    }

    #[inline(always)]
    fn process_lanes<V: Numbers, const F: usize>(
        &mut self,
        config: Config,
        domain: Domain,
        raw: &[Lanes<f32>; F],
    ) {
        let processed = process::<V, _, _>(config.partitioning, domain, raw);
        self.counts = self.keep(config, domain, 0, &processed);
    }

    /// Sets all lanes, or the lane with this number, from processed factors. Does not set the
    /// output sizes, but returns them.
    #[inline(always)]
    fn keep<const L: usize, const F: usize>(
        &mut self,
        config: Config,
        domain: Domain,
        lane: usize,
        processed: &Processed<L, F>,
    ) -> PacketCounts<L> {
        let Processed { fixed, odd, minimum, .. } = processed;
        // If factors are integers, few spacings are ever needed: they are computed on demand.
        let points = if config.partitioning.has_integer_factors() {
            point_counts(fixed, odd)
        } else {
            self.spacings.keep(lane, processed, config.split)
        };
        // Rows that the domain lacks have numbers of factors that nobody gave: zeros replace them,
        // so that topologies of different domains differ.
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

    /// Whether all patches are compact.
    #[inline(always)]
    pub(crate) fn all_compact(&self) -> bool {
        self.compact.iter().fold(1, |all, compact| all & compact) == 1
    }

    /// The patch of a lane.
    #[inline(always)]
    pub(crate) const fn patch(&self, lane: usize) -> PacketPatch<'_> {
        PacketPatch { packet: self, lane }
    }
}

/// The output sizes of a packet's patches, without the rest of the packet.
#[inline(always)]
pub(crate) fn packet_counts<V: Numbers>(
    config: Config,
    domain: Domain,
    raw: &Column<f32>,
) -> PacketCounts {
    #[inline(always)]
    fn of<V: Numbers, const F: usize>(
        config: Config,
        domain: Domain,
        raw: &[Lanes<f32>; F],
    ) -> PacketCounts {
        let processed = process::<V, _, _>(config.partitioning, domain, raw);
        let points = point_counts(&processed.fixed, &processed.odd);
        counts(config, domain, &processed, &points)
    }
    use Domain::{Isoline, Quad, Triangle};
    match (domain, raw) {
        (Isoline, &[a, b, ..]) => of::<V, _>(config, Isoline, &[a, b]),
        (Triangle, &[a, b, c, d, ..]) => of::<V, _>(config, Triangle, &[a, b, c, d]),
        (Quad, all) => of::<V, _>(config, Quad, all),
    }
}

/// One patch of a packet. Factors are numbered in the core's order.
#[derive(Clone, Copy, Debug)]
pub(crate) struct PacketPatch<'a> {
    packet: &'a Packet,
    lane: usize,
}

impl PacketPatch<'_> {
    /// The patch's domain.
    #[inline(always)]
    pub(crate) const fn domain(self) -> Domain {
        self.packet.domain
    }

    /// The number of points; 0 if the patch is culled.
    #[inline(always)]
    pub(crate) const fn points(self) -> u32 {
        self.packet.counts.points[self.lane]
    }

    /// The number of indices; 0 if the patch is culled.
    #[inline(always)]
    pub(crate) const fn indices(self) -> u32 {
        self.packet.counts.indices[self.lane]
    }

    /// Whether all factors are integers; then a factor's locations follow from its point count.
    #[inline(always)]
    pub(crate) const fn integer(self) -> bool {
        self.packet.config.partitioning.has_integer_factors()
    }

    /// Whether the patch is a minimum patch.
    #[inline(always)]
    pub(crate) const fn is_minimum(self) -> bool {
        self.packet.minimum[self.lane] == 1
    }

    /// Whether the patch is a quad or a triangle with at most [`COMPACT_EDGE`] points along each
    /// edge and each inside axis; for a triangle's inside at most [`COMPACT_TRIANGLE_INSIDE`].
    #[inline(always)]
    pub(crate) const fn is_compact(self) -> bool {
        self.packet.compact[self.lane] == 1
    }

    /// The number of the patch's topology, not 0: see the head of this file.
    #[inline(always)]
    pub(crate) const fn topology(self) -> u64 {
        self.packet.topologies[self.lane]
    }

    /// A number below [`SMALL_TOPOLOGIES`], different for each topology, if each factor has one of
    /// the first point counts that are possible: the first four for a quad, the first eight for a
    /// triangle. Other topologies have larger numbers, which may coincide.
    #[inline(always)]
    pub(crate) const fn small_topology(self) -> usize {
        self.packet.small[self.lane] as usize
    }

    /// The point counts of the patch's factors.
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

    /// The number, not 0, of a factor's context: different contexts of one split order have
    /// different numbers.
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

    /// [`Self::spacing`] for fractional partitionings.
    #[inline(always)]
    pub(crate) const fn fractional_spacing(self, factor: usize) -> Spacing {
        self.packet.spacings.get(factor, self.lane, self.edge_points(factor))
    }
}

/// The numbers of topologies: a leading 1, the point counts of all factors, and whether the patch
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

/// The numbers of small topologies. From the lowest bit: two or three bits for each factor, the
/// rank of its point count among those that are possible; a bit for the domain; then bits that are
/// set if a rank is too large. A minimum patch has rank 0 for every factor. No other patch of its
/// partitioning does, because an inside factor of rank 0 would have 2 points.
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
            // The rank: integer factors have 2, 3, 4 .. points, fractional ones every other number.
            // A rank that needs more bits than it has room for sets a bit above the whole number,
            // which then is beyond the table.
            let place = points[lane].wrapping_sub(2) >> fractional;
            small[lane] = (small[lane] << bits) | place | ((place >> bits) << (SMALL_BITS + 1));
        }
    }
    for lane in 0..L {
        // `minimum - 1` is a mask: none of a minimum patch's bits stay, all of another's.
        small[lane] = (small[lane] & minimum[lane].wrapping_sub(1)) | quad;
    }
    small
}

/// For each lane, 1 if the patch is compact, else 0.
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
            packet.process::<i32>(config, domain, &raw);
            packet.patch(0).is_compact()
        };
        assert!(is_compact(Domain::Quad, 15.0, 15.0), "16 by 16 points");
        assert!(!is_compact(Domain::Quad, 16.0, 2.0) && !is_compact(Domain::Quad, 2.0, 16.0), "17");
        assert!(is_compact(Domain::Triangle, 15.0, 12.0), "13 points inside");
        assert!(!is_compact(Domain::Triangle, 2.0, 13.0), "14 points inside");
        assert!(!is_compact(Domain::Isoline, 2.0, 2.0), "isolines are not");
    }

    /// Topologies of two domains differ even if all common factors are equal.
    #[test]
    fn topologies_of_domains_differ() {
        let [triangle, quad] = [Domain::Triangle, Domain::Quad].map(|domain| {
            let mut packet = Packet::EMPTY;
            packet.process::<i32>(tour::CONFIG, domain, &[[4.0; LANES]; MAX_FACTORS]);
            packet.patch(0).topology()
        });
        assert_ne!(triangle, quad, "{:?}", QuadFactors::uniform(4.0));
    }
}
