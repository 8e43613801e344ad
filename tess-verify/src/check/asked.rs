//! Matches answers with the cases that were asked: a dropped, repeated or foreign answer is a
//! single difference.
//!
//! ```text
//! asked    A B C D E      A is answered. C is not the next one: the answers and cases ahead are read, and
//! answers  A C D E        the shortest explanation is that B is missing and everything after it is in step
//! ```
//!
//! While answers are in step, nothing is read ahead. Where they are not, at most [`WINDOW`] answers
//! and twice as many cases are read, and the smallest number of edits that explains these answers
//! is found (`alignment`). Only the first half of the edits is settled, because the best
//! explanation of the rest depends on what follows. So fewer than [`WINDOW`] missing cases can be
//! bridged, and the comparison resumes at a case only if what follows agrees.

use super::Known;
use super::alignment::{Pairing, Said, align};
use super::findings::{Findings, Found};
use crate::case::Case;
use crate::check::compare::{Element, Mismatch, SpecStage};
use crate::vectors::{Record, VectorError, VectorFile};
use std::collections::VecDeque;
use std::io::BufRead;

/// The asked cases, in the order in which a file is to answer them.
pub type Asked<'a> = &'a mut (dyn Iterator<Item = Result<Case, VectorError>> + Send);

/// The number of answers that are examined where answers are out of step. Fewer than this may be
/// missing or superfluous in one place. Where answers have more than 4000 points and indices on
/// average, fewer are examined.
const WINDOW: usize = 4096;

/// The largest number of points and indices read ahead, not counting the last answer: about 100 MB.
const ELEMENTS: usize = 4000 * WINDOW;

/// The cases still to be answered, and the answers read ahead.
pub(super) struct Expected<'a> {
    asked: Asked<'a>,
    /// The next cases; the first one is due.
    next: VecDeque<Case>,
    /// The number of the case that is due, from 1.
    due: u64,
    /// The next answers, as far as they have been read.
    ahead: VecDeque<Record>,
    answers_end: bool,
    /// The error at which the answers end early; it is reported once the answers before it are
    /// settled.
    malformed: Option<VectorError>,
    /// The settled pairings of the first answers and cases.
    pairings: VecDeque<Pairing>,
    said: Said,
    known: &'a Known,
    missing: Findings,
}

impl<'a> Expected<'a> {
    pub(super) fn new(asked: Asked<'a>, known: &'a Known) -> Self {
        Self {
            asked,
            known,
            next: VecDeque::new(),
            due: 1,
            ahead: VecDeque::new(),
            answers_end: false,
            malformed: None,
            pairings: VecDeque::new(),
            said: Said::default(),
            missing: Findings::default(),
        }
    }

    /// The next answer, with its fault if it is out of place; `None` at the end.
    ///
    /// # Errors
    /// The answers or the asked cases cannot be read.
    pub(super) fn answer<R: BufRead>(
        &mut self,
        file: &mut VectorFile<R>,
    ) -> Result<Option<(Record, Option<Mismatch>)>, VectorError> {
        loop {
            if self.pairings.is_empty() {
                self.read_answers(file, 1);
                self.read_cases(1)?;
                let Some(record) = self.ahead.front() else {
                    return self.malformed.take().map_or(Ok(None), Err);
                };
                if record.case().is_some() && record.case() == self.next.front().copied() {
                    self.pairings.push_back(Pairing::Same);
                } else {
                    self.settle(file)?;
                }
            }
            let pairing = self.pairings.pop_front();
            if pairing == Some(Pairing::Missing) {
                self.miss();
            } else if let Some(record) = self.ahead.pop_front() {
                let expected = self.next.front().copied();
                let is_wrong = pairing != Some(Pairing::Same);
                if pairing != Some(Pairing::Extra) {
                    self.next.pop_front();
                    self.due += 1;
                }
                let astray = is_wrong.then(|| other_answer(record.case(), expected));
                return Ok(Some((record, astray)));
            }
        }
    }

    /// Settles the pairings of at least one answer.
    fn settle<R: BufRead>(&mut self, file: &mut VectorFile<R>) -> Result<(), VectorError> {
        self.read_answers(file, WINDOW);
        self.read_cases(2 * WINDOW)?;
        let cases_end = self.next.len() < 2 * WINDOW;
        let answers: Vec<Option<Case>> = self.ahead.iter().map(Record::case).collect();
        // More answers may follow a malformed one.
        let is_cut = self.malformed.is_some();
        let whole = self.answers_end && !is_cut || cases_end;
        let pairings = align(&answers, self.next.make_contiguous(), whole, &mut self.said);
        let settled = if is_cut || self.answers_end && cases_end {
            answers.len()
        } else {
            answers.len().div_ceil(2)
        };
        let mut taken = 0;
        self.pairings = pairings
            .into_iter()
            .take_while(|pairing| {
                let is_settled = taken < settled;
                taken += usize::from(*pairing != Pairing::Missing);
                is_settled
            })
            .collect();
        Ok(())
    }

    /// The cases left without an answer, once there are no more answers.
    ///
    /// # Errors
    /// The asked cases cannot be read.
    pub(super) fn finish(mut self) -> Result<Findings, VectorError> {
        loop {
            self.read_cases(1)?;
            if self.next.is_empty() {
                return Ok(self.missing);
            }
            self.miss();
        }
    }

    /// The cases without an answer that precede a malformed record.
    pub(super) fn so_far(self) -> Findings {
        self.missing
    }

    fn read_cases(&mut self, cases: usize) -> Result<(), VectorError> {
        while self.next.len() < cases {
            let Some(case) = self.asked.next().transpose()? else { break };
            self.next.push_back(case);
        }
        Ok(())
    }

    /// Reads until `answers` answers are ahead. A malformed answer ends the answers, too.
    fn read_answers<R: BufRead>(&mut self, file: &mut VectorFile<R>, answers: usize) {
        let mut elements: usize = self.ahead.iter().map(size).sum();
        while self.ahead.len() < answers && elements <= ELEMENTS && !self.answers_end {
            match file.next() {
                Some(Ok(record)) => {
                    elements += size(&record);
                    self.ahead.push_back(record);
                }
                ended => {
                    self.answers_end = true;
                    self.malformed = ended.and_then(Result::err);
                }
            }
        }
    }

    /// Records that the case that is due has no answer.
    fn miss(&mut self) {
        if let Some(case) = self.next.pop_front() {
            let found = Found::Different(missing(), Some(case));
            let found = found.unless_known(Some(case), self.known);
            self.missing.add(self.due, None, found, Default::default);
            self.due += 1;
        }
    }
}

/// The number of points and indices of a record.
fn size(record: &Record) -> usize {
    match record {
        Record::Listing(listing) => listing.output.points.len() + listing.output.indices.len(),
        Record::Coordinates(coordinates) => coordinates.vertices.len(),
        _ => 0,
    }
}

fn missing() -> Mismatch {
    let (observed, expected) = ("none".to_owned(), "an answer".to_owned());
    Mismatch { element: Element::Record, observed, expected, stage: SpecStage::Answer }
}

fn other_answer(observed: Option<Case>, expected: Option<Case>) -> Mismatch {
    let show = |case: Option<Case>| case.map_or("none".to_owned(), |case| case.to_string());
    let (observed, expected) = (show(observed), show(expected));
    Mismatch { element: Element::Case, observed, expected, stage: SpecStage::Answer }
}
