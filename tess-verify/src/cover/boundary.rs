//! Both sides of every comparison of the specification: the bins `boundary/*`.
//!
//! | comparison | below | above |
//! | --- | --- | --- |
//! | `cull` | an outer factor is a zero | or the smallest denormal |
//! | `sign` | - | one is a denormal below zero, or an inside one would make a picture frame but for its sign |
//! | `number` | a factor is infinite | or the first pattern that is not a number |
//! | `clamp_low`, `clamp_high` | up to two units below the lower end, the upper end | the lower end, up to a unit above the upper |
//! | `round` | an integer | a pattern above it; `last`: the pattern before the next |
//! | `frame` | the largest factor is 1 + 2^-17 | or a pattern more |
//! | `minimum` | - | all factors but one are 1, and that one a pattern more |
//! | `one` | a rounded factor is 1 | or 2 |
//! | `conversion` | a pattern below the middle of two numbers; `at`: in it | a pattern above it |
//! | `whole` | the fraction of a context is 0 | or 1 |
//! | `location`, `ring` | a sum lies just below the middle of two places | or in it |
//! | `wider` | inside counts along u and v are equal or v has up to two more | u has up to two more |

use crate::case::Case;
use crate::generate::{FIRST_NAN, FRAME, SIGN};
use tess_core::fixed_point::{ONE, TWO_THIRDS};
use tess_core::place::{place, placement};
use tess_core::{Domain, FactorContext, FixedFactor, Partitioning, PatchFactors, ProcessedFactor};

const SIDES: [&str; 2] = ["below", "above"];

/// The bins that patches of a domain and a partitioning can hit.
pub(super) fn bins(domain: Domain, partitioning: Partitioning) -> Vec<String> {
    let is_isoline = domain == Domain::Isoline;
    let is_integer = partitioning.has_integer_factors();
    let mut bins = vec!["boundary/sign/above".to_owned()];
    let mut both = |is_there: bool, names: &[&str], others: &[&str]| {
        let sided =
            names.iter().flat_map(|name| SIDES.map(|side| format!("boundary/{name}/{side}")));
        let others = others.iter().map(|bin| format!("boundary/{bin}"));
        bins.extend(sided.chain(others).filter(|_| is_there));
    };
    both(true, &["cull", "number", "clamp_low", "clamp_high"], &[]);
    both(is_integer || is_isoline, &["round", "one"], &["round/last"]);
    both(!is_integer, &["conversion", "whole", "location"], &["conversion/at"]);
    both(!is_integer && domain == Domain::Triangle, &["ring"], &[]);
    both(!is_isoline && partitioning == Partitioning::FractionalOdd, &["frame"], &[]);
    both(is_integer && !is_isoline, &[], &["minimum/above"]);
    both(domain == Domain::Quad, &["wider"], &[]);
    bins
}

/// Sends to `hit` the bins of thresholds that the case is next to. `factors` are the processed
/// factors; `None` for a culled patch.
pub(super) fn observe(
    case: &Case,
    factors: Option<&PatchFactors<ProcessedFactor>>,
    hit: &mut impl FnMut(String),
) {
    let mut hit = |bin: &str| hit(format!("boundary/{bin}"));
    let domain = case.domain();
    for (i, raw) in case.factors.iter().enumerate() {
        let bits = raw.to_bits();
        match (i < domain.outer_factors(), bits) {
            (true, 0 | SIGN) => hit("cull/below"),
            (true, 1) => hit("cull/above"),
            (_, FIRST_NAN) => hit("number/above"),
            (outer, _) if bits == SIGN | if outer { 1 } else { FRAME[1] } => hit("sign/above"),
            _ if raw == f32::INFINITY => hit("number/below"),
            _ => {}
        }
    }
    let Some(factors) = factors else { return };
    for (i, (raw, factor)) in case.factors.iter().zip(factors.iter()).enumerate() {
        let is_density = domain == Domain::Isoline && i == 0;
        let own = case.config.partitioning;
        let partitioning = if is_density { Partitioning::Integer } else { own };
        clamping(partitioning, raw, &mut hit);
        match partitioning.has_integer_factors() {
            true => rounding(&factor, &mut hit),
            false => conversion(&factor, &mut hit),
        }
    }
    match factors {
        PatchFactors::Isoline(_) => return,
        PatchFactors::Triangle(f) => {
            if !case.config.partitioning.has_integer_factors() {
                rings(&f.inside.context, &mut hit);
            }
        }
        PatchFactors::Quad(f) => {
            let [u, v] = f.inside().map(|factor| factor.context.points);
            if u.abs_diff(v) <= 2 {
                hit(if u > v { "wider/above" } else { "wider/below" });
            }
        }
    }
    largest(case, &mut hit);
}

fn clamping(partitioning: Partitioning, raw: f32, hit: &mut impl FnMut(&str)) {
    let fixed = |factor| FixedFactor::from_f32(factor).to_bits();
    let (low, high) = partitioning.range();
    let is = |end: f32| raw.to_bits() == end.to_bits();
    match raw {
        _ if is(low) => hit("clamp_low/above"),
        _ if raw < low && fixed(raw) + 2 >= fixed(low) => hit("clamp_low/below"),
        _ if is(high) => hit("clamp_high/below"),
        _ if raw > high && fixed(raw) <= fixed(high) + 1 => hit("clamp_high/above"),
        _ => {}
    }
}

fn rounding(factor: &ProcessedFactor, hit: &mut impl FnMut(&str)) {
    let mask = (1 << (23 - exponent(factor))) - 1;
    match factor.clamped & mask {
        0 => hit("round/below"),
        1 => hit("round/above"),
        fraction if fraction == mask => hit("round/last"),
        _ => {}
    }
    match factor.fixed.to_bits() / ONE {
        1 => hit("one/below"),
        2 => hit("one/above"),
        _ => {}
    }
}

/// The exponent of a clamped factor, 0 to 6.
const fn exponent(factor: &ProcessedFactor) -> u32 {
    (factor.clamped >> 23) - 127
}

fn conversion(factor: &ProcessedFactor, hit: &mut impl FnMut(&str)) {
    // The bits below 2^-16. For the factor 64 they are all 0.
    let half = (1 << (7 - exponent(factor))) / 2;
    match i64::from(factor.clamped & (2 * half - 1)) - i64::from(half) {
        -1 if half > 1 => hit("conversion/below"),
        0 => hit("conversion/at"),
        1 => hit("conversion/above"),
        _ => {}
    }
    let context = &factor.context;
    match context.fraction {
        0 => hit("whole/below"),
        1 => hit("whole/above"),
        _ => {}
    }
    for p in 0..context.half_points {
        let Some(blend) = placement(context, p).blend else { continue };
        let sum = blend.coarse * (ONE - blend.fraction) + blend.fine * blend.fraction;
        beside_middle(sum, 0x7FFF, ["location/below", "location/above"], hit);
    }
}

/// The distances of a triangle's rings from its edges. Their products are even, so 0x7FFE is the
/// largest value below the middle.
fn rings(inside: &FactorContext, hit: &mut impl FnMut(&str)) {
    for ring in 1..inside.points / 2 {
        let product = place(inside, ring).to_bits() * TWO_THIRDS;
        beside_middle(product, 0x7FFE, ["ring/below", "ring/above"], hit);
    }
}

fn beside_middle(sum: u32, below: u32, names: [&str; 2], hit: &mut impl FnMut(&str)) {
    let rest = sum & 0xFFFF;
    if rest == below || rest == 0x8000 {
        hit(names[usize::from(rest == 0x8000)]);
    }
}

/// The comparisons that decide whether a triangle or quad has a picture frame, and whether it is a
/// minimum patch.
fn largest(case: &Case, hit: &mut impl FnMut(&str)) {
    let bits = || case.factors.iter().map(f32::to_bits);
    let largest = bits().filter(|bits| *bits < FIRST_NAN).max();
    let is_odd = case.config.partitioning == Partitioning::FractionalOdd;
    match largest {
        Some(bits) if is_odd && bits == FRAME[0] => hit("frame/below"),
        Some(bits) if is_odd && bits == FRAME[1] => hit("frame/above"),
        Some(above) if case.config.partitioning.has_integer_factors() => {
            let ones = bits().filter(|bits| *bits == 1f32.to_bits()).count();
            let is_next = above == 1f32.to_bits() + 1 && ones + 1 == bits().count();
            if is_next {
                hit("minimum/above");
            }
        }
        _ => {}
    }
}
