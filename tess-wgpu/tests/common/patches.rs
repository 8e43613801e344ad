//! Patches to test with.

use tess_check::generate::{patch_of, random_factor};
use tess_check::random::SplitMix64;
use tess_core::{Domain, PatchFactors};

/// Random patches, boundary values, culled and degenerate ones included.
pub(crate) fn random(domain: Domain, count: u32, random: &mut SplitMix64) -> Vec<PatchFactors> {
    (0..count).map(|_| patch_of(domain, |_| random_factor(random))).collect()
}
