//! Cases on each side of every comparison of the specification that a patch can show.
//!
//! A comparison may be hidden: where all factors are equal, one that lies just above the threshold of the picture frame
//! changes nothing. In these cases the neighbouring threshold changes the output:
//!
//! ```text
//!                     below              above
//! frame (section 3)   1 1 3f800040 1     1 1 3f800041 1     the patch is minimum, or has an inside
//! round               40000000           40000001           2 segments, or 3
//! ```
//!
//! Each entry is a comparison with a side of it, and a case that lies exactly there. The bins `boundary/*` of the
//! coverage have the same names; what lies there is said where they are observed.

use super::from_fixed;
use crate::case::Case;
use tess_core::{
    Config, Domain, FixedFactor, OutputPrimitive, Partitioning, PatchFactors, SplitOrder,
};

type Threshold = (&'static str, Case);

/// The smallest binary32 that is not a number, which lies just above infinity.
pub(crate) const FIRST_NAN: u32 = 0x7F80_0001;
/// 1 + 2^-17 and what is just above it: only the latter makes a picture frame, and is more than one in fixed point.
pub(crate) const FRAME: [u32; 2] = [0x3F80_0040, 0x3F80_0041];
pub(crate) const SIGN: u32 = 0x8000_0000;
const ONE: f32 = 1.0;

/// Every entry, in the order of the specification: a bin of the group `boundary` without the group, such as
/// `frame/above`, and a case.
#[must_use]
pub fn thresholds() -> Vec<(&'static str, Case)> {
    let mut list = Vec::new();
    for domain in Domain::ALL {
        cull(&mut list, domain);
        for partitioning in Partitioning::ALL {
            clamp(&mut list, domain, partitioning);
        }
        round(&mut list, domain);
        frame(&mut list, domain);
        parity(&mut list, domain);
        conversion(&mut list, domain);
    }
    whole(&mut list);
    locations(&mut list);
    wider(&mut list);
    list
}

fn case(partitioning: Partitioning, factors: PatchFactors) -> Case {
    let output = OutputPrimitive::TriangleCw;
    Case { config: Config { partitioning, output, split: SplitOrder::Ruler }, factors }
}

/// One factor among others that are equal.
fn alone(domain: Domain, position: usize, bits: u32, others: f32) -> PatchFactors {
    let factor = |p| if p == position { f32::from_bits(bits) } else { others };
    PatchFactors::from_fn(domain, factor)
}

/// Each outer factor alone at the ends of what is greater than zero.
fn cull(list: &mut Vec<Threshold>, domain: Domain) {
    let infinity = f32::INFINITY.to_bits();
    for position in 0..domain.outer_factors() {
        for (side, bits) in [
            ("cull/below", 0),
            ("cull/below", SIGN),
            ("cull/above", 1),
            ("sign/above", SIGN + 1),
            ("number/below", infinity),
            ("number/above", FIRST_NAN),
        ] {
            let partitioning = Partitioning::ALL[position];
            list.push((side, case(partitioning, alone(domain, position, bits, ONE))));
        }
    }
}

/// All factors at the lower end of the range; outer factors at the upper end, then inside factors, of isolines the
/// density, then the detail.
fn clamp(list: &mut Vec<Threshold>, domain: Domain, partitioning: Partitioning) {
    let of =
        |p| if (domain, p) == (Domain::Isoline, 0) { Partitioning::Integer } else { partitioning };
    let units = |factor, units| {
        from_fixed(FixedFactor::from_f32(factor).to_bits().wrapping_add_signed(units))
    };
    for (side, offset) in [("clamp_low/below", -2), ("clamp_low/below", -1), ("clamp_low/above", 0)]
    {
        let low = |p| units(of(p).range().0, offset);
        list.push((side, case(partitioning, PatchFactors::from_fn(domain, low))));
    }
    // Rounding up sees what a conversion to fixed point would not.
    let beyond = |p| match of(p).range().1 {
        high if of(p).has_integer_factors() => f32::from_bits(high.to_bits() + 1),
        high => units(high, 1),
    };
    let first = if domain == Domain::Isoline { 1 } else { domain.outer_factors() };
    for is_first in [true, false] {
        let among_ones = |high: &dyn Fn(usize) -> f32| {
            let factor = |p| if (p < first) == is_first { high(p) } else { ONE };
            case(partitioning, PatchFactors::from_fn(domain, factor))
        };
        list.push(("clamp_high/below", among_ones(&|p| of(p).range().1)));
        list.push(("clamp_high/above", among_ones(&beyond)));
    }
}

/// Powers of two from 1 to 32, in each position: exact, one pattern more, and the last pattern before the next.
fn round(list: &mut Vec<Threshold>, domain: Domain) {
    for partitioning in [Partitioning::Integer, Partitioning::Pow2] {
        for turn in 0..6 {
            let power = |p: usize| [127, 128, 129, 130, 131, 132][(p + turn) % 6];
            let of = |bits: &dyn Fn(u32) -> u32| {
                let factor = |p| f32::from_bits(bits(power(p)));
                case(partitioning, PatchFactors::from_fn(domain, factor))
            };
            list.extend([
                ("round/below", of(&|power| power << 23)),
                ("round/above", of(&|power| (power << 23) + 1)),
                ("round/last", of(&|power| ((power + 1) << 23) - 1)),
            ]);
        }
    }
}

/// Each factor alone beside what makes a picture frame, and what makes a patch more than a minimum one.
fn frame(list: &mut Vec<Threshold>, domain: Domain) {
    if domain == Domain::Isoline {
        return;
    }
    let [below, above] = FRAME;
    for position in 0..domain.factors() {
        let at = |partitioning, bits| case(partitioning, alone(domain, position, bits, ONE));
        let odd = |bits| at(Partitioning::FractionalOdd, bits);
        list.extend([
            ("frame/below", odd(below)),
            ("frame/above", odd(above)),
            ("number/below", odd(f32::INFINITY.to_bits())),
        ]);
        for partitioning in [Partitioning::Integer, Partitioning::Pow2] {
            list.push(("minimum/above", at(partitioning, ONE.to_bits() + 1)));
        }
        if position >= domain.outer_factors() {
            list.push(("sign/above", odd(SIGN | above)));
            list.push(("round/last", at(Partitioning::Integer, 2f32.to_bits() - 1)));
            for partitioning in Partitioning::ALL {
                list.push(("number/above", at(partitioning, FIRST_NAN)));
            }
        }
    }
}

/// Each factor alone is 1 or 2: only an inside factor of 1 counts as even.
fn parity(list: &mut Vec<Threshold>, domain: Domain) {
    for position in 0..domain.factors() {
        for (side, one) in [("one/below", 1f32), ("one/above", 2.0)] {
            for partitioning in [Partitioning::Integer, Partitioning::Pow2] {
                list.push((side, case(partitioning, alone(domain, position, one.to_bits(), 3.0))));
            }
        }
    }
}

/// Even 15.16 numbers in each binade from 1 or 2 on, whose odd successor moves a point on an outer edge and inside.
const ODD_MOVES: [u32; 6] = [0x1_0200, 0x2_0204, 0x4_0204, 0x8_0202, 0x10_0210, 0x20_0200];
const EVEN_MOVES: [u32; 5] = [0x2_0204, 0x4_0202, 0x8_0206, 0x10_0202, 0x20_0216];

/// Halfway between two 15.16 numbers, and one pattern to each side, in each position and binade.
fn conversion(list: &mut Vec<Threshold>, domain: Domain) {
    for (partitioning, moves) in [
        (Partitioning::FractionalOdd, &ODD_MOVES[..]),
        (Partitioning::FractionalEven, &EVEN_MOVES[..]),
    ] {
        for turn in 0..moves.len() {
            for (side, offset) in
                [("conversion/below", -1), ("conversion/at", 0), ("conversion/above", 1)]
            {
                let factor = |p| {
                    let fixed = moves[(p + turn) % moves.len()];
                    let [low, high] = [fixed, fixed + 1].map(|fixed| from_fixed(fixed).to_bits());
                    let tie = u32::midpoint(low, high);
                    f32::from_bits(tie.wrapping_add_signed(offset))
                };
                // The density is processed as integer.
                let factor = |p| if (domain, p) == (Domain::Isoline, 0) { ONE } else { factor(p) };
                list.push((side, case(partitioning, PatchFactors::from_fn(domain, factor))));
            }
        }
    }
}

fn isoline(split: SplitOrder, partitioning: Partitioning, detail: u32) -> Case {
    let factors = PatchFactors::from_fn(Domain::Isoline, |p| [ONE, from_fixed(detail)][p]);
    let Case { config, factors } = case(partitioning, factors);
    Case { config: Config { split, ..config }, factors }
}

/// Details that are whole, and those by a unit above: the least that splits a point off, in both orders.
fn whole(list: &mut Vec<Threshold>) {
    for split in SplitOrder::ALL {
        for whole in 1..=62u32 {
            let partitioning = match whole % 2 {
                0 => Partitioning::FractionalEven,
                _ => Partitioning::FractionalOdd,
            };
            let detail = |units| isoline(split, partitioning, (whole << 16) + units);
            list.extend([("whole/below", detail(0)), ("whole/above", detail(1))]);
        }
    }
}

/// Factors of which a location lies just below the middle between two 16.16 numbers, or in it.
fn locations(list: &mut Vec<Threshold>) {
    use Partitioning::{FractionalEven as Even, FractionalOdd as Odd};
    for (side, partitioning, detail) in [
        ("location/below", Odd, 0x2_0005),
        ("location/above", Odd, 0x1_FFFF),
        ("location/below", Even, 0x5_7FF9),
        ("location/above", Even, 0x2_0003),
    ] {
        list.extend(SplitOrder::ALL.map(|split| (side, isoline(split, partitioning, detail))));
    }
    for (side, partitioning, inside) in [
        ("ring/below", Odd, 0x2_8011),
        ("ring/above", Odd, 0x2_7FFF),
        ("ring/below", Even, 0x3_FFE5),
        ("ring/above", Even, 0x3_FFFD),
    ] {
        let inside = from_fixed(inside).to_bits();
        list.push((side, case(partitioning, alone(Domain::Triangle, 3, inside, 3.0))));
    }
}

/// Quads of every size whose inside factors differ by at most two, either being the larger. An inside factor of 1 is 2.
fn wider(list: &mut Vec<Threshold>) {
    for u in 2..=64u8 {
        for v in (u - 2).max(2)..=(u + 2).min(64) {
            let side = if u > v { "wider/above" } else { "wider/below" };
            let [inside_u, inside_v] = [u, v].map(f32::from);
            let factors = PatchFactors::from_fn(Domain::Quad, |p| match p {
                4 => inside_u,
                5 => inside_v,
                _ => ONE,
            });
            list.push((side, case(Partitioning::Integer, factors)));
        }
    }
}
