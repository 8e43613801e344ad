//! Explains answers that are out of step with what was asked, by an edit distance and the edits
//! that it counts.
//!
//! ```text
//! asked    A B C D E        A is answered; B is missing; C is answered; X takes the place of D; E is answered;
//! answers  A C X E E        the second E is one too many: three edits, and no other explanation has fewer
//! ```
//!
//! `D[i][j]` is the smallest number of edits between the answers from `i` on and the asked cases
//! from `j` on. The lower right corner is 0. Every other entry is the smallest of its right, lower
//! and lower right neighbours plus one, or the lower right neighbour itself where the cases agree.
//! If more answers are to come, the whole bottom row is 0.
//!
//! Neighbours differ by at most one, so a row of the matrix is stored as bits, 64 entries per word,
//! and each row follows from the one below by a few word operations (Myers, "A fast bit-vector
//! algorithm for approximate string matching", 1999; Hyyrö's form). Two bits per entry are kept to
//! tell which edit comes first.

use crate::case::Case;
use std::collections::HashMap;

/// How the next answer, the next asked case, or both are accounted for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Pairing {
    /// The answer is to this case.
    Same,
    /// The answer is to another case and takes the place of this one.
    Replaced,
    /// The answer was not asked for.
    Extra,
    /// The case has no answer.
    Missing,
}

/// A row of the matrix, or one property of each of its entries. Bit `j - 1` belongs to the last `j`
/// asked cases.
type Bits = Vec<u64>;

/// The pairings that explain `answers` by the `asked` cases with the fewest edits. Where there is a
/// choice, an answer takes the place of the next case. With `whole`, every case that is left over
/// is missing. Otherwise cases after the last answer cost nothing, because their answers are still
/// to come.
///
/// Time: proportional to the number of answers times the number of 64-case words.
pub(super) fn align(
    answers: &[Option<Case>],
    asked: &[Case],
    whole: bool,
    said: &mut Said,
) -> Vec<Pairing> {
    let words = asked.len().div_ceil(64);
    // The positions of each case that was answered. Other cases are not stored, and an answer that
    // was not asked for allocates nothing.
    let mut places: HashMap<Case, Bits> =
        answers.iter().flatten().map(|case| (*case, Bits::new())).collect();
    for (bit, case) in asked.iter().rev().enumerate() {
        if let Some(places) = places.get_mut(case) {
            places.resize(words, 0);
            places[bit / 64] |= 1 << (bit % 64);
        }
    }
    let none = vec![0; words];
    let mut row = Row { up: vec![if whole { u64::MAX } else { 0 }; words], down: none.clone() };
    said.diagonal.clear();
    said.up.clear();
    for answer in answers.iter().rev() {
        let equal = answer.and_then(|case| places.get(&case));
        row.next(equal.filter(|places| !places.is_empty()).unwrap_or(&none), &mut said.diagonal);
        said.up.extend_from_slice(&row.up);
    }
    trace(answers, asked, whole, said)
}

/// The difference between each entry of a row and the entry for one case fewer: one more (`up`) or
/// one less (`down`).
struct Row {
    up: Bits,
    down: Bits,
}

/// Two bits per entry, row by row, starting with the last answer. The memory is reused.
#[derive(Default)]
pub(super) struct Said {
    /// The entry equals the one for one answer and one case fewer: the answer is right, or it is
    /// not a replacement.
    diagonal: Bits,
    /// The entry is one more than that for one case fewer: the case may be missing.
    up: Bits,
}

impl Row {
    /// Advances to the row for one more answer; `equal` marks the cases that it answers.
    fn next(&mut self, equal: &Bits, diagonal: &mut Bits) {
        let (mut carry, mut more_in, mut less_in) = (false, 1, 0);
        // `carry` is that of the addition, from word to word; `more_in` and `less_in` are the bits
        // that the shifts move from word to word. The first case has no case fewer: there each row
        // is one more than the row below, hence 1 and 0.
        for ((up, down), equal) in self.up.iter_mut().zip(&mut self.down).zip(equal) {
            // The carry of the addition runs along `up` from each equal case: an entry stays as
            // cheap as its diagonal neighbour as long as each is one more than the one before.
            let (sum, over) = (equal & *up).overflowing_add(*up);
            let (sum, over_again) = sum.overflowing_add(u64::from(carry));
            carry = over || over_again;
            let same = (sum ^ *up) | equal | *down;
            // Compared with the row below: one more, or one less.
            let (more, less) = (*down | !(same | *up), *up & same);
            let (more_left, less_left) = (more << 1 | more_in, less << 1 | less_in);
            (more_in, less_in) = (more >> 63, less >> 63);
            // Compared with one case fewer, from the differences of the left neighbours.
            *up = less_left | !(same | more_left);
            *down = more_left & same;
            diagonal.push(same);
        }
    }
}

/// The pairings, starting with the first answer and case.
fn trace(answers: &[Option<Case>], asked: &[Case], whole: bool, said: &Said) -> Vec<Pairing> {
    let mut pairings = Vec::with_capacity(answers.len());
    let (mut i, mut j) = (0, 0);
    while i < answers.len() {
        let row = (answers.len() - 1 - i) * asked.len().div_ceil(64);
        let is_set = |bits: &Bits| {
            let bit = asked.len() - 1 - j;
            bits[row + bit / 64] >> (bit % 64) & 1 == 1
        };
        // An entry that is not the diagonal one is one more than it: an edit replaces both. Else an
        // edit of one side must explain it, a missing case before an answer too many.
        let pairing = if j == asked.len() {
            Pairing::Extra
        } else if answers[i] == Some(asked[j]) {
            Pairing::Same
        } else if !is_set(&said.diagonal) {
            Pairing::Replaced
        } else if is_set(&said.up) {
            Pairing::Missing
        } else {
            Pairing::Extra
        };
        i += usize::from(pairing != Pairing::Missing);
        j += usize::from(pairing != Pairing::Extra);
        pairings.push(pairing);
    }
    let left = if whole { asked.len() - j } else { 0 };
    pairings.extend(std::iter::repeat_n(Pairing::Missing, left));
    pairings
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::SplitMix64;

    fn case(k: u32) -> Case {
        let line = format!("case isoline integer point ruler 3f800000 {:08x}", 0x3F80_0000 + k);
        line.parse().expect("a case")
    }

    /// The number of edits from the whole matrix, entry by entry.
    fn fewest(answers: &[Option<Case>], asked: &[Case], whole: bool) -> usize {
        let last = |j| if whole { asked.len() - j } else { 0 };
        let mut row: Vec<usize> = (0..=asked.len()).map(last).collect();
        for answer in answers.iter().rev() {
            let mut next = row.clone();
            next[asked.len()] += 1;
            for j in (0..asked.len()).rev() {
                let replaced = row[j + 1] + usize::from(*answer != Some(asked[j]));
                next[j] = replaced.min(row[j] + 1).min(next[j + 1] + 1);
            }
            row = next;
        }
        row[0]
    }

    /// The number of edits among the pairings; each pairing is checked.
    fn edits(pairings: &[Pairing], answers: &[Option<Case>], asked: &[Case], whole: bool) -> usize {
        let (mut i, mut j) = (0, 0);
        for pairing in pairings {
            match pairing {
                Pairing::Same => assert_eq!(answers[i], Some(asked[j]), "{pairings:?}"),
                Pairing::Replaced => assert_ne!(answers[i], Some(asked[j]), "{pairings:?}"),
                Pairing::Extra | Pairing::Missing => {}
            }
            i += usize::from(*pairing != Pairing::Missing);
            j += usize::from(*pairing != Pairing::Extra);
        }
        assert_eq!(i, answers.len(), "every answer: {pairings:?}");
        assert!(
            if whole { j == asked.len() } else { j <= asked.len() },
            "every case: {pairings:?}"
        );
        pairings.iter().filter(|pairing| **pairing != Pairing::Same).count()
    }

    /// Sequences of few and of many distinct cases, shorter and longer than a word, with long equal
    /// parts or with none.
    #[test]
    fn no_explanation_is_shorter() {
        let (mut random, mut said) = (SplitMix64::new(1), Said::default());
        for round in 0..3000usize {
            let length = [3, 10, 64, 65, 200][round % 5];
            let kinds = [2, 4, 1000][round / 5 % 3];
            let whole = round / 15 % 2 == 0;
            let mut some = || -> Vec<Case> {
                let length = random.below(length + 1);
                (0..length).map(|_| case(random.below(kinds))).collect()
            };
            let asked = some();
            let mut answered = if round % 2 == 0 { some() } else { asked.clone() };
            for edit in 0..round % 7 {
                let at = (round * 31 + edit * 17) % (answered.len() + 1);
                match (round + edit) % 3 {
                    0 => answered.insert(at, case(7)),
                    1 if at < answered.len() => drop(answered.remove(at)),
                    _ => answered.rotate_left(at.min(1)),
                }
            }
            let answers: Vec<Option<Case>> = answered.into_iter().map(Some).collect();
            let pairings = align(&answers, &asked, whole, &mut said);
            let found = edits(&pairings, &answers, &asked, whole);
            assert_eq!(found, fewest(&answers, &asked, whole), "round {round}: {pairings:?}");
        }
    }
}
