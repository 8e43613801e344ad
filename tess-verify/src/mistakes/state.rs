//! Mistakes: state of the first or previous patch, patches that are wrongly discarded or kept, and
//! anything else that is kept between patches.

use super::family::{Family, Label};
use super::places::{each, is_discarded, levels, outer, with_config};
use super::request::{OUTPUT, Request, SETTINGS, SPACING};
use crate::case::Case;
use tess_core::fixed_point::ONE;
use tess_core::{Config, DomainPoint, PatchFactors, Tessellation};

pub(super) fn all() -> Vec<Family> {
    [kept(), cached(), discarded(), leaked()].into_iter().flatten().collect()
}

/// The part of the state that a device keeps from another patch.
#[derive(Clone, Copy)]
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

fn kept() -> Vec<Family> {
    let of = |name: &'static str, there: fn(&Request) -> Case| {
        let states = [
            ("domain", State::Domain),
            ("spacing", State::Spacing),
            ("output", State::Output),
            ("all", State::All),
        ];
        let family = states.into_iter().fold(Family::new(name), |family, (variant, state)| {
            family.remembers(variant, move |request| {
                with_state(&request.case, &there(request), state)
            })
        });
        family.in_sequence()
    };
    vec![
        of("the state is that of the first patch", |request| request.first),
        of("the state is that of the patch before", |request| request.before),
    ]
}

/// A cache that takes two patches for equal if they differ in one setting only.
fn cached() -> Vec<Family> {
    let levels = (0..SPACING).fold(Family::new("a cache leaves out a level"), |family, setting| {
        family.remembers(setting.label(), move |request| request.stale(setting))
    });
    let settings = [("spacing", SPACING), ("output", OUTPUT)];
    debug_assert_eq!(SETTINGS, SPACING + settings.len(), "every setting");
    let family = Family::new("a cache leaves out a part of the state");
    let state = settings.into_iter().fold(family, |family, (variant, setting)| {
        family.remembers(variant, move |request| request.stale(setting))
    });
    let repeated = [2u64, 3, 5, 8, 16, 64].into_iter().fold(
        Family::new("some patches have the output of the one before"),
        |family, n| {
            family.remembers(format!("every {n} patches"), move |request| {
                let is_due = request.number % n == n - 1;
                if is_due { request.before } else { request.case }
            })
        },
    );
    vec![levels, state.in_sequence(), repeated]
}

/// Devices that make a patch of what should be discarded, and devices that discard what should be a
/// patch.
fn discarded() -> Vec<Family> {
    // Levels that are wrongly taken as positive count as 1.
    fn passes(mistake: Family, name: &'static str, is_passed: fn(f32) -> bool) -> Family {
        mistake.asks(name, move |case| {
            each(case, |p, level| if p < outer(case) && is_passed(level) { 1.0 } else { level })
        })
    }
    fn culls(mistake: Family, name: &'static str, is_culled: fn(&Case) -> bool) -> Family {
        mistake.answers(name, move |case, output| {
            if is_culled(case) {
                *output = Tessellation::default();
            }
        })
    }
    let passing = Family::new("an outer level of 0 or less, or NaN, does not discard");
    let passing = passes(passing, "0", |level| level == 0.0);
    let passing = passes(passing, "-0", |level| level.to_bits() == 0x8000_0000);
    let passing = passes(passing, "negative", |level| level < 0.0);
    let passing = passes(passing, "-inf", |level| level == f32::NEG_INFINITY);
    let passing = passes(passing, "NaN", f32::is_nan);
    let first = Family::new("only one outer level can discard").asks("the first", |case| {
        let is_low = |level: f32| level.is_nan() || level <= 0.0;
        each(case, |p, level| if p > 0 && p < outer(case) && is_low(level) { 1.0 } else { level })
    });
    let inner = Family::new("an inner level of 0 or less, or NaN, discards");
    let inner = culls(inner, "0", |case| case.factors.inside().any(|level| level == 0.0));
    let inner = culls(inner, "negative", |case| case.factors.inside().any(|level| level < 0.0));
    let inner = culls(inner, "NaN", |case| case.factors.inside().any(f32::is_nan));
    let above = Family::new("outer levels above 0 discard");
    let above = culls(above, "below 1", |case| case.factors.outer().any(|level| level < 1.0));
    let above = culls(above, "below 2^-17", |case| {
        case.factors.outer().any(|level| level < f32::from_bits(0x3700_0000))
    });
    let above =
        culls(above, "infinite", |case| case.factors.outer().any(|level| level == f32::INFINITY));
    let denormal = culls(
        Family::new("an outer level that is a positive denormal discards"),
        "denormal",
        |case| case.factors.outer().any(|level| level > 0.0 && level.is_subnormal()),
    )
    .vulkan_allows("", "a denormal may be flushed to zero, unless a shader asks otherwise")
    .d3d11_allows("", "denormals may be flushed before the test (13)");
    let triangle =
        Family::new("a discarded patch has a primitive").answers("one", |case, output| {
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
fn leaked() -> Vec<Family> {
    let order = Family::new("primitives have another order every second time").spoils(
        "rotated",
        |request, output| {
            if request.number % 2 == 1 {
                let size = request.case.primitive_size().min(output.indices.len());
                output.indices.rotate_left(size);
            }
        },
    );
    let added = Family::new("primitives of the patch before come again").spoils(
        "added",
        |request, output| {
            let base = output.points.len().try_into().unwrap_or(u32::MAX);
            if request.number > 0
                && request.case.primitive_size() == request.before.primitive_size()
            {
                let before = request.before.patch().tessellate();
                output.indices.extend(before.indices.iter().map(|index| index + base));
                output.points.extend(before.points);
            }
        },
    );
    let limited = Family::new("a patch has at most some number of primitives")
        .answers("1000", |case, output| output.indices.truncate(1000 * case.primitive_size()));
    vec![order, added, limited]
}
