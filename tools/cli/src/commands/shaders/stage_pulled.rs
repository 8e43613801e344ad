//! For hosts that join the parts of a stage when they run: vertex shaders that compute the points,
//! as with `Points::Pull` and `Points::PullWithoutIndices` of `tess-wgpu`, and the pass that makes
//! a draw for each group of patches.

use super::stage_manifest::{Bound, Pass, Workgroups};
use naga::Module;
use tess_gpu::{Access, Pull, Resource, Setup, Stage};

/// As in `tess-wgpu/shaders`.
const PULLED: &str = include_str!("vertex_pulled.wgsl");
const UNINDEXED: &str = include_str!("vertex_unindexed.wgsl");

/// The bind group and the first binding that the text has before a host replaces `GROUP`.
const PULL: Pull = Pull { group: 0, first_binding: 0 };

/// The texts of the vertex shaders that follow `shared`: with an index buffer, and without one.
///
/// # Errors
/// One is not valid.
pub(super) fn vertex_parts(setup: Setup) -> Result<[String; 2], String> {
    let own = PULL.source_for_drawing(setup);
    let read = naga::front::wgsl::parse_str(&own).map_err(|error| error.emit_to_string(&own))?;
    let own = with_own_names(&own, &read).replace("@group(0)", "@group(GROUP)");
    let prefixed = |text: &str| own.clone() + &with_own_names(text, &read);
    Ok([PULLED, UNINDEXED].map(prefixed))
}

/// What the vertex shaders bind.
pub(super) fn pulled(setup: Setup) -> Vec<Bound> {
    let bound = |(binding, resource)| bound(binding, resource, false);
    PULL.bindings(setup).map(bound).collect()
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

/// The text with a prefix before each name that the module declares, so that the user's text can
/// have these names too. A member or a local variable of the same name is renamed with it.
fn with_own_names(text: &str, module: &Module) -> String {
    let named = |word: &str| {
        let is = |name: &Option<String>| name.as_deref() == Some(word);
        !word.starts_with("tess_")
            && (module.constants.iter().any(|(_, one)| is(&one.name))
                || module.global_variables.iter().any(|(_, one)| is(&one.name))
                || module.functions.iter().any(|(_, one)| is(&one.name))
                || module.types.iter().any(|(_, one)| is(&one.name)))
    };
    let is_in_word = |letter: char| letter.is_alphanumeric() || letter == '_';
    let mut renamed = String::with_capacity(text.len() * 5 / 4);
    let mut rest = text;
    while let Some(begin) = rest.find(is_in_word) {
        let (between, from_word) = rest.split_at(begin);
        let end = from_word.find(|letter| !is_in_word(letter)).unwrap_or(from_word.len());
        let (word, behind) = from_word.split_at(end);
        let prefix = if named(word) { "tess_" } else { "" };
        renamed.extend([between, prefix, word]);
        rest = behind;
    }
    renamed + rest
}

#[cfg(test)]
mod tests {
    use super::super::stage_modules::Read;
    use super::*;
    use std::fs;
    use tess_core::{Domain, OutputPrimitive, Partitioning};
    use tess_gpu::sizes::WORKGROUP;
    use tess_wgpu::stage::ShaderParts;

    #[test]
    fn vertex_shaders_are_those_of_the_stage_in_rust() {
        for (name, own) in [("vertex_pulled", PULLED), ("vertex_unindexed", UNINDEXED)] {
            let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tess-wgpu/shaders");
            let text = fs::read_to_string(format!("{folder}/{name}.wgsl")).expect(name);
            assert_eq!(text, own, "{name}");
        }
    }

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
                let shared = ShaderParts::new(domain).shared;
                for part in vertex_parts(setup).expect("it is valid") {
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
