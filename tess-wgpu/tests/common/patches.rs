//! Patches to test with.

use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors, SplitOrder};
use tess_gpu::{Numbering, Setup};
use tess_testkit::pairs::Options;
use tess_verify::generate::{SplitMix64, configurations, random_patch};

/// Setups in which every two values of domain, partitioning, output, split order and numbering
/// occur together.
pub(crate) fn covering() -> Vec<Setup> {
    let rows = Options::new(&[3, 4, 4, 2, 2], |_, _| false).rows();
    let setup = |row: Vec<usize>| {
        let config = Config {
            split: SplitOrder::ALL[row[3]],
            ..Config::new(Partitioning::ALL[row[1]], OutputPrimitive::ALL[row[2]])
        };
        let numbering = [Numbering::PerBatch, Numbering::PerPatch][row[4]];
        Setup { numbering, ..Setup::new(Domain::ALL[row[0]], config) }
    };
    rows.into_iter().map(setup).collect()
}

/// All 96 configurations, in the numbering of a batch.
pub(crate) fn all() -> Vec<Setup> {
    configurations().map(|(domain, config)| Setup::new(domain, config)).collect()
}

/// Random patches, including boundary values, culled and degenerate ones.
pub(crate) fn random(domain: Domain, count: u32, random: &mut SplitMix64) -> Vec<PatchFactors> {
    (0..count).map(|_| random_patch(domain, random)).collect()
}
