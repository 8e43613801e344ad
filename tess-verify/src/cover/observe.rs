//! The bins that a case hits, read off the model's intermediate values.

use super::boundary;
use crate::case::Case;
use crate::names::{Named, way_of};
use tess_core::place::place;
use tess_core::{
    Config, Domain, FactorContext, Parity, Partitioning, PatchFactors, ProcessedFactor,
    ProcessedPatch, SplitOrder,
};

/// Sends the bins of a case to `hit`; a bin may be sent more than once.
pub(super) fn observe(case: &Case, mut hit: impl FnMut(String)) {
    let config = case.config;
    let (domain, partitioning) = (case.domain().name(), config.partitioning.name());
    let (output, split) = (config.output.name(), config.split.name());
    hit(format!("configuration/{domain}/{partitioning}/{output}/{split}"));
    let patch = case.patch();
    boundary::observe(case, patch.processed().factors(), &mut hit);
    match patch.processed() {
        ProcessedPatch::Culled => culled(case, &mut hit),
        ProcessedPatch::Minimum(factors) => {
            hit(format!("minimum/{domain}/{partitioning}/{output}/{split}"));
            processing(case, factors, &mut hit);
        }
        ProcessedPatch::Regular(factors) => {
            processing(case, factors, &mut hit);
            connectivity(case, factors, &mut hit);
        }
    }
}

/// The state that a patch may leave behind for the next one, as names and values: its kind, which
/// is its domain and the path that it takes, and the fields of its configuration.
pub(super) fn sequence_values_of(case: &Case) -> [(&'static str, String); 4] {
    sequence_values(case.domain(), case.config, way_of(&case.patch()))
}

/// The same for any patch of this domain and configuration that takes this path.
pub(super) fn sequence_values(
    domain: Domain,
    config: Config,
    way: &str,
) -> [(&'static str, String); 4] {
    [
        ("kind", format!("{}_{way}", domain.name())),
        ("partitioning", config.partitioning.name().to_owned()),
        ("output", config.output.name().to_owned()),
        ("split", config.split.name().to_owned()),
    ]
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

/// The bins of spec sections 3 to 5, by factor.
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

/// The bins of spec sections 4 and 5 for one factor.
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

/// The bins of spec section 7, which depend on point counts and parities.
fn connectivity(
    case: &Case,
    factors: &PatchFactors<ProcessedFactor>,
    hit: &mut impl FnMut(String),
) {
    // For each outer edge, the inside factor of the axis along which it runs.
    let (outer, along): (Vec<_>, Vec<_>) = match factors {
        PatchFactors::Isoline(_) => return,
        PatchFactors::Triangle(f) => (f.outer().to_vec(), vec![f.inside; 3]),
        PatchFactors::Quad(f) => {
            (f.outer().to_vec(), vec![f.inside_v, f.inside_u, f.inside_v, f.inside_u])
        }
    };
    let (domain, partitioning) = (case.domain().name(), case.config.partitioning.name());
    let split = case.config.split.name();
    for (outer, inside) in outer.iter().zip(&along) {
        let (outer, inside) = (outer.context, inside.context);
        let parities = format!("{}x{}", outer.parity.name(), inside.parity.name());
        hit(format!("parities/{split}/{domain}/{partitioning}/{parities}"));
        hit(format!("middle/{split}/{parities}"));
        hit(format!("transition/{split}/{}x{}", outer.points, inside.points));
    }
    let rings = along.iter().map(|inside| inside.context.points.div_ceil(2) - 1).min();
    let rings = rings.unwrap_or(0);
    let centre = match factors {
        PatchFactors::Isoline(_) => return,
        PatchFactors::Triangle(f) => triangle_centre(f.inside.context.parity).to_owned(),
        PatchFactors::Quad(f) => {
            let [u, v] = f.inside().map(|factor| (factor.context.points, factor.context.parity));
            quad_centre(u, v)
        }
    };
    hit(format!("rings/{domain}/{rings}/{centre}"));
    hit(format!("centre/{domain}/{centre}"));
}

/// The centre of a triangle patch, by the parity of its inside factor.
pub(super) const fn triangle_centre(inside: Parity) -> &'static str {
    match inside {
        Parity::Even => "point",
        Parity::Odd => "triangle",
    }
}

/// The centre of a quad patch, by the points and parities of its inside factors.
pub(super) fn quad_centre(u: (u32, Parity), v: (u32, Parity)) -> String {
    let along_u = u.0 > v.0;
    let (axis, long, short) = if along_u { ("u", u, v) } else { ("v", v, u) };
    match (short.1, long.0 == short.0) {
        (Parity::Even, true) => "point".to_owned(),
        (Parity::Odd, true) => "strip_of_one".to_owned(),
        (Parity::Even, false) => format!("row_along_{axis}/{}", long.1.name()),
        (Parity::Odd, false) => format!("strip_along_{axis}/{}", long.1.name()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeMap;

    /// The bins that a case hits, in alphabetical order and each with its number of hits. Those
    /// that `tests/thresholds.rs` covers are left out.
    fn bins(line: &str) -> Vec<String> {
        let case: Case = line.parse().expect("a case");
        let mut hits: BTreeMap<String, u32> = BTreeMap::new();
        observe(&case, |bin| *hits.entry(bin).or_default() += 1);
        hits.retain(|bin, _| !bin.starts_with("boundary/"));
        hits.into_iter().map(|(bin, hits)| format!("{bin} {hits}")).collect()
    }

    /// The bins of one group.
    fn group(line: &str, group: &str) -> Vec<String> {
        bins(line).iter().filter_map(|bin| Some(bin.strip_prefix(group)?.to_owned())).collect()
    }

    /// The case hits exactly these bins.
    fn expect(line: &str, expected: &str) {
        let expected: Vec<&str> = expected.lines().map(str::trim).collect();
        assert_eq!(bins(line), expected, "{line}");
    }

    #[test]
    fn culled_patches() {
        expect(
            "case tri integer line ruler 00000000 40400000 bf800000 40400000",
            "configuration/tri/integer/line/ruler 1
             cull/tri/u0/zero 1
             cull/tri/w0/negative 1",
        );
        expect(
            "case quad pow2 point center 3f800000 7fc00000 80000000 40400000 40400000 40400000",
            "configuration/quad/pow2/point/center 1
             cull/quad/u1/zero 1
             cull/quad/v0/nan 1",
        );
    }

    /// Outer factors 64, 2.5, 65 and 0.5; inside factors NaN and 64.
    #[test]
    fn ends_of_the_range() {
        let line =
            "case quad integer point ruler 42800000 40200000 42820000 3f000000 7fc00000 42800000";
        let clamp =
            ["inside/nan 1", "inside/within 1", "outer/above 1", "outer/below 1", "outer/within 2"];
        assert_eq!(group(line, "clamp/integer/"), clamp);
        let round = ["inside/exact 2", "outer/exact 3", "outer/up 1"];
        assert_eq!(group(line, "round/integer/"), round);
    }

    /// Equal inside factors, odd and even; a denormal; factors that do not round.
    #[test]
    fn regular_quads() {
        expect(
            "case quad integer triangle_cw ruler 40400000 40400000 40400000 40400000 40400000 40400000",
            "centre/quad/strip_of_one 1
             clamp/integer/inside/within 2
             clamp/integer/outer/within 4
             configuration/quad/integer/triangle_cw/ruler 1
             context/ruler/odd/2/whole 6
             conversion/inside/exact 2
             conversion/outer/exact 4
             middle/ruler/oddxodd 4
             parities/ruler/quad/integer/oddxodd 4
             rings/quad/1/strip_of_one 1
             round/integer/inside/exact 2
             round/integer/outer/exact 4
             transition/ruler/4x4 4",
        );
        expect(
            "case quad fractional_even line ruler 40000000 40000000 40000000 00000001 40800000 40800000",
            "centre/quad/point 1
             clamp/fractional_even/inside/within 2
             clamp/fractional_even/outer/below 1
             clamp/fractional_even/outer/within 3
             configuration/quad/fractional_even/line/ruler 1
             context/ruler/even/1/whole 4
             context/ruler/even/2/whole 2
             conversion/inside/exact 2
             conversion/outer/exact 4
             denormal/quad/v1 1
             middle/ruler/evenxeven 4
             parities/ruler/quad/fractional_even/evenxeven 4
             rings/quad/2/point 1
             transition/ruler/3x5 4",
        );
    }

    /// Inside factors whose shorter axis is odd or even; the longer axis is u or v.
    #[test]
    fn centres_of_quads() {
        for (inside, expected) in [
            ("40400000 40a00000", "strip_along_v/odd 1"),
            ("40a00000 40400000", "strip_along_u/odd 1"),
            ("40400000 40c00000", "strip_along_v/even 1"),
            ("40800000 40c00000", "row_along_v/even 1"),
            ("40e00000 40800000", "row_along_u/odd 1"),
            ("40800000 40800000", "point 1"),
        ] {
            let line = format!("case quad integer line ruler{} {inside}", " 40400000".repeat(4));
            assert_eq!(group(&line, "centre/quad/"), [expected], "{inside}");
        }
    }

    /// 3f800080 is 1 + 2^-16, and 3f800040 is 1 + 2^-17.
    #[test]
    fn picture_frames() {
        for (factors, expected) in [
            ("40000000 3f800000 3f800000 3f800080", "already_above 1"),
            ("40000000 3f800000 3f800000 3f80007f", "raised 1"),
            ("3f800000 3f800000 3f800000 3f800040", "all_one 1"),
        ] {
            let line = format!("case tri fractional_odd line ruler {factors}");
            assert_eq!(group(&line, "picture_frame/"), [expected], "{factors}");
        }
    }

    /// 3 + 2^-17 and 3 + 3 * 2^-17 are in the middle between two numbers. The inside of a picture
    /// frame is raised.
    #[test]
    fn fractional_triangles() {
        expect(
            "case tri fractional_odd line ruler 3f800000 40400020 40400060 3f800000",
            "centre/tri/triangle 1
             clamp/fractional_odd/inside/within 1
             clamp/fractional_odd/outer/within 3
             configuration/tri/fractional_odd/line/ruler 1
             context/ruler/odd/1/whole 1
             context/ruler/odd/2/split 1
             context/ruler/odd/2/whole 1
             context/ruler/odd/3/split 1
             conversion/inside/exact 1
             conversion/outer/exact 1
             conversion/outer/tie_down 1
             conversion/outer/tie_up 1
             exceptional/ruler/odd/equal_neighbours 2
             middle/ruler/oddxodd 3
             parities/ruler/tri/fractional_odd/oddxodd 3
             picture_frame/raised 1
             rings/tri/1/triangle 1
             transition/ruler/2x4 1
             transition/ruler/4x4 1
             transition/ruler/6x4 1",
        );
        expect(
            "case tri fractional_odd line ruler 3f800000 3f800000 3f800000 3f800000",
            "clamp/fractional_odd/inside/within 1
             clamp/fractional_odd/outer/within 3
             configuration/tri/fractional_odd/line/ruler 1
             context/ruler/odd/1/whole 4
             conversion/inside/exact 1
             conversion/outer/exact 3
             minimum/tri/fractional_odd/line/ruler 1
             picture_frame/all_one 1",
        );
    }

    /// The density is processed as an integer, whatever the partitioning.
    #[test]
    fn isolines() {
        expect(
            "case isoline fractional_odd line ruler 40200000 40200001",
            "clamp/fractional_odd/outer/within 1
             clamp/integer/outer/within 1
             configuration/isoline/fractional_odd/line/ruler 1
             context/ruler/odd/2/split 1
             context/ruler/odd/2/whole 1
             conversion/outer/down 1
             conversion/outer/exact 1
             round/integer/outer/up 1",
        );
    }
}
