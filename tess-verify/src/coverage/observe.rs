//! Which bins a case hits, read off the model's intermediate values.

use crate::case::Case;
use crate::names::Named;
use tess_core::{
    Domain, FactorContext, Parity, Partitioning, PatchFactors, ProcessedFactor, ProcessedPatch,
    QuadFactors, SplitOrder, place,
};

/// Sends the bins of a case to `hit`; a bin may come more than once.
pub(super) fn observe(case: &Case, mut hit: impl FnMut(String)) {
    let config = case.config;
    let (domain, partitioning) = (case.domain().name(), config.partitioning.name());
    let (output, split) = (config.output.name(), config.split.name());
    hit(format!("configuration/{domain}/{partitioning}/{output}/{split}"));
    match case.patch().processed() {
        ProcessedPatch::Culled => culled(case, &mut hit),
        ProcessedPatch::Minimum(factors) => {
            hit(format!("minimum/{domain}/{partitioning}/{output}"));
            processing(case, factors, &mut hit);
        }
        ProcessedPatch::Regular(factors) => {
            processing(case, factors, &mut hit);
            connectivity(case, factors, &mut hit);
        }
    }
}

fn culled(case: &Case, hit: &mut impl FnMut(String)) {
    let domain = case.domain();
    for (name, factor) in domain.factor_names().iter().zip(case.factors.outer()) {
        let why = match factor {
            _ if factor.is_nan() => "nan",
            _ if factor < 0.0 => "negative",
            _ if factor > 0.0 => continue,
            _ => "zero",
        };
        hit(format!("cull/{}/{name}/{why}", domain.name()));
    }
}

/// What spec sections 3 to 5 do with each factor.
fn processing(case: &Case, factors: &PatchFactors<ProcessedFactor>, hit: &mut impl FnMut(String)) {
    let domain = case.domain();
    for (i, (raw, factor)) in case.factors.iter().zip(factors.iter()).enumerate() {
        let is_density = domain == Domain::Isoline && i == 0;
        let partitioning =
            if is_density { Partitioning::Integer } else { case.config.partitioning };
        let role = if i < domain.outer_factors() { "outer" } else { "inside" };
        if role == "outer" && raw.is_subnormal() {
            hit(format!("denormal/{}/{}", domain.name(), domain.factor_names()[i]));
        }
        clamping_and_rounding(partitioning, role, raw, &factor, hit);
        context(case.config.split, &factor.context, hit);
    }
    if case.config.partitioning == Partitioning::FractionalOdd {
        picture_frame(factors, &case.factors, hit);
    }
}

fn clamping_and_rounding(
    partitioning: Partitioning,
    role: &str,
    raw: f32,
    factor: &ProcessedFactor,
    hit: &mut impl FnMut(String),
) {
    let (low, high) = partitioning.range();
    let clamp = match raw {
        _ if raw.is_nan() => "nan",
        _ if raw < low => "below",
        _ if raw > high => "above",
        _ => "within",
    };
    let partitioning_name = partitioning.name();
    hit(format!("clamp/{partitioning_name}/{role}/{clamp}"));
    if partitioning.has_integer_factors() {
        let how = if factor.rounded == factor.clamped { "exact" } else { "up" };
        hit(format!("round/{partitioning_name}/{role}/{how}"));
    }
    hit(format!("conversion/{role}/{}", conversion(factor)));
}

/// How the rounded factor, in 1..=64, became a 15.16 number.
fn conversion(factor: &ProcessedFactor) -> &'static str {
    // In units of 2^-39 both are integers: a binary32 of at least 1 has at most 23 fraction bits.
    let exponent = (factor.rounded >> 23) - 127;
    let exact = u64::from((factor.rounded & 0x007F_FFFF) | 0x0080_0000) << (16 + exponent);
    let fixed = u64::from(factor.fixed.to_bits()) << 23;
    let half = 1 << 22;
    match (fixed.cmp(&exact), fixed.abs_diff(exact) == half) {
        (std::cmp::Ordering::Equal, _) => "exact",
        (std::cmp::Ordering::Less, true) => "tie_down",
        (std::cmp::Ordering::Less, false) => "down",
        (std::cmp::Ordering::Greater, true) => "tie_up",
        (std::cmp::Ordering::Greater, false) => "up",
    }
}

fn picture_frame(
    factors: &PatchFactors<ProcessedFactor>,
    raw: &PatchFactors,
    hit: &mut impl FnMut(String),
) {
    const LOW: u32 = 0x3F80_0080; // 1 + 2^-16
    for (raw, factor) in raw.inside().zip(factors.inside()) {
        let raised = factor.clamped == LOW && raw.to_bits() != LOW;
        hit(match factor.clamped {
            _ if raised => "picture_frame/raised".to_owned(),
            bits if bits < LOW => "picture_frame/all_one".to_owned(),
            _ => "picture_frame/already_above".to_owned(),
        });
    }
}

/// What spec sections 4 and 5 make of one factor.
pub(super) fn context(split: SplitOrder, context: &FactorContext, hit: &mut impl FnMut(String)) {
    let (split, parity) = (split.name(), context.parity.name());
    let kind = if context.fraction == 0 { "whole" } else { "split" };
    hit(format!("context/{split}/{parity}/{}/{kind}", context.half_points));
    let locations: Vec<_> = (0..context.points).map(|p| place(context, p)).collect();
    if locations.windows(2).any(|pair| pair[0] == pair[1]) {
        hit(format!("exceptional/{split}/{parity}/equal_neighbours"));
    }
    if locations.windows(2).any(|pair| pair[1] < pair[0]) {
        hit(format!("exceptional/{split}/{parity}/backwards"));
    }
}

/// What spec section 7 does with the point counts and parities.
fn connectivity(
    case: &Case,
    factors: &PatchFactors<ProcessedFactor>,
    hit: &mut impl FnMut(String),
) {
    // For each outer edge, the inside factor of the axis that it runs along.
    let (outer, along): (Vec<_>, Vec<_>) = match factors {
        PatchFactors::Isoline(_) => return,
        PatchFactors::Triangle(f) => (f.outer().to_vec(), vec![f.inside; 3]),
        PatchFactors::Quad(f) => {
            (f.outer().to_vec(), vec![f.inside_v, f.inside_u, f.inside_v, f.inside_u])
        }
    };
    let (domain, partitioning) = (case.domain().name(), case.config.partitioning.name());
    for (outer, inside) in outer.iter().zip(&along) {
        let (outer, inside) = (outer.context, inside.context);
        let parities = format!("{}x{}", outer.parity.name(), inside.parity.name());
        hit(format!("parities/{domain}/{partitioning}/{parities}"));
        hit(format!("middle/{parities}"));
        hit(format!("transition/{}x{}", outer.points, inside.points));
    }
    let rings = along.iter().map(|inside| inside.context.points.div_ceil(2) - 1).min();
    hit(format!("rings/{domain}/{}", rings.unwrap_or(0)));
    match factors {
        PatchFactors::Triangle(f) => hit(match f.inside.context.parity {
            Parity::Even => "centre/tri/point".to_owned(),
            Parity::Odd => "centre/tri/triangle".to_owned(),
        }),
        PatchFactors::Quad(f) => quad_centre(f, hit),
        PatchFactors::Isoline(_) => {}
    }
}

fn quad_centre(factors: &QuadFactors<ProcessedFactor>, hit: &mut impl FnMut(String)) {
    let [u, v] = factors.inside().map(|factor| factor.context);
    let along_u = u.points > v.points;
    let (axis, long, short) = if along_u { ("u", u, v) } else { ("v", v, u) };
    let shape = match short.parity {
        Parity::Even => "row",
        Parity::Odd => "strip",
    };
    if shape == "row" && long.points == short.points {
        hit("centre/quad/point".to_owned());
        return;
    }
    hit(format!("centre/quad/{shape}_along_{axis}/{}", long.parity.name()));
    if shape == "strip" && long.points == short.points {
        hit("centre/quad/strip_of_one".to_owned());
    }
}
