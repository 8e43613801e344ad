//! The report of a probe. docs/probe.md explains each entry of its JSON.

use crate::capture::Captured;
use crate::digests::Digests;
use crate::info::Info;
use crate::verdict::PatchVerdict;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;
use tess_verify::Case;
use tess_verify::check::Way;

/// The result of a probe.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct ProbeReport {
    /// The device.
    pub device: Info,
    /// The captured elements: `primitives`, or `points` alone.
    pub method: &'static str,
    /// Patches that were compared.
    pub patches: u64,
    /// Patches that differ in the strength that was asked for, and are not known to.
    pub different: u64,
    /// Patches that differ so, and are known to.
    pub known: u64,
    /// How many of the different ones point to each stage.
    pub stages: BTreeMap<String, u64>,
    /// The first of the different ones.
    pub first_different: Option<First>,
    /// Whether that one is right when it is asked again by itself.
    pub passes_alone: bool,
    /// Patches that are not the model's in any order.
    pub odd: u64,
    /// The freedoms that explain some of the odd ones.
    pub explanations: Vec<ExplainedBy>,
    /// Odd patches that no freedom of the specification explains.
    pub unexplained: Unexplained,
    /// A row for each configuration.
    pub rows: Vec<ProbeRow>,
}

/// Something that makes odd patches equal.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct ExplainedBy {
    /// Which.
    pub way: Way,
    /// The device's behaviour.
    pub words: &'static str,
    /// Whether the specification leaves it to a device.
    pub is_allowed: bool,
    /// Odd patches that it explains.
    pub patches: u64,
    /// Whether these are all.
    pub is_all: bool,
}

/// A difference that no freedom explains.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct Unexplained {
    /// How many patches.
    pub patches: u64,
    /// The first of them.
    pub first: Option<First>,
}

/// One difference in full.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct First {
    /// The case as a line.
    pub line: String,
    /// The command that shows what the model gives.
    pub command: String,
    /// The first difference, in any order.
    pub difference: String,
    /// The stage that it points to.
    pub stage: String,
    /// The case.
    #[serde(skip)]
    pub case: Case,
    /// The device's answer.
    #[serde(skip)]
    pub captured: Captured,
}

/// How the patches of one configuration compare with the model.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct ProbeRow {
    /// Domain.
    pub domain: &'static str,
    /// Partitioning.
    pub partitioning: &'static str,
    /// Output primitive.
    pub output: &'static str,
    /// Patches.
    pub patches: u64,
    /// Patches that differ in the strength that was asked for, and are not known to.
    pub different: u64,
    /// The model's primitives in the model's order.
    pub sequence: u64,
    /// The same with another leading vertex.
    pub leading: u64,
    /// The model's primitives in another order.
    pub order: u64,
    /// The model's points, other primitives.
    pub connectivity: u64,
    /// Other points.
    pub coordinates: u64,
    /// The most units of 2^-16 by which a coordinate differs.
    pub max_units: u32,
    /// Patches that only one of the two culls.
    pub culling: u64,
    /// Patches whose third coordinates are wrong.
    pub third: u64,
    /// Digest of all patches in the device's order.
    pub sequence_digest: String,
    /// Digest that does not depend on the order.
    pub set_digest: String,
}

impl ProbeRow {
    pub(crate) fn new(
        (domain, partitioning, output): (&'static str, &'static str, &'static str),
    ) -> Self {
        Self { domain, partitioning, output, ..Self::default() }
    }

    pub(crate) const fn names(&self) -> (&'static str, &'static str, &'static str) {
        (self.domain, self.partitioning, self.output)
    }

    pub(crate) fn add(&mut self, verdict: PatchVerdict, third_is_right: bool) {
        self.patches += 1;
        self.third += u64::from(!third_is_right);
        let count = match verdict {
            PatchVerdict::Sequence => &mut self.sequence,
            PatchVerdict::Leading => &mut self.leading,
            PatchVerdict::Order => &mut self.order,
            PatchVerdict::Connectivity => &mut self.connectivity,
            PatchVerdict::Coordinates(units) => {
                self.max_units = self.max_units.max(units);
                &mut self.coordinates
            }
            PatchVerdict::Culling => &mut self.culling,
        };
        *count += 1;
    }

    pub(crate) fn with(self, digests: &Digests) -> Self {
        Self { sequence_digest: digests.sequence(), set_digest: digests.set(), ..self }
    }
}

/// A column of numbers: head, width and number.
type Column = (&'static str, usize, fn(&ProbeRow) -> u64);

const COLUMNS: [Column; 9] = [
    ("patches", 8, |row| row.patches),
    ("in order", 8, |row| row.sequence),
    ("leading", 8, |row| row.leading),
    ("reorder", 8, |row| row.order),
    ("connected", 9, |row| row.connectivity),
    ("points", 8, |row| row.coordinates),
    ("units", 6, |row| row.max_units.into()),
    ("culling", 8, |row| row.culling),
    ("third", 6, |row| row.third),
];

/// The table for people, then what explains the differences.
impl fmt::Display for ProbeReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "device {}", self.device)?;
        if self.method == "points" {
            writeln!(f, "domain points alone: the device does not capture primitives")?;
        }
        write!(f, "{:<8} {:<15} {:<12}", "domain", "partitioning", "output")?;
        COLUMNS.iter().try_for_each(|(head, width, _)| write!(f, " {head:>width$}"))?;
        for row in &self.rows {
            let ProbeRow { domain, partitioning, output, .. } = row;
            write!(f, "\n{domain:<8} {partitioning:<15} {output:<12}")?;
            COLUMNS.iter().try_for_each(|(_, width, of)| write!(f, " {:>width$}", of(row)))?;
        }
        writeln!(f)?;
        self.write_explanations(f)
    }
}

impl ProbeReport {
    /// The same, with this report of the first different case, asked again by itself.
    #[must_use]
    pub fn with_alone(self, alone: &Self) -> Self {
        Self { passes_alone: alone.patches == 1 && alone.different == 0, ..self }
    }

    fn write_explanations(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { patches, odd, unexplained, .. } = self;
        if self.rows.iter().any(|row| row.partitioning == "pow2") {
            writeln!(f, "pow2: Vulkan has none; the factors were rounded beforehand")?;
        }
        if *odd == 0 {
            return writeln!(f, "all {patches} patches are the model's");
        }
        writeln!(f, "{odd} of {patches} patches are not the model's in any order")?;
        for one in &self.explanations {
            let all = if one.is_all { "all" } else { "some" };
            let allowed = if one.is_allowed { "allowed" } else { "not allowed" };
            let (count, words) = (one.patches, one.words);
            writeln!(f, "explains {all} ({count}), {allowed}: {words}")?;
        }
        if let Some(first) = &unexplained.first {
            let count = unexplained.patches;
            writeln!(f, "no freedom explains {count} of them; the first:")?;
            writeln!(f, "  {}\n  {}\n  {}", first.line, first.difference, first.command)?;
        }
        Ok(())
    }
}
