//! Each value must be converted in one way throughout a file.
//!
//! Some values have two legal fixed-point numbers within 0.6 units in the last place. A device may
//! choose either one, but must always choose the same, because neighbouring patches meet only then.

use super::{Difference, Report};
use crate::case::Case;
use crate::check::compare::{Element, Mismatch, SpecStage};
use crate::strength::{Ambiguous, Conversions};
use std::collections::HashMap;

/// A record that the model explains if some values were converted in one of several ways.
#[derive(Debug)]
pub(super) struct Use {
    pub(super) number: u64,
    pub(super) line: Option<u64>,
    pub(super) case: Case,
    pub(super) conversions: Conversions,
}

/// For each value, which of its numbers it became (0 or 1), and the first record that shows it.
type Known = HashMap<u32, (usize, u64)>;

/// The records that convert a value in a way that contradicts an earlier record.
pub(super) fn conflicts(mut uses: Vec<Use>) -> Report {
    uses.sort_unstable_by_key(|used| used.number);
    let (mut report, mut known) = (Report::default(), Known::new());
    for used in uses {
        if let Some(mismatch) = conflict(&used, &mut known) {
            let Use { number, line, case, .. } = used;
            report.differ(Difference::new(number, line, mismatch, Some(case)));
        }
    }
    report
}

/// How a record contradicts earlier ones. If it does not, the values that it shows become known.
fn conflict(used: &Use, known: &mut Known) -> Option<Mismatch> {
    let Conversions { values, accepted } = &used.conversions;
    let bit = |choice: u64, value: usize| usize::from(choice >> value & 1 == 1);
    // A known value that this choice converts in the other way.
    let against = |choice: u64| {
        values.iter().enumerate().find_map(|(i, value)| {
            let (number, record) = known.get(&value.value)?;
            (bit(choice, i) != *number).then_some((*value, *number, *record))
        })
    };
    let choices = || (0..64).filter(|choice| accepted >> choice & 1 == 1);
    let consistent: Vec<u64> = choices().filter(|&choice| against(choice).is_none()).collect();
    let Some(&first) = consistent.first() else {
        let (value, number, record) = choices().find_map(against)?;
        return Some(mismatch(value, number, record));
    };
    for (i, value) in values.iter().enumerate() {
        // A value whose number does not show in the output may be either one.
        if consistent.iter().all(|&choice| bit(choice, i) == bit(first, i)) {
            known.entry(value.value).or_insert((bit(first, i), used.number));
        }
    }
    None
}

fn mismatch(value: Ambiguous, number: usize, record: u64) -> Mismatch {
    let [expected, observed] = [value.numbers[number], value.numbers[1 - number]];
    Mismatch {
        element: Element::Conversion(value.value),
        observed: format!("0x{observed:06x}"),
        expected: format!("0x{expected:06x}, as in record {record}"),
        stage: SpecStage::Factors,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ambiguous(value: u32) -> Ambiguous {
        Ambiguous { value, numbers: [2 * value, 2 * value + 1] }
    }

    /// A record with ambiguous values, and the choices that explain it.
    fn shows(number: u64, values: &[u32], choices: &[u64]) -> Use {
        let case = "case isoline integer line ruler 3f800000 3f800000".parse().expect("a case");
        let values = values.iter().map(|&value| ambiguous(value)).collect();
        let accepted = choices.iter().map(|choice| 1 << choice).sum();
        Use { number, line: None, case, conversions: Conversions { values, accepted } }
    }

    /// Where a record has two values, each is known by its own bit, whatever the other's bit is.
    #[test]
    fn each_value_has_a_bit() {
        for choice in 0..4 {
            let first = || shows(1, &[10, 20], &[choice]);
            for other in 0..4 {
                let report = conflicts(vec![shows(2, &[10, 20], &[other]), first()]);
                assert_eq!(report.mismatches, u64::from(other != choice), "{choice}, {other}");
                let Some(found) = report.differences.first() else { continue };
                let value: u32 = if (other ^ choice) & 1 == 1 { 10 } else { 20 };
                let known = u32::from(choice >> (value / 20) & 1 == 1);
                let expected = format!("0x{:06x}, as in record 1", 2 * value + known);
                assert_eq!(found.mismatch.expected, expected, "{choice}, {other}");
                assert_eq!(found.mismatch.element, Element::Conversion(value));
            }
            let alone = |bit: u64| conflicts(vec![first(), shows(2, &[20], &[bit])]).mismatches;
            assert_eq!([alone(choice >> 1), alone(choice >> 1 ^ 1)], [0, 1], "{choice}");
        }
    }

    /// A value that may be either number in a record stays open; choices that contradict other
    /// records are dropped.
    #[test]
    fn what_does_not_show_stays_open() {
        let open = || shows(1, &[10, 20], &[0, 2]);
        for bit in 0..2 {
            let uses = vec![open(), shows(2, &[20], &[bit]), shows(3, &[10], &[0])];
            assert_eq!(conflicts(uses).mismatches, 0, "20 became number {bit}");
        }
        assert_eq!(conflicts(vec![open(), shows(2, &[10], &[1])]).mismatches, 1, "10 shows");
        // 10 became the second number in record 1, so record 2 shows that 20 did as well.
        let with = |bit: u64| {
            let uses =
                [shows(1, &[10], &[1]), shows(2, &[10, 20], &[0, 3]), shows(3, &[20], &[bit])];
            conflicts(uses.into()).mismatches
        };
        assert_eq!([with(0), with(1)], [1, 0]);
    }
}
