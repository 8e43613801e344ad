//! Patches to test with.

use tess_core::{Domain, PatchFactors};
use tess_verify::generate::{SplitMix64, random_patch};

/// Random patches, including boundary values, culled and degenerate ones.
pub(crate) fn random(domain: Domain, count: u32, random: &mut SplitMix64) -> Vec<PatchFactors> {
    (0..count).map(|_| random_patch(domain, random)).collect()
}
