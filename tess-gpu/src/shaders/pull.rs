//! WGSL for shaders that compute points and primitives where they need them.

use super::files;
use crate::setup::Setup;

/// WGSL to put in front of your own shader. It computes any point or primitive of a patch from its
/// number, in constant time, so that nothing needs to be written out for drawing.
///
/// Run a batch with room for nothing first, of one chunk: it leaves topologies and contexts. The WGSL
/// declares `topologies`, `tables` and, unless [`Setup::has_integer_factors`], `contexts` as read-only
/// storage buffers, and offers these functions:
/// - `tess_point(patch_index, i) -> vec2<u32>`: u and v of point `i` as 16.16 numbers,
/// - `tess_location(patch_index, i) -> vec2<f32>`: the same as binary32, exactly,
/// - `tess_primitive(patch_index, t) -> vec3<u32>`: the indices of primitive `t`, which count from the
///   patch's first point; as many of the three as a primitive has.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Pull {
    /// Bind group of the buffers.
    pub group: u32,
    /// Binding of `topologies`; `tables` and `contexts` have the next two numbers.
    pub first_binding: u32,
}

impl Pull {
    /// The WGSL.
    #[must_use]
    pub fn source(self, setup: Setup) -> String {
        let declare = |offset: u32, name: &str, of: &str| {
            let (group, binding) = (self.group, self.first_binding + offset);
            format!("@group({group}) @binding({binding}) var<storage, read> {name}: array<{of}>;\n")
        };
        let mut source =
            setup.prelude() + &declare(0, "topologies", "vec2<u32>") + &declare(1, "tables", "u32");
        if !setup.has_integer_factors() {
            source += &declare(2, "contexts", "vec2<u32>");
        }
        source + &files::joined("locate", &files::placing(setup, "pulled_contexts"))
    }
}
