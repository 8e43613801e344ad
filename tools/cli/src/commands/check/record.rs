//! Entries that a check adds to the report of its run.

use crate::campaign::report::{First, Report, ReportPart};
use crate::campaign::{Placed, ShardArgs, shard};
use crate::failure::Failure;
use tess_verify::check::{self, Checked, Difference, Element, SpecStage};
use tess_verify::vectors::Header;
use tess_verify::{Case, Named};

/// The part to which a record's case belongs: its configuration without the split order.
fn part_of(case: Option<Case>) -> String {
    let Some(case) = case else { return "rows".to_owned() };
    let (partitioning, output) = (case.config.partitioning.name(), case.config.output.name());
    format!("{} {partitioning} {output}", case.domain().name())
}

/// Adds records as they are checked.
pub(super) fn add(report: &mut Report, checked: Checked<'_>) {
    for (record, different) in checked.records.iter().zip(checked.different) {
        let (name, mismatches) = (part_of(record.case()), u64::from(*different));
        report.add_part(ReportPart { name, cases: 1, mismatches, first: None });
    }
}

/// The part of faults that no single record shows.
const OTHERS: &str = "missing answers, answers to other cases, contradictions";

/// Adds the final results: stages, differences, and mismatches that no single record shows.
pub(super) fn finish(report: &mut Report, found: &check::Report) {
    let cases = found.cases.saturating_sub(report.cases);
    let mismatches = found.mismatches.saturating_sub(report.mismatches);
    if cases > 0 || mismatches > 0 {
        report.add_part(ReportPart { name: OTHERS.to_owned(), cases, mismatches, first: None });
    }
    // Only some of the first differences are kept, but of each configuration the smallest.
    let groups = found.groups();
    for difference in found.differences.iter().chain(groups.iter().map(|group| &group.smallest)) {
        let part = report.parts.iter_mut().find(|part| part.name == part_with(difference));
        if let Some(part) = part.filter(|part| part.mismatches > 0) {
            part.first.get_or_insert_with(|| first(difference));
        }
    }
    // The threads of a check finish in any order.
    report.parts.sort_by(|a, b| a.name.cmp(&b.name));
    report.first = found.differences.first().map(first);
    report.period = found.period();
    report.add_stages(groups.iter().map(|group| (group.stage, group.mismatches)));
}

/// The part that counts a difference.
fn part_with(difference: &Difference) -> String {
    let found = &difference.mismatch;
    let is_other =
        found.stage == SpecStage::Answer || matches!(found.element, Element::Conversion(_));
    if is_other { OTHERS.to_owned() } else { part_of(difference.case) }
}

pub(super) fn first(difference: &Difference) -> First {
    let case = difference.case.map(|case| case.to_string());
    let (difference, passes_alone) = (difference.mismatch.to_string(), difference.passes_alone);
    First { case, difference, passes_alone }
}

/// The note that names the shard of a file.
pub(super) const SHARD: &str = "shard";

/// The shard that a file belongs to: from the option or the environment, or from the note in the
/// first line of the asked cases or of the file itself.
///
/// # Errors
/// They contradict each other, or a note is not a shard.
pub(super) fn place(
    said: ShardArgs,
    file: &Header,
    asked: Option<&Header>,
) -> Result<Placed, Failure> {
    let mut placed = said.place()?;
    let headers = [("--cases", asked), ("FILE", Some(file))];
    for (source, header) in headers.into_iter().filter_map(|(of, header)| Some((of, header?))) {
        let Some((_, text)) = header.notes.iter().find(|(key, _)| key == SHARD) else { continue };
        let noted = shard(text).map_err(|error| {
            Failure::bad_input(format!("{source}: the note shard={text}: {error}"))
        })?;
        let noted = Placed { shard: noted, source: Some(source) };
        if placed.source.is_some() && placed.shard != noted.shard {
            let message = format!(
                "one says shard {placed}, the other shard {noted}: give the file of that shard"
            );
            return Err(Failure::bad_input(message));
        }
        if placed.source.is_none() {
            placed = noted;
        }
    }
    Ok(placed)
}
