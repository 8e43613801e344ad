//! WGSL for shaders that ask how much output factors give.

use super::files;
use crate::setup::Setup;

/// WGSL to put in front of your own shader. It counts the output of a patch from its raw factors,
/// exactly as a batch does.
///
/// It offers `tess_counts(raw: vec4<u32>, raw_inside: vec2<u32>) -> vec2<u32>`, points and
/// primitives of a patch from the bits of its factors in the specification's order (section 1):
/// four, then two. A domain with fewer factors ignores the others. It declares `tables`, a
/// read-only storage buffer that this function does not read, so a pipeline that only counts need
/// not bind it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Counting {
    /// Bind group of `tables`.
    pub group: u32,
    /// Binding of `tables`.
    pub binding: u32,
}

impl Counting {
    /// The WGSL.
    #[must_use]
    pub fn source(self, setup: Setup) -> String {
        let Self { group, binding } = self;
        let tables = "var<storage, read> tables: array<u32>;";
        setup.prelude()
            + &format!("@group({group}) @binding({binding}) {tables}\n")
            + &files::joined(&["offered/counting"], &files::placing(setup, "variants/no_contexts"))
    }
}
