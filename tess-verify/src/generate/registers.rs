//! Patches in whose factors each class of value is left behind, before a patch of each domain.
//!
//! A device may keep factors in registers. A patch of few factors does not write all of them, so a
//! value of the patch before may cull it or count as a level of it.

use crate::case::Case;
use tess_core::{Config, Domain, PatchFactors};

/// A value of each class that is treated differently, and the largest numbers of segments.
pub(super) const LEFT_BEHIND: [f32; 14] = [
    f32::NAN,
    f32::NEG_INFINITY,
    -1.0,
    -0.0,
    0.0,
    f32::from_bits(1),
    0.5,
    1.0,
    2.5,
    63.0,
    64.0,
    100.0,
    f32::MAX,
    f32::INFINITY,
];

/// Small levels, all different.
const SMALL: [f32; 6] = [3.0, 2.5, 4.0, 1.5, 3.5, 2.0];

/// Each class of value in each position of each domain, followed by an ordinary patch of each
/// domain.
pub(super) fn registers(
    domains: &[Domain],
    config: impl Fn(Domain) -> Config,
    cases: &mut Vec<Case>,
) {
    let ordinary = |domain: Domain| Case {
        config: config(domain),
        factors: PatchFactors::from_fn(domain, |position| SMALL[position]),
    };
    for &domain in domains {
        for position in 0..domain.factors() {
            for value in LEFT_BEHIND {
                let left = ordinary(domain).with_factor(position, value);
                cases.extend(domains.iter().flat_map(|&next| [left, ordinary(next)]));
            }
        }
    }
}
