//! Coverage as text: a table by stage of the specification, then the holes.

use super::{BinGroup, Coverage, Exclusions};
use std::fmt::Write;

/// The stages of a patch in order, with their sections of the specification and their groups.
pub(super) const STAGES: [(&str, &str, &[&str]); 7] = [
    ("configuration", "1", &["configuration"]),
    (
        "factors",
        "2 and 3",
        &["cull", "denormal", "clamp", "round", "conversion", "picture_frame", "minimum"],
    ),
    ("context", "4", &["context"]),
    ("location", "5", &["exceptional"]),
    ("stitch", "7", &["parities", "middle", "transition", "rings", "centre"]),
    ("comparisons", "2 to 7", &["boundary"]),
    ("streams", "3", &["sequence"]),
];

/// The stage that a group's bins cover.
pub(super) fn stage(group: &str) -> &'static str {
    let found = STAGES.iter().find(|(_, _, groups)| groups.contains(&group));
    found.map_or("", |(stage, _, _)| stage)
}

/// The groups of each stage in order, with their sum and the section of the specification.
pub(super) fn by_stage(
    coverage: &Coverage,
    exclusions: &Exclusions,
) -> Vec<(Vec<BinGroup>, BinGroup, &'static str)> {
    let groups = coverage.groups_without(exclusions);
    let of_stage = |&(stage, section, names): &(&'static str, &'static str, &[&str])| {
        let own = names.iter().filter_map(|name| groups.iter().find(|group| group.name == **name));
        let own: Vec<BinGroup> = own.cloned().collect();
        let sum = BinGroup { stage, ..sum(&own) };
        (own, sum, section)
    };
    STAGES.iter().map(of_stage).collect()
}

/// The sum of groups, as a group named `all`.
pub(super) fn sum(groups: &[BinGroup]) -> BinGroup {
    let mut sum = BinGroup { name: "all".to_owned(), stage: "", hit: 0, bins: 0, excluded: 0 };
    for group in groups {
        sum.hit += group.hit;
        sum.bins += group.bins;
        sum.excluded += group.excluded;
    }
    sum
}

/// The percentage of the bins that are not excluded and were hit, with one decimal; `-` if all are
/// excluded. It is rounded down, so 100.0 means all of them.
pub(super) fn percent(group: &BinGroup) -> String {
    match (1000 * group.hit).checked_div(group.bins - group.excluded) {
        Some(tenths) => format!("{}.{}", tenths / 10, tenths % 10),
        None => "-".to_owned(),
    }
}

impl Coverage {
    /// The report as text: a line per group, by stage, with sums; then every bin that was missed
    /// and is not excluded.
    #[must_use]
    pub fn report(&self, exclusions: &Exclusions) -> String {
        let mut text = format!(
            "{:<14} {:<14} {:>5} {:>5} {:>8} {:>7}\n",
            "stage", "group", "bins", "hit", "excluded", "percent"
        );
        // Writing to a String does not fail.
        let mut row = |stage: &str, group: &BinGroup| {
            let BinGroup { name, bins, hit, excluded, .. } = group;
            let percent = percent(group);
            _ = writeln!(
                text,
                "{stage:<14} {name:<14} {bins:>5} {hit:>5} {excluded:>8} {percent:>7}"
            );
        };
        for (groups, sum, _) in by_stage(self, exclusions) {
            groups.iter().for_each(|group| row(group.stage, group));
            if groups.len() > 1 {
                row(sum.stage, &sum);
            }
        }
        row("all", &sum(&self.groups_without(exclusions)));
        self.hit_though_excluded(exclusions)
            .for_each(|bin| _ = writeln!(text, "excluded, but hit {bin}"));
        self.holes(exclusions).for_each(|bin| _ = writeln!(text, "missed {bin}"));
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::case::Case;

    /// The coverage of a quad of three by five, with all other configurations excluded.
    fn example() -> (Coverage, Exclusions) {
        let line =
            "case quad integer line ruler 40400000 40400000 40400000 40400000 40a00000 40400000";
        let case: Case = line.parse().expect("a case");
        let mut coverage = Coverage::default();
        coverage.record_stream(None, [case]);
        (coverage, Exclusions::outside([(case.domain(), case.config)]))
    }

    #[test]
    fn every_group_has_one_stage() {
        for group in Coverage::default().groups() {
            let stages = STAGES.iter().filter(|(_, _, groups)| groups.contains(&&*group.name));
            assert_eq!(stages.count(), 1, "{}", group.name);
        }
        let named: usize = STAGES.iter().map(|(_, _, groups)| groups.len()).sum();
        assert_eq!(named, Coverage::default().groups().len(), "and there is no other name");
    }

    #[test]
    fn numbers_of_a_table() {
        let (coverage, mut exclusions) = example();
        let text = coverage.report(&exclusions);
        let row = |name: &str| {
            let row = text.lines().find(|line| line.split_whitespace().nth(1) == Some(name));
            row.unwrap_or_default().split_whitespace().skip(2).collect::<Vec<_>>()
        };
        assert_eq!(row("configuration"), ["96", "1", "95", "100.0"], "{text}");
        assert_eq!(row("middle"), ["8", "1", "4", "25.0"], "{text}");
        assert_eq!(row("exceptional"), ["6", "0", "6", "-"], "{text}");
        assert!(text.contains("\nmissed middle/ruler/evenxodd\n"), "{text}");
        assert!(!text.contains("missed exceptional") && !text.contains("but hit"), "{text}");
        exclusions.add("middle/ruler/oddxodd").expect("a bin");
        let text = coverage.report(&exclusions);
        assert!(text.contains("excluded, but hit middle/ruler/oddxodd\n"), "{text}");
    }

    #[test]
    fn percents_are_rounded_down() {
        let of = |hit, bins, excluded| {
            percent(&BinGroup { name: String::new(), stage: "", hit, bins, excluded })
        };
        assert_eq!([of(2999, 3000, 0), of(1, 3, 1), of(4, 4, 0)], ["99.9", "50.0", "100.0"]);
    }

    /// One row per group, one more for each stage with several groups, and one for all.
    #[test]
    fn stages_with_several_groups_have_a_sum() {
        let text = Coverage::default().report(&Exclusions::default());
        let rows = text.lines().skip(1).take_while(|line| !line.starts_with("missed "));
        let stages: Vec<&str> = rows
            .filter(|row| row.split_whitespace().nth(1) == Some("all"))
            .filter_map(|row| row.split_whitespace().next())
            .collect();
        assert_eq!(stages, ["factors", "stitch", "all"], "{text}");
        for (stage, _, groups) in STAGES {
            for group in groups {
                let row = text.lines().find(|line| line.split_whitespace().nth(1) == Some(group));
                assert!(row.is_some_and(|row| row.starts_with(stage)), "{group}: {text}");
            }
        }
        let table = text.lines().take_while(|line| !line.starts_with("missed ")).count();
        let groups = Coverage::default().groups().len();
        assert_eq!(table, 1 + groups + stages.len(), "{text}");
    }
}
