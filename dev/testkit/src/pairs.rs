//! Covering arrays: rows of options in which any two values of two options occur together.
//!
//! Most faults of options need one value, or two together. There are 59 049 rows of 10 options with
//! 3 values; 15 of them have every two values together. Two values may exclude each other, and then
//! no row has both:
//!
//! ```text
//! domain  quad, tri    values [2, 2, 2]; index u16 and output points exclude each other
//! index   u16, u32     rows     quad u16 tris, quad u32 points, tri u16 tris, tri u32 points, quad u32 tris
//! output  tris, points refused  tri u16 points
//! ```

use std::collections::BTreeSet;
use std::ops::Range;

/// A value of an option: the option's number, then the value's.
pub type Choice = (usize, usize);

/// Options by their numbers of values, and the pairs of values that exclude each other.
#[derive(Clone, Debug)]
pub struct Options<E> {
    values: Vec<usize>,
    excluded: E,
    seldom: Vec<Choice>,
}

impl<E: Fn(Choice, Choice) -> bool> Options<E> {
    /// One option for each element of `values`, which is its number of values. `excluded` gets two
    /// choices of different options, the one of the lower option first.
    ///
    /// # Panics
    /// If there are fewer than two options, or an option has no value.
    pub fn new(values: &[usize], excluded: E) -> Self {
        assert!(values.len() >= 2 && !values.contains(&0), "pairs of options: {values:?}");
        Self { values: values.to_vec(), excluded, seldom: Vec::new() }
    }

    /// The same options, with choices that a row has only for a pair with them, or where there is
    /// no other choice.
    #[must_use]
    pub fn seldom(self, choices: &[Choice]) -> Self {
        Self { seldom: choices.to_vec(), ..self }
    }

    /// Rows with a value of each option, by number. No row has an excluded pair; every other pair
    /// is in one of them. The same options give the same rows.
    ///
    /// # Panics
    /// If no row can have some pair that is not excluded, for example because one of the two
    /// excludes all values of a third option.
    pub fn rows(&self) -> Vec<Vec<usize>> {
        let mut missing: BTreeSet<[Choice; 2]> = self.pairs(false).collect();
        let mut rows: Vec<Vec<usize>> = Vec::new();
        while let Some(&pair) = missing.first() {
            let row = self.row(&pair, &missing, rows.len());
            let row = row.unwrap_or_else(|| panic!("no row can have {pair:?}: exclude it"));
            let choices: Vec<Choice> = row.iter().copied().enumerate().collect();
            missing.retain(|[a, b]| !(choices.contains(a) && choices.contains(b)));
            rows.push(row);
        }
        rows
    }

    /// Each excluded pair, with a row that has it and no other excluded pair.
    ///
    /// # Panics
    /// If there is no such row.
    pub fn refused(&self) -> Vec<([Choice; 2], Vec<usize>)> {
        let row = |pair: [Choice; 2]| {
            let row = self.row(&pair, &BTreeSet::new(), pair[0].1 + pair[1].1);
            (pair, row.unwrap_or_else(|| panic!("no row has {pair:?} as its only fault")))
        };
        self.pairs(true).map(row).collect()
    }

    /// All excluded pairs of choices, or all others.
    fn pairs(&self, excluded: bool) -> impl Iterator<Item = [Choice; 2]> {
        let choices = |option: usize| (0..self.values[option]).map(move |value| (option, value));
        let all = move |options: Range<usize>| options.flat_map(choices);
        let two = all(0..self.values.len()).flat_map(move |b| all(0..b.0).map(move |a| [a, b]));
        two.filter(move |&[a, b]| (self.excluded)(a, b) == excluded)
    }

    /// A row with the choices of `start` and otherwise no excluded pairs; it has many pairs of
    /// `missing`.
    fn row(
        &self,
        start: &[Choice],
        missing: &BTreeSet<[Choice; 2]>,
        turn: usize,
    ) -> Option<Vec<usize>> {
        let mut chosen = start.to_vec();
        self.complete(&mut chosen, missing, turn).then(|| {
            chosen.sort_unstable();
            chosen.into_iter().map(|(_, value)| value).collect()
        })
    }

    /// Chooses a value of each option that has none yet: the one that adds most pairs of `missing`,
    /// and among equals each in turn, with those of `seldom` last. Goes back where no value is
    /// possible.
    fn complete(
        &self,
        chosen: &mut Vec<Choice>,
        missing: &BTreeSet<[Choice; 2]>,
        turn: usize,
    ) -> bool {
        let is_free = |option: &usize| chosen.iter().all(|(other, _)| other != option);
        let Some(option) = (0..self.values.len()).find(is_free) else { return true };
        let mut values: Vec<Choice> = (0..self.values[option])
            .map(|value| (option, (value + turn) % self.values[option]))
            .filter(|&choice| chosen.iter().all(|&other| !self.excludes(other, choice)))
            .collect();
        let is_missing = |a: Choice, b: Choice| missing.contains(&ordered(a, b));
        values.sort_by_key(|&a| {
            let added = chosen.iter().filter(|&&b| is_missing(a, b)).count();
            (self.seldom.contains(&a), std::cmp::Reverse(added))
        });
        values.into_iter().any(|choice| {
            chosen.push(choice);
            let is_complete = self.complete(chosen, missing, turn);
            if !is_complete {
                chosen.pop();
            }
            is_complete
        })
    }

    fn excludes(&self, a: Choice, b: Choice) -> bool {
        let [a, b] = ordered(a, b);
        (self.excluded)(a, b)
    }
}

fn ordered(a: Choice, b: Choice) -> [Choice; 2] {
    if a < b { [a, b] } else { [b, a] }
}
