//! WGSL for shaders that count the output of given factors.

use super::files;
use crate::setup::Setup;

/// WGSL to prepend to your own shader. It counts the output of a patch from its raw factors,
/// exactly as a batch does.
///
/// It offers `tess_counts(raw: vec4<u32>, raw_inside: vec2<u32>) -> vec2<u32>`: the points and
/// primitives of a patch. The arguments are the bits of its factors in the specification's order
/// (section 1), four, then two; a domain with fewer factors ignores the rest. The WGSL declares
/// `tables`, a read-only storage buffer. This function does not read it, so a pipeline that only
/// counts does not have to bind it.
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
