//! Errors have a type, and the user's line.

use crate::both::Builder;
use crate::common::device::{device_of, limited};
use crate::common::objects;
use crate::drawing::scene;
use crate::model::compare;
use crate::scene::{PATCHES, Scene, in_pass, source};
use tess_core::{Domain, Partitioning, PatchFactors};
use tess_wgpu::stage::{Factors, PatchCount, Points, Room, StageError};
use tess_wgpu::{Error, Stopwatch, Tessellator};
use wgpu::BufferUsages as Usage;

fn quads() -> Scene {
    scene(Domain::Quad, Partitioning::Integer)
}

/// The error with which a stage of this WGSL is refused.
fn refusal(scene: &Scene, source: &str, points: Points) -> StageError {
    let built = scene.builder_of(source).points(points).build(&scene.gpu.device);
    match built {
        Err(Error::Stage(error)) => error,
        other => panic!("{other:?}"),
    }
}

/// The line and the message with which a stage refuses the valid WGSL in which `to` replaces
/// `from`.
fn complaint(scene: &Scene, [from, to]: [&str; 2], points: Points) -> (Option<u32>, String) {
    let right = source(Domain::Quad);
    let wrong = right.replace(from, to);
    assert_ne!(wrong, right, "{from}");
    match refusal(scene, &wrong, points) {
        StageError::Wgsl { line, message } => (line, message),
        other => panic!("{to}: {other:?}"),
    }
}

/// The line on which a text begins.
fn line_of(source: &str, text: &str) -> u32 {
    let before = source.split(text).next().expect("a first part");
    assert!(before.len() < source.len(), "{text} is not there");
    u32::try_from(before.matches('\n').count()).expect("few lines") + 1
}

#[test]
fn wrong_wgsl_is_reported_with_the_users_line() {
    let scene = quads();
    let right = source(Domain::Quad);
    for points in [Points::Stored, Points::PullWithoutIndices] {
        for (from, to, says) in [
            ("return Vertex(vec4<f32>(0.5", "return Vertex(vec5<f32>(0.5", "vec5"),
            ("place(number) + uv;", "place(number) + uw;", "uw"),
            ("const ONE = 1.0;", "const ONE = 1.0", "expected"),
            // It can be parsed, but is not valid: the function's body has another type.
            (
                "return vec2<f32>(f32(number % 4u), f32(number / 4u));",
                "return number;",
                "`return` expression",
            ),
        ] {
            let expected = line_of(&right, from);
            let (line, message) = complaint(&scene, [from, to], points);
            let line = line.expect("a line of the user's");
            // A missing semicolon is found at the next token. A statement of the wrong type is
            // reported with its function, which begins one line earlier.
            assert!((expected - 1..=expected + 2).contains(&line), "{line}: {message}");
            assert!(message.contains(says), "{message}");
            let text = StageError::Wgsl { line: Some(line), message }.to_string();
            assert!(text.starts_with(&format!("line {line} of your WGSL: ")), "{text}");
        }
    }
}

#[test]
fn missing_functions_are_named() {
    let scene = quads();
    for (from, to, says) in
        [("fn domain(", "fn surface(", "domain"), ("fn hull(", "fn control(", "hull")]
    {
        let (line, message) = complaint(&scene, [from, to], Points::Stored);
        assert!(line.is_none() && message.contains(says), "{line:?}: {message}");
        let text = StageError::Wgsl { line, message }.to_string();
        let demand = "`fn domain(number: u32, uv: vec2<f32>) -> Vertex`";
        assert!(text.contains(demand), "{text}");
    }
}

#[test]
fn functions_that_do_not_go_with_the_stage_are_reported_with_their_line() {
    let scene = quads();
    let right = source(Domain::Quad);
    for (function, from, to) in [
        (
            "domain",
            "fn domain(number: u32, uv: vec2<f32>)",
            "fn domain(number: u32, uv: vec3<f32>)",
        ),
        ("domain", "fn domain(number: u32, uv", "fn domain(number: f32, uv"),
        ("domain", "let at = place(number) + uv;", "let at = place(number) + dpdx(uv);"),
        ("hull", "fn hull(number: u32)", "fn hull(number: vec2<u32>)"),
        (
            "hull",
            "fn hull(number: u32) -> QuadFactors {",
            "fn hull(number: u32) -> f32 { return 1.0;",
        ),
        ("QuadFactors", "const ONE = 1.0;", "const ONE = 1.0; struct QuadFactors { a: f32 }"),
    ] {
        for points in [Points::Stored, Points::PullWithoutIndices] {
            let keyword = if function == "QuadFactors" { "struct" } else { "fn" };
            let expected = line_of(&right.replace(from, to), &format!("{keyword} {function}"));
            let (line, message) = complaint(&scene, [from, to], points);
            // The error may be in the body of `hull` instead.
            let is_there = line.is_some_and(|line| (expected..=expected + 2).contains(&line));
            assert!(is_there, "{to}: {line:?}: {message}");
        }
    }
}

#[test]
#[ignore = "slow: a stage for each mistake"]
fn functions_of_other_types_are_answered_with_the_right_line() {
    let scene = quads();
    let right = source(Domain::Quad);
    let (hull, domain) = ("fn hull(number: u32) -> QuadFactors {", "fn domain(number: u32, uv");
    let seen = "fn seen(vertex: Vertex) -> Vertex { return vertex; }";
    let right = right + seen;
    let domain_line = "write `fn domain(number: u32, uv: vec2<f32>) -> Vertex`";
    let seen_line = "write `fn seen(vertex: Vertex) -> Vertex`";
    for (from, to, own, says) in [
        (hull, "fn hull(number: u32) -> vec4f {", "`fn hull(number: u32) -> vec4f`", ""),
        (hull, "fn hull() -> QuadFactors {", "`fn hull() -> QuadFactors`", ""),
        (
            domain,
            "fn domain(n: i32, uv",
            "`fn domain(n: i32, uv: vec2<f32>) -> Vertex`",
            domain_line,
        ),
        (domain, "fn domain(uv", "`fn domain(uv: vec2<f32>) -> Vertex`", domain_line),
        (
            seen,
            "fn seen(at: vec4f) -> vec4f { return at; }",
            "`fn seen(at: vec4f) -> vec4f`",
            seen_line,
        ),
        (seen, "fn seen() -> Vertex { return Vertex(); }", "`fn seen() -> Vertex`", seen_line),
    ] {
        assert!(right.contains(from), "{from}");
        let wrong = right.replace(from, to);
        let says =
            if says.is_empty() { "write `fn hull(number: u32) -> QuadFactors`" } else { says };
        for points in [Points::Stored, Points::Evaluated] {
            let builder = scene.builder_of(&wrong).points(points).project("seen");
            let error = builder.build(&scene.gpu.device).map(drop).expect_err("other types");
            let begin = format!("line {} of your WGSL: {own} does not", line_of(&wrong, to));
            let text = error.to_string();
            assert!(text.starts_with(&begin) && text.contains(says), "{points:?}: {text}");
        }
    }
    let alias = right.replace(hull, "alias F = QuadFactors; alias N = u32; fn hull(n: N) -> F {");
    let alias = alias.replace("6u * number", "6u * n").replace("uv: vec2<f32>)", "uv: vec2f,)");
    assert_eq!(scene.builder_of(&alias).build(&scene.gpu.device).map(drop), Ok(()), "the same");
}

#[test]
fn derivatives_outside_of_fragment_shaders_are_named_with_what_to_use() {
    let scene = quads();
    let textures = "@group(1) @binding(0) var image: texture_2d<f32>;
@group(1) @binding(1) var linear: sampler;
@group(1) @binding(2) var shadows: texture_depth_2d;
@group(1) @binding(3) var nearer: sampler_comparison;
";
    let right = textures.to_owned() + &source(Domain::Quad);
    let sum = "let at = place(number) + uv;";
    for (used, instead) in [
        ("textureSample(image, linear, uv).x", "`textureSampleLevel`"),
        ("textureSampleCompare(shadows, nearer, uv, 0.5)", "`textureSampleCompareLevel`"),
        ("fwidth(uv.x)", "compute the difference"),
    ] {
        for points in [Points::Stored, Points::Evaluated] {
            let wrong = right.replace(sum, &format!("{sum} let sampled = {used};"));
            let StageError::Wgsl { line, message } = refusal(&scene, &wrong, points) else {
                panic!("of the WGSL");
            };
            assert_eq!(line, Some(line_of(&right, "fn domain")), "{message}");
            assert!(
                message.contains("needs derivatives") && message.contains(instead),
                "{message}"
            );
        }
    }
}

/// Four of the stage's storage buffers and five of the user's are more than eight.
#[test]
#[ignore = "slow: many pipelines"]
fn a_storage_buffer_too_many_is_counted_for_the_user() {
    use crate::common::objects::{group, layout, storage, whole};
    use wgpu::ShaderStages;
    let scene = quads();
    let device = &scene.gpu.device;
    let visibility = ShaderStages::COMPUTE | ShaderStages::VERTEX;
    let build = |count: usize, points| {
        let of_all = layout(device, visibility, vec![storage(true); count]);
        let bound = group(device, &of_all, whole(vec![&scene.factors; count]));
        let text = source(Domain::Quad);
        let builder = Builder::new(&text, scene.domain, scene.config, PATCHES);
        let builder = builder.bind_group(&of_all, &bound).target(crate::scene::FORMAT);
        builder.points(points).build(device).map(drop)
    };
    for (points, function, most, own) in [
        (Points::Evaluated, "domain", 4, 4),
        (Points::Stored, "hull", 6, 2),
        // With integer factors no contexts are bound.
        (Points::Pull, "domain", 4, 4),
    ] {
        let too_many = |got| StageError::TooManyStorageBuffers { function, got, most, own };
        assert_eq!(build(most as usize, points), Ok(()), "{points:?}: as many as there may be");
        let error = build(most as usize + 1, points).expect_err("one more");
        assert_eq!(error, too_many(most + 1).into(), "{points:?}");
        assert!(error.to_string().contains("put several arrays into one buffer"), "{error}");
    }
}

#[test]
fn the_factors_of_another_domain_are_named() {
    for (own, other, function) in [
        (Domain::Quad, Domain::Triangle, "QuadFactors"),
        (Domain::Triangle, Domain::Quad, "TriFactors"),
        (Domain::Quad, Domain::Isoline, "QuadFactors"),
    ] {
        let scene = scene(own, Partitioning::Integer);
        let text = source(other);
        let StageError::Wgsl { line, message } = refusal(&scene, &text, Points::Stored) else {
            panic!("of the WGSL");
        };
        assert_eq!(line, Some(line_of(&text, "fn hull")), "{message}");
        let says = format!("made for Domain::{own:?}: return `{function}`");
        assert!(message.contains(&says), "{message}");
    }
}

/// Layouts that do not match the WGSL: the error has the binding's name, its line and the right
/// entry.
#[test]
#[ignore = "slow: many pipelines"]
fn bindings_that_do_not_go_with_their_layout_are_named() {
    use crate::common::objects::{buffer, group, layout, storage, whole};
    use wgpu::{BindingType, BufferBindingType, ShaderStages};
    let scene = quads();
    let device = &scene.gpu.device;
    let right = source(Domain::Quad);
    let in_domain = right
        .replace("let at = place(number) + uv;", "let at = place(number) + uv + 0.0 * given[0];");
    let small = BindingType::Buffer {
        ty: BufferBindingType::Uniform,
        has_dynamic_offset: false,
        min_binding_size: std::num::NonZeroU64::new(4),
    };
    let uniform = "\n@group(0) @binding(0) var<uniform> given: mat4x4f;\n\
        struct Vertex { @builtin(position) position: vec4f }\n\
        fn hull(number: u32) -> QuadFactors { return tess_quad_factors(given[number % 4u]); }\n\
        fn domain(number: u32, uv: vec2f) -> Vertex { return Vertex(vec4f(uv, 0.0, 1.0)); }\n\
        @fragment fn identify() -> @location(0) vec4<u32> { return vec4<u32>(); }"
        .to_owned();
    for (text, points, visibility, entry, says) in [
        (&right, Points::Stored, ShaderStages::VERTEX, storage(true), "ShaderStages::COMPUTE"),
        (&in_domain, Points::Evaluated, ShaderStages::COMPUTE, storage(true), ""),
        (&in_domain, Points::Stored, ShaderStages::COMPUTE, storage(true), "ShaderStages::VERTEX"),
        (
            &right,
            Points::Stored,
            ShaderStages::COMPUTE,
            buffer(BufferBindingType::Uniform),
            "let entry 0 have its type (",
        ),
        (&uniform, Points::Stored, ShaderStages::COMPUTE, small, "min_binding_size"),
    ] {
        let of_one = layout(device, visibility, [entry]);
        let usage = Usage::STORAGE | Usage::UNIFORM;
        let given = scene.gpu.buffer("given", 256, usage).expect("there is room");
        let bound = group(device, &of_one, whole([&given]));
        let built = Builder::new(text, scene.domain, scene.config, PATCHES)
            .bind_group(&of_one, &bound)
            .points(points)
            .target(crate::scene::FORMAT)
            .build(device);
        match built.err() {
            None => assert_eq!(says, "", "{visibility:?}"),
            Some(Error::Stage(StageError::Wgsl { line, message })) => {
                assert_eq!(line, Some(line_of(text, "@group(0)")), "{message}");
                assert!(message.starts_with("`given` does not go with the layout"), "{message}");
                assert!(!says.is_empty() && message.contains(says), "{message}");
            }
            Some(other) => panic!("{other}"),
        }
    }
}

#[test]
#[ignore = "slow: a stage for each name"]
fn names_of_wgsls_own_are_refused_where_the_stage_uses_them() {
    let scene = quads();
    let right = source(Domain::Quad);
    for declaration in [
        "fn distance(a: vec3<f32>, b: vec3<f32>) -> f32 { return 1.0; }",
        "fn min(a: f32, b: f32) -> f32 { return a; }",
        "fn round(a: f32) -> f32 { return a; }",
        "fn clamp(a: f32) -> f32 { return a; }",
        "const dot = 1.0;",
        "var<private> select: f32;",
        "alias f32 = u32;",
        "struct vec4 { a: u32 }",
    ] {
        let to = format!("const ONE = 1.0;\n\n{declaration}");
        let change = ["const ONE = 1.0;", &to];
        let (line, message) = complaint(&scene, change, Points::PullWithoutIndices);
        let expected = line_of(&right.replace(change[0], &to), declaration);
        assert_eq!(line, Some(expected), "{message}");
        assert!(message.contains("built-in name of WGSL"), "{message}");
    }
    for declaration in ["fn pow(a: f32) -> f32 { return a; }", "fn at() {}", "const thread = 1;"] {
        let allowed = right.clone() + declaration;
        let built = scene.builder_of(&allowed).build(&scene.gpu.device);
        assert_eq!(built.err(), None, "{declaration}: the stage does not use it");
    }
}

#[test]
#[ignore = "slow: many pipelines"]
fn an_unclear_fragment_shader_is_refused() {
    let scene = quads();
    let right = source(Domain::Quad);
    let two =
        right.clone() + "@fragment fn other() -> @location(0) vec4<u32> { return vec4<u32>(1u); }";
    let none =
        right.replace("@fragment", "@must_use").replace("@location(0) vec4<u32> {", "vec4<u32> {");
    let build = |source: &str, chosen: Option<&str>| {
        let builder = scene.builder_of(source);
        let builder = match chosen {
            Some(name) => builder.fragment(name).build(&scene.gpu.device),
            None => builder.build(&scene.gpu.device),
        };
        builder.err()
    };
    let unclear = |asked: Option<&str>, found: &[&str]| {
        let asked = asked.map(str::to_owned);
        let found = found.iter().map(|&name| name.to_owned()).collect();
        Some(Error::from(StageError::UnclearFragment { asked, found }))
    };
    assert_eq!(build(&two, None), unclear(None, &["identify", "other"]), "which of them?");
    assert_eq!(build(&two, Some("other")), None, "this one");
    assert_eq!(build(&two, Some("third")), unclear(Some("third"), &["identify", "other"]), "no");
    assert_eq!(build(&none, None), unclear(None, &[]), "there is none");
    for (asked, found, says) in [
        (None, &[][..], "no function with the attribute @fragment"),
        (None, &["a", "b"], "choose one of a, b"),
        (Some("c"), &[], "no fragment shader `c`, nor any other"),
        (Some("c"), &["a", "b"], "no fragment shader `c`; it has a, b"),
    ] {
        let text = unclear(asked, found).expect("an error").to_string();
        assert!(text.contains(says), "{text}");
    }
}

#[test]
fn what_a_stage_cannot_do_is_refused() {
    let scene = quads();
    let mut stage = scene.build(scene.builder());
    let mut encoder = scene.gpu.device.create_command_encoder(&Default::default());
    let refused = stage.prepare(&mut encoder, PATCHES + 1).err();
    let too_many = StageError::TooManyPatches { got: PATCHES + 1, most: PATCHES };
    assert_eq!(refused, Some(too_many.into()), "more patches than it was made for");
    let refused = stage.set_factors(&mut encoder, &scene.patches).err();
    assert_eq!(refused, Some(StageError::NotHostFactors.into()), "it has a hull function");
    for (usage, offset) in [(Usage::STORAGE, 0), (Usage::COPY_SRC, 2), (Usage::COPY_SRC, 8)] {
        let count = scene.gpu.buffer("count", 8, usage).expect("there is room");
        let refused = stage.prepare(&mut encoder, PatchCount::Device(&count, offset)).err();
        let expected = StageError::BadPatchCount { offset, size: 8, usage };
        assert_eq!(refused, Some(expected.into()), "{usage:?} at {offset}");
    }
    let refused = stage.set_bind_group(1, &scene.group).err();
    assert_eq!(refused, Some(StageError::NoSuchBindGroup { number: 1, groups: 1 }.into()));
    assert_eq!(stage.set_bind_group(0, &scene.group), Ok(()), "the one that there is");
    let mut refused = None;
    let drawn = scene.frame_with(&mut stage, PATCHES.into(), |stage, pass| {
        refused = stage.draw_group(pass, 0).err();
    });
    assert_eq!(drawn.map(|_| ()), Ok(()), "and the frame goes on");
    assert_eq!(refused, Some(StageError::NoSuchGroup { group: 0, groups: 0 }.into()));
}

#[test]
fn a_device_without_compute_shaders_is_refused() {
    let gpu = limited(wgpu::Limits::downlevel_webgl2_defaults());
    let scene = quads();
    let source = source(Domain::Quad);
    let built = Builder::new(&source, scene.domain, scene.config, PATCHES)
        .target(wgpu::TextureFormat::Rgba8Unorm)
        .build(&gpu.device);
    let limit = "max_compute_workgroups_per_dimension";
    let low = Error::LimitTooLow { limit, needed: 1, got: 0 };
    assert_eq!(built.err(), Some(low.clone()), "the stage");
    assert!(low.to_string().contains("WebGL has no compute shaders"), "{low}");
    let setup = tess_gpu::Setup::new(scene.domain, scene.config);
    let patches = [PatchFactors::uniform(scene.domain, 3.0)];
    let output = Tessellator::new(&gpu.device).tessellate(&gpu, setup, &patches);
    assert_eq!(output.err(), Some(low), "batches");
}

#[test]
fn a_device_without_timestamps_is_told_what_it_lacks() {
    let refused = Stopwatch::new(&limited(wgpu::Limits::default())).err();
    let error = Error::MissingFeatures { missing: Stopwatch::FEATURES };
    assert!(error.to_string().contains("TIMESTAMP_QUERY_INSIDE_PASSES"), "{error}");
    assert_eq!(refused, Some(error), "it was opened without");
}

#[test]
fn low_limits_are_named() {
    let setup = tess_gpu::Setup::new(Domain::Quad, quads().config);
    let patches = [PatchFactors::uniform(Domain::Quad, 3.0)];
    let small = wgpu::Limits { max_buffer_size: 1 << 20, ..Default::default() };
    let small = wgpu::Limits { max_storage_buffer_binding_size: 1 << 20, ..small };
    for (limits, expected) in [
        (wgpu::Limits::downlevel_defaults(), "max_storage_buffers_per_shader_stage"),
        (small, "max_buffer_size"),
    ] {
        let gpu = limited(limits);
        let output = Tessellator::new(&gpu.device).tessellate(&gpu, setup, &patches);
        let Err(error @ Error::LimitTooLow { limit, needed, got }) = output else {
            panic!("{expected}: {output:?}")
        };
        assert_eq!(limit, expected, "{error}");
        assert!(needed > got && error.to_string().contains("open it with"), "{error}");
    }
}

#[test]
fn what_cannot_be_made_is_refused() {
    let scene = quads();
    let device = &scene.gpu.device;
    let needed = u64::from(24 * PATCHES);
    let got = needed - 4;
    let short = scene.gpu.buffer("short", got, Usage::STORAGE).expect("there is room");
    let built = scene.builder().factors(Factors::Buffer(&short)).build(device);
    assert_eq!(built.err(), Some(Error::FactorsTooShort { needed, got }), "a word is missing");
    let built = scene.builder().bind_group(&scene.layout, &scene.group);
    let built = built.bind_group(&scene.layout, &scene.group);
    let built = built.bind_group(&scene.layout, &scene.group).build(device);
    let many = StageError::TooManyBindGroups { got: 4, most: 3 };
    assert!(many.to_string().contains("fewer groups"), "{many}");
    assert_eq!(built.err(), Some(many.into()), "four of the user's and one of the stage's");
    let mut built = scene.builder().factors(Factors::Buffer(&scene.factors));
    for _ in 0..3 {
        built = built.bind_group(&scene.layout, &scene.group);
    }
    assert_eq!(built.build(device).err(), None, "four, and the stage binds none");
    let source = source(Domain::Quad);
    let many = Builder::new(&source, scene.domain, scene.config, 6_000_000);
    let built = many.bind_group(&scene.layout, &scene.group).build(device);
    let expected = StageError::TooManyFactors { needed: 144_000_000, limit: 128 << 20 };
    assert_eq!(built.err(), Some(expected.into()), "they are bound at once");
    let built = Builder::new(&source, scene.domain, scene.config, 8)
        .target(wgpu::TextureFormat::Rgba32Uint)
        .build(device);
    let error = built.map(|_| ()).expect_err("without its bind group");
    assert!(error.to_string().contains("a bind group that the builder did not get"), "{error}");
    let mut stage = scene.build(scene.builder().factors(Factors::Host));
    let mut encoder = device.create_command_encoder(&Default::default());
    let triangles = [PatchFactors::uniform(Domain::Triangle, 2.0)];
    let refused = stage.set_factors(&mut encoder, &triangles).err();
    let (expected, got) = (Domain::Quad, Domain::Triangle);
    assert_eq!(refused, Some(Error::WrongDomain { patch: 0, expected, got }));
}

#[test]
fn type_errors_say_what_the_user_wrote() {
    let scene = quads();
    let right = source(Domain::Quad);
    let sum = "let at = place(number) + uv;";
    for (from, to, culprit, says) in [
        (
            sum,
            "let at = place(number) + number;",
            "place(number) + number",
            "(vec2<f32>) and (vec2<u32>)",
        ),
        (sum, "let at = place(uv) + uv;", "place(uv)", "Argument 0"),
        (sum, "let at = place(number, uv) + uv;", "place(number, uv)", "Requires 1 arguments"),
        (
            "fn hull(number: u32) -> QuadFactors {",
            "fn hull(number: u32) -> QuadFactors { given[0] = 1.0;",
            "given[0]",
            "store",
        ),
        (
            "return Vertex(vec4<f32>(0.5",
            "return Vertex(vec3<f32>(0.5",
            "vec3<f32>(0.5",
            "expects 3 components",
        ),
        (
            "6u * number;",
            "6u * number; for (var i = 0; i < 4u; i++) {}",
            "i < 4u",
            "(i32) and (u32)",
        ),
    ] {
        let (line, message) = complaint(&scene, [from, to], Points::Stored);
        assert_eq!(line, Some(line_of(&right.replace(from, to), to)), "{message}");
        let begin = format!("in `{culprit}");
        assert!(message.starts_with(&begin) && message.contains(says), "{message}, not {begin}");
        let has_number =
            message.as_bytes().windows(2).any(|two| two[0] == b'[' && two[1].is_ascii_digit());
        assert!(!has_number || culprit == "given[0]", "{message}");
    }
}

#[test]
#[ignore = "slow: many pipelines"]
fn bindings_without_a_bind_group_are_named() {
    let scene = quads();
    let right = source(Domain::Quad);
    let sun = "\n@group(1) @binding(0) var<uniform> sun: vec4<f32>;\n";
    let unused = right.clone() + sun;
    let build = |source: &str| scene.builder_of(source).build(&scene.gpu.device);
    assert_eq!(build(&unused).err(), None, "nothing reads it");
    for user in ["let at = 6u * number", "let at = place(number)", "return vec4<u32>(bitcast"] {
        let wrong = unused.replace(user, &format!("let light = sun.x; {user}"));
        let error = build(&wrong).map(|_| ()).expect_err("there is no group 1").to_string();
        let line = line_of(&wrong, sun.trim());
        let says = format!(
            "line {line} of your WGSL: `sun` is in a bind group that the builder did not get"
        );
        assert!(error.starts_with(&says), "{error}");
    }
}

#[test]
fn pipeline_constants_reach_every_function_or_are_refused() {
    let scene = quads();
    let declared = "override ONE: f32; @id(7) override mark: u32 = 3u; override scale = 0.0;";
    let source = source(Domain::Quad)
        .replace("const ONE = 1.0;", declared)
        .replace("given[at], ", "scale * given[at], ")
        .replace("vertex.number, 1u", "vertex.number, mark");
    let build = |constants: &[(&str, f64)]| {
        scene
            .builder_of(&source)
            .room(Room::WorstCase)
            .constants(constants)
            .build(&scene.gpu.device)
    };
    let mut stage =
        build(&[("mark", 1.0), ("ONE", 1.0), ("scale", 1.0)]).expect("they are declared");
    let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
    assert_eq!(
        compare(&observed, &scene.pixels(&scene.patches)),
        Ok(()),
        "as with these numbers in the text"
    );
    let error = build(&[("scale", 1.0)]).map(|_| ()).expect_err("ONE has no value");
    let line = line_of(&source, "override ONE");
    assert_eq!(
        error.to_string(),
        format!("line {line} of your WGSL: `ONE` has no value; give one with `constants`")
    );
    let error = build(&[("ONE", 1.0), ("on", 1.0)]).map(|_| ()).expect_err("there is no `on`");
    let found = ["ONE", "mark", "scale"].map(str::to_owned).to_vec();
    assert_eq!(error, StageError::NoSuchConstant { name: "on".to_owned(), found }.into());
    assert!(
        error.to_string().contains("no `override on`; it declares ONE, mark, scale"),
        "{error}"
    );
}

#[test]
fn encoders_and_tessellators_of_other_devices_are_refused() {
    let scene = quads();
    // Later instances have fewer buffers, so that wgpu cannot mistake one for another.
    let other = limited(wgpu::Limits::default());
    let mut stage = scene.build(scene.builder().factors(Factors::Host));
    for _ in 0..2 {
        let mut encoder = other.device.create_command_encoder(&Default::default());
        let refused = stage.prepare(&mut encoder, PATCHES).err();
        assert_eq!(refused, Some(StageError::OtherDevice.into()), "a frame");
        let mut encoder = other.device.create_command_encoder(&Default::default());
        let refused = stage.set_factors(&mut encoder, &scene.patches).err();
        assert_eq!(refused, Some(StageError::OtherDevice.into()), "factors");
    }
    let mut encoder = scene.gpu.device.create_command_encoder(&Default::default());
    stage.set_factors(&mut encoder, &scene.patches).expect("it is the stage's");
    scene.gpu.run(encoder).expect("the device finishes");
    let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
    assert_eq!(compare(&observed, &scene.pixels(&scene.patches)), Ok(()), "the stage goes on");
    let usage = wgpu::TextureUsages::RENDER_ATTACHMENT;
    let target = objects::plain(&other, crate::scene::FORMAT, [64, 64], usage);
    let mut encoder = other.device.create_command_encoder(&Default::default());
    in_pass(&mut encoder, &target, None, |pass| {
        let refused = stage.material.draw(pass, stage.frame()).err();
        assert_eq!(refused, Some(StageError::OtherDevice.into()), "a render pass");
    });
    // Another device of the stage's own instance, because devices of two instances can have the
    // same number.
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let [first, second] = [0; 2].map(|_| device_of(&instance, Default::default()).device);
    let shared = Tessellator::new(&first);
    let built = scene.builder().tessellator(&shared).build(&second);
    assert_eq!(built.err(), Some(StageError::OtherDevice.into()), "a tessellator");
    let told = StageError::OtherDevice.to_string();
    assert!(told.contains("the device that `build` got: `Tessellator::new(&device)`"), "{told}");
}
