//! Tests of the stage for SDL's GPU interface.

use super::stage::{Asked, Stage};
use super::tests::decorated;
use super::translation::{Checks, Layout, Target, Translation};
use crate::failure::Failure;
use std::fs;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_gpu::Setup;

const USER: &str = "
    @group(0) @binding(3) var<uniform> eye: vec4f;
    @group(0) @binding(1) var<storage, read> heights: array<f32>;
    @group(1) @binding(0) var map: texture_2d<f32>;
    @group(1) @binding(1) var smooth_sampler: sampler;
    struct Vertex { @builtin(position) position: vec4f, @location(0) uv: vec2f }
    fn hull(number: u32) -> QuadFactors { return tess_quad_factors(eye * heights[number]); }
    fn domain(number: u32, uv: vec2f) -> Vertex {
        let factor = tess_factors(number).inside.x;
        return Vertex(eye * textureSampleLevel(map, smooth_sampler, uv, factor), uv);
    }
    @fragment fn shade(vertex: Vertex) -> @location(0) vec4f {
        return eye + textureLoad(map, vec2i(vertex.uv), 0) * heights[0];
    }";

/// The stage of this text for SDL.
fn for_sdl(text: &str, target: Target, evaluate: bool) -> Result<Stage, Failure> {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("user.wgsl");
    fs::write(&file, text).expect("a file");
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let translation = Translation { target, layout: Layout::Sdl, checks: Checks::Full };
    let translation = Some(translation);
    let asked = Asked { file: Some(&file), evaluate, project: None, translation };
    Stage::new(Setup::new(Domain::Quad, config), &asked)
}

/// What each shader of a stage binds, as `textures/read/written/uniforms: names`.
fn programs(manifest: &serde_json::Value) -> Vec<String> {
    let list = |name: &str| manifest[name].as_array().cloned().unwrap_or_default();
    let passes = list("before_batch").into_iter().chain(list("after_batch"));
    let passes = passes.chain([manifest["vertex"].clone()]).map(|it| it["program"].clone());
    let text = |one: serde_json::Value| {
        let counts = ["textures", "read_only", "read_write", "uniforms"];
        let counts = counts.map(|kind| one[kind].to_string()).join("/");
        let bound = one["bound"].as_array().cloned().unwrap_or_default();
        let name = |it: &serde_json::Value| {
            let user = it["user"].as_str().map(|name| format!("own {name}"));
            user.or(it["buffer"].as_str().map(str::to_owned)).unwrap_or_default()
        };
        let bound: Vec<_> = bound.iter().map(name).collect();
        format!("{} {counts}: {}", one["entry_point"].as_str().unwrap_or("?"), bound.join(", "))
    };
    passes.chain(list("fragments")).map(text).collect()
}

/// Every shader has its resources in SDL's order and sets, and no others.
#[test]
fn sdl_has_what_each_shader_binds() {
    let stage = for_sdl(USER, Target::Spirv, false).expect("it is sound");
    let manifest = serde_json::to_value(&stage.manifest).expect("JSON");
    assert_eq!(
        programs(&manifest),
        [
            "tess_hull 0/2/1/1: own heights, patch_count, factors, own eye",
            "count_whole 0/1/2/0: terms, factors, fit",
            "decide 0/1/2/0: terms, fit, fit_arguments",
            "count_coarse 0/1/2/0: terms, factors, fit",
            "count_fine 0/1/2/0: terms, factors, fit",
            "scale_factors 0/1/2/0: terms, factors, fit",
            "tess_vertex 1/1/0/1: own map, factors, own eye",
            "shade 1/1/0/1: own map, own heights, own eye",
        ]
    );
    let users = manifest["users"].to_string();
    assert!(users.contains(r#"{"bytes":16,"kind":"uniform","name":"eye"}"#), "{users}");
    let bound = |name: &str| {
        let file = stage.files.iter().find(|(file, _)| file == name).expect(name);
        decorated(&file.1)
    };
    assert_eq!(bound("stage_hull.spv"), [(0, 0), (0, 1), (1, 0), (2, 0)]);
    // The texture and its sampler are one binding of SDL.
    assert_eq!(bound("stage_vertex.spv"), [(0, 0), (0, 0), (0, 1), (1, 0)]);
    assert_eq!(bound("stage_fragment_shade.spv"), [(2, 0), (2, 1), (3, 0)]);
    let evaluated = for_sdl(USER, Target::Spirv, true).expect("it is sound");
    let evaluated = programs(&serde_json::to_value(&evaluated.manifest).expect("JSON"));
    let expected =
        "tess_evaluate 1/4/1/1: own map, points, status, window, factors, vertices, own eye";
    assert_eq!(evaluated[6], expected);
}

/// What Metal and HLSL lack, the host passes in one more uniform buffer.
#[test]
fn other_languages_have_an_extra_buffer() {
    let text = USER.replace("textureSampleLevel(map, smooth_sampler, uv, factor)", "vec4f(factor)");
    for (target, extra, at) in [
        (Target::Msl, "sizes", "_buffer_sizes [[buffer(1)]]"),
        (Target::Hlsl, "workgroups", "_NagaConstants: register(b1, space2)"),
    ] {
        let stage = for_sdl(&text, target, false).expect("it is sound");
        let hull = &stage.manifest.before_batch[0].program;
        let hull = serde_json::to_value(hull).expect("JSON");
        assert_eq!((&hull["extra"], &hull["uniforms"]), (&extra.into(), &2.into()));
        let written = String::from_utf8_lossy(&stage.files[0].1);
        assert!(written.contains(at), "{target:?}: {written}");
    }
}

#[test]
fn what_sdl_does_not_bind_is_refused() {
    let two = "\n@group(1) @binding(2) var more: texture_2d<f32>;\n\
               @fragment fn both(vertex: Vertex) -> @location(0) vec4f {\n\
               return textureSample(map, smooth_sampler, vertex.uv)\n\
               + textureSample(more, smooth_sampler, vertex.uv); }";
    let written = USER.replace("var<storage, read> heights", "var<storage, read_write> heights");
    let large = USER
        .replace("eye: vec4f", "eye: array<vec4f, 512>")
        .replace("(eye * ", "(eye[0] * ")
        .replace("return eye +", "return eye[0] +");
    for (text, target, says) in [
        (USER.to_owned() + two, Target::Spirv, "`smooth_sampler` samples more than one"),
        (USER.to_owned(), Target::Hlsl, "samplers have no words in HLSL"),
        (large, Target::Spirv, "at most 4096 bytes: `eye` has 8192"),
        (written, Target::Spirv, "only compute shaders write buffers"),
    ] {
        let error = for_sdl(&text, target, false).expect_err(says);
        assert!(format!("{error:?}").contains(says), "{error:?}");
    }
}
