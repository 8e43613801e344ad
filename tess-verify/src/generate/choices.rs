//! The values that a selection leaves open, and the configurations made of them.

use super::configurations_among;
use crate::case::Case;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors, SplitOrder};

/// The selected values of each part of a configuration: one value or all, in the order of the
/// specification. No list is empty.
#[derive(Clone, Debug)]
pub(super) struct Choices {
    pub(super) domains: Vec<Domain>,
    pub(super) partitionings: Vec<Partitioning>,
    pub(super) outputs: Vec<OutputPrimitive>,
    pub(super) splits: Vec<SplitOrder>,
}

impl Choices {
    /// All values.
    pub(super) fn all() -> Self {
        Self {
            domains: Domain::ALL.to_vec(),
            partitionings: Partitioning::ALL.to_vec(),
            outputs: OutputPrimitive::ALL.to_vec(),
            splits: SplitOrder::ALL.to_vec(),
        }
    }

    /// Every domain with every partitioning.
    pub(super) fn combinations(&self) -> impl Iterator<Item = (Domain, Partitioning)> {
        let of = |&domain: &Domain| self.partitionings.iter().map(move |&p| (domain, p));
        self.domains.iter().flat_map(of)
    }

    /// Every domain with every configuration.
    pub(super) fn configurations(&self) -> impl Iterator<Item = (Domain, Config)> {
        configurations_among(&self.domains, &self.partitionings, &self.outputs, &self.splits)
    }

    /// A configuration that varies with `turn`: three of five have triangles, and the split order
    /// changes every four turns.
    pub(super) fn config(&self, partitioning: Partitioning, turn: usize) -> Config {
        let output = match turn % 5 {
            0 | 3 => OutputPrimitive::TriangleCw,
            1 => OutputPrimitive::TriangleCcw,
            2 => OutputPrimitive::Line,
            _ => OutputPrimitive::Point,
        };
        let output = if self.outputs.contains(&output) { output } else { self.outputs[0] };
        Config { partitioning, output, split: self.splits[(turn / 4) % self.splits.len()] }
    }

    /// A configuration whose output shows a patch's inside: clockwise triangles, if they are
    /// selected.
    pub(super) fn surface_config(&self, partitioning: Partitioning, split: SplitOrder) -> Config {
        let triangles = OutputPrimitive::TriangleCw;
        let output = if self.outputs.contains(&triangles) { triangles } else { self.outputs[0] };
        Config { partitioning, output, split }
    }

    /// The configuration of each domain for patches that leave values behind: with fractional odd
    /// spacing, if it is selected, and with an output that the domain has.
    pub(super) fn registers(&self, split: SplitOrder) -> impl Fn(Domain) -> Config {
        let partitioning = self.partitioning(&[Partitioning::FractionalOdd]);
        let (config, has_lines) = (
            self.surface_config(partitioning, split),
            self.outputs.contains(&OutputPrimitive::Line),
        );
        move |domain| match domain {
            Domain::Isoline if has_lines => Config { output: OutputPrimitive::Line, ..config },
            _ => config,
        }
    }

    /// A patch in the configuration of [`Self::surface_config`].
    pub(super) fn surface(
        &self,
        partitioning: Partitioning,
        split: SplitOrder,
        factors: PatchFactors,
    ) -> Case {
        Case { config: self.surface_config(partitioning, split), factors }
    }

    /// The first of the `preferred` partitionings that is selected; if none is, the first selected
    /// one.
    pub(super) fn partitioning(&self, preferred: &[Partitioning]) -> Partitioning {
        let found = preferred.iter().find(|one| self.partitionings.contains(one));
        found.copied().unwrap_or(self.partitionings[0])
    }

    /// The partitionings, without `pow2` if `integer` is selected too: a tessellator treats both
    /// the same.
    pub(super) fn distinct_partitionings(&self) -> impl Iterator<Item = Partitioning> {
        let has_integer = self.partitionings.contains(&Partitioning::Integer);
        let is_distinct = move |one: &Partitioning| !(has_integer && *one == Partitioning::Pow2);
        self.partitionings.iter().copied().filter(is_distinct)
    }
}
