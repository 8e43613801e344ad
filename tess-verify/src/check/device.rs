//! Observations of a device under test, compared with the model.

use super::Found;
use crate::case::Case;
use crate::check::compare::{self, Element, Mismatch, SpecStage};
use crate::generate::from_fixed;
use crate::strength::{
    Alternatives, Difference, Elements, ListOrder, Strength, first_difference, first_stray,
};
use crate::vectors::Coordinates;
use tess_core::{Config, PatchFactors, SplitOrder, Tessellation};

/// Judges a device's output for a case.
pub(super) fn check(case: &Case, observed: &Tessellation, strength: Strength) -> Found {
    match strength.explain(case, observed) {
        Some(conversions) if conversions.values.is_empty() => Found::Equal,
        Some(conversions) => Found::Converted(*case, conversions),
        None => match first_mismatch(case, observed, strength) {
            Some(mismatch) => Found::Device(mismatch, *case),
            None => Found::Equal,
        },
    }
}

/// The strength at which outputs by coordinates are judged. They have no vertex numbers, so the
/// strictest order is the model's sequence.
pub(super) const fn strength_of_coordinates(strength: Strength) -> Strength {
    let order = match strength.order {
        ListOrder::Exact => ListOrder::Sequence,
        order => order,
    };
    Strength { order, ..strength }
}

/// Judges a device's output by coordinates. Third coordinates are compared at every strength.
pub(super) fn check_coordinates(coordinates: &Coordinates, strength: Strength) -> Found {
    let (case, output) = (&coordinates.case, coordinates.output());
    match (check(case, &output, strength_of_coordinates(strength)), coordinates.wrong_third()) {
        (Found::Equal | Found::Converted(..), Some((vertex, observed, expected))) => {
            let size = case.primitive_size();
            let element = Element::Third { primitive: vertex / size, position: vertex % size };
            let mismatch = Mismatch::hex(element, 5, observed, expected, SpecStage::Location);
            Found::Different(mismatch, Some(*case))
        }
        (found, _) => found,
    }
}

/// The first difference from the nearest legal output.
fn first_mismatch(case: &Case, observed: &Tessellation, strength: Strength) -> Option<Mismatch> {
    let case = nearest(case, observed, strength);
    let expected = case.patch().tessellate();
    let found = match (strength.order, strength.elements) {
        (ListOrder::Exact, Elements::Primitives) => Mismatch::between(&case, observed, &expected),
        (ListOrder::Sequence, Elements::Primitives) => {
            compare::sequences(&case, observed, &expected)
                .or_else(|| first_stray(observed, &expected).map(unordered))
        }
        (ListOrder::Exact | ListOrder::Sequence, Elements::Points) => {
            compare::points_alone(observed, &expected)
        }
        (ListOrder::Any, elements) => {
            first_difference(elements, &case, observed, &expected).map(unordered)
        }
    };
    found.map(|found| {
        let stage = stage(&case, observed, strength, found.stage);
        Mismatch { stage, ..found }
    })
}

/// The case, among those with a legal output, whose output shares the most points with the observed
/// one: the first difference from it is the most useful.
fn nearest(case: &Case, observed: &Tessellation, strength: Strength) -> Case {
    let alternatives = Alternatives::new(case, strength.conversion);
    let wrong_points = |choice: &u64| {
        let expected = alternatives.case(*choice).patch().tessellate();
        match strength.order {
            ListOrder::Exact => {
                observed.points.iter().zip(&expected.points).filter(|(a, b)| a != b).count()
            }
            ListOrder::Sequence | ListOrder::Any => {
                observed.points.iter().filter(|point| !expected.points.contains(point)).count()
            }
        }
    };
    let choices = alternatives.choices();
    let nearest = if choices.end == 1 { Some(0) } else { choices.min_by_key(wrong_points) };
    alternatives.case(nearest.unwrap_or(0))
}

fn unordered(difference: Difference) -> Mismatch {
    let Difference { vertices, observed, expected, instead } = difference;
    let stage = if vertices.len() == 1 { SpecStage::Location } else { SpecStage::Stitch };
    let times = |count: usize| format!("{count} times");
    let instead = instead.map(|other| {
        let Difference { vertices, observed, expected, .. } = *other;
        format!(" (but {} {observed} times, not {expected})", Element::Vertices(vertices))
    });
    let observed = times(observed) + &instead.unwrap_or_default();
    Mismatch { element: Element::Vertices(vertices), observed, expected: times(expected), stage }
}

/// The stage of the fault, if one change explains the whole output: a factor processed differently,
/// or the other split order. Otherwise the stage that the first difference points to.
fn stage(case: &Case, observed: &Tessellation, strength: Strength, first: SpecStage) -> SpecStage {
    let explains = |strength: Strength, other: &Case| {
        strength.equal(case, observed, &other.patch().tessellate())
    };
    if other_factors(case).iter().any(|other| explains(strength, other)) {
        return SpecStage::Factors;
    }
    let split = match case.config.split {
        SplitOrder::Ruler => SplitOrder::Centre,
        SplitOrder::Centre => SplitOrder::Ruler,
    };
    let other_split = Case { config: Config { split, ..case.config }, ..*case };
    let points_alone = Strength { elements: Elements::Points, ..strength };
    if first == SpecStage::Location && explains(points_alone, &other_split) {
        return SpecStage::Context;
    }
    first
}

/// Variants of a case whose factors were processed differently: one factor off by a unit in the
/// last place or by one; all factors 1; the inside raised to that of a picture frame; a patch
/// culled that should not be, or not culled that should be.
fn other_factors(case: &Case) -> Vec<Case> {
    let with = |factors| Case { factors, ..*case };
    let uniform = |factor| with(PatchFactors::uniform(case.domain(), factor));
    let outer = case.domain().outer_factors();
    // A factor that is not positive becomes the smallest positive number, which is raised to the
    // lower end of the range.
    let above_zero = |factor: f32| if factor > 0.0 { factor } else { f32::from_bits(1) };
    let raised = |inside: u32| {
        with(PatchFactors::from_fn(case.domain(), |position| {
            let factor = case.factors.iter().nth(position).unwrap_or_default();
            if position < outer { factor } else { factor.max(from_fixed(inside)) }
        }))
    };
    let mut cases = vec![uniform(0.0), uniform(1.0), with(case.factors.map(above_zero))];
    cases.extend([0x1_0001, 0x1_0002].map(raised));
    let patch = case.patch();
    let processed = patch.processed().factors().into_iter().flat_map(|factors| factors.iter());
    for (position, factor) in processed.enumerate() {
        let fixed = factor.fixed.to_bits();
        let others = [fixed - 1, fixed + 1, fixed - 0x1_0000, fixed + 0x1_0000];
        cases.extend(others.map(|other| case.with_factor(position, from_fixed(other))));
    }
    cases
}
