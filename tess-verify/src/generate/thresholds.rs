//! Cases on each side of every comparison of the specification, where the output shows the
//! difference.
//!
//! A comparison may be hidden: if all factors are equal, a factor just above the threshold of the
//! picture frame changes nothing. In these cases, moving the threshold by one changes the output:
//!
//! ```text
//!                     below              above
//! frame (section 3)   1 1 3f800040 1     1 1 3f800041 1     the patch is minimum, or has an inside
//! round               40000000           40000001           2 segments, or 3
//! ```
//!
//! Each entry is a comparison with one of its sides, and a case exactly there. The bins
//! `boundary/*` of the coverage have the same names; `cover/boundary.rs` describes them.

use super::choices::Choices;
use super::from_fixed;
use crate::case::Case;
use tess_core::{Domain, FixedFactor, Partitioning, PatchFactors};

type Threshold = (&'static str, Case);

/// The smallest binary32 that is not a number, just above infinity.
pub(crate) const FIRST_NAN: u32 = 0x7F80_0001;
/// 1 + 2^-17, and the next number. Only the latter makes a picture frame, and is more than 1 in
/// fixed point.
pub(crate) const FRAME: [u32; 2] = [0x3F80_0040, 0x3F80_0041];
pub(crate) const SIGN: u32 = 0x8000_0000;
const ONE: f32 = 1.0;

/// Every entry, in the order of the specification: a bin of the group `boundary`, such as
/// `frame/above`, without the name of the group, and a case.
#[must_use]
pub fn thresholds() -> Vec<(&'static str, Case)> {
    of(&Choices::all())
}

/// The entries of a selection. They have both sides of each comparison that its patches can reach.
pub(super) fn of(choices: &Choices) -> Vec<Threshold> {
    let mut list = Thresholds { choices, list: Vec::new() };
    for &domain in &choices.domains {
        list.cull(domain);
        for &partitioning in &choices.partitionings {
            list.clamp(domain, partitioning);
            list.round(domain, partitioning);
        }
        list.frame(domain);
        list.minimum(domain);
        for &partitioning in &choices.partitionings {
            list.parity(domain, partitioning);
            list.conversion(domain, partitioning);
        }
        if domain == Domain::Triangle {
            list.rings();
        }
        if domain == Domain::Quad {
            list.wider();
        }
    }
    list.whole();
    list.locations();
    list.list
}

/// The list under construction.
struct Thresholds<'a> {
    choices: &'a Choices,
    list: Vec<Threshold>,
}

/// Factors that are all `others`, except one.
fn alone(domain: Domain, position: usize, bits: u32, others: f32) -> PatchFactors {
    let factor = |p| if p == position { f32::from_bits(bits) } else { others };
    PatchFactors::from_fn(domain, factor)
}

/// Whether a factor is processed as an integer; an isoline's density always is.
fn is_integer(domain: Domain, partitioning: Partitioning, position: usize) -> bool {
    partitioning.has_integer_factors() || (domain, position) == (Domain::Isoline, 0)
}

impl Thresholds<'_> {
    fn push(&mut self, side: &'static str, partitioning: Partitioning, factors: PatchFactors) {
        let split = self.choices.splits[0];
        self.list.push((side, self.choices.surface(partitioning, split, factors)));
    }

    fn push_in_each_order(
        &mut self,
        side: &'static str,
        partitioning: Partitioning,
        factors: PatchFactors,
    ) {
        for &split in &self.choices.splits {
            self.list.push((side, self.choices.surface(partitioning, split, factors)));
        }
    }

    /// Each outer factor by itself at the limits of the numbers greater than zero.
    fn cull(&mut self, domain: Domain) {
        let infinity = f32::INFINITY.to_bits();
        let partitionings = &self.choices.partitionings;
        for position in 0..domain.outer_factors() {
            for (side, bits) in [
                ("cull/below", 0),
                ("cull/below", SIGN),
                ("cull/above", 1),
                ("sign/above", SIGN + 1),
                ("number/below", infinity),
                ("number/above", FIRST_NAN),
            ] {
                let partitioning = partitionings[position % partitionings.len()];
                self.push(side, partitioning, alone(domain, position, bits, ONE));
            }
        }
    }

    /// All factors at the lower end of the range. Then outer factors at the upper end, and inside
    /// factors; for isolines the density, and the detail.
    fn clamp(&mut self, domain: Domain, partitioning: Partitioning) {
        let of = |p| match is_integer(domain, partitioning, p) {
            true => Partitioning::Integer,
            false => partitioning,
        };
        let units = |factor, units| {
            from_fixed(FixedFactor::from_f32(factor).to_bits().wrapping_add_signed(units))
        };
        for (side, offset) in
            [("clamp_low/below", -2), ("clamp_low/below", -1), ("clamp_low/above", 0)]
        {
            let low = |p| units(of(p).range().0, offset);
            self.push(side, partitioning, PatchFactors::from_fn(domain, low));
        }
        // Rounding up detects a difference that a conversion to fixed point would not.
        let beyond = |p| match of(p).range().1 {
            high if of(p).has_integer_factors() => f32::from_bits(high.to_bits() + 1),
            high => units(high, 1),
        };
        let first = if domain == Domain::Isoline { 1 } else { domain.outer_factors() };
        for is_first in [true, false] {
            let among_ones = |high: &dyn Fn(usize) -> f32| {
                let factor = |p| if (p < first) == is_first { high(p) } else { ONE };
                PatchFactors::from_fn(domain, factor)
            };
            self.push("clamp_high/below", partitioning, among_ones(&|p| of(p).range().1));
            self.push("clamp_high/above", partitioning, among_ones(&beyond));
        }
    }

    /// Powers of two from 1 to 32 in each position that is rounded: exact, the next bit pattern,
    /// and the last pattern before the next integer.
    fn round(&mut self, domain: Domain, partitioning: Partitioning) {
        if !is_integer(domain, partitioning, 0) {
            return;
        }
        for turn in 0..6 {
            let power = |p: usize| [127_u32, 128, 129, 130, 131, 132][(p + turn) % 6];
            // The three sides differ in the exponent and in the bits that are added.
            for (side, next, more) in
                [("round/below", 0, 0), ("round/above", 0, 1), ("round/last", 1, -1)]
            {
                let factor = |p| match is_integer(domain, partitioning, p) {
                    true => f32::from_bits(((power(p) + next) << 23_u32).wrapping_add_signed(more)),
                    false => ONE,
                };
                self.push(side, partitioning, PatchFactors::from_fn(domain, factor));
            }
        }
    }

    /// Each factor by itself at the threshold of a picture frame.
    fn frame(&mut self, domain: Domain) {
        let odd = Partitioning::FractionalOdd;
        if domain == Domain::Isoline || !self.choices.partitionings.contains(&odd) {
            return;
        }
        let [below, above] = FRAME;
        for position in 0..domain.factors() {
            let mut at = |side, bits| self.push(side, odd, alone(domain, position, bits, ONE));
            at("frame/below", below);
            at("frame/above", above);
            at("number/below", f32::INFINITY.to_bits());
            if position >= domain.outer_factors() {
                at("sign/above", SIGN | above);
            }
        }
    }

    /// Each factor by itself at the threshold of a minimum patch.
    fn minimum(&mut self, domain: Domain) {
        if domain == Domain::Isoline {
            return;
        }
        let choices = self.choices;
        for position in 0..domain.factors() {
            for &partitioning in &choices.partitionings {
                let mut at =
                    |side, bits| self.push(side, partitioning, alone(domain, position, bits, ONE));
                if partitioning.has_integer_factors() {
                    at("minimum/above", ONE.to_bits() + 1);
                }
                if position < domain.outer_factors() {
                    continue;
                }
                at("number/above", FIRST_NAN);
                if partitioning == Partitioning::Integer {
                    at("round/last", 2f32.to_bits() - 1);
                }
            }
        }
    }

    /// Each factor by itself is 1 or 2: a factor of 1 counts as even only inside.
    fn parity(&mut self, domain: Domain, partitioning: Partitioning) {
        for position in 0..domain.factors() {
            if is_integer(domain, partitioning, position) {
                for (side, one) in [("one/below", 1f32), ("one/above", 2.0)] {
                    let factors = alone(domain, position, one.to_bits(), 3.0);
                    self.push(side, partitioning, factors);
                }
            }
        }
    }

    /// Halfway between two 15.16 numbers, and one bit pattern to each side, in each position and
    /// binade.
    fn conversion(&mut self, domain: Domain, partitioning: Partitioning) {
        let moves = match partitioning {
            Partitioning::Integer | Partitioning::Pow2 => return,
            Partitioning::FractionalOdd => &ODD_MOVES[..],
            Partitioning::FractionalEven => &EVEN_MOVES[..],
        };
        for turn in 0..moves.len() {
            for (side, offset) in
                [("conversion/below", -1), ("conversion/at", 0), ("conversion/above", 1)]
            {
                let factor = |p| {
                    let fixed = moves[(p + turn) % moves.len()];
                    let [low, high] = [fixed, fixed + 1].map(|fixed| from_fixed(fixed).to_bits());
                    let tie = u32::midpoint(low, high);
                    let beside = f32::from_bits(tie.wrapping_add_signed(offset));
                    if is_integer(domain, partitioning, p) { ONE } else { beside }
                };
                self.push(side, partitioning, PatchFactors::from_fn(domain, factor));
            }
        }
    }

    /// Factors that put a ring just below the middle between two 16.16 numbers, or exactly in it.
    fn rings(&mut self) {
        for (side, partitioning, inside) in [
            ("ring/below", Partitioning::FractionalOdd, 0x2_8011),
            ("ring/above", Partitioning::FractionalOdd, 0x2_7FFF),
            ("ring/below", Partitioning::FractionalEven, 0x3_FFE5),
            ("ring/above", Partitioning::FractionalEven, 0x3_FFFD),
        ] {
            if self.choices.partitionings.contains(&partitioning) {
                let inside = from_fixed(inside).to_bits();
                self.push(side, partitioning, alone(Domain::Triangle, 3, inside, 3.0));
            }
        }
    }

    /// Quads of every size whose inside factors differ by at most two, in either direction. An
    /// inside factor of 1 becomes 2.
    fn wider(&mut self) {
        let partitioning = self.choices.partitioning(&[Partitioning::Integer]);
        for u in 2..=64u8 {
            for v in (u - 2).max(2)..=(u + 2).min(64) {
                let side = if u > v { "wider/above" } else { "wider/below" };
                let [inside_u, inside_v] = [u, v].map(f32::from);
                let factors = PatchFactors::from_fn(Domain::Quad, |p| match p {
                    4 => inside_u,
                    5 => inside_v,
                    _ => ONE,
                });
                self.push(side, partitioning, factors);
            }
        }
    }

    /// A patch with one factor whose context shows the split order: an isoline's detail, or an
    /// outer factor.
    fn push_detail(&mut self, side: &'static str, partitioning: Partitioning, detail: u32) {
        let domain = self.choices.domains[0];
        let position = usize::from(domain == Domain::Isoline);
        let factors = alone(domain, position, from_fixed(detail).to_bits(), ONE);
        self.push_in_each_order(side, partitioning, factors);
    }

    /// Whole factors, and factors one unit above them, which is the smallest excess that splits a
    /// point off. In both orders.
    fn whole(&mut self) {
        for whole in 1..=62u32 {
            let partitioning = match whole % 2 {
                0 => Partitioning::FractionalEven,
                _ => Partitioning::FractionalOdd,
            };
            if self.choices.partitionings.contains(&partitioning) {
                self.push_detail("whole/below", partitioning, whole << 16);
                self.push_detail("whole/above", partitioning, (whole << 16) + 1);
            }
        }
    }

    /// Factors that put a location just below the middle between two 16.16 numbers, or exactly in
    /// it.
    fn locations(&mut self) {
        use Partitioning::{FractionalEven as Even, FractionalOdd as Odd};
        for (side, partitioning, detail) in [
            ("location/below", Odd, 0x2_0005),
            ("location/above", Odd, 0x1_FFFF),
            ("location/below", Even, 0x5_7FF9),
            ("location/above", Even, 0x2_0003),
        ] {
            if self.choices.partitionings.contains(&partitioning) {
                self.push_detail(side, partitioning, detail);
            }
        }
    }
}

/// Even 15.16 numbers, one in each binade from 1 or 2 upwards, whose odd successor moves a point on
/// an outer edge and inside.
pub(super) const ODD_MOVES: [u32; 6] =
    [0x1_0200, 0x2_0204, 0x4_0204, 0x8_0202, 0x10_0210, 0x20_0200];
pub(super) const EVEN_MOVES: [u32; 5] = [0x2_0204, 0x4_0202, 0x8_0206, 0x10_0202, 0x20_0216];
