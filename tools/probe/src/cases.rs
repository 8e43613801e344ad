//! The cases that a Vulkan device can be asked.

use std::collections::HashSet;
use tess_core::{Config, Domain, OutputPrimitive, SplitOrder};
use tess_verify::Case;
use tess_verify::generate::{Selection, Shard};

/// The cases of a selection, converted by [`asked`] to those that Vulkan has, in its split order;
/// of these, one shard.
#[must_use]
pub fn cases(selection: Selection, shard: Shard) -> Vec<Case> {
    let split = selection.split.or(Some(SplitOrder::Ruler));
    let asked = asked(Selection { split, ..selection }.cases());
    (0..).zip(asked).filter(|(number, _)| shard.has(*number)).map(|(_, case)| case).collect()
}

/// The selected cases as a device is asked them for rules: in order, also repeated ones.
#[must_use]
pub fn rule_cases(selection: Selection) -> Vec<Case> {
    let selection = Selection { split: Some(SplitOrder::Ruler), ..selection };
    selection.cases().map(|case| asked_for(&case)).collect()
}

/// Replaces the parts of cases that Vulkan lacks: there is one split order, only isolines have
/// lines, and isolines have no triangles. Each resulting case occurs once.
#[must_use]
pub fn asked(cases: impl IntoIterator<Item = Case>) -> Vec<Case> {
    let mut seen = HashSet::new();
    cases.into_iter().map(|case| asked_for(&case)).filter(|case| seen.insert(*case)).collect()
}

/// A case with the parts that Vulkan lacks replaced.
pub(crate) fn asked_for(case: &Case) -> Case {
    let output = match (case.domain(), case.config.output) {
        (_, OutputPrimitive::Point) => OutputPrimitive::Point,
        (Domain::Isoline, _) => OutputPrimitive::Line,
        (_, OutputPrimitive::TriangleCcw) => OutputPrimitive::TriangleCcw,
        (_, OutputPrimitive::TriangleCw | OutputPrimitive::Line) => OutputPrimitive::TriangleCw,
    };
    let config = Config { output, split: SplitOrder::Ruler, ..case.config };
    Case { config, factors: case.factors }
}

/// The same cases, grouped by domain and configuration.
pub(crate) fn groups(cases: &[Case]) -> Vec<Vec<Case>> {
    let mut groups: Vec<Vec<Case>> = Vec::new();
    let kind = |case: &Case| (case.domain(), case.config);
    for case in cases {
        match groups.iter_mut().find(|group| kind(&group[0]) == kind(case)) {
            Some(group) => group.push(*case),
            None => groups.push(vec![*case]),
        }
    }
    groups
}
