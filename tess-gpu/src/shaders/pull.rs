//! WGSL for shaders that compute points and primitives where they need them.

use super::files;
use crate::setup::Setup;

/// WGSL to put in front of your own shader. It computes any point or primitive of a patch from its
/// number, in constant time, so that nothing needs to be written out for drawing.
///
/// Run a batch with room for nothing first, of one portion: it leaves topologies and contexts. The WGSL
/// declares `topologies`, `tables` and, unless [`Setup::has_integer_factors`], `contexts` as read-only
/// storage buffers and `job` as a uniform buffer with the batch's first [`crate::layout::Job`], which says where the
/// contexts of each factor begin. Any of them may be bound in a larger buffer. It offers these functions:
/// - `tess_point(patch_index, i) -> vec2<u32>`: u and v of point `i` as 16.16 numbers,
/// - `tess_location(patch_index, i) -> vec2<f32>`: the same as binary32, exactly,
/// - `tess_primitive(patch_index, t) -> vec3<u32>`: the indices of primitive `t`, which count from the
///   patch's first point; as many of the three as a primitive has.
///
/// [`Pull::source_for_drawing`] also finds the patch of a vertex that is drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Pull {
    /// Bind group of the buffers.
    pub group: u32,
    /// Binding of `topologies`; `tables`, `contexts` and `job` have the next three numbers.
    pub first_binding: u32,
}

impl Pull {
    /// The WGSL.
    #[must_use]
    pub fn source(self, setup: Setup) -> String {
        let job = if setup.has_integer_factors() { String::new() } else { self.job() };
        self.begin(setup) + &job + &Self::files(setup, &["stages/locate"])
    }

    /// The same for the vertex shader of a batch that does not write everything
    /// ([`crate::Plan::writing`]).
    ///
    /// The WGSL declares `job` in every setup, and the storage buffers `offsets` and `tiles`: bindings
    /// `first_binding` + 4 and 5. It also offers
    /// - `tess_point_at(i) -> vec2<u32>`: the patch of point `i` of the batch, and the point's number
    ///   within the patch,
    /// - `tess_primitive_at(t) -> vec2<u32>`: the same for primitive `t` of the batch.
    #[must_use]
    pub fn source_for_drawing(self, setup: Setup) -> String {
        self.begin(setup)
            + &self.job()
            + &self.declared(4, "offsets", "vec2<u32>")
            + &self.declared(5, "tiles", "u32")
            + &Self::files(setup, &["stages/locate", "offered/elements"])
    }

    /// These files and what they need.
    fn files(setup: Setup, files: &[&'static str]) -> String {
        files::joined(files, &files::placing(setup, "variants/stored_contexts"))
    }

    /// The declaration of the job.
    fn job(self) -> String {
        let (group, binding) = (self.group, self.first_binding + 3);
        format!("@group({group}) @binding({binding}) var<uniform> job: Job;\n")
    }

    /// The constants, and the buffers that both forms read.
    fn begin(self, setup: Setup) -> String {
        let mut source = setup.prelude()
            + &self.declared(0, "topologies", "vec2<u32>")
            + &self.declared(1, "tables", "u32");
        if !setup.has_integer_factors() {
            source += &self.declared(2, "contexts", "vec2<u32>");
        }
        source
    }

    /// The declaration of a buffer.
    fn declared(self, offset: u32, name: &str, of: &str) -> String {
        let (group, binding) = (self.group, self.first_binding + offset);
        format!("@group({group}) @binding({binding}) var<storage, read> {name}: array<{of}>;\n")
    }
}
