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
//!                          Tally for each rule ◄─────────┘  ──► held | broken | not exercised
//! ```
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
//! - Where a standard allows two results, the rule does not judge the patch.

mod answer;
mod edge;
mod inside;
mod levels;
mod lines;
mod memory;
mod mesh;
mod neighbours;
mod report;
mod rings;
mod specified;
mod standard;

pub use report::{Example, RuleRow, RulesReport, Verdict};
pub use standard::{Rule, Specification};

use crate::backend::{Backend, BackendError, tessellate};
use crate::case::Case;
use answer::Answer;
use memory::Memory;
use report::Tally;
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

/// A rule's judgement of one patch, or of a patch and an earlier one: the earlier case, and the
/// result with its fault.
type Judgement = (Option<Case>, Result<(), String>);

impl Checker {
    /// A checker that has judged nothing yet.
    #[must_use]
    pub fn new(specification: Specification) -> Self {
        let tally = |rule| Some(Tally::new(rule, specification.source(rule)?));
        let tallies = specification.rules().filter_map(tally).collect();
        Self { specification, patches: 0, tallies, memory: Memory::default() }
    }

    /// Judges an output by itself and against earlier ones.
    ///
    /// The output of a capture by coordinates may have one point per vertex.
    pub fn add(&mut self, case: &Case, output: &Tessellation) {
        self.patches += 1;
        let answer = match Answer::new(case, output) {
            Ok(answer) => answer,
            Err(what) => {
                return self.note(Rule::Range, case, output.points.len(), (None, Err(what)));
            }
        };
        let size = answer.size();
        if let Some(Err(what)) = answer.range() {
            return self.note(Rule::Range, case, size, (None, Err(what)));
        }
        let is_exact = self.specification == Specification::D3d11;
        let specified = is_exact.then(|| specified::specified(case)).flatten();
        for rule in self.specification.rules() {
            for judgement in self.judge(rule, &answer, specified.as_ref()) {
                self.note(rule, case, size, judgement);
            }
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

    fn judge(&mut self, rule: Rule, answer: &Answer, specified: Option<&Answer>) -> Vec<Judgement> {
        let alone = |result: Judged| result.into_iter().map(|result| (None, result)).collect();
        let specification = self.specification;
        match rule {
            Rule::Range => alone(answer.range()),
            Rule::Discard => alone(answer.discard()),
            Rule::Segments => alone(edge::segments(answer, specified, specification)),
            Rule::InnerLevels => alone(inside::inner_levels(answer, specified, specification)),
            Rule::InnerSpacing => alone(inside::inner_spacing(answer, specification)),
            Rule::Neighbours => alone(neighbours::neighbours(answer, specification)),
            Rule::Spacing => alone(edge::spacing(answer, specification)),
            Rule::Symmetric => alone(edge::symmetric(answer, specification)),
            Rule::Cover => alone(mesh::cover(answer)),
            Rule::Orientation => alone(mesh::orientation(answer)),
            Rule::Isolines => alone(mesh::isolines(answer, specification)),
            Rule::Counts => alone(specified::counts(answer, specified)),
            Rule::Places => alone(specified::places(answer, specified)),
            Rule::Primitives => alone(specified::primitives(answer, specified)),
            Rule::PointsOnce => alone(mesh::points_once(answer, specification)),
            _ => self.memory.judge(rule, answer, specification),
        }
    }

    fn note(&mut self, rule: Rule, case: &Case, size: usize, (other, result): Judgement) {
        if let Some(tally) = self.tallies.iter_mut().find(|tally| tally.is_of(rule)) {
            tally.add(case, other, size, result);
        }
    }
}
