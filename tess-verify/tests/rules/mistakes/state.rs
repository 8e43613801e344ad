//! Mistakes: state of the first or previous patch, patches that are wrongly discarded or kept, and
//! anything else that is kept between patches.

use super::places::*;
use super::*;
use tess_core::{Config, PatchFactors};

pub(super) fn all() -> Vec<Mistake> {
    [kept(), discarded(), leaked()].into_iter().flatten().collect()
}

/// The part of the state that a device keeps from another patch.
#[derive(Clone, Copy, Debug)]
enum State {
    Domain,
    Spacing,
    Output,
    All,
}

/// The case with a part of another case's state.
fn with_state(case: &Case, other: &Case, state: State) -> Case {
    let own = levels(case);
    let in_turn = |p: usize| own[p % own.len()];
    let domain = Case { factors: PatchFactors::from_fn(other.domain(), in_turn), ..*case };
    let spacing = |config| Config { partitioning: other.config.partitioning, ..config };
    let output = |config| Config { output: other.config.output, ..config };
    match state {
        State::Domain => domain,
        State::Spacing => with_config(case, spacing),
        State::Output => with_config(case, output),
        State::All => with_config(&domain, |config| output(spacing(config))),
    }
}

fn kept() -> Vec<Mistake> {
    let of = |name: &'static str, number: fn(usize) -> usize| {
        let states = [State::Domain, State::Spacing, State::Output, State::All];
        let mistake = states.into_iter().fold(Mistake::new(name), |mistake, state| {
            mistake.remembers(format!("{state:?}"), move |cases, i| {
                with_state(&cases[i], &cases[number(i)], state)
            })
        });
        mistake.in_sequence()
    };
    vec![
        of("the state is that of the first patch (domain, spacing, output)", |_| 0),
        of("the state is that of the patch before (domain, spacing, output)", |i| {
            i.saturating_sub(1)
        }),
    ]
}

/// Devices that make a patch of what should be discarded, and devices that discard what should be a
/// patch.
fn discarded() -> Vec<Mistake> {
    // Levels that are wrongly taken as positive count as 1.
    fn passes(mistake: Mistake, name: &'static str, is_passed: fn(f32) -> bool) -> Mistake {
        mistake.asks(name, move |case| {
            each(case, |p, level| if p < outer(case) && is_passed(level) { 1.0 } else { level })
        })
    }
    fn culls(mistake: Mistake, name: &'static str, is_culled: fn(&Case) -> bool) -> Mistake {
        mistake.answers(name, move |case, output| {
            if is_culled(case) {
                *output = Tessellation::default();
            }
        })
    }
    let passing = Mistake::new("an outer level of 0 or less, or NaN, does not discard");
    let passing = passes(passing, "0", |level| level == 0.0);
    let passing = passes(passing, "-0", |level| level.to_bits() == 0x8000_0000);
    let passing = passes(passing, "negative", |level| level < 0.0);
    let passing = passes(passing, "-inf", |level| level == f32::NEG_INFINITY);
    let passing = passes(passing, "NaN", f32::is_nan);
    let first = Mistake::new("only one outer level can discard").asks("the first", |case| {
        let is_low = |level: f32| level.is_nan() || level <= 0.0;
        each(case, |p, level| if p > 0 && p < outer(case) && is_low(level) { 1.0 } else { level })
    });
    let inner = Mistake::new("an inner level of 0 or less, or NaN, discards");
    let inner = culls(inner, "0", |case| case.factors.inside().any(|level| level == 0.0));
    let inner = culls(inner, "negative", |case| case.factors.inside().any(|level| level < 0.0));
    let inner = culls(inner, "NaN", |case| case.factors.inside().any(f32::is_nan));
    let above = Mistake::new("outer levels above 0 discard");
    let above = culls(above, "below 1", |case| case.factors.outer().any(|level| level < 1.0));
    let above = culls(above, "below 2^-17", |case| {
        case.factors.outer().any(|level| level < f32::from_bits(0x3700_0000))
    });
    let above =
        culls(above, "infinite", |case| case.factors.outer().any(|level| level == f32::INFINITY));
    let denormal = culls(
        Mistake::new("an outer level that is a positive denormal discards"),
        "denormal",
        |case| case.factors.outer().any(|level| level > 0.0 && level.is_subnormal()),
    )
    .vulkan_allows("", "a denormal may be flushed to zero, unless a shader asks otherwise")
    .d3d11_allows("", "denormals may be flushed before the test (13)");
    let triangle =
        Mistake::new("a discarded patch has a primitive").answers("one", |case, output| {
            if is_discarded(case) {
                let points =
                    [(0, ONE), (0, 0), (ONE, 0)].map(|(u, v)| DomainPoint::from_bits(u, v));
                output.points = points.to_vec();
                output.indices = (0..3).take(case.primitive_size()).collect();
            }
        });
    vec![passing, first, inner, above, denormal, triangle]
}

/// Answers that depend on when a patch is asked.
fn leaked() -> Vec<Mistake> {
    let order = Mistake::new("primitives have another order every second time").spoils(
        "rotated",
        |cases, i, output| {
            if i % 2 == 1 {
                let size = cases[i].primitive_size().min(output.indices.len());
                output.indices.rotate_left(size);
            }
        },
    );
    let added = Mistake::new("primitives of the patch before come again").spoils(
        "added",
        |cases, i, output| {
            let before = cases[i.saturating_sub(1)].patch().tessellate();
            let base = u32::try_from(output.points.len()).expect("few points");
            if cases[i].primitive_size() == cases[i.saturating_sub(1)].primitive_size() {
                output.indices.extend(before.indices.iter().map(|index| index + base));
                output.points.extend(before.points);
            }
        },
    );
    let limited = Mistake::new("a patch has at most some number of primitives")
        .answers("1000", |case, output| output.indices.truncate(1000 * case.primitive_size()));
    vec![order, added, limited]
}
