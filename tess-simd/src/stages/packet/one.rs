//! The front end of one patch: the elements of a vector are its factors, not sixteen patches.
//!
//! A packet of one patch would cost as much as one of sixteen. Here each stage is one short vector
//! with an element for each factor. The results go to one lane of a packet, so that later stages
//! need not know the difference. `threads/part` calls this for one patch per call,
//! `kernels/front_end` for a few patches or for one that repeats.
//!
//! # Data
//!
//! The factors have three forms, each made from the one before:
//!
//! ```text
//! PatchFactors       the caller's factors
//! RawPairs           3 numbers of 64 bits, in registers      [v0 u0] [v1 u1] [inside_v inside_u]
//! RawFactors         a vector of 8, if the patch is new      u0 v0 u1 v1 inside_u inside_v 0 0
//! ```
//!
//! The pairs exist because a kernel's arguments go through registers, the vector because the stages
//! compute with vectors. If the patch repeats, the pairs are compared and the vector is not made.
//!
//! # Entries
//!
//! ```text
//! OnePatch::process      one patch per call: keeps its packet, and does nothing if the factors are the same
//! Packet::process_one    a patch of a small batch, or one that repeats: any lane of the batch's packet
//! one_counts             a patch that is only counted: no packet
//! ```
//!
//! All three take the same path: `pairs`, `apart`, `process`. They differ in the result that they
//! keep, and one call takes only one of them.
//!
//! # What must hold
//!
//! - Factors reach the kernel in registers ([`pairs`]). A vector load from memory would wait until
//!   the separately stored factors arrive: 7 to 17 % of a call.
//! - [`OnePatch`] is the only writer of its packet, so the packet is still right when equal factors
//!   come again.
//! - [`key`] has everything that the packet and the sizes depend on: if it is equal, the rest is
//!   skipped.

use super::Packet;
use crate::data::lanes::{MAX_FACTORS, set};
use crate::stages::counts::{PacketCounts, counts};
use crate::stages::factor_context::point_counts;
use crate::stages::factors::{Processed, all, process};
use tess_core::{Config, Counts, Domain, PatchFactors, QuadFactors, TriangleFactors};

/// A single patch, in the first lane of a packet.
#[derive(Clone, Debug)]
pub(crate) struct OnePatch {
    /// The packet of the patch that was processed last; nothing else writes to it.
    packet: Packet,
    raw: RawPairs,
    /// [`key`] of the patch's processed factors, which the packet and the sizes depend on.
    key: [u32; ROWS],
    domain: Domain,
    counts: Counts,
}

/// Rows for a patch's factors: enough to fill a short vector.
pub(crate) const ROWS: usize = 8;

/// The raw factors of a patch, followed by zeros.
type RawFactors = [[f32; 1]; ROWS];

/// Pairs of raw factors, the first of each pair in the lower half, then zeros. They are passed in
/// registers.
type RawPairs = [u64; MAX_FACTORS / 2];

impl OnePatch {
    /// A patch that is culled because all its factors are 0.
    pub(crate) const CULLED: Self = Self {
        packet: Packet::EMPTY,
        raw: [0; _],
        key: [0; ROWS],
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

    /// Whether the patch that was processed last has these factors and is not compact.
    pub(crate) fn is_large_and_has(&self, domain: Domain, raw: RawPairs) -> bool {
        !self.packet.patch(0).is_compact() && self.domain == domain && self.raw == raw
    }

    /// Processes the raw factors of one patch, given as [`pairs`], unless they equal those of the
    /// previous patch. Returns the output sizes, zeros if the patch is culled. The configuration
    /// must be the same in every call.
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
        // All factors in one comparison, because it is hard to predict which one differs first.
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

    /// Whether the patch is a minimum patch and not culled.
    #[inline(always)]
    const fn is_minimum(&self) -> bool {
        self.key[0] != 0 && self.packet.patch(0).is_minimum()
    }

    /// Makes the packet from raw factors, unless it was made from the same processed factors.
    #[inline(always)]
    fn process_as(&mut self, config: Config, domain: Domain, raw: &RawFactors, other: bool) {
        if !other && self.is_minimum() && are_at_most_one(&raw[..domain.factors()]) {
            return;
        }
        let processed = process(config.partitioning, domain, raw);
        let key = key(&processed);
        let differences = (0..ROWS).fold(0, |any, i| any | (key[i] ^ self.key[i]));
        if differences != 0 || other {
            self.key = key;
            self.counts = self.packet.keep_one(config, domain, 0, &processed);
        }
    }
}

/// Whether all factors are in (0, 1]. In a configuration that has minimum patches, such factors
/// make one.
#[inline(always)]
fn are_at_most_one(raw: &[[f32; 1]]) -> bool {
    all(raw, |factor| factor.to_bits().wrapping_sub(1) < 1.0_f32.to_bits()) == [1]
}

/// The processed factors in one vector; zeros if the patch is culled, which no other patch has,
/// because processed factors are at least 1. Within one configuration and domain, the parities and
/// whether it is a minimum patch depend only on these.
#[inline(always)]
fn key(processed: &Processed<1, ROWS>) -> [u32; ROWS] {
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

/// The factors from which [`pairs`] made these pairs, as vectors of one lane.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "the lower half")]
fn apart(raw: RawPairs) -> RawFactors {
    let [a, b, c] = raw.map(|pair| [pair as u32, (pair >> 32) as u32].map(f32::from_bits));
    [a[0], a[1], b[0], b[1], c[0], c[1], 0.0, 0.0].map(|factor| [factor])
}

impl Packet {
    /// Processes the raw factors of one patch; the other lanes keep their contents. Returns the
    /// output sizes, zeros if the patch is culled.
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

    /// Sets a lane, including its sizes, from processed factors.
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

    /// Patches of a domain whose factors are equal except for one.
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

    /// The counts do not depend on the previous patch, even if that was culled, or was a minimum
    /// patch of other factors.
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
