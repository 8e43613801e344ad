//! WGSL for shaders that compute points and primitives on demand.

use super::files;
use crate::bindings::Resource;
use crate::setup::Setup;

/// WGSL to prepend to your own shader. It computes any point or primitive of a patch from its
/// number, in constant time, so that no output has to be written for drawing.
///
/// First run a batch of one portion without room for output: it makes topologies and contexts. The
/// WGSL declares `topologies` and `tables` as read-only storage buffers. Unless
/// [`Setup::has_integer_factors`], it also declares `contexts`, another one, and `job`, a uniform
/// buffer with the batch's first [`crate::layout::Job`], which has the place of each factor's
/// contexts. Any of them may be bound as a part of a larger buffer. The WGSL offers these
/// functions:
/// - `tess_point(patch_index, i) -> vec2<u32>`: u and v of point `i` as 16.16 numbers,
/// - `tess_location(patch_index, i) -> vec2<f32>`: the same as binary32, exactly,
/// - `tess_primitive(patch_index, t) -> vec3<u32>`: the indices of primitive `t`, counted from the
///   patch's first point; only as many of the three are used as a primitive has.
///
/// [`Pull::source_for_drawing`] also finds the patch of a drawn vertex.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Pull {
    /// Bind group of the buffers.
    pub group: u32,
    /// Binding of `topologies`. The other bindings follow it: [`Pull::bindings`].
    pub first_binding: u32,
}

impl Pull {
    /// The buffers in order of their bindings.
    const RESOURCES: [Resource; 6] = [
        Resource::Topologies,
        Resource::Tables,
        Resource::Contexts,
        Resource::Job,
        Resource::Offsets,
        Resource::Tiles,
    ];

    /// The bindings that [`Pull::source_for_drawing`] declares: their numbers and buffers.
    /// [`Pull::source`] declares the first four of these six. With [`Setup::has_integer_factors`]
    /// contexts are left out, and it declares the first two of five.
    pub fn bindings(self, setup: Setup) -> impl Iterator<Item = (u32, Resource)> {
        let all = (self.first_binding..).zip(Self::RESOURCES);
        all.filter(move |(_, what)| *what != Resource::Contexts || !setup.has_integer_factors())
    }

    /// The WGSL.
    #[must_use]
    pub fn source(self, setup: Setup) -> String {
        let declared = if setup.has_integer_factors() { 2 } else { 4 };
        self.begin(setup, declared) + &Self::files(setup, &["stages/locate"])
    }

    /// The WGSL for the vertex shader of a batch that does not write everything
    /// ([`crate::Plan::writing`]).
    ///
    /// In addition to [`Pull::source`], it declares `job` in every setup, and the storage buffers
    /// `offsets` and `tiles`. It also offers:
    /// - `tess_point_at(i) -> vec2<u32>`: the patch of point `i` of the batch, and the point's
    ///   number within the patch,
    /// - `tess_primitive_at(t) -> vec2<u32>`: the same for primitive `t` of the batch.
    #[must_use]
    pub fn source_for_drawing(self, setup: Setup) -> String {
        self.begin(setup, Self::RESOURCES.len())
            + &Self::files(setup, &["stages/locate", "offered/elements"])
    }

    /// These files and the files that they need.
    fn files(setup: Setup, files: &[&'static str]) -> String {
        files::joined(files, &files::placing(setup, "variants/stored_contexts"))
    }

    /// The constants, and the declarations of the first bindings.
    fn begin(self, setup: Setup, declared: usize) -> String {
        let bindings = self.bindings(setup).take(declared);
        setup.prelude() + &bindings.map(|binding| self.declaration(binding)).collect::<String>()
    }

    fn declaration(self, (binding, resource): (u32, Resource)) -> String {
        let (space, declared) = match resource {
            Resource::Job => ("uniform", "job: Job"),
            Resource::Topologies => ("storage, read", "topologies: array<vec2<u32>>"),
            Resource::Contexts => ("storage, read", "contexts: array<vec2<u32>>"),
            Resource::Offsets => ("storage, read", "offsets: array<vec2<u32>>"),
            Resource::Tiles => ("storage, read", "tiles: array<u32>"),
            _ => ("storage, read", "tables: array<u32>"),
        };
        format!("@group({}) @binding({binding}) var<{space}> {declared};\n", self.group)
    }
}
