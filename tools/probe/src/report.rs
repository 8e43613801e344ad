//! The report of a probe. docs/probe.md explains each entry of its JSON.

use crate::capture::Captured;
use crate::digests::Digests;
use crate::info::Info;
use crate::verdict::PatchVerdict;
use serde::Serialize;
use std::collections::BTreeMap;
use std::fmt;
use tess_verify::Case;

/// The result of a probe.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct ProbeReport {
    /// The device.
    pub device: Info,
    /// The captured elements: `primitives`, or only `points`.
    pub method: &'static str,
    /// The number of compared patches.
    pub patches: u64,
    /// The number of patches that differ at the requested strength and are not known to.
    pub different: u64,
    /// The number of patches that differ and are known to.
    pub known: u64,
    /// The number of different patches by the stage that they point to.
    pub stages: BTreeMap<String, u64>,
    /// The first different patch.
    pub first_different: Option<First>,
    /// Whether that patch is right when it is repeated by itself.
    pub passes_alone: bool,
    /// The number of odd patches: those that are not the model's in any order.
    pub odd: u64,
    /// The freedoms that explain some of the odd patches, and the mistakes that explain all of
    /// them.
    pub explanations: Vec<ExplainedBy>,
    /// The odd patches that no freedom of the specification explains.
    pub unexplained: Unexplained,
    /// One row per configuration.
    pub rows: Vec<ProbeRow>,
}

/// A way that explains odd patches.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct ExplainedBy {
    /// The name of the freedoms, or the family of the mistake.
    pub way: String,
    /// The device's behaviour.
    pub words: String,
    /// Whether the specification leaves this to a device.
    pub is_allowed: bool,
    /// The number of odd patches that it explains.
    pub patches: u64,
    /// Whether these are all odd patches.
    pub is_all: bool,
}

/// The differences that no freedom explains.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct Unexplained {
    /// The number of patches.
    pub patches: u64,
    /// The first of these patches.
    pub first: Option<First>,
}

/// A full description of one difference.
#[derive(Clone, Debug, Serialize)]
#[non_exhaustive]
pub struct First {
    /// The case as a line.
    pub line: String,
    /// The command that shows the model's output.
    pub command: String,
    /// The first difference, in any order.
    pub difference: String,
    /// The stage that it points to.
    pub stage: String,
    /// The case.
    #[serde(skip)]
    pub case: Case,
    /// The device's output.
    #[serde(skip)]
    pub captured: Captured,
}

/// The comparison of one configuration's patches with the model.
#[derive(Clone, Debug, Default, PartialEq, Eq, Serialize)]
#[non_exhaustive]
pub struct ProbeRow {
    /// The domain.
    pub domain: &'static str,
    /// The partitioning.
    pub partitioning: &'static str,
    /// The output primitive.
    pub output: &'static str,
    /// The number of patches.
    pub patches: u64,
    /// The number of patches that differ at the requested strength and are not known to.
    pub different: u64,
    /// Patches with the model's primitives in the model's order.
    pub sequence: u64,
    /// Patches that differ from these only in leading vertices.
    pub leading: u64,
    /// Patches with the model's primitives in another order.
    pub order: u64,
    /// Patches with the model's points but other primitives.
    pub connectivity: u64,
    /// Patches with other points.
    pub coordinates: u64,
    /// The largest difference of a coordinate, in units of 2^-16.
    pub max_units: u32,
    /// Patches that only the model or only the device culls.
    pub culling: u64,
    /// Patches with wrong third coordinates.
    pub third: u64,
    /// The digest of all patches in the device's order.
    pub sequence_digest: String,
    /// The digest that does not depend on the order.
    pub set_digest: String,
    /// The case line and the difference of the first different patch.
    #[serde(skip)]
    pub first: Option<(String, String)>,
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

/// A column of numbers: its heading, width and number.
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

/// The table for people, followed by the explanations of the differences.
impl fmt::Display for ProbeReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "device {}", self.device)?;
        if self.method == "points" {
            writeln!(f, "only domain points: the device does not capture primitives")?;
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
    /// Adds the report on the first different case, repeated by itself.
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
            let (count, words) = (one.patches, &one.words);
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
