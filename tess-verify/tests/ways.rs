//! Tests of each mistake that a report names: it is planted in the model's output, detected, and
//! named only where it explains every difference.

use tess_core::fixed_point::ONE;
use tess_core::{
    Config, Domain, DomainPoint, IsolineFactors, OutputPrimitive, PatchFactors, QuadFactors,
    Tessellation,
};
use tess_verify::Case;
use tess_verify::check::{ListOrder, Report, Strength, Way, check_device};
use tess_verify::generate::{SplitMix64, configurations, random_patch};

/// A device's answer for a case.
type Device = fn(&Case) -> Tessellation;

fn model(case: &Case) -> Tessellation {
    case.patch().tessellate()
}

/// The model's output with every point moved and its vertices in the same order.
fn moved(case: &Case, to: fn([u32; 2]) -> [u32; 2]) -> Tessellation {
    let Tessellation { points, indices } = model(case);
    let place = |point: DomainPoint| {
        let [u, v] = to([point.u.to_bits(), point.v.to_bits()]);
        DomainPoint::from_bits(u, v)
    };
    Tessellation { points: points.into_iter().map(place).collect(), indices }
}

/// The same, with triangles that turn in the right direction.
fn moved_and_turned(case: &Case, to: fn([u32; 2]) -> [u32; 2]) -> Tessellation {
    let output = match case.config.output {
        OutputPrimitive::TriangleCw => OutputPrimitive::TriangleCcw,
        OutputPrimitive::TriangleCcw => OutputPrimitive::TriangleCw,
        other => other,
    };
    moved(&Case { config: Config { output, ..case.config }, ..*case }, to)
}

const fn swapped([u, v]: [u32; 2]) -> [u32; 2] {
    [v, u]
}

const fn u_backwards([u, v]: [u32; 2]) -> [u32; 2] {
    [ONE - u, v]
}

const fn v_backwards([u, v]: [u32; 2]) -> [u32; 2] {
    [u, ONE - v]
}

const fn w_for_v([u, v]: [u32; 2]) -> [u32; 2] {
    [u, (ONE - u).wrapping_sub(v)]
}

/// The answer of a device with this mistake on one domain; elsewhere, the model's output.
fn on(domain: Domain, case: &Case, answer: impl Fn(&Case) -> Tessellation) -> Tessellation {
    if case.domain() == domain { answer(case) } else { model(case) }
}

fn with_factors(case: &Case, factors: PatchFactors) -> Tessellation {
    model(&Case { factors, ..*case })
}

fn isoline_factors(case: &Case) -> Tessellation {
    let PatchFactors::Isoline(f) = case.factors else { return model(case) };
    let exchanged = IsolineFactors { density: f.detail, detail: f.density };
    with_factors(case, PatchFactors::Isoline(exchanged))
}

fn inside_factors(case: &Case) -> Tessellation {
    let PatchFactors::Quad(f) = case.factors else { return model(case) };
    let exchanged = QuadFactors { inside_u: f.inside_v, inside_v: f.inside_u, ..f };
    with_factors(case, PatchFactors::Quad(exchanged))
}

/// The nearest number with a significand of 11 bits, ties to even: binary16, as long as the number
/// is normal in it.
fn half(factor: f32) -> f32 {
    let bits = factor.to_bits();
    let tie = 0xFFF + (bits >> 13 & 1);
    f32::from_bits((bits + tie) & !0x1FFF)
}

const DEVICES: [(Way, Device); 12] = [
    (Way::Reversed, |case| moved_and_turned(case, |uv| uv)),
    (Way::Transposed, |case| moved_and_turned(case, swapped)),
    (Way::TransposedReversed, |case| moved(case, swapped)),
    (Way::MirroredU, |case| moved_and_turned(case, u_backwards)),
    (Way::MirroredUReversed, |case| moved(case, u_backwards)),
    (Way::MirroredV, |case| moved_and_turned(case, v_backwards)),
    (Way::MirroredVReversed, |case| moved(case, v_backwards)),
    (Way::ExchangedVW, |case| on(Domain::Triangle, case, |case| moved_and_turned(case, w_for_v))),
    (Way::ExchangedVWReversed, |case| on(Domain::Triangle, case, |case| moved(case, w_for_v))),
    (Way::IsolineFactors, isoline_factors),
    (Way::InsideFactors, inside_factors),
    (Way::HalfFactors, |case| with_factors(case, case.factors.map(half))),
];

/// Small random patches of every configuration with factors in range, none of which is subnormal in
/// binary16.
fn cases() -> Vec<Case> {
    let mut random = SplitMix64::new(1);
    let patch = |(domain, config)| {
        [0; 3].map(|_| Case { config, factors: random_patch(domain, &mut random) })
    };
    let in_range = |case: &Case| case.factors.iter().all(|factor| (1.0..=64.0).contains(&factor));
    configurations().flat_map(patch).filter(in_range).collect()
}

fn report(strength: Strength, device: impl Fn(&Case) -> Tessellation) -> Report {
    check_device(cases().into_iter().map(|case| (case, device(&case))), strength)
}

const STRENGTHS: [ListOrder; 3] = [ListOrder::Exact, ListOrder::Sequence, ListOrder::Any];

#[test]
fn each_mistake_is_named() {
    for (way, device) in DEVICES {
        for order in STRENGTHS {
            let report = report(Strength { order, ..Strength::default() }, device);
            assert!(report.mismatches > 10, "{way:?}, {order:?}: {report}");
            assert_eq!(report.ways(), [way], "{order:?}: {report}");
        }
    }
    let devices = DEVICES.map(|(way, _)| way);
    let not_allowed = Way::ALL.into_iter().filter(|way| !way.is_allowed());
    assert!(not_allowed.eq(devices), "each has a device");
}

/// A device that also loses the last primitive of one patch.
#[test]
fn a_mistake_that_does_not_explain_everything_is_not_named() {
    let odd = cases().into_iter().find(|case| model(case).indices.len() > 30).expect("one");
    for (way, device) in DEVICES {
        let report = report(Strength::default(), |case| {
            let mut output = device(case);
            if *case == odd {
                output.indices.truncate(output.indices.len() - odd.primitive_size());
            }
            output
        });
        assert_eq!(report.ways(), [], "{way:?}: {report}");
    }
}

/// Ties to even, and numbers too small or too large for binary16.
#[test]
fn binary16_has_its_own_ends() {
    let answer = |line: &str, taken: &str| {
        let [case, taken]: [Case; 2] = [line, taken].map(|line| line.parse().expect("a case"));
        Way::HalfFactors.explains(&case, &model(&taken), Strength::default(), 64)
    };
    let isoline =
        |detail: &str| format!("case isoline fractional_odd line ruler 40400000 {detail}");
    for (detail, taken) in [
        ("40401000", "40400000"), // 3 + 2^-10, halfway: to the even one
        ("40403000", "40404000"), // 3 + 3 * 2^-10
        ("40401001", "40402000"),
        ("33000000", "00000000"), // 2^-25, which becomes 0 and culls
        ("33000001", "33800000"),
        ("477ff000", "7f800000"), // 65520, which becomes infinity
    ] {
        assert!(answer(&isoline(detail), &isoline(taken)), "{detail} is {taken}");
    }
    assert!(!answer(&isoline("40401000"), &isoline("40402000")), "ties go to the even one");
    assert!(!answer(&isoline("33000001"), &isoline("00000000")), "it is above zero");
}
