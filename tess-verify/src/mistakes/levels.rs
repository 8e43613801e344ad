//! Mistakes: levels that are ignored, exchanged, shared, or taken from another patch.

use super::family::{Family, Label};
use super::places::{each, is_discarded, levels, one, outer, taken};
use super::request::Request;
use crate::case::Case;
use tess_core::Domain;

pub(super) fn all() -> Vec<Family> {
    [ignored(), exchanged(), shared(), of_other_patches()].into_iter().flatten().collect()
}

/// A device that mixes levels up, but still discards the patches that should be discarded.
pub(super) fn mixes(
    mistake: Family,
    name: impl Into<String>,
    other: impl Fn(&Case) -> Case + Send + Sync + 'static,
) -> Family {
    mistake.asks(name, move |case| {
        let mixed = other(case);
        if is_discarded(case) || is_discarded(&mixed) { *case } else { mixed }
    })
}

/// A variant for each of these values.
pub(super) fn for_each<T: Copy + Label + Send + Sync + 'static>(
    mistake: Family,
    values: impl IntoIterator<Item = T>,
    other: impl Fn(&Case, T) -> Case + Copy + Send + Sync + 'static,
) -> Family {
    values.into_iter().fold(mistake, |mistake, value| {
        mixes(mistake, value.label(), move |case| other(case, value))
    })
}

/// The position of an inner level, if there is one.
pub(super) fn inner(case: &Case, number: usize) -> Option<usize> {
    let position = outer(case) + number;
    (position < case.domain().factors()).then_some(position)
}

fn pairs(count: usize) -> Vec<[usize; 2]> {
    (0..count).flat_map(|a| (a + 1..count).map(move |b| [a, b])).collect()
}

fn ignored() -> Vec<Family> {
    let is_outer = |case: &Case, p: usize| p < outer(case);
    vec![
        for_each(Family::new("an outer level is ignored"), 0..4, move |case, p| {
            if is_outer(case, p) { one(case, p, |_| 1.0) } else { *case }
        }),
        for_each(Family::new("an inner level is ignored"), 0..2, |case, number| {
            inner(case, number).map_or(*case, |p| one(case, p, |_| 1.0))
        }),
        mixes(Family::new("both inner levels are ignored"), "both", |case| {
            each(case, |p, level| if p < outer(case) { level } else { 1.0 })
        }),
    ]
}

fn exchange(case: &Case, [a, b]: [usize; 2]) -> Case {
    if b >= case.domain().factors() {
        return *case;
    }
    taken(case, |p| match p {
        _ if p == a => b,
        _ if p == b => a,
        _ => p,
    })
}

fn exchanged() -> Vec<Family> {
    vec![
        permuted(),
        mixes(Family::new("the two levels of isolines are exchanged"), "", |case| {
            if case.domain() == Domain::Isoline { exchange(case, [0, 1]) } else { *case }
        }),
        mixes(Family::new("the inner levels are exchanged"), "both", |case| {
            if inner(case, 1).is_some() { exchange(case, [4, 5]) } else { *case }
        }),
        for_each(
            Family::new("an outer and an inner level are exchanged"),
            pairs(6).into_iter().filter(|[a, b]| *a < 4 && *b >= 3 && *b != *a),
            |case, [a, b]| {
                let crosses = a < outer(case) && b >= outer(case);
                if crosses { exchange(case, [a, b]) } else { *case }
            },
        ),
    ]
}

/// The outer levels in every other order. A permutation of the first two or three applies to the
/// domains that have as many.
fn permuted() -> Family {
    let mut orders: Vec<[usize; 4]> = Vec::new();
    for number in 0..256 {
        let order = [number / 64, number / 16 % 4, number / 4 % 4, number % 4];
        let is_permutation = (0..4).all(|p| order.contains(&p));
        if is_permutation && order != [0, 1, 2, 3] {
            orders.push(order);
        }
    }
    let family = Family::new("the outer levels are in another order");
    orders.into_iter().fold(family, |family, order| {
        let variant = order.map(|p| p.to_string()).join(" ");
        mixes(family, variant, move |case| {
            let n = outer(case);
            let is_of_domain = order[..n].iter().all(|from| *from < n);
            if is_of_domain { taken(case, |p| if p < n { order[p] } else { p }) } else { *case }
        })
    })
}

/// A level used in place of others: one of the outer or inner levels, or a function of them.
fn shared() -> Vec<Family> {
    let largest = |levels: &[f32]| levels.iter().copied().fold(f32::NEG_INFINITY, f32::max);
    let least = |levels: &[f32]| levels.iter().copied().fold(f32::INFINITY, f32::min);
    let of_inner = move |case: &Case, of: &dyn Fn(&[f32]) -> f32| {
        let inner = &levels(case)[outer(case)..];
        if inner.len() < 2 {
            return *case;
        }
        let shared = of(inner);
        each(case, |p, level| if p < outer(case) { level } else { shared })
    };
    let of_outer = move |case: &Case, of: &dyn Fn(&[f32]) -> f32| {
        let shared = of(&levels(case)[..outer(case)]);
        each(case, |p, level| if p < outer(case) { shared } else { level })
    };
    let for_inner = Family::new("one inner level is used for both");
    let for_inner = for_each(for_inner, 0..2, |case, number| {
        inner(case, number)
            .map_or(*case, |from| taken(case, |p| if p < outer(case) { p } else { from }))
    });
    let for_inner = mixes(for_inner, "the larger", move |case| of_inner(case, &largest));
    let for_inner = mixes(for_inner, "the smaller", move |case| of_inner(case, &least));
    #[expect(clippy::float_arithmetic, reason = "a mistake in binary32")]
    let mean =
        |levels: &[f32]| levels.iter().sum::<f32>() / if levels.len() > 1 { 2.0 } else { 1.0 };
    let for_inner = mixes(for_inner, "the mean", move |case| of_inner(case, &mean));
    let for_outer = Family::new("one outer level is used for all edges");
    let for_outer = for_each(for_outer, 0..4, |case, from| {
        if from < outer(case) {
            taken(case, |p| if p < outer(case) { from } else { p })
        } else {
            *case
        }
    });
    let for_outer = mixes(for_outer, "the largest", move |case| of_outer(case, &largest));
    let for_outer = mixes(for_outer, "the smallest", move |case| of_outer(case, &least));
    let from_outer = Family::new("an inner level is taken from an outer one");
    let crossing: Vec<_> = pairs(6).into_iter().filter(|[a, b]| *a < 4 && *b >= 3).collect();
    let from_outer = for_each(from_outer, crossing.clone(), |case, [a, b]| {
        let crosses = a < outer(case) && b >= outer(case) && b < case.domain().factors();
        if crosses { taken(case, |p| if p == b { a } else { p }) } else { *case }
    });
    let from_outer = mixes(from_outer, "the largest", move |case| {
        let level = largest(&levels(case)[..outer(case)]);
        each(case, |p, own| if p < outer(case) { own } else { level })
    });
    let from_inner = Family::new("an outer level is taken from an inner one");
    let from_inner = for_each(from_inner, crossing, |case, [a, b]| {
        let crosses = a < outer(case) && b >= outer(case) && b < case.domain().factors();
        if crosses { taken(case, |p| if p == a { b } else { p }) } else { *case }
    });
    vec![for_inner, for_outer, from_outer, from_inner]
}

/// Levels taken from the patches around a patch.
fn of_other_patches() -> Vec<Family> {
    fn other(
        mistake: Family,
        name: &'static str,
        there: impl Fn(&Request) -> Case + Copy + Send + Sync + 'static,
    ) -> Family {
        (0..6).chain([usize::MAX]).fold(mistake, |mistake, position| {
            let is_all = position == usize::MAX;
            let name =
                if is_all { format!("{name}, all") } else { format!("{name}, number {position}") };
            mistake.remembers(name, move |request| {
                let own = request.case;
                let others = levels(&there(request));
                let mixed = each(&own, |p, level| {
                    let is_other = is_all || p == position;
                    others.get(p).filter(|_| is_other).copied().unwrap_or(level)
                });
                let keeps = is_discarded(&own) || is_discarded(&mixed);
                if keeps { own } else { mixed }
            })
        })
    }
    let neighbours = Family::new("levels are those of the patch before or after");
    let neighbours = other(neighbours, "before", |request| request.before);
    let neighbours = other(neighbours, "after", |request| request.after);
    let first =
        other(Family::new("levels are those of the first patch"), "first", |request| request.first);
    vec![neighbours, first]
}
