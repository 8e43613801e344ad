//! What was asked, beside what is answered: one dropped, repeated or foreign answer is one difference.
//!
//! ```text
//! asked    A B C D E      A is answered; C is not the next one, but stands further on in what was asked, so B
//! answers  A C D E        is missing and everything behind it is in step again
//! ```
//!
//! An answer to a case that does not stand among the next [`WINDOW`] stands in the place of the one that is due.
//! If the due one comes behind it after all, nothing is missing.

use super::findings::{Findings, Found};
use crate::case::Case;
use crate::compare::{Element, Mismatch, Stage};
use crate::vectors::VectorError;
use std::collections::VecDeque;

/// The cases that were asked, in the order in which a file is to answer them.
pub type Asked<'a> = &'a mut (dyn Iterator<Item = Result<Case, VectorError>> + Send);

/// How many asked cases are looked through for an answer: fewer may be missing in one place.
pub const WINDOW: usize = 4096;

/// The cases that are still to be answered.
pub(super) struct Expected<'a> {
    asked: Asked<'a>,
    /// The next ones, of which the first is due.
    next: VecDeque<Case>,
    /// The number of the case that is due, from 1.
    due: u64,
    /// Answers since the last one in step that stand in the places of the first of `next`.
    foreign: usize,
    missing: Findings,
}

impl<'a> Expected<'a> {
    pub(super) fn new(asked: Asked<'a>) -> Self {
        let (next, missing) = (VecDeque::new(), Findings::default());
        Self { asked, next, due: 1, foreign: 0, missing }
    }

    /// What is wrong with the place of an answer, if something is.
    ///
    /// # Errors
    /// The asked cases cannot be read.
    pub(super) fn answer(
        &mut self,
        observed: Option<Case>,
    ) -> Result<Option<Mismatch>, VectorError> {
        self.read_up_to(self.foreign + 1)?;
        if let Some(observed) = observed {
            let ahead = if self.next.front() == Some(&observed) {
                Some(0)
            } else {
                self.read_up_to(WINDOW)?;
                self.next.iter().position(|case| *case == observed)
            };
            if let Some(ahead) = ahead {
                self.skip(ahead);
                self.next.pop_front();
                self.due += 1;
                return Ok(None);
            }
        }
        let expected = self.next.get(self.foreign).copied();
        self.foreign += 1;
        Ok(Some(other_answer(observed, expected)))
    }

    /// The cases without an answer, when there are no more answers.
    ///
    /// # Errors
    /// The asked cases cannot be read.
    pub(super) fn finish(mut self) -> Result<Findings, VectorError> {
        loop {
            self.read_up_to(WINDOW)?;
            if self.next.is_empty() {
                return Ok(self.missing);
            }
            self.skip(self.next.len());
        }
    }

    fn read_up_to(&mut self, cases: usize) -> Result<(), VectorError> {
        while self.next.len() < cases {
            let Some(case) = self.asked.next().transpose()? else { break };
            self.next.push_back(case);
        }
        Ok(())
    }

    /// Gives up the next cases: those in whose places foreign answers stand were reported.
    fn skip(&mut self, cases: usize) {
        let replaced = self.foreign.min(cases);
        for (ahead, case) in self.next.drain(..cases).enumerate() {
            if ahead >= replaced {
                let number = self.due + ahead as u64;
                let found = Found::Different(missing(), Some(case));
                self.missing.add(number, None, found, || None);
            }
        }
        self.due += cases as u64;
        self.foreign = 0;
    }
}

fn missing() -> Mismatch {
    let (observed, expected) = ("none".to_owned(), "an answer".to_owned());
    Mismatch { element: Element::Record, observed, expected, stage: Stage::Answer }
}

fn other_answer(observed: Option<Case>, expected: Option<Case>) -> Mismatch {
    let show = |case: Option<Case>| case.map_or("none".to_owned(), |case| case.to_string());
    let (observed, expected) = (show(observed), show(expected));
    Mismatch { element: Element::Case, observed, expected, stage: Stage::Answer }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Answers that name no case stand in the places of the first two.
    #[test]
    fn the_case_that_is_due_is_expected() {
        let case = |detail: u32| -> Case {
            format!("case isoline integer point ruler 3f800000 {detail:08x}")
                .parse()
                .expect("a case")
        };
        let cases = [case(0x3F80_0000), case(0x4000_0000)];
        let mut asked = cases.into_iter().map(Ok);
        let mut expected = Expected::new(&mut asked);
        for case in cases {
            let wrong = expected.answer(None).expect("cases").expect("no case was named");
            assert_eq!((wrong.observed, wrong.expected), ("none".to_owned(), case.to_string()));
        }
        let wrong = expected.answer(Some(cases[1])).expect("cases");
        assert!(wrong.is_none(), "the second after all: {wrong:?}");
    }
}
