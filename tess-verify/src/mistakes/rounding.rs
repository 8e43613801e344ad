//! Mistakes: levels that are clamped or rounded in another way, and the patch without an inside.

#![expect(clippy::float_arithmetic, clippy::float_cmp, reason = "mistakes in binary32")]

use super::family::{Family, Label};
use super::levels::{for_each, inner, mixes};
use super::places::{each, levels, one, outer};
use crate::case::Case;
use half::{bf16, f16};
use tess_core::{Domain, Partitioning};

pub(super) fn all() -> Vec<Family> {
    [clamped(), rounded(), changed(), formats(), minimum()].into_iter().flatten().collect()
}

/// The smaller of a level and a number; NaN stays.
fn at_most(level: f32, most: f32) -> f32 {
    if level > most { most } else { level }
}

fn clamped() -> Vec<Family> {
    // Under fractional odd spacing the largest number of segments is 63, so ending at 63 is not a
    // mistake there.
    let high = for_each(
        Family::new("levels end at a smaller number"),
        [62.0, 61.5, 32.0, 16.0f32],
        |case, high| each(case, |_, level| at_most(level, high)),
    );
    let one_kind = for_each(
        Family::new("only outer, or only inner levels, end at a smaller number"),
        [Which::Outer, Which::Inner],
        |case, which| {
            each(case, |p, level| if which.has(case, p) { at_most(level, 62.0) } else { level })
        },
    );
    let wraps = for_each(
        Family::new("levels above 64 count as another number"),
        [1.0, 2.0, 36.0f32],
        |case, wrong| each(case, |_, level| if level > 64.0 { wrong } else { level }),
    );
    let low =
        for_each(Family::new("levels begin at a larger number"), [2.0, 3.0f32], |case, low| {
            each(case, |_, level| if level > 0.0 { level.max(low) } else { level })
        });
    let inner_low = for_each(
        Family::new("inner levels begin at a larger number"),
        [3.0, 4.0f32],
        |case, low| {
            each(
                case,
                |p, level| if p < outer(case) || level.is_nan() { level } else { level.max(low) },
            )
        },
    );
    let nan = "no sentence speaks of an inner level that is NaN";
    let inner_nan = for_each(
        Family::new("an inner level that is NaN counts as the largest"),
        [64.0f32],
        |case, most| {
            each(case, |p, level| if level.is_nan() && p >= outer(case) { most } else { level })
        },
    )
    .vulkan_allows("", nan);
    vec![high, one_kind, wraps, low, inner_low, inner_nan]
}

/// The distance between neighbouring numbers of segments.
const fn step(partitioning: Partitioning) -> f32 {
    match partitioning {
        Partitioning::Integer | Partitioning::Pow2 => 1.0,
        Partitioning::FractionalOdd | Partitioning::FractionalEven => 2.0,
    }
}

/// Rounds a level to the number of segments that it asks for.
fn whole(case: &Case, position: usize, level: f32) -> f32 {
    let is_density = case.domain() == Domain::Isoline && position == 0;
    let level = level.max(1.0).ceil();
    match case.config.partitioning {
        _ if level.is_nan() => level,
        Partitioning::FractionalOdd if !is_density && level % 2.0 != 1.0 => level + 1.0,
        Partitioning::FractionalEven if !is_density && level % 2.0 != 0.0 => level + 1.0,
        _ => level,
    }
}

/// Which levels a variant changes.
#[derive(Clone, Copy)]
enum Which {
    All,
    Outer,
    Inner,
}

impl Label for Which {
    fn label(&self) -> String {
        match self {
            Self::All => "all levels",
            Self::Outer => "outer levels",
            Self::Inner => "inner levels",
        }
        .to_owned()
    }
}

const WHICH: [Which; 3] = [Which::All, Which::Outer, Which::Inner];

impl Which {
    fn has(self, case: &Case, position: usize) -> bool {
        match self {
            Self::All => true,
            Self::Outer => position < outer(case),
            Self::Inner => position >= outer(case),
        }
    }
}

fn each_of(case: &Case, which: Which, change: impl Fn(usize, f32) -> f32) -> Case {
    each(case, |p, level| {
        if which.has(case, p) && level > 0.0 && level.is_finite() {
            change(p, level)
        } else {
            level
        }
    })
}

fn rounded() -> Vec<Family> {
    let down = for_each(Family::new("levels are rounded down"), WHICH, |case, which| {
        let step = step(case.config.partitioning);
        each_of(case, which, |p, level| {
            let up = whole(case, p, level);
            if up > level && level > step { up - step } else { up }
        })
    });
    let nearest =
        for_each(Family::new("levels are rounded to the nearest"), WHICH, |case, which| {
            let half = step(case.config.partitioning) / 2.0;
            each_of(case, which, |p, level| {
                let up = whole(case, p, level);
                if up - level > half && level > 1.0 { up - 2.0 * half } else { up }
            })
        });
    let threshold = for_each(
        Family::new("levels count as an integer up to 0.01 above it"),
        WHICH,
        |case, which| {
            each_of(
                case,
                which,
                |_, level| if level.fract() < 0.01 { level.floor() } else { level },
            )
        },
    );
    let pow2 =
        for_each(Family::new("levels are rounded up to powers of two"), WHICH, |case, which| {
            each_of(case, which, |_, level| {
                let bits = level.to_bits();
                let up = if bits & 0x7F_FFFF == 0 { bits } else { ((bits >> 23) + 1) << 23 };
                if level > 1.0 { f32::from_bits(up) } else { level }
            })
        });
    vec![down, nearest, threshold, pow2]
}

/// Levels that are a step off, lose their fraction, or take another level's parity.
fn changed() -> Vec<Family> {
    let steps = |name: &'static str, sign: f32| {
        for_each(Family::new(name), 0..6, move |case, position| {
            let by = sign * step(case.config.partitioning);
            if position >= case.domain().factors() {
                return *case;
            }
            one(case, position, |level| if level > 0.0 { level + by } else { level })
        })
    };
    let more = steps("a level has a step more", 1.0);
    let less = steps("a level has a step less", -1.0);
    let fraction =
        for_each(Family::new("fractions of levels are ignored"), WHICH, |case, which| {
            each_of(case, which, |p, level| whole(case, p, level))
        });
    let half_steps = for_each(Family::new("levels have steps of 1/2"), WHICH, |case, which| {
        each_of(case, which, |_, level| (level * 2.0).ceil() / 2.0)
    });
    let parity = Family::new("the parity of an inner level is another level's");
    let parity = for_each(parity, 0..6, |case, from| {
        let own = levels(case);
        if case.config.partitioning != Partitioning::Integer || from >= own.len() {
            return *case;
        }
        let is_odd = |level: f32| level.max(1.0).ceil() % 2.0 == 1.0;
        each_of(case, Which::Inner, |_, level| {
            let up = level.max(1.0).ceil();
            if is_odd(level) == is_odd(own[from]) { up } else { up + 1.0 }
        })
    });
    vec![more, less, fraction, half_steps, parity]
}

/// A way to round a level, with its words.
type Rounding = (String, Box<dyn Fn(f32) -> f32 + Send + Sync>);

/// A variant for each way of rounding, and for all levels, outer ones and inner ones. A level that
/// becomes 0 discards its patch.
fn rounded_to(name: &'static str, roundings: Vec<Rounding>) -> Family {
    roundings.into_iter().fold(Family::new(name), |family, (words, round)| {
        let round = std::sync::Arc::new(round);
        WHICH.into_iter().fold(family, |family, which| {
            let (round, variant) = (std::sync::Arc::clone(&round), which.label());
            family.asks(format!("{variant}, {words}"), move |case| {
                each_of(case, which, |_, level| round(level))
            })
        })
    })
}

/// Levels in a format with fewer bits.
fn formats() -> Vec<Family> {
    let nearest = "to the nearest";
    let zero = "toward zero";
    let named =
        |words: &str, round: fn(f32) -> f32| -> Rounding { (words.into(), Box::new(round)) };
    let half = vec![
        named(nearest, |level| f16::from_f32(level).to_f32()),
        named(zero, |level| {
            let near = f16::from_f32(level);
            if near.to_f32() > level { f16::from_bits(near.to_bits() - 1) } else { near }.to_f32()
        }),
    ];
    let brain = vec![
        named(nearest, |level| bf16::from_f32(level).to_f32()),
        named(zero, |level| f32::from_bits(level.to_bits() & 0xFFFF_0000)),
    ];
    let steps = [256.0, 512.0, 1024.0, 2048.0, 4096.0f32].into_iter().flat_map(|n| {
        let to = |words: &str, round: fn(f32) -> f32| -> Rounding {
            // Exact: `n` is a power of two.
            (format!("1/{n} {words}"), Box::new(move |level| round(level * n) / n))
        };
        [to(nearest, f32::round_ties_even), to(zero, f32::trunc)]
    });
    vec![
        rounded_to("levels are rounded to binary16, as Metal stores them", half),
        rounded_to("levels are rounded to bfloat16", brain),
        rounded_to("levels are rounded to steps", steps.collect()),
    ]
}

/// The patch without an inside, and inner levels of 1.
fn minimum() -> Vec<Family> {
    let is_one = |level: f32| level <= 1.0 || level.is_nan();
    let is_fractional_even = |case: &Case| case.config.partitioning == Partitioning::FractionalEven;
    let always =
        mixes(
            Family::new("a patch of levels 1 has an inside"),
            "inner 3",
            move |case| match levels(case).into_iter().all(is_one) && !is_fractional_even(case) {
                true => each_of(case, Which::Inner, |_, _| 3.0),
                false => *case,
            },
        );
    let outer_only =
        mixes(Family::new("a patch of outer levels 1 has no inside"), "outer", move |case| {
            match levels(case)[..outer(case)].iter().all(|level| is_one(*level)) {
                true => each(case, |_, _| 1.0),
                false => *case,
            }
        });
    let inner_only = mixes(
        Family::new("a patch of inner levels 1 has no inside, and its edges are not divided"),
        "inner",
        move |case| {
            let all_one = levels(case)[outer(case)..].iter().all(|level| is_one(*level));
            let has_inner = inner(case, 0).is_some();
            if all_one && has_inner { each(case, |_, _| 1.0) } else { *case }
        },
    );
    let three = mixes(
        Family::new("an inner level of 1 gives three segments under equal spacing"),
        "3",
        move |case| {
            let is_integer = case.config.partitioning.has_integer_factors();
            let has_inside = !levels(case).into_iter().all(is_one);
            if is_integer && has_inside {
                each_of(case, Which::Inner, |_, level| if is_one(level) { 3.0 } else { level })
            } else {
                *case
            }
        },
    );
    vec![always, outer_only, inner_only, three]
}
