//! Explains a device's differences: by freedoms that were not granted, or by one mistake.
//!
//! ```text
//!  each different record ──► drops every mistake that does not give this output
//!                                │ the mistakes that are left explain all differences
//!  all right records  ──────────► a mistake that would show on one of them is refuted,
//!                                  unless a condition that all differences meet excludes it
//! ```
//!
//! Most mistakes are dropped at the first difference, so the others cost one patch each. The right
//! records are tried last, and only if a mistake is left.

use crate::case::Case;
use crate::check::freedoms::Freedoms;
use crate::mistakes::{self, Common, Mistake, Request, Scope, requests};
use crate::strength::{ListOrder, Strength};
use std::collections::HashMap;
use tess_core::Tessellation;

/// The number of records that are kept to refute mistakes.
const MOST: u64 = 1 << 20;

/// An explanation of every difference of a device.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Explanation {
    /// The device takes freedoms of the specification that the comparison did not grant.
    Freedoms(Freedoms),
    /// The device makes a mistake on the patches of a scope.
    Mistake(&'static Mistake, Scope),
}

impl Explanation {
    /// The freedoms' name, such as `flush`, or the family of the mistake.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::Freedoms(freedoms) => freedoms.name(),
            Self::Mistake(mistake, _) => mistake.family().to_owned(),
        }
    }

    /// A description of the device's way.
    #[must_use]
    pub fn words(&self) -> String {
        match self {
            Self::Freedoms(freedoms) => freedoms.words(),
            Self::Mistake(mistake, scope) => format!("{}{scope}", mistake.words()),
        }
    }

    /// Whether the specification leaves this to a device.
    #[must_use]
    pub const fn is_allowed(&self) -> bool {
        matches!(self, Self::Freedoms(_))
    }

    /// The length by which the shortest explanation is found: conditions first, then words.
    fn length(&self) -> (usize, usize) {
        let conditions = match self {
            Self::Freedoms(_) => 0,
            Self::Mistake(_, scope) => scope.conditions(),
        };
        (conditions, self.words().len())
    }
}

/// Finds what explains all differences of a device.
///
/// Each record is added once, in any order; [`Explainer::join`] adds those of another explainer.
#[derive(Clone, Debug)]
pub struct Explainer {
    /// The weakest strength of the records so far.
    strength: Strength,
    max_level: u32,
    freedoms: Vec<Freedoms>,
    mistakes: Vec<&'static Mistake>,
    differences: Common,
    /// The number of each record, its case, and whether it is right.
    records: Vec<(u64, Case, bool)>,
}

/// No record yet, of a device with factors up to 64.
impl Default for Explainer {
    fn default() -> Self {
        Self::new(64)
    }
}

impl Explainer {
    /// No record yet. `max_level` is the largest factor that the device supports; pass 64 if it is
    /// unknown.
    #[must_use]
    pub fn new(max_level: u32) -> Self {
        Self {
            strength: Strength::default(),
            max_level,
            freedoms: Freedoms::combinations(),
            mistakes: mistakes::all().iter().collect(),
            differences: Common::default(),
            records: Vec::new(),
        }
    }

    /// Adds a record that is right at a strength.
    pub fn right(&mut self, request: &Request, strength: Strength) {
        self.keep(request, strength, true);
    }

    /// Adds a record that says nothing, such as a known difference.
    pub fn skip(&mut self, request: &Request, strength: Strength) {
        self.keep(request, strength, false);
    }

    /// Adds a record that differs at a strength.
    pub fn different(&mut self, request: &Request, output: &Tessellation, strength: Strength) {
        self.keep(request, strength, false);
        self.differences.add(request);
        let (case, max_level) = (&request.case, self.max_level);
        self.freedoms.retain(|freedoms| freedoms.explain(case, output, strength, max_level));
        self.mistakes.retain(|mistake| explains(mistake, request, output, strength));
    }

    /// Adds a difference that nothing explains, such as a record that is missing.
    pub fn unexplained(&mut self) {
        self.freedoms.clear();
        self.mistakes.clear();
    }

    /// Adds the records of another explainer.
    pub fn join(&mut self, other: Self) {
        self.weaken(other.strength);
        self.freedoms.retain(|own| other.freedoms.contains(own));
        self.mistakes.retain(|own| other.mistakes.contains(own));
        self.differences.join(&other.differences);
        self.records.extend(other.records);
    }

    /// The explanations that each account for every difference and that no right record refutes:
    /// freedoms, or else mistakes, the shortest first. Of mistakes with equal numbers of conditions
    /// the one of fewer letters is shorter. None if nothing differs.
    #[must_use]
    pub fn explanations(mut self) -> Vec<Explanation> {
        if self.differences.count == 0 {
            return Vec::new();
        }
        let freedoms = std::mem::take(&mut self.freedoms);
        let is_needed = |own: &&Freedoms| !freedoms.iter().any(|part| part.are_part_of(**own));
        let taken: Vec<_> =
            freedoms.iter().filter(is_needed).map(|own| Explanation::Freedoms(*own)).collect();
        if !taken.is_empty() {
            return taken;
        }
        let mut mistakes = self.unrefuted();
        mistakes.sort_by_key(Explanation::length);
        mistakes
    }

    /// The mistakes that no right record refutes, each with the fewest conditions.
    fn unrefuted(&mut self) -> Vec<Explanation> {
        if self.mistakes.is_empty() {
            return Vec::new();
        }
        self.records.sort_unstable_by_key(|(number, ..)| *number);
        let cases = self.records.iter().map(|(_, case, _)| *case);
        let rights = requests(cases).zip(&self.records).filter(|(_, (.., is_right))| *is_right);
        let rights: Vec<Request> = rights.map(|(request, _)| request).collect();
        let scopes = self.differences.scopes();
        let scope_of = |mistake: &&'static Mistake| {
            let mut shown = HashMap::new();
            let mut shows = |number: usize| {
                let shows = || shows(mistake, &rights[number], self.strength);
                *shown.entry(number).or_insert_with(shows)
            };
            let mut is_refuted = |scope: &Scope| {
                (0..rights.len()).any(|number| scope.has(&rights[number]) && shows(number))
            };
            let scope = scopes.iter().find(|scope| !is_refuted(scope))?;
            Some(Explanation::Mistake(mistake, *scope))
        };
        self.mistakes.iter().filter_map(scope_of).collect()
    }

    fn keep(&mut self, request: &Request, strength: Strength, is_right: bool) {
        self.weaken(strength);
        if request.number < MOST {
            self.records.push((request.number, request.case, is_right));
        }
    }

    /// Vertices by coordinates are compared at a weaker strength than listings of the same file.
    fn weaken(&mut self, strength: Strength) {
        if strength.order != ListOrder::Exact || self.strength == Strength::default() {
            self.strength = strength;
        }
    }
}

/// Whether a device with this mistake could give an output that differs at a strength.
fn explains(
    mistake: &Mistake,
    request: &Request,
    observed: &Tessellation,
    strength: Strength,
) -> bool {
    let taken = mistake.case(request);
    if mistake.is_of_question() && taken == request.case {
        return false;
    }
    let answer = |case: &Case| {
        let mut output = case.patch().tessellate();
        mistake.spoil(&request.with_case(*case), &mut output);
        output
    };
    strength.explain_as(&taken, observed, answer).is_some()
}

/// Whether a mistake would have shown in a record that is right at a strength.
fn shows(mistake: &Mistake, request: &Request, strength: Strength) -> bool {
    let right = request.case.patch().tessellate();
    let wrong = mistake.wrong_answer(request, &right);
    wrong.is_some_and(|wrong| !strength.accepts(&request.case, &wrong))
}
