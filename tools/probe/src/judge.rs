//! Sums up what captured patches show.

use crate::capture::{Captured, Method};
use crate::digests::Digests;
use crate::info::Info;
use crate::report::{ExplainedBy, First, ProbeReport, ProbeRow, Unexplained};
use crate::verdict::{PatchVerdict, any_order, third_is_right, verdict};
use std::collections::BTreeMap;
use std::sync::Arc;
use tess_core::Tessellation;
use tess_verify::check::{Explainer, Explanation, Freedoms, Known, Strength, check_device};
use tess_verify::mistakes::{Request, Sequence};
use tess_verify::vectors::fixed;
use tess_verify::{Case, Named};

/// Compares a device's captures patch by patch, and finally explains the differences.
#[derive(Clone, Debug)]
pub struct Judge {
    method: Method,
    /// The strength of the comparison.
    strength: Strength,
    /// The cases that are known to differ.
    known: Arc<Known>,
    rows: Vec<(ProbeRow, Digests)>,
    /// How many patches that are not the model's in any order each combination of freedoms
    /// explains.
    freedoms: Vec<(Freedoms, u64)>,
    /// Finds the mistake that explains all of these patches.
    explainer: Explainer,
    sequence: Sequence,
    /// The other observations so far.
    report: ProbeReport,
}

impl Judge {
    /// A judge of captures from a device. `strength` selects what counts as equal; if only points
    /// are captured, only points are compared.
    #[must_use]
    pub fn new(info: &Info, method: Method, strength: Strength) -> Self {
        let (name, elements) = match method {
            Method::Primitives => ("primitives", strength.elements),
            Method::Points => ("points", method.elements()),
        };
        Self {
            method,
            strength: Strength { elements, ..strength },
            known: Arc::default(),
            rows: Vec::new(),
            freedoms: Freedoms::combinations().into_iter().map(|own| (own, 0)).collect(),
            explainer: Explainer::new(info.max_level),
            sequence: Sequence::default(),
            report: ProbeReport {
                device: info.clone(),
                method: name,
                patches: 0,
                different: 0,
                known: 0,
                stages: BTreeMap::new(),
                first_different: None,
                passes_alone: false,
                odd: 0,
                explanations: Vec::new(),
                unexplained: Unexplained { patches: 0, first: None },
                rows: Vec::new(),
            },
        }
    }

    /// Adds known differences: a case that differs does not count as different if that is known.
    #[must_use]
    pub fn with_known(self, known: &Arc<Known>) -> Self {
        Self { known: Arc::clone(known), ..self }
    }

    /// Adds a patch: the case that was asked, and the device's capture.
    pub fn add(&mut self, case: &Case, captured: &Captured) {
        let observed = captured.output();
        let expected = case.patch().tessellate();
        let verdict = verdict(case, captured, observed.as_ref(), &expected, self.method);
        let third = third_is_right(case, captured);
        let row = self.row(case);
        row.0.add(verdict, third);
        if let Some(observed) = &observed {
            row.1.add(observed, case.primitive_size());
        }
        let is_equal = |observed: &Tessellation| {
            self.strength.equal(case, observed, &expected) || self.strength.accepts(case, observed)
        };
        let equal = third && observed.as_ref().is_some_and(is_equal);
        let found =
            (!equal).then(|| self.describe(self.strength, case, captured, observed.as_ref()));
        if self.known.excuses(case, found.as_ref().map(|found| &found.difference as _)) {
            self.report.known += 1;
        } else if let Some(found) = found {
            self.differ(found);
        }
        let in_any_order =
            matches!(verdict, PatchVerdict::Sequence | PatchVerdict::Leading | PatchVerdict::Order);
        let request = self.sequence.next(*case, None);
        if in_any_order && third {
            self.explainer.right(&request, any_order(self.method));
        } else {
            self.explain(&request, captured, observed.as_ref().filter(|_| third));
        }
    }

    /// Counts a difference that is not known.
    fn differ(&mut self, found: First) {
        self.report.different += 1;
        let (row, _) = self.row(&found.case);
        row.different += 1;
        row.first.get_or_insert_with(|| (found.line.clone(), found.difference.clone()));
        *self.report.stages.entry(found.stage.clone()).or_default() += 1;
        self.report.first_different.get_or_insert(found);
    }

    /// Explains an odd patch. `observed` is `None` if it has coordinates that nothing explains.
    fn explain(&mut self, request: &Request, captured: &Captured, observed: Option<&Tessellation>) {
        self.report.odd += 1;
        let (order, max_level) = (any_order(self.method), self.report.device.max_level);
        match observed {
            Some(observed) => self.explainer.different(request, observed, order),
            None => self.explainer.unexplained(),
        }
        let case = &request.case;
        let mut explaining: Vec<Freedoms> = Vec::new();
        for (freedoms, patches) in &mut self.freedoms {
            // A combination counts only if no part of it is enough.
            let is_needed = !explaining.iter().any(|part| part.are_part_of(*freedoms));
            if is_needed && observed.is_some_and(|o| freedoms.explain(case, o, order, max_level)) {
                explaining.push(*freedoms);
                *patches += 1;
            }
        }
        if explaining.is_empty() {
            self.report.unexplained.patches += 1;
            if self.report.unexplained.first.is_none() {
                let observed = captured.output();
                self.report.unexplained.first =
                    Some(self.describe(order, case, captured, observed.as_ref()));
            }
        }
    }

    /// A full description of a difference at a strength.
    fn describe(
        &self,
        strength: Strength,
        case: &Case,
        captured: &Captured,
        observed: Option<&Tessellation>,
    ) -> First {
        let mismatch = observed.and_then(|observed| {
            let report = check_device([(*case, observed.clone())], strength);
            report.differences.into_iter().next().map(|difference| difference.mismatch)
        });
        let (difference, stage) = match (mismatch, observed) {
            (Some(found), _) => (found.to_string(), found.stage.to_string()),
            (None, Some(_)) => ("the third coordinate is wrong".to_owned(), "location".to_owned()),
            (None, None) => {
                let odd = captured.vertices.iter().flat_map(|[u, v, _]| [u, v]);
                let odd = odd.copied().find(|bits| fixed(*bits).is_none());
                let bits = odd.unwrap_or_default();
                let float = f32::from_bits(bits);
                let text = format!(
                    "a coordinate is {float} (0x{bits:08x}), not a multiple of 2^-16 in 0..=1"
                );
                (text, "location".to_owned())
            }
        };
        let (line, command) = (case.to_string(), case.command());
        First { line, command, difference, stage, case: *case, captured: captured.clone() }
    }

    fn row(&mut self, case: &Case) -> &mut (ProbeRow, Digests) {
        let names =
            (case.domain().name(), case.config.partitioning.name(), case.config.output.name());
        let known = self.rows.iter().position(|(row, _)| row.names() == names);
        let at = known.unwrap_or_else(|| {
            self.rows.push((ProbeRow::new(names), Digests::default()));
            self.rows.len() - 1
        });
        &mut self.rows[at]
    }

    /// The report on all patches.
    #[must_use]
    pub fn finish(self) -> ProbeReport {
        let odd = self.report.odd;
        let explained_by = |own: &Explanation, patches: u64| ExplainedBy {
            way: own.name(),
            words: own.words(),
            is_allowed: own.is_allowed(),
            patches,
            is_all: patches == odd,
        };
        let freedoms = self.freedoms.into_iter().filter(|(_, patches)| *patches > 0);
        let mut explanations: Vec<ExplainedBy> = freedoms
            .map(|(freedoms, patches)| explained_by(&Explanation::Freedoms(freedoms), patches))
            .collect();
        let mistakes = self.explainer.explanations();
        let mistake = mistakes.iter().find(|own| !own.is_allowed());
        explanations.extend(mistake.map(|own| explained_by(own, odd)));
        let mut rows: Vec<ProbeRow> = self.rows.into_iter().map(|(row, d)| row.with(&d)).collect();
        rows.sort_by(|a, b| a.names().cmp(&b.names()));
        ProbeReport {
            patches: rows.iter().map(|row| row.patches).sum(),
            explanations,
            rows,
            ..self.report
        }
    }
}
