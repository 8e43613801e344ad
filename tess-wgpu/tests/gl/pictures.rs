//! The stage on OpenGL.

use crate::both::Both;
use crate::model::{self, compare};
use crate::scene::{PATCHES, Scene, source};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_wgpu::stage::{Points, StageError};
use tess_wgpu::{Error, Gpu};

const CONFIG: Config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);

/// A scene whose patches have different factors on each edge.
fn scene(gpu: Gpu, domain: Domain) -> Scene {
    let of = |patch: u16| {
        let mut factor = f32::from(patch) * 0.75;
        PatchFactors::from_fn(domain, |_| {
            factor += 1.25;
            factor
        })
    };
    Scene::on(gpu, domain, CONFIG, (0..8).map(of).collect())
}

pub(crate) fn every_way_to_draw(gpu: Gpu) {
    let quads = [Points::Stored, Points::Pull, Points::PullWithoutIndices];
    for (domain, ways) in [(Domain::Triangle, &quads[..1]), (Domain::Quad, &quads)] {
        let scene = scene(gpu.clone(), domain);
        let expected = scene.pixels(&scene.patches);
        for &points in ways {
            let mut stage = scene.build(scene.builder().points(points));
            leave_locations_enabled(&scene, &mut stage);
            let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
            assert_eq!(compare(&observed, &expected), Ok(()), "{points:?}, {domain:?}");
            for corner in [0, 1] {
                let turned = model::pixels(CONFIG, &scene.patches, corner);
                assert!(compare(&observed, &turned).is_err(), "triangles begin elsewhere");
            }
            let observed = scene.frame(&mut stage, 7.into()).expect("it draws");
            assert!(compare(&observed, &expected).is_err(), "a patch less");
        }
    }
}

/// Draws with another pipeline, whose vertex buffers are dropped afterwards.
fn leave_locations_enabled(scene: &Scene, stage: &mut Both) {
    const WGSL: &str = "
        @vertex
        fn place(@location(0) a: f32, @location(5) b: f32) -> @builtin(position) vec4<f32> {
            return vec4<f32>(a, b, 0.0, 1.0);
        }

        @fragment
        fn shade() -> @location(0) vec4<u32> {
            return vec4<u32>(7u);
        }
    ";
    let layout = |attributes| {
        let step_mode = wgpu::VertexStepMode::Vertex;
        Some(wgpu::VertexBufferLayout { array_stride: 4, step_mode, attributes })
    };
    let [first, second] =
        [wgpu::vertex_attr_array![0 => Float32], wgpu::vertex_attr_array![5 => Float32]];
    let pipeline = scene.pipeline(WGSL.to_owned(), "place", &[layout(&first), layout(&second)]);
    let buffer = |coordinates: [f32; 3]| {
        let bytes = bytemuck::bytes_of(&coordinates);
        scene.gpu.upload("theirs", bytes, wgpu::BufferUsages::VERTEX).expect("it fits")
    };
    let buffers = [buffer([0.0, 0.0, 1.0]), buffer([0.0, 1.0, 1.0])];
    let pixels = scene.frame_with(stage, PATCHES.into(), |_, pass| {
        pass.set_pipeline(&pipeline);
        for (slot, buffer) in (0..).zip(&buffers) {
            pass.set_vertex_buffer(slot, buffer.slice(..));
        }
        pass.draw(0..3, 0..1);
    });
    let is_drawn = pixels.expect("it draws").contains(&[7; 4]);
    assert!(is_drawn, "the other pipeline draws its triangle");
    drop(buffers);
    scene.gpu.device.poll(wgpu::PollType::wait_indefinitely()).expect("the device is idle");
}

pub(crate) fn flat_members_are_refused(gpu: Gpu) {
    let scene = scene(gpu, Domain::Quad);
    let build = |source: &str| scene.builder_of(source).build(&scene.gpu.device).map(drop);
    let first = source(scene.domain);
    let refused = |member: &str| {
        Err(Error::Stage(StageError::FlatOfFirstVertex { member: member.to_owned() }))
    };
    assert_eq!(build(&first), refused("uv"), "a place differs from vertex to vertex");
    let of_patch = first.replacen("@interpolate(flat)", "", 1);
    assert_eq!(build(&of_patch), refused("number"), "nobody said that it does not");
    let either = of_patch.replace("@interpolate(flat)", "@interpolate(flat, either)");
    assert_eq!(build(&either), Ok(()), "now it is said");
}
