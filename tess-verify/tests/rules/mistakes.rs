//! Tests of every kind of mistake: each is planted in the model's output and judged by the rules of
//! each standard.
//!
//! ```text
//!  cases of `tess gen --rules` ──► a device with one mistake ──► Checker ──► rules that it breaks
//!                                                                              │
//!      docs/rules.md, "Mistakes" ◄── a row for each mistake ◄──────────────────┘
//! ```
//!
//! The model itself breaks some rules of Vulkan on some patches. A mistake counts as broken where a
//! rule judges a patch wrong more often than it does with the model. Every variant of a mistake is
//! planted under every domain and spacing in which it can show. Each of these must be broken, or
//! the row of the table quotes the sentence of the standard that allows it.
//!
//! - Vulkan has no pow2, so only Direct3D judges it.
//! - Where a standard allows a mistake, only 100 patches are judged.
//! - Patches are judged up to the first broken rule, so a row lists the rules that detect a mistake
//!   first.
//! - A variant that changes no answer of a domain and spacing is not planted there. Each variant is
//!   planted somewhere.
//! - OpenGL has Vulkan's rules, which [`opengl_has_the_rules_of_vulkan`] checks, so one column is
//!   for both.

use super::*;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Mutex;
use tess_verify::mistakes::{Mistake, Request, all, requests};

/// The standards that have a column in the table.
const STANDARDS: [Specification; 2] = [VULKAN, Specification::D3d11];

/// Whether a sentence of a standard allows a mistake in a group.
fn is_allowed(mistake: &Mistake, standard: Specification, group: &str) -> bool {
    mistake.allowed().iter().any(|own| own.standard == standard && own.is_for(group))
}

/// A group of patches, with the model's answers and how often they break each rule.
struct Group {
    /// Domain and spacing, such as `quad fractional_odd`, or `all` for the whole sequence.
    name: String,
    requests: Vec<Request>,
    answers: Vec<Tessellation>,
    /// For each standard, the judgement of the model's answers to the first patches, as many as
    /// were needed so far.
    model: [Mutex<(Judge, Vec<Vec<u64>>)>; 2],
}

impl Group {
    fn new(name: &str, cases: Vec<Case>) -> Self {
        let answers = cases.iter().map(|case| case.patch().tessellate()).collect();
        let model = STANDARDS.map(|standard| Mutex::new((Judge::new(standard), Vec::new())));
        Self { name: name.to_owned(), requests: requests(cases).collect(), answers, model }
    }

    /// The patches of `tess gen --rules` and every number of segments, grouped by domain and
    /// spacing, and a group of all of them.
    fn all() -> Vec<Self> {
        let split = Some(tess_core::SplitOrder::Ruler);
        let selection = Selection { split, ..Selection::level(GenLevel::Rules, 1) };
        let cases: Vec<Case> = selection.cases().chain(numbers::every_number()).collect();
        let mut groups: BTreeMap<String, Vec<Case>> = BTreeMap::new();
        for case in &cases {
            let name = format!("{} {}", case.domain().name(), case.config.partitioning.name());
            groups.entry(name).or_default().push(*case);
        }
        groups.insert("all".to_owned(), cases);
        groups.into_iter().map(|(name, cases)| Self::new(&name, cases)).collect()
    }

    /// The answer of a device with a mistake, if it differs from the model's.
    fn other_answer(&self, mistake: &Mistake, i: usize) -> Option<Tessellation> {
        mistake.wrong_answer(&self.requests[i], &self.answers[i])
    }

    /// The first patch for which a device's answer differs from the model's.
    fn first_other(&self, mistake: &Mistake) -> Option<usize> {
        (0..self.requests.len()).find(|&i| self.other_answer(mistake, i).is_some())
    }

    /// The rules that a device breaks first and more often than the model does; empty if it breaks
    /// none for `patches`.
    fn first_broken(
        &self,
        mistake: &Mistake,
        standard: usize,
        patches: std::ops::Range<usize>,
    ) -> BTreeSet<&'static str> {
        let mut judge = Judge::new(STANDARDS[standard]);
        let mut of_part = (patches.start > 0).then(|| Judge::new(STANDARDS[standard]));
        for i in patches {
            let other = self.other_answer(mistake, i);
            let found =
                judge.add(&self.requests[i].case, other.as_ref().unwrap_or(&self.answers[i]));
            let model = match &mut of_part {
                Some(model) => model.add(&self.requests[i].case, &self.answers[i]),
                None => self.of_model(standard, i),
            };
            let more = found.iter().zip(&model).map(|(own, model)| own > model);
            let rules: BTreeSet<_> =
                more.zip(&judge.rules).filter(|(more, _)| *more).map(|(_, rule)| *rule).collect();
            if !rules.is_empty() {
                return rules;
            }
        }
        BTreeSet::new()
    }

    /// How often the model's answer to a patch breaks each rule, when judged after all patches
    /// before it.
    fn of_model(&self, standard: usize, patch: usize) -> Vec<u64> {
        let mut model = self.model[standard].lock().expect("no panic");
        let (judge, found) = &mut *model;
        while found.len() <= patch {
            let next = found.len();
            found.push(judge.add(&self.requests[next].case, &self.answers[next]));
        }
        found[patch].clone()
    }

    /// The rules of a standard that a device breaks first, if any.
    fn judge(
        &self,
        mistake: &Mistake,
        standard: usize,
        first: usize,
        is_allowed: bool,
    ) -> BTreeSet<&'static str> {
        let all = self.requests.len();
        if is_allowed {
            return self.first_broken(mistake, standard, first..all.min(first + OF_ALLOWED));
        }
        // The rules are likeliest to compare the first differing answer with the patches just
        // before it.
        let near =
            self.first_broken(mistake, standard, first.saturating_sub(NEAR)..all.min(first + NEAR));
        if near.is_empty() { self.first_broken(mistake, standard, 0..all) } else { near }
    }
}

/// The number of patches that are judged, starting at the first differing answer, if a standard
/// allows the mistake.
const OF_ALLOWED: usize = 100;

/// The number of patches before a device's first differing answer that are judged with it. All are
/// judged if these break no rule.
const NEAR: usize = 25;

/// A checker that returns how often each patch breaks each rule.
struct Judge {
    checker: Checker,
    rules: Vec<&'static str>,
    /// How often all patches so far broke each rule.
    sums: Vec<u64>,
}

impl Judge {
    fn new(standard: Specification) -> Self {
        let checker = Checker::new(standard);
        let rules: Vec<_> = checker.broken().map(|(rule, _)| rule.name()).collect();
        Self { checker, sums: vec![0; rules.len()], rules }
    }

    fn add(&mut self, case: &Case, output: &Tessellation) -> Vec<u64> {
        self.checker.add(case, output);
        let sums: Vec<u64> = self.checker.broken().map(|(_, broken)| broken).collect();
        let more: Vec<u64> =
            sums.iter().zip(&self.sums).map(|(now, before)| now - before).collect();
        self.sums = sums;
        more
    }
}

/// The result of a mistake under one standard.
#[derive(Default)]
struct Outcome {
    /// The rules that each variant breaks first in each group.
    broken: Vec<BTreeSet<&'static str>>,
    /// The groups in which a variant breaks no rule, with the variant.
    held: Vec<(String, String)>,
}

impl Outcome {
    /// A small set of rules such that each variant breaks one of them in each group: the most
    /// frequent rules come first.
    fn rules(&self) -> Vec<&'static str> {
        let mut left: Vec<_> = self.broken.iter().collect();
        let mut chosen = Vec::new();
        while let Some(rule) = most_frequent(&left) {
            left.retain(|rules| !rules.contains(rule));
            chosen.push(rule);
        }
        chosen
    }
}

/// Rules whose messages name a mistake. The first of these is taken if several rules detect it
/// equally often.
const TELLING: [&str; 10] = [
    "inner-levels",
    "segments",
    "discard",
    "isolines",
    "orientation",
    "spacing",
    "inner-spacing",
    "equal-levels",
    "points-once",
    "places",
];

fn most_frequent(sets: &[&BTreeSet<&'static str>]) -> Option<&'static str> {
    let mut times: BTreeMap<&'static str, usize> = BTreeMap::new();
    for rule in sets.iter().flat_map(|set| set.iter()) {
        *times.entry(rule).or_default() += 1;
    }
    let weight = |rule: &str| TELLING.iter().position(|own| *own == rule).unwrap_or(TELLING.len());
    let best = times.into_iter().max_by_key(|(rule, n)| (*n, std::cmp::Reverse(weight(rule))));
    best.map(|(rule, _)| rule)
}

/// The outcome for each standard, and the mistakes that no patch shows.
type Planted = ([Outcome; 2], Vec<String>);

/// Plants every mistake of a family.
fn plant(family: &[Mistake], groups: &[Group]) -> Planted {
    let mut outcomes = [Outcome::default(), Outcome::default()];
    let mut unseen = Vec::new();
    for mistake in family {
        let mut planted = 0;
        let of_sequence = mistake.is_of_sequence();
        for group in groups.iter().filter(|group| (group.name == "all") == of_sequence) {
            let Some(first) = group.first_other(mistake) else { continue };
            planted += 1;
            for (standard, outcome) in outcomes.iter_mut().enumerate() {
                if STANDARDS[standard] == VULKAN && group.name.ends_with("pow2") {
                    continue;
                }
                let is_allowed = is_allowed(mistake, STANDARDS[standard], &group.name);
                let rules = group.judge(mistake, standard, first, is_allowed);
                if rules.is_empty() {
                    outcome.held.push((group.name.clone(), mistake.words()));
                } else {
                    outcome.broken.push(rules);
                }
            }
        }
        if planted == 0 {
            unseen.push(format!("{}: no patch shows it", mistake.words()));
        }
    }
    (outcomes, unseen)
}

/// The table cell of a family, and the combinations that pass although no sentence allows them.
fn cell(mistake: &Mistake, standard: Specification, outcome: &Outcome) -> (String, Vec<String>) {
    let allowed: Vec<_> =
        mistake.allowed().iter().filter(|allowed| allowed.standard == standard).collect();
    let is_allowed = |group: &str| allowed.iter().any(|allowed| allowed.is_for(group));
    let held = outcome.held.iter().filter(|(group, _)| !is_allowed(group));
    let mut faults: Vec<String> = held
        .map(|(group, words)| format!("{}: {words}, {group}: no rule", standard.name()))
        .collect();
    let mut parts = Vec::new();
    let rules: Vec<_> = outcome.rules().iter().map(|rule| format!("`{rule}`")).collect();
    parts.extend((!rules.is_empty()).then(|| rules.join(", ")));
    for own in &allowed {
        let (only, because) = (own.only, own.because);
        let is_met = allowed
            .iter()
            .filter(|own| own.only == only)
            .any(|own| outcome.held.iter().any(|(group, _)| own.is_for(group)));
        if !is_met && !outcome.broken.is_empty() {
            faults.push(format!(
                "{}: {}: broken everywhere, though allowed: {only}",
                standard.name(),
                mistake.family()
            ));
        }
        let place = if only.is_empty() { String::new() } else { format!(" ({only})") };
        parts.push(format!("*allowed{place}*: {because}"));
    }
    (parts.join("; "), faults)
}

/// The table of docs/rules.md, line by line, and what is wrong with it.
fn table() -> (Vec<String>, Vec<String>) {
    let families: Vec<&[Mistake]> = all().chunk_by(|a, b| a.family() == b.family()).collect();
    let groups = Group::all();
    let found: Mutex<BTreeMap<usize, Planted>> = Mutex::default();
    let next = std::sync::atomic::AtomicUsize::new(0);
    let work = || {
        while let number = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed)
            && let Some(family) = families.get(number)
        {
            let outcomes = plant(family, &groups);
            found.lock().expect("no panic").insert(number, outcomes);
        }
    };
    std::thread::scope(|scope| {
        scope.spawn(work);
        work();
    });
    let mut lines = Vec::new();
    let mut faults = Vec::new();
    for (number, (outcomes, unseen)) in found.into_inner().expect("no panic") {
        faults.extend(unseen);
        let mistake = &families[number][0];
        let cells = STANDARDS.iter().zip(&outcomes).map(|(standard, outcome)| {
            let (text, wrong) = cell(mistake, *standard, outcome);
            faults.extend(wrong);
            text
        });
        lines.push(format!("| {} | {} |", mistake.family(), cells.collect::<Vec<_>>().join(" | ")));
    }
    (lines, faults)
}

/// Each mistake is detected by the rules that docs/rules.md names, or allowed by the sentence that
/// it quotes.
#[test]
#[ignore = "slow: every mistake under every rule"]
fn mistakes_are_broken_or_allowed() {
    let (lines, faults) = table();
    let page = include_str!("../../../docs/rules.md");
    let (_, section) = page.split_once("\n## Mistakes\n").expect("the section of the table");
    let documented: Vec<_> = section
        .lines()
        .skip_while(|line| !line.starts_with("| ---"))
        .skip(1)
        .take_while(|line| line.starts_with("| "))
        .collect();
    assert!(faults.is_empty(), "{}\n{}", lines.join("\n"), faults.join("\n"));
    assert_eq!(documented, lines, "the table should be:\n{}", lines.join("\n"));
}

/// Vulkan's column is valid for OpenGL too.
#[test]
fn opengl_has_the_rules_of_vulkan() {
    let rows = |standard| Checker::new(standard).report().rows;
    let rules = |standard| rows(standard).iter().map(|row| row.rule).collect::<Vec<_>>();
    assert_eq!(rules(VULKAN), rules(Specification::OpenGl));
    let answers: Vec<_> = population().take(3000).map(model).collect();
    let broken = |standard| {
        let report = judge(standard, answers.iter().cloned());
        report.rows.iter().map(|row| (row.judged, row.broken)).collect::<Vec<_>>()
    };
    assert_eq!(broken(VULKAN), broken(Specification::OpenGl), "the same verdicts");
}
