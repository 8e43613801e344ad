//! For hosts that join the parts of a stage when they run: what the vertex shaders bind that
//! compute the points, and the pass that makes a draw for each group of patches.

use super::stage_manifest::{Bound, Pass, Workgroups};
use tess_gpu::{Access, Pull, Resource, Setup, Stage};

/// What the vertex shaders of `ShaderParts::vertex_pulled` bind.
pub(super) fn pulled(setup: Setup) -> Vec<Bound> {
    let bound = |(binding, resource)| bound(binding, resource, false);
    Pull { group: 0, first_binding: 0 }.bindings(setup).map(bound).collect()
}

/// The pass that writes the draws of the groups, after the batch, and its text.
pub(super) fn groups(setup: Setup) -> (Pass, String) {
    let stage = Stage::Groups;
    let bindings = (0..).zip(stage.bindings());
    let bindings = bindings.map(|(at, one)| bound(at, one.0, one.1 == Access::ReadWrite));
    let pass = Pass {
        entry_point: stage.entry_point().to_owned(),
        file: None,
        part: "groups",
        workgroups: Workgroups::Groups,
        bindings: bindings.collect(),
        program: None,
    };
    (pass, stage.source(stage.relevant(setup)))
}

fn bound(binding: u32, resource: Resource, is_written: bool) -> Bound {
    let buffer = match resource {
        Resource::Job => "job",
        Resource::Topologies => "topologies",
        Resource::Tables => "tables",
        Resource::Contexts => "contexts",
        Resource::Offsets => "offsets",
        Resource::Tiles => "tiles",
        Resource::Status => "status",
        Resource::Groups => "groups",
        _ => "draws",
    };
    Bound { group: 0, binding, is_written, buffer }
}

#[cfg(test)]
mod tests {
    use super::super::stage_modules::Read;
    use super::*;
    use tess_core::{Domain, OutputPrimitive, Partitioning};
    use tess_gpu::sizes::WORKGROUP;
    use tess_wgpu::stage::ShaderParts;

    /// A module is valid whatever names the user's text has, and binds what the list says.
    #[test]
    fn parts_join_to_valid_modules() {
        const USER: &str = "struct Vertex { @builtin(position) position: vec4<f32> }\n\
            const ONE = 1.0; fn place() {} fn corner() {} struct Job { a: u32 }\n\
            fn domain(number: u32, uv: vec2<f32>) -> Vertex { return Vertex(vec4<f32>(uv, 0.0, ONE)); }\n";
        for domain in Domain::ALL {
            for partitioning in Partitioning::ALL {
                let config = tess_core::Config::new(partitioning, OutputPrimitive::TriangleCw);
                let setup = Setup::new(domain, config);
                let ShaderParts { shared, vertex_pulled, .. } = ShaderParts::new(setup);
                for part in vertex_pulled {
                    let words = [(" BUILTINS", ""), ("BEGIN", ""), ("PROJECT", ""), ("GROUP", "2")];
                    let own = words.iter().fold(part, |text, (word, by)| text.replace(word, by));
                    let text = format!("{USER}\n{shared}\n{own}");
                    let read = Read::new(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
                    let all = read.module.global_variables.iter();
                    let mut bound: Vec<_> = all.filter_map(|(_, one)| one.binding).collect();
                    bound.sort_by_key(|one| one.binding);
                    let numbers: Vec<_> =
                        bound.iter().map(|one| (one.group, one.binding)).collect();
                    let listed = pulled(setup);
                    let listed: Vec<_> = listed.iter().map(|one| (2, one.binding)).collect();
                    assert_eq!(numbers, listed, "{domain:?}, {partitioning:?}");
                }
                let (pass, text) = groups(setup);
                let read = Read::new(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
                let size = read.module.entry_points[0].workgroup_size;
                assert_eq!((size, WORKGROUP), ([64, 1, 1], 64), "the manifest's workgroup_size");
                let said: Vec<_> = pass.bindings.iter().map(|one| one.buffer).collect();
                assert_eq!(said, ["job", "offsets", "status", "groups", "draws"]);
            }
        }
    }
}
