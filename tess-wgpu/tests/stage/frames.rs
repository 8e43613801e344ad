//! Frames that are dropped, kept or interrupted do not disturb the stage.

use crate::both::{Both, Builder};
use crate::common::objects::{group, layout, part, whole};
use crate::drawing::{scene, some_factors};
use crate::model::{compare, compare_factors, drawn};
use crate::scene::{PATCHES, Scene};
use tess_core::{Domain, Partitioning, PatchFactors};
use tess_wgpu::Error;
use tess_wgpu::stage::{Overflow, PatchCount, Room, StageError};
use wgpu::BufferUsages as Usage;

/// A scene whose first frame does not fit, and its stage.
fn growing() -> (Scene, Both) {
    let scene = scene(Domain::Quad, Partitioning::FractionalOdd);
    let room = Room::Automatic { most_bytes: 1 << 20 };
    let stage = scene.build(scene.builder().room(room));
    (scene, stage)
}

/// Prepares a frame in an encoder of its own.
fn prepared(scene: &Scene, stage: &mut Both) -> wgpu::CommandEncoder {
    let mut encoder = scene.gpu.device.create_command_encoder(&Default::default());
    stage.prepare(&mut encoder, PATCHES).expect("it is prepared");
    encoder
}

fn assert_exact(scene: &Scene, stage: &mut Both, what: &str) {
    let observed = scene.frame(stage, PATCHES.into()).expect("it draws");
    assert_eq!(compare(&observed, &scene.pixels(&scene.patches)), Ok(()), "{what}");
}

#[test]
fn a_refused_frame_changes_nothing() {
    let (scene, mut stage) = growing();
    scene.frame(&mut stage, PATCHES.into()).expect("it draws");
    let mut encoder = scene.gpu.device.create_command_encoder(&Default::default());
    let too_many = StageError::TooManyPatches { got: PATCHES + 1, most: PATCHES };
    let refused = stage.prepare(&mut encoder, PATCHES + 1);
    assert_eq!(refused, Err(too_many.into()), "more than it was made for");
    let observed = scene.draw_only(encoder, |pass| stage.draw(pass)).expect("it draws");
    assert_ne!(drawn(&observed), 0, "the frame before is still there");
    assert_exact(&scene, &mut stage, "after a refused frame");
}

#[test]
fn dropped_frames_do_not_stop_feedback() {
    let (scene, mut stage) = growing();
    for _ in 0..10 {
        drop(prepared(&scene, &mut stage));
    }
    assert_eq!(stage.feedback(), None, "none was submitted");
    scene.frame(&mut stage, PATCHES.into()).expect("it draws");
    assert_eq!(stage.feedback().map(|feedback| feedback.frame), Some(10), "this one was");
    assert_exact(&scene, &mut stage, "and there is room");
}

#[test]
#[ignore = "slow: many frames"]
fn kept_frames_stop_feedback_for_a_while_only() {
    let (scene, mut stage) = growing();
    let kept: Vec<_> = (0..4).map(|_| prepared(&scene, &mut stage)).collect();
    let mut frames = 4;
    while stage.feedback().is_none() {
        scene.gpu.run(prepared(&scene, &mut stage)).expect("the device finishes");
        frames += 1;
        assert!(frames < 80, "nothing was heard of {frames} frames");
    }
    assert_eq!(frames, 65, "frame 0 is given up after 64, and frame 64 takes its place");
    drop(kept);
}

#[test]
fn a_late_frame_is_heard_of() {
    let (scene, mut stage) = growing();
    let late = prepared(&scene, &mut stage);
    for _ in 0..30 {
        drop(prepared(&scene, &mut stage));
    }
    scene.gpu.run(late).expect("the device finishes");
    assert_eq!(stage.feedback().map(|feedback| feedback.frame), Some(0), "submitted after 30");
}

#[test]
fn a_lost_device_is_an_error() {
    for waits in [false, true] {
        for overflow in [Overflow::Coarser, Overflow::DrawNothing] {
            let scene = scene(Domain::Quad, Partitioning::Integer);
            let mut stage = scene.build(scene.builder().overflow(overflow));
            let encoder = prepared(&scene, &mut stage);
            scene.gpu.queue.submit([encoder.finish()]);
            if waits {
                let waited = scene.gpu.device.poll(wgpu::PollType::wait_indefinitely());
                assert!(waited.is_ok(), "{waited:?}");
            }
            scene.gpu.device.destroy();
            let mut encoder = scene.gpu.device.create_command_encoder(&Default::default());
            for _ in 0..3 {
                let refused = stage.prepare(&mut encoder, PATCHES);
                assert!(matches!(refused, Err(Error::DeviceLost { .. })), "{refused:?}");
            }
            let _ = stage.feedback();
            let refused = stage.make_room(&scene.gpu.queue, PATCHES);
            assert!(matches!(refused, Err(Error::DeviceLost { .. })), "{refused:?}");
            let _ = (stage.set_groups(&[0]), stage.set_bind_group(0, &scene.group));
        }
    }
}

/// The layout of one buffer, and its group. The arguments are whether it has a dynamic offset, and
/// its type.
fn bound(
    scene: &Scene,
    (has_dynamic_offset, ty): (bool, wgpu::BufferBindingType),
    buffer: &wgpu::Buffer,
) -> (wgpu::BindGroupLayout, wgpu::BindGroup) {
    let device = &scene.gpu.device;
    let ty = wgpu::BindingType::Buffer { ty, has_dynamic_offset, min_binding_size: None };
    let visibility = wgpu::ShaderStages::COMPUTE | wgpu::ShaderStages::VERTEX;
    let layout = layout(device, visibility, [ty]);
    let group = group(device, &layout, whole([buffer]));
    (layout, group)
}

#[test]
#[ignore = "slow: many pipelines"]
fn bind_groups_of_other_layouts_are_errors_of_wgpus() {
    let scene = scene(Domain::Quad, Partitioning::Integer);
    let device = &scene.gpu.device;
    let uniform = scene.gpu.buffer("uniform", 256, Usage::UNIFORM).expect("there is room");
    let (_, other) = bound(&scene, (false, wgpu::BufferBindingType::Uniform), &uniform);
    let read = wgpu::BufferBindingType::Storage { read_only: true };
    let (dynamic, of_dynamic) = bound(&scene, (true, read), &scene.factors);
    let build = |layout: &wgpu::BindGroupLayout, group: &wgpu::BindGroup| {
        let source = crate::scene::source(Domain::Quad);
        Builder::new(&source, scene.domain, scene.config, PATCHES)
            .bind_group(layout, group)
            .target(crate::scene::FORMAT)
            .build(device)
            .expect("the group is not looked at yet")
    };
    let complaint = |stage: &mut Both| {
        let scope = device.push_error_scope(wgpu::ErrorFilter::Validation);
        let mut encoder = device.create_command_encoder(&Default::default());
        stage.prepare(&mut encoder, PATCHES).expect("nor here");
        drop(encoder.finish());
        pollster::block_on(scope.pop()).map(|error| error.to_string())
    };
    let mut stage = scene.build(scene.builder());
    stage.set_bind_group(0, &other).expect("there is one of this number");
    let incompatible = "index 0 is not compatible";
    for (stage, says) in [
        (&mut stage, incompatible),
        (&mut build(&scene.layout, &other), incompatible),
        (&mut build(&dynamic, &of_dynamic), "label 0 expects 1 dynamic offset"),
    ] {
        let told = complaint(stage).expect("wgpu refuses it");
        assert!(told.contains(says), "{told}");
    }
    stage.set_bind_group(0, &scene.group).expect("there is one of this number");
    assert_eq!(complaint(&mut stage), None);
    assert_exact(&scene, &mut stage, "with the group that it had");
}

#[test]
fn dynamic_offsets_choose_factors() {
    let mut scene = scene(Domain::Quad, Partitioning::Integer);
    let reversed: Vec<_> = scene.patches.iter().rev().copied().collect();
    let mut words = tess_gpu::layout::factor_words(&scene.patches);
    let size = 4 * words.len() as u64;
    words.resize(64, 0);
    words.extend(tess_gpu::layout::factor_words(&reversed));
    let both =
        scene.gpu.upload("both", bytemuck::cast_slice(&words), Usage::STORAGE).expect("room");
    let ty = wgpu::BufferBindingType::Storage { read_only: true };
    let (layout, _) = bound(&scene, (true, ty), &both);
    let group = group(&scene.gpu.device, &layout, [(0, part(&both, 0, size))]);
    let source = crate::scene::source(Domain::Quad);
    let mut stage = Builder::new(&source, scene.domain, scene.config, PATCHES)
        .bind_group(&layout, &group)
        .target(crate::scene::FORMAT)
        .room(Room::WorstCase)
        .build(&scene.gpu.device)
        .expect("it is right");
    for offset in [0, 256, 0] {
        stage.set_dynamic_offsets(0, &[offset]).expect("there is one of this number");
        assert_exact(&scene, &mut stage, &format!("from byte {offset}"));
        scene.patches.reverse();
    }
    let none = StageError::NoSuchBindGroup { number: 1, groups: 1 };
    assert_eq!(stage.set_dynamic_offsets(1, &[0]).err(), Some(none.into()));
}

/// A second bind group, whose offset selects the number that the domain function adds to the
/// patch's.
#[test]
fn dynamic_offsets_of_later_groups_reach_the_draw() {
    let scene = scene(Domain::Quad, Partitioning::Integer);
    let mut words = [0_u32; 65];
    (words[0], words[64]) = (10, 20);
    let added =
        scene.gpu.upload("added", bytemuck::cast_slice(&words), Usage::STORAGE).expect("room");
    let ty = wgpu::BufferBindingType::Storage { read_only: true };
    let (layout, _) = bound(&scene, (true, ty), &added);
    let group = group(&scene.gpu.device, &layout, [(0, part(&added, 0, 4))]);
    let source = crate::scene::source(Domain::Quad).replace("uv, number);", "uv, number + added);");
    let source = format!("@group(1) @binding(0) var<storage, read> added: u32;\n{source}");
    let builder = scene.builder_of(&source).bind_group(&layout, &group).room(Room::WorstCase);
    let mut stage = scene.build(builder);
    for (offset, sum) in [(0, 10), (256, 20), (0, 10)] {
        stage.set_dynamic_offsets(1, &[offset]).expect("there is one of this number");
        let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
        let mut expected = scene.pixels(&scene.patches);
        let drawn = expected.iter_mut().flatten().filter(|pixel| pixel[3] == 1);
        drawn.for_each(|pixel| pixel[2] += sum);
        assert_eq!(compare(&observed, &expected), Ok(()), "from byte {offset}");
    }
}

#[test]
fn factors_of_the_hull_can_be_read() {
    let scene = scene(Domain::Quad, Partitioning::FractionalOdd);
    let mut stage = scene.build(scene.builder());
    scene.frame(&mut stage, PatchCount::Host(5)).expect("it draws");
    let bytes =
        scene.gpu.read(stage.factors(), 4 * 6 * u64::from(PATCHES)).expect("they are there");
    let mut expected = some_factors(Domain::Quad);
    expected[5..].fill(PatchFactors::uniform(Domain::Quad, 0.0));
    let words: Vec<u32> = bytemuck::pod_collect_to_vec(&bytes);
    assert_eq!(compare_factors(&words, &expected), Ok(()), "after a frame");
}
