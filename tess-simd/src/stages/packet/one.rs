//! The front end of one patch: its factors stand side by side, as patches do in a packet.
//!
//! A packet of one patch would cost what sixteen cost. Here each stage is one short vector with an element
//! for each factor, and the results go to one lane of a packet, so that everything behind the front end
//! finds a patch as it always does.

use super::{COMPACT_EDGE, COMPACT_TRIANGLE_INSIDE, Packet};
use crate::data::lanes::{EdgePoints, LANES, MAX_FACTORS};
use crate::stages::counts::counts_of_patch;
use crate::stages::factor_context::{Context, point_count};
use crate::stages::factors::{FACTORS_AT_ONCE, OneProcessed, process_one, process_one_isoline};
use crate::stages::place::Spacing;
use core::array::from_fn;
use tess_core::{Config, Counts, Domain, PatchFactors};

/// A patch that came alone, and a packet that has it in its first lane.
#[derive(Clone, Debug)]
pub(crate) struct OnePatch {
    /// As the patch that was processed last made it; nothing else writes to it.
    packet: Packet,
    raw: RawPairs,
    /// [`kept`] of its processed factors: what the packet and the sizes follow from.
    kept: [u32; FACTORS_AT_ONCE],
    domain: Domain,
    counts: Counts,
}

/// The raw factors of a patch side by side; zeros follow those that its domain has.
type RawFactors = [f32; FACTORS_AT_ONCE];

/// Pairs of raw factors, the first of each pair in the lower half, zeros behind them. They travel in registers: a
/// vector that is loaded from memory would wait for factors written in pieces.
pub(crate) type RawPairs = [u64; MAX_FACTORS / 2];

impl OnePatch {
    /// A patch that is culled, as all its factors are 0.
    pub(crate) const CULLED: Self = Self {
        packet: Packet::EMPTY,
        raw: [0; _],
        kept: [0; FACTORS_AT_ONCE],
        domain: Domain::Quad,
        counts: Counts { points: 0, primitives: 0, indices: 0 },
    };

    /// The packet with the patch.
    pub(crate) const fn packet(&self) -> &Packet {
        &self.packet
    }

    /// Processes the raw factors of one patch, unless they are those of the patch before. Returns its output
    /// sizes, zeros if it is culled. The configuration is the same in each call.
    #[inline(always)]
    pub(crate) fn process(&mut self, config: Config, domain: Domain, raw: RawPairs) -> Counts {
        use Domain::{Isoline, Quad, Triangle};
        // All factors in one comparison: which is the first to differ is hard to predict.
        let differences = (0..raw.len()).fold(0, |any, i| any | (raw[i] ^ self.raw[i]));
        let other = domain != self.domain;
        if differences != 0 || other {
            (self.raw, self.domain) = (raw, domain);
            // In each arm the domain is a constant.
            match domain {
                Isoline => {
                    self.keep(config, Isoline, &process(config, Isoline, &apart(raw)), other)
                }
                Triangle => {
                    self.keep(config, Triangle, &process(config, Triangle, &apart(raw)), other)
                }
                Quad => self.keep(config, Quad, &process(config, Quad, &apart(raw)), other),
            }
        }
        self.counts
    }

    /// Makes the packet from processed factors, unless it has these.
    #[inline(always)]
    fn keep(&mut self, config: Config, domain: Domain, processed: &OneProcessed, other: bool) {
        let kept = kept(processed);
        let differences = (0..FACTORS_AT_ONCE).fold(0, |any, i| any | (kept[i] ^ self.kept[i]));
        if differences != 0 || other {
            self.kept = kept;
            self.counts = self.packet.keep_one(config, 0, domain, processed);
        }
    }
}

/// Processed factors in one vector: zeros if the patch is culled, as the others are at least 1. In one
/// configuration and domain, parities and whether it is a minimum patch follow from the factors.
#[inline(always)]
fn kept(processed: &OneProcessed) -> [u32; FACTORS_AT_ONCE] {
    let mask = 0_u32.wrapping_sub(processed.alive.into());
    processed.fixed.map(|factor| factor & mask)
}

#[inline(always)]
fn side_by_side(factors: PatchFactors) -> RawFactors {
    match factors {
        PatchFactors::Isoline(factors) => {
            let [density, detail] = factors.into();
            [density, detail, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]
        }
        PatchFactors::Triangle(factors) => {
            let [u0, v0, w0, inside] = factors.into();
            [u0, v0, w0, inside, 0.0, 0.0, 0.0, 0.0]
        }
        PatchFactors::Quad(factors) => {
            let [u0, v0, u1, v1, inside_u, inside_v] = factors.into();
            [u0, v0, u1, v1, inside_u, inside_v, 0.0, 0.0]
        }
    }
}

/// The raw factors of one patch in pairs.
#[inline(always)]
pub(crate) fn pairs(factors: PatchFactors) -> RawPairs {
    let raw = side_by_side(factors).map(f32::to_bits).map(u64::from);
    from_fn(|i| raw[2 * i] | (raw[2 * i + 1] << 32))
}

/// The factors of which [`pairs`] made these.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the lower half")]
fn apart(raw: RawPairs) -> RawFactors {
    let [a, b, c] = raw.map(|pair| [pair as u32, (pair >> 32) as u32].map(f32::from_bits));
    [a[0], a[1], b[0], b[1], c[0], c[1], 0.0, 0.0]
}

#[inline(always)]
fn process(config: Config, domain: Domain, raw: &RawFactors) -> OneProcessed {
    let partitioning = config.partitioning;
    match domain {
        Domain::Isoline => process_one_isoline(partitioning, raw),
        Domain::Triangle => process_one::<3, 4>(partitioning, raw),
        Domain::Quad => process_one::<4, 6>(partitioning, raw),
    }
}

impl Packet {
    /// Processes the raw factors of one patch; the other lanes stay as they are. Returns its output sizes,
    /// zeros if it is culled.
    #[inline(always)]
    pub(crate) fn process_one(
        &mut self,
        config: Config,
        lane: usize,
        factors: PatchFactors,
    ) -> Counts {
        let domain = factors.domain();
        self.keep_one(config, lane, domain, &process(config, domain, &side_by_side(factors)))
    }

    /// Makes the lane from processed factors.
    #[inline(always)]
    fn keep_one(
        &mut self,
        config: Config,
        lane: usize,
        domain: Domain,
        processed: &OneProcessed,
    ) -> Counts {
        let lane = lane % LANES;
        let edges = self.keep_points(config, lane, domain, processed);
        let minimum = u32::from(processed.minimum);
        let counts = if processed.alive {
            counts_of_patch(config, domain, &edges, minimum)
        } else {
            Counts::default()
        };
        (self.config, self.domain) = (config, domain);
        self.counts.points[lane] = counts.points;
        self.counts.indices[lane] = counts.indices;
        self.minimum[lane] = minimum;
        self.topologies[lane] = topology(&edges, minimum);
        self.compact[lane] = u32::from(is_compact(domain, &edges));
        counts
    }

    /// Keeps the factors, the point counts and, where factors are not integers, the spacings. Returns the
    /// point counts; 0 for factors that the domain does not have.
    #[inline(always)]
    fn keep_points(
        &mut self,
        config: Config,
        lane: usize,
        domain: Domain,
        OneProcessed { fixed, odd, .. }: &OneProcessed,
    ) -> EdgePoints {
        let mut points = [0; FACTORS_AT_ONCE];
        if config.partitioning.has_integer_factors() {
            for i in 0..FACTORS_AT_ONCE {
                points[i] = point_count(fixed[i], odd[i]);
            }
        } else {
            let [mut split, mut step, mut lag] = [[0; FACTORS_AT_ONCE]; 3];
            for i in 0..FACTORS_AT_ONCE {
                let spacing = Spacing::new(&Context::new(fixed[i], odd[i], config.split));
                (points[i], split[i]) = (spacing.points, spacing.split);
                (step[i], lag[i]) = (spacing.step, spacing.lag);
            }
            for i in 0..MAX_FACTORS {
                let (points, split) = (points[i], split[i]);
                let spacing = Spacing { points, split, step: step[i], lag: lag[i] };
                self.spacings.set(i * LANES + lane, &spacing);
            }
        }
        let mut edges = [0; MAX_FACTORS];
        for i in 0..MAX_FACTORS {
            edges[i] = if i < domain.factors() { points[i] } else { 0 };
            self.fixed[i * LANES + lane] = fixed[i];
            self.points[i * LANES + lane] = edges[i];
        }
        edges
    }
}

/// The number of a topology, as packets have it.
#[inline(always)]
fn topology(edges: &EdgePoints, minimum: u32) -> u64 {
    let topology = edges.iter().fold(1, |topology, &points| (topology << 7) | u64::from(points));
    (topology << 1) | u64::from(minimum)
}

/// See [`PacketPatch::is_compact`](super::PacketPatch::is_compact).
#[inline(always)]
fn is_compact(domain: Domain, edges: &EdgePoints) -> bool {
    let [.., inside, _, _] = *edges;
    let fits = edges.iter().fold(true, |fits, &points| fits & (points as usize <= COMPACT_EDGE));
    match domain {
        Domain::Isoline => false,
        Domain::Triangle => fits & (inside as usize <= COMPACT_TRIANGLE_INSIDE),
        Domain::Quad => fits,
    }
}
