//! Stages with one tessellator share all pipelines that are the same for both. Sequences compare
//! their output.

use crate::both::Builder;
use crate::common::device::device_of;
use crate::scene::{FORMAT, PATCHES, source};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use tess_wgpu::{Gpu, Tessellator};

/// The numbers of compute and of render pipelines in an instance.
fn pipelines(instance: &wgpu::Instance) -> [usize; 2] {
    let report = instance.generate_report().expect("natively");
    let hub = report.hub_report();
    [&hub.compute_pipelines, &hub.render_pipelines].map(|one| one.num_kept_from_user)
}

/// A tessellator as a program makes it, whose pipeline cache may exist from an earlier run. Making
/// wgpu's cache is `unsafe`, so these tests have none.
fn tessellator(device: &wgpu::Device, cache: Option<&wgpu::PipelineCache>) -> Tessellator {
    let new = Tessellator::new(device);
    cache.into_iter().fold(new, Tessellator::with_pipeline_cache)
}

#[test]
fn a_stage_makes_the_pipelines_that_no_other_has() {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let gpu = device_of(&instance, Default::default());
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let scene = crate::scene::Scene::on(gpu, Domain::Quad, config, Vec::new());
    let shared = tessellator(&scene.gpu.device, None);
    let right = source(Domain::Quad);
    let build = |text: &str, change: fn(Builder<'_>) -> Builder<'_>| {
        let builder = Builder::new(text, Domain::Quad, config, PATCHES)
            .bind_group(&scene.layout, &scene.group)
            .target(FORMAT)
            .tessellator(&shared);
        let before = pipelines(&instance);
        let stage = change(builder).build(&scene.gpu.device);
        let after = pipelines(&instance);
        (stage.unwrap_or_else(|error| panic!("{error}")), [0, 1].map(|at| after[at] - before[at]))
    };
    let (first, [compute, render]) = build(&right, |builder| builder);
    assert!(compute > 7 && render == 1, "{compute} compute pipelines and {render}");
    let other_fragment = right.replace("vertex.number, 1u", "vertex.number, 2u");
    let other_hull = right.replace("6u * number", "6u * (number ^ 1u)");
    let with_constant = right.clone() + "override a = 1.0;";
    let mut all = Vec::new();
    for (what, text, change, expected) in [
        ("nothing", &right, (|builder| builder) as fn(Builder<'_>) -> Builder<'_>, [0, 0]),
        ("the fragment shader", &other_fragment, |builder| builder, [0, 1]),
        ("the same again", &other_fragment, |builder| builder, [0, 0]),
        ("the hull", &other_hull, |builder| builder, [1, 1]),
        (
            "culling",
            &right,
            |builder| {
                let cull_mode = Some(wgpu::Face::Back);
                builder.primitive(wgpu::PrimitiveState { cull_mode, ..Default::default() })
            },
            [0, 1],
        ),
        (
            "the most bytes",
            &right,
            |builder| builder.room(tess_wgpu::stage::Room::Bytes(9000)),
            [0, 0],
        ),
        ("a constant's declaration", &with_constant, |builder| builder, [0, 1]),
        ("a constant's value", &with_constant, |builder| builder.constants(&[("a", 2.0)]), [1, 1]),
    ] {
        let (stage, made) = build(text, change);
        assert_eq!(made, expected, "another stage that differs in {what}");
        all.push(stage);
    }
    drop((first, all));
    let left = pipelines(&instance);
    let (_, made) = build(&right, |builder| builder);
    assert!(left[1] == 0 && made == [compute - left[0], 1], "{left:?} were left, {made:?} made");
}

/// A room that grows out of a short batch and shrinks into one again, other groups, and a stage for
/// more patches: all of their pipelines were made when the first stage was built.
#[test]
#[ignore = "slow: many frames"]
fn no_frame_makes_a_pipeline() {
    let instance = wgpu::Instance::new(wgpu::InstanceDescriptor::new_without_display_handle());
    let gpu = device_of(&instance, Default::default());
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let hull = "@group(0) @binding(0) var<uniform> factor: vec4f;\n\
                fn hull(number: u32) -> QuadFactors { return tess_quad_factors(factor); }\n\
                struct Vertex { @builtin(position) position: vec4f }\n\
                fn domain(number: u32, uv: vec2f) -> Vertex { return Vertex(vec4f(uv, 0.0, 1.0)); }\n\
                @fragment fn shade() -> @location(0) vec4<u32> { return vec4<u32>(); }";
    let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
    let uniform = gpu.upload("factor", &[0; 16], usage).expect("there is room");
    let ty = crate::common::objects::buffer(wgpu::BufferBindingType::Uniform);
    let layout = crate::common::objects::layout(&gpu.device, wgpu::ShaderStages::COMPUTE, [ty]);
    let whole = crate::common::objects::whole([&uniform]);
    let group = crate::common::objects::group(&gpu.device, &layout, whole);
    for points in crate::drawing::WAYS {
        let shared = tessellator(&gpu.device, None);
        let build = |patches| {
            let builder = Builder::new(hull, Domain::Quad, config, patches)
                .bind_group(&layout, &group)
                .target(FORMAT)
                .points(points)
                .tessellator(&shared);
            let stage = builder.build(&gpu.device);
            stage.unwrap_or_else(|error| panic!("{error}"))
        };
        let mut stage = build(1000);
        stage.shrink_after(4);
        let made = pipelines(&instance);
        let mut rooms = std::collections::BTreeSet::new();
        for frame in 0..40 {
            let factor = if (8..20).contains(&frame) { 40.0_f32 } else { 3.0 };
            gpu.queue.write_buffer(&uniform, 0, bytemuck::bytes_of(&[factor; 4]));
            if frame == 5 {
                stage.set_groups(&[0, 10]).expect("they ascend");
            }
            let mut encoder = gpu.device.create_command_encoder(&Default::default());
            stage.prepare(&mut encoder, 1000).expect("it is prepared");
            gpu.run(encoder).expect("the device finishes");
            let room = stage.capacity();
            rooms.insert(u64::from(room.points) + u64::from(room.primitives) > 1 << 19);
            assert_eq!(pipelines(&instance), made, "{points:?}, frame {frame}, {room:?}");
        }
        assert_eq!(rooms.len(), 2, "{points:?}: a short batch and a long one");
        let larger = build(20_000);
        assert_eq!(pipelines(&instance), made, "{points:?}, a stage for more patches");
        drop((stage, larger));
    }
}

#[test]
fn stages_can_be_built_on_another_thread() {
    const fn is_send<T: Send>(_: &T) {}
    let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
    let text = source(Domain::Quad);
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let shared = Tessellator::new(&gpu.device);
    let build = || Builder::new(&text, Domain::Quad, config, 1).tessellator(&shared);
    is_send(&build().build_async(&gpu.device));
    let refused =
        std::thread::scope(|scope| scope.spawn(|| build().build(&gpu.device).err()).join());
    let told = refused.expect("it ends").expect("it lacks its bind group").to_string();
    assert!(told.contains("`given` is in a bind group"), "{told}");
}
