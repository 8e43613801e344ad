//! Observations of a device under test, compared with the model.

use crate::case::{Case, factor_list, factors_from_list, outer_count};
use crate::compare::{self, Element, Mismatch, Stage};
use crate::generate::from_fixed;
use crate::strength::{Elements, Missing, Order, Strength};
use tess_core::{Config, ProcessedPatch, SplitOrder, Tessellation};

/// What a device's output for a case has wrong, if `strength` does not accept it.
pub(super) fn compare(
    case: &Case,
    observed: &Tessellation,
    expected: &Tessellation,
    strength: Strength,
) -> Option<Mismatch> {
    if strength.accepts(case, observed) {
        return None;
    }
    let mismatch = match (strength.order, strength.elements) {
        (Order::Exact, Elements::Primitives) => compare::tessellations(case, observed, expected),
        (Order::Exact, Elements::Points) => compare::points_alone(observed, expected),
        (Order::Any, _) => strength.first_missing(case, observed, expected).map(missing),
    };
    mismatch.map(|mismatch| Mismatch { stage: stage(case, observed, mismatch.stage), ..mismatch })
}

fn missing(missing: Missing) -> Mismatch {
    let Missing { vertices, observed, expected } = missing;
    let stage = if vertices.len() == 1 { Stage::Location } else { Stage::Stitch };
    let times = |count: usize| format!("{count} times");
    let element = Element::Vertices(vertices);
    Mismatch { element, observed: times(observed), expected: times(expected), stage }
}

/// The stage that explains a whole output: one that the model reaches with one factor processed
/// differently, or with the other split order; else the one that the first difference points to.
fn stage(case: &Case, observed: &Tessellation, first: Stage) -> Stage {
    if other_factors(case).iter().any(|other| other.patch().tessellate() == *observed) {
        return Stage::Factors;
    }
    let other_split = match case.config.split {
        SplitOrder::Ruler => SplitOrder::Center,
        SplitOrder::Center => SplitOrder::Ruler,
    };
    let other = Case { config: Config { split: other_split, ..case.config }, ..*case };
    if other.patch().tessellate().points == observed.points && first == Stage::Location {
        return Stage::Context;
    }
    first
}

/// The case with one factor off by a unit in the last place, or by one; and culled.
fn other_factors(case: &Case) -> Vec<Case> {
    let raw = factor_list(&case.factors);
    let with = |list: Vec<f32>| {
        factors_from_list(case.domain(), &list).map(|factors| Case { factors, ..*case })
    };
    let mut culled = raw.clone();
    culled[..outer_count(case.domain())].fill(0.0);
    let mut lists = vec![culled];
    if let ProcessedPatch::Minimum(factors) | ProcessedPatch::Regular(factors) =
        case.patch().processed()
    {
        for (position, factor) in factor_list(factors).into_iter().enumerate() {
            let fixed = factor.fixed.to_bits();
            for other in [fixed - 1, fixed + 1, fixed - 0x1_0000, fixed + 0x1_0000] {
                let mut list = raw.clone();
                list[position] = from_fixed(other);
                lists.push(list);
            }
        }
    }
    lists.into_iter().filter_map(with).collect()
}
