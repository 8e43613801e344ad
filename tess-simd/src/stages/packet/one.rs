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
//! PatchFactors       the caller's factors, in memory
//! RawPair            6 floats in registers: 3 arguments    (u0, v0) (u1, v1) (inside_u, inside_v)
//! RawFactors         a vector of 8                         u0 v0 u1 v1 inside_u inside_v 0 0
//! ```
//!
//! A kernel is a compiled function, so its arguments are what its caller loads. The compiler joins
//! two loads of 32 bits into one of 64, or four into one of 128, wherever the result is one value;
//! it cannot join floats that go to registers of their own.
//!
//! # Entries
//!
//! ```text
//! OnePatch::process      one patch per call: keeps its packet; equal factors change nothing
//! Packet::process_one    a patch of a small batch, or one that repeats: any lane of a packet
//! one_counts             a patch that is only counted: no packet
//! ```
//!
//! All three take the same path: `pairs`, `side_by_side`, `process`. They differ in the result that
//! they keep, and one call takes only one of them.
//!
//! # What must hold
//!
//! - Each factor is read from the caller's memory by a load of its own ([`pairs`]). A caller stores
//!   factors one by one just before the call. A processor forwards a store to a later load only if
//!   the store has all bytes of the load; a wider load waits until all earlier stores have left for
//!   the cache. After a patch's output those are many: with loads of two factors, calls for small
//!   quads that were made just before took 1.06 to 1.09 times as long (AVX-512).
//! - [`OnePatch`] is the only writer of its packet, so the packet is still right when equal factors
//!   come again.
//! - [`key`] has everything that the packet and the sizes depend on: if it is equal, the rest is
//!   skipped.

use super::Packet;
use crate::data::lanes::{MAX_FACTORS, set};
use crate::stages::counts::{PacketCounts, counts};
use crate::stages::factor_context::point_counts;
use crate::stages::factors::{Processed, all, process};
use tess_core::{
    Config, Counts, Domain, IsolineFactors, PatchFactors, QuadFactors, TriangleFactors,
};

/// A single patch, in the first lane of a packet.
#[derive(Clone, Debug)]
pub(crate) struct OnePatch {
    /// The packet of the patch that was processed last; nothing else writes to it.
    packet: Packet,
    raw: RawFactors,
    /// [`key`] of the patch's processed factors, which the packet and the sizes depend on.
    key: [u32; ROWS],
    domain: Domain,
    counts: Counts,
}

/// Rows for a patch's factors: enough to fill a short vector.
pub(crate) const ROWS: usize = 8;

/// The raw factors of a patch, followed by zeros.
type RawFactors = [[f32; 1]; ROWS];

/// Two raw factors, or zeros. A tuple of two floats is passed in two registers; an array of two
/// would be one number of 64 bits, loaded at once.
pub(crate) type RawPair = (f32, f32);

impl OnePatch {
    /// A patch that is culled because all its factors are 0.
    pub(crate) const CULLED: Self = Self {
        packet: Packet::EMPTY,
        raw: [[0.0]; ROWS],
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
    pub(crate) fn is_large_and_has(&self, domain: Domain, raw: [RawPair; 3]) -> bool {
        !self.packet.patch(0).is_compact()
            && self.domain == domain
            && differences(&self.raw, &side_by_side(raw)) == 0
    }

    /// Processes the raw factors of one patch, given as [`pairs`], unless they equal those of the
    /// previous patch. Returns the output sizes, zeros if the patch is culled. The configuration
    /// must be the same in every call.
    #[inline(always)]
    pub(crate) fn process(
        &mut self,
        config: Config,
        domain: Domain,
        a: RawPair,
        b: RawPair,
        c: RawPair,
    ) -> Counts {
        use Domain::{Isoline, Quad, Triangle};
        let raw = side_by_side([a, b, c]);
        let other = domain != self.domain;
        if differences(&self.raw, &raw) != 0 || other {
            (self.raw, self.domain) = (raw, domain);
            // In each arm the domain is a constant.
            match domain {
                Isoline => self.process_as(config, Isoline, &raw, other),
                Triangle => self.process_as(config, Triangle, &raw, other),
                Quad => self.process_as(config, Quad, &raw, other),
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
        let processed = process::<i32, _, _>(config.partitioning, domain, raw);
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
    all(raw, |factor: i32| {
        let is_at_most_one = factor.cast_unsigned().wrapping_sub(1) < 1.0_f32.to_bits();
        -i32::from(is_at_most_one)
    }) == [1]
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
pub(crate) const fn pairs(factors: &PatchFactors) -> [RawPair; MAX_FACTORS / 2] {
    match *factors {
        PatchFactors::Isoline(IsolineFactors { density, detail }) => {
            [(density, detail), (0.0, 0.0), (0.0, 0.0)]
        }
        PatchFactors::Triangle(TriangleFactors { u0, v0, w0, inside }) => {
            [(u0, v0), (w0, inside), (0.0, 0.0)]
        }
        PatchFactors::Quad(QuadFactors { u0, v0, u1, v1, inside_u, inside_v }) => {
            [(u0, v0), (u1, v1), (inside_u, inside_v)]
        }
    }
}

/// The factors of [`pairs`] as vectors of one lane.
#[inline(always)]
const fn side_by_side([a, b, c]: [RawPair; MAX_FACTORS / 2]) -> RawFactors {
    [[a.0], [a.1], [b.0], [b.1], [c.0], [c.1], [0.0], [0.0]]
}

/// 0 if all factors have the same bits. All are compared at once, because it is hard to predict
/// which one differs first.
#[inline(always)]
fn differences(a: &RawFactors, b: &RawFactors) -> u32 {
    (0..ROWS).fold(0, |any, i| any | (a[i][0].to_bits() ^ b[i][0].to_bits()))
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
        let raw = side_by_side(pairs(&factors));
        let mut keep = |domain| {
            self.keep_one(
                config,
                domain,
                lane,
                &process::<i32, _, _>(config.partitioning, domain, &raw),
            )
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
    let raw = side_by_side(pairs(factors));
    let of = |domain| {
        let processed = process::<i32, _, _>(config.partitioning, domain, &raw);
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
