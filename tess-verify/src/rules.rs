//! What each standard demands of a tessellator's output, checked without a driver.
//!
//! A device may differ from the model and still be right. A rule is a statement of one standard
//! about output, such as "an outer edge's vertices depend only on its own level and spacing". Some
//! rules judge one patch, others compare patches that have a level in common; `tess gen --rules`
//! generates patches that exercise all of them.
//!
//! ```text
//!  (case, output) ──► Answer: vertices by place ──► rules of one patch   (answer.rs, mesh.rs, edge.rs)
//!                                              └──► rules of several      (memory.rs)
//!                                                        │
//!                          Tally for each rule ◄─────────┘  ──► held | held as far as asked | broken | not exercised
//! ```
//!
//! A rule is a row of `rule.rs`: its demand, its sources, its scope and its judge. It is held only
//! if every level of its scope was asked (`scope.rs`, `asked.rs`); see [`Asked`].
//!
//! Vertices are identified by their coordinates, as a shader sees them, never by index.
//!
//! ```
//! use tess_verify::Case;
//! use tess_verify::rules::{Checker, Rule, Specification, Verdict};
//!
//! let mut checker = Checker::new(Specification::Vulkan);
//! // 3.00000024 is above 3, so Vulkan asks for 5 segments. The model first rounds to 16 fraction bits.
//! let case: Case = "case isoline fractional_odd line ruler 3f800000 40400001".parse()?;
//! checker.add(&case, &case.patch().tessellate());
//!
//! let rows = checker.report().rows;
//! let segments = rows.iter().find(|row| row.rule == Rule::Segments).expect("a rule of Vulkan");
//! assert_eq!(segments.verdict(), Verdict::Broken);
//! let example = segments.smallest.as_ref().expect("broken");
//! assert_eq!(example.cases, [case]);
//! assert_eq!(example.what, "line 0 has 3 segments, its level 3.0000002 asks for 5");
//! # Ok::<(), tess_verify::CaseError>(())
//! ```
//!
//! - A patch with an index that names no point, or a point outside the domain, is judged only by
//!   [`Rule::Range`].
//! - Coordinates are rounded, so a vertex may be 16/65536 away from the place that equal lengths
//!   give it, and a length may be off by twice that. Everything else is compared bit for bit.
//! - Where a standard allows two results, either is right.

mod answer;
mod asked;
mod division;
mod edge;
mod inside;
mod lengths;
mod levels;
mod lines;
mod memory;
mod mesh;
mod neighbours;
mod report;
mod rings;
mod rule;
mod scope;
mod specified;
mod standard;

pub use asked::Asked;
pub use report::{Example, RuleRow, RulesReport, Verdict};
pub use rule::Rule;
pub use standard::Specification;

use crate::backend::{Backend, BackendError, tessellate};
use crate::case::Case;
use answer::Answer;
use memory::Memory;
use report::Tally;
use rule::{Judge, Subject};
use tess_core::Tessellation;

/// Judges outputs by the rules of one standard.
#[derive(Debug)]
pub struct Checker {
    specification: Specification,
    patches: u64,
    tallies: Vec<Tally>,
    memory: Memory,
}

/// Patches per call of a backend.
const BATCH: usize = 256;

/// Judges a backend's outputs for cases. After each batch, `done` is called with the number of
/// patches so far.
///
/// # Errors
/// The backend could not run, or the number of its answers is not the number of cases.
pub fn check_rules(
    backend: &mut dyn Backend,
    cases: impl IntoIterator<Item = Case>,
    specification: Specification,
    mut done: impl FnMut(u64),
) -> Result<RulesReport, BackendError> {
    let mut checker = Checker::new(specification);
    let mut cases = cases.into_iter();
    loop {
        let batch: Vec<Case> = cases.by_ref().take(BATCH).collect();
        if batch.is_empty() {
            return Ok(checker.report());
        }
        let outputs = tessellate(backend, &batch)?;
        batch.iter().zip(&outputs).for_each(|(case, output)| checker.add(case, output));
        done(checker.patches);
    }
}

/// A rule's judgement of one patch; `None` if the patch could not show a fault.
type Judged = Option<Result<(), String>>;

/// A rule's judgement of one patch, or of a patch and an earlier one.
#[derive(Debug)]
struct Judgement {
    /// The earlier case.
    other: Option<Case>,
    /// The positions of the levels that it is about, as bits.
    positions: u8,
    /// The fault, if there is one.
    result: Result<(), String>,
}

impl Judgement {
    /// A judgement of one patch, about all levels of the rule's scope.
    const fn of_patch(result: Result<(), String>) -> Self {
        Self { other: None, positions: u8::MAX, result }
    }
}

impl Checker {
    /// A checker that has judged nothing yet.
    #[must_use]
    pub fn new(specification: Specification) -> Self {
        let rules = specification.rules();
        let tallies = rules.filter_map(|row| Tally::new(row, specification)).collect();
        Self { specification, patches: 0, tallies, memory: Memory::default() }
    }

    /// Judges an output by itself and against earlier ones.
    ///
    /// The output of a capture by coordinates may have one point per vertex.
    pub fn add(&mut self, case: &Case, output: &Tessellation) {
        self.patches += 1;
        let answer = match Answer::new(case, output, self.specification) {
            Ok(answer) => answer,
            Err(what) => return self.out_of_range(case, output.points.len(), what),
        };
        let size = answer.size();
        if let Some(Err(what)) = answer.range() {
            return self.out_of_range(case, size, what);
        }
        let is_exact = self.specification == Specification::D3d11;
        let specified = is_exact.then(|| specified::specified(&answer)).flatten();
        let subject = Subject { answer: &answer, specified: specified.as_ref() };
        for (row, tally) in self.specification.rules().zip(&mut self.tallies) {
            let judgements = match row.judge {
                Judge::One(judge) => judge(&subject).map(Judgement::of_patch).into_iter().collect(),
                Judge::Many(judge) => judge(&mut self.memory, &answer),
            };
            judgements.into_iter().for_each(|judgement| tally.add(case, size, judgement));
        }
    }

    /// The findings so far.
    #[must_use]
    pub fn report(&self) -> RulesReport {
        RulesReport {
            specification: self.specification,
            patches: self.patches,
            rows: self.tallies.iter().map(Tally::row).collect(),
        }
    }

    /// How often each rule was broken so far, in the order of [`Rule`].
    pub fn broken(&self) -> impl Iterator<Item = (Rule, u64)> {
        self.tallies.iter().map(|tally| (tally.rule(), tally.broken()))
    }

    /// Counts an output that no other rule can judge.
    fn out_of_range(&mut self, case: &Case, size: usize, what: String) {
        let judgement = Judgement { positions: 0, ..Judgement::of_patch(Err(what)) };
        if let Some(tally) = self.tallies.iter_mut().find(|tally| tally.rule() == Rule::Range) {
            tally.add(case, size, judgement);
        }
    }
}
