//! The front end of one patch: its factors are side by side, as patches are in a packet.
//!
//! A packet of one patch would cost what sixteen cost. Here each stage is one short vector with an
//! element for each factor, and the results go to one lane of a packet, so that every later stage
//! finds a patch as usual. `threads/part` calls it for one patch per call, `kernels/front_end` for
//! a few patches or for one that repeats.
//!
//! # Data
//!
//! The factors have three forms, each made from the one before:
//!
//! ```text
//! PatchFactors       what callers have
//! RawPairs           3 numbers of 64 bits, in registers      [v0 u0] [v1 u1] [inside_v inside_u]
//! RawFactors         a vector of 8, if the patch is new      u0 v0 u1 v1 inside_u inside_v 0 0
//! ```
//!
//! # What must hold
//!
//! - Factors reach the kernel in registers ([`pairs`]). A vector loaded from memory would wait for
//!   factors that were written in pieces: 7 to 17 % of a call.
//! - [`OnePatch`] is the only writer of its packet, so equal factors leave it as it is.
//! - Everything that the packet and the sizes follow from is in [`kept`]: equal ones skip the rest.

use super::Packet;
use crate::data::lanes::{MAX_FACTORS, set};
use crate::stages::counts::{PacketCounts, counts};
use crate::stages::factor_context::point_counts;
use crate::stages::factors::{Processed, all, process};
use tess_core::{Config, Counts, Domain, PatchFactors, QuadFactors, TriangleFactors};

/// A patch that came alone, and a packet that has it in its first lane.
#[derive(Clone, Debug)]
pub(crate) struct OnePatch {
    /// As the patch that was processed last made it; nothing else writes to it.
    packet: Packet,
    raw: RawPairs,
    /// [`kept`] of its processed factors: what the packet and the sizes follow from.
    kept: [u32; ROWS],
    domain: Domain,
    counts: Counts,
}

/// Rows of a patch's factors: they fill a short vector.
pub(crate) const ROWS: usize = 8;

/// The raw factors of a patch side by side; zeros follow those that its domain has.
type RawFactors = [[f32; 1]; ROWS];

/// Pairs of raw factors, the first of each pair in the lower half, then zeros. They travel
/// in registers: a vector that is loaded from memory would wait for factors written in pieces.
type RawPairs = [u64; MAX_FACTORS / 2];

impl OnePatch {
    /// A patch that is culled, as all its factors are 0.
    pub(crate) const CULLED: Self = Self {
        packet: Packet::EMPTY,
        raw: [0; _],
        kept: [0; ROWS],
        domain: Domain::Quad,
        counts: Counts { points: 0, primitives: 0, indices: 0 },
    };

    /// The packet with the patch.
    pub(crate) const fn packet(&self) -> &Packet {
        &self.packet
    }

    /// The output sizes of the patch; zeros if it is culled.
    pub(crate) const fn counts(&self) -> Counts {
        self.counts
    }

    /// Whether this is the patch that was processed last, and it is not compact.
    pub(crate) fn is_large_and_has(&self, domain: Domain, raw: RawPairs) -> bool {
        !self.packet.patch(0).is_compact() && self.domain == domain && self.raw == raw
    }

    /// Processes the raw factors of one patch, unless they are those of the patch before. Returns
    /// its output sizes, zeros if it is culled. The configuration is the same in each call. The
    /// factors come in [`pairs`].
    #[inline(always)]
    pub(crate) fn process(
        &mut self,
        config: Config,
        domain: Domain,
        a: u64,
        b: u64,
        c: u64,
    ) -> Counts {
        use Domain::{Isoline, Quad, Triangle};
        let raw = [a, b, c];
        // All factors in one comparison: which is the first to differ is hard to predict.
        let differences = (0..raw.len()).fold(0, |any, i| any | (raw[i] ^ self.raw[i]));
        let other = domain != self.domain;
        if differences != 0 || other {
            (self.raw, self.domain) = (raw, domain);
            let factors = apart(raw);
            // In each arm the domain is a constant.
            match domain {
                Isoline => self.process_as(config, Isoline, &factors, other),
                Triangle => self.process_as(config, Triangle, &factors, other),
                Quad => self.process_as(config, Quad, &factors, other),
            }
        }
        self.counts
    }

    /// Whether the patch is a minimum patch that is not culled.
    #[inline(always)]
    const fn is_minimum(&self) -> bool {
        self.kept[0] != 0 && self.packet.patch(0).is_minimum()
    }

    /// Makes the packet from raw factors, unless it has the processed ones.
    #[inline(always)]
    fn process_as(&mut self, config: Config, domain: Domain, raw: &RawFactors, other: bool) {
        if !other && self.is_minimum() && are_at_most_one(&raw[..domain.factors()]) {
            return;
        }
        let processed = process(config.partitioning, domain, raw);
        let kept = kept(&processed);
        let differences = (0..ROWS).fold(0, |any, i| any | (kept[i] ^ self.kept[i]));
        if differences != 0 || other {
            self.kept = kept;
            self.counts = self.packet.keep_one(config, domain, 0, &processed);
        }
    }
}

/// Whether all factors are in (0, 1]: where there are minimum patches, they make one.
#[inline(always)]
fn are_at_most_one(raw: &[[f32; 1]]) -> bool {
    all(raw, |factor| factor.to_bits().wrapping_sub(1) < 1.0_f32.to_bits()) == [1]
}

/// Processed factors in one vector: zeros if the patch is culled, as the others are at least 1. In
/// one configuration and domain, parities and whether it is a minimum patch follow from the
/// factors.
#[inline(always)]
fn kept(processed: &Processed<1, ROWS>) -> [u32; ROWS] {
    let mask = 0_u32.wrapping_sub(processed.alive[0]);
    processed.fixed.map(|[factor]| factor & mask)
}

/// The raw factors of one patch in pairs, in the order of its domain.
#[inline(always)]
pub(crate) fn pairs(factors: &PatchFactors) -> RawPairs {
    let pair = |one: f32, other: f32| u64::from(one.to_bits()) | (u64::from(other.to_bits()) << 32);
    match *factors {
        PatchFactors::Isoline(factors) => [pair(factors.density, factors.detail), 0, 0],
        PatchFactors::Triangle(TriangleFactors { u0, v0, w0, inside }) => {
            [pair(u0, v0), pair(w0, inside), 0]
        }
        PatchFactors::Quad(QuadFactors { u0, v0, u1, v1, inside_u, inside_v }) => {
            [pair(u0, v0), pair(u1, v1), pair(inside_u, inside_v)]
        }
    }
}

/// The factors of which [`pairs`] made these, as vectors of one lane.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the lower half")]
fn apart(raw: RawPairs) -> RawFactors {
    let [a, b, c] = raw.map(|pair| [pair as u32, (pair >> 32) as u32].map(f32::from_bits));
    [a[0], a[1], b[0], b[1], c[0], c[1], 0.0, 0.0].map(|factor| [factor])
}

impl Packet {
    /// Processes the raw factors of one patch; the other lanes stay as they are. Returns its output
    /// sizes, zeros if it is culled.
    #[inline(always)]
    pub(crate) fn process_one(
        &mut self,
        config: Config,
        lane: usize,
        factors: PatchFactors,
    ) -> Counts {
        use Domain::{Isoline, Quad, Triangle};
        let raw = apart(pairs(&factors));
        let mut keep = |domain| {
            self.keep_one(config, domain, lane, &process(config.partitioning, domain, &raw))
        };
        // In each arm the domain is a constant.
        match factors.domain() {
            Isoline => keep(Isoline),
            Triangle => keep(Triangle),
            Quad => keep(Quad),
        }
    }

    /// Makes a lane from processed factors.
    #[inline(always)]
    fn keep_one(
        &mut self,
        config: Config,
        domain: Domain,
        lane: usize,
        processed: &Processed<1, ROWS>,
    ) -> Counts {
        let counts = self.keep(config, domain, lane, processed);
        set(&mut self.counts.points, lane, counts.points);
        set(&mut self.counts.indices, lane, counts.indices);
        counts.of_patch(config, domain)
    }
}

/// The output sizes of one patch.
#[inline(always)]
pub(crate) fn one_counts(config: Config, factors: &PatchFactors) -> PacketCounts<1> {
    use Domain::{Isoline, Quad, Triangle};
    let raw = apart(pairs(factors));
    let of = |domain| {
        let processed = process(config.partitioning, domain, &raw);
        counts(config, domain, &processed, &point_counts(&processed.fixed, &processed.odd))
    };
    // In each arm the domain is a constant.
    match factors.domain() {
        Isoline => of(Isoline),
        Triangle => of(Triangle),
        Quad => of(Quad),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;
    use tess_core::{OutputPrimitive, Partitioning};

    /// A domain, and patches of it whose factors are alike but for one.
    fn near_minimum(domain: Domain) -> Vec<PatchFactors> {
        let factors = [0.0, f32::from_bits(1), 0.5, 1.0, 1.0_f32.next_up(), 2.0, -1.0, f32::NAN];
        let mut patches = Vec::new();
        for [most, one] in factors.map(|most| factors.map(|one| [most, one])).as_flattened() {
            for place in 0..domain.factors() {
                let mut raw = [*most; MAX_FACTORS];
                raw[place] = *one;
                patches.extend(PatchFactors::from_slice(domain, &raw[..domain.factors()]));
            }
        }
        patches
    }

    /// Whatever came before, minimum patches that were culled or have other factors included.
    #[test]
    fn minimum_patches_follow_from_their_factors() {
        use Partitioning::{FractionalEven, FractionalOdd, Integer, Pow2};
        let domains = [Domain::Triangle, Domain::Quad];
        let patches: Vec<_> = domains.into_iter().flat_map(near_minimum).collect();
        for partitioning in [Integer, Pow2, FractionalOdd, FractionalEven] {
            let config = Config::new(partitioning, OutputPrimitive::TriangleCw);
            let processed = |one: &mut OnePatch, patch| {
                let [a, b, c] = pairs(patch);
                one.process(config, patch.domain(), a, b, c)
            };
            for before in patches.iter().step_by(7) {
                for patch in &patches {
                    let (mut one, mut other) = (OnePatch::CULLED, OnePatch::CULLED);
                    processed(&mut one, before);
                    let expected = processed(&mut other, patch);
                    let counts = processed(&mut one, patch);
                    assert_eq!(counts, expected, "{partitioning:?}, {before:?}, then {patch:?}");
                }
            }
        }
    }
}
