//! Surfaces come and go.

use super::{app, picture, run};
use crate::render::layout::GpuInstance;
use crate::{HeightField, LevelOfDetail, Shape, TessStats, Tessellated};
use bevy::prelude::*;
use bevy::render::RenderApp;
use bevy::render::renderer::RenderInstance;
use std::f32::consts::FRAC_PI_2;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// A field with this many patches along each side.
fn field(number: u32, patches: u32) -> Arc<dyn Shape> {
    let heights = (0..25).map(|i| ((i * (number + 3)) % 7) as f32).collect();
    let field = HeightField::new(UVec2::splat(5), heights).expect("25 texels");
    Arc::new(field.with_patches(UVec2::splat(patches)).expect("there are some"))
}

/// Spawns a surface that faces the camera of [`app`], in its own place and colour.
fn spawn(app: &mut App, number: u32, shape: Arc<dyn Shape>) -> Entity {
    let base_color = Color::hsl((number * 37 % 360) as f32, 1.0, 0.5);
    let material = StandardMaterial { base_color, unlit: true, ..default() };
    let material = app.world_mut().resource_mut::<Assets<StandardMaterial>>().add(material);
    let at = Vec3::new((number % 12) as f32 - 5.5, (number / 12 % 12) as f32 - 5.5, 0.0) * 0.12;
    let transform = Transform::from_translation(at).with_rotation(Quat::from_rotation_x(FRAC_PI_2));
    let transform = transform.with_scale(Vec3::new(0.1, 0.01, 0.1));
    let surface = Tessellated::shared(shape).with_detail(LevelOfDetail::Uniform(2.0));
    app.world_mut().spawn((surface, MeshMaterial3d(material), transform)).id()
}

/// The bytes that a frame uploads, and those of the next three.
fn uploaded(app: &mut App) -> [usize; 2] {
    let mut frame = || {
        app.update();
        app.world().resource::<TessStats>().uploaded() as usize
    };
    [frame(), frame() + frame() + frame()]
}

/// The bytes per entity that Bevy's fragment functions read.
const MESH: usize = 176;

/// The bytes per entity that follow a frame late, when Bevy knows where a new entity was before.
const MOTION: usize = 60;

#[test]
fn only_what_is_new_is_uploaded() {
    let mut app = app();
    let mut all = Vec::new();
    for number in 0..40 {
        all.push(spawn(&mut app, number, field(number, 2)));
    }
    run(&mut app);
    assert_eq!(uploaded(&mut app), [0, 0], "nothing changes");
    let new = field(99, 2);
    let (words, entity) = (4 * new.words().len(), size_of::<GpuInstance>() + MESH + 4 * (4 + 1));
    all.push(spawn(&mut app, 40, Arc::clone(&new)));
    assert_eq!(uploaded(&mut app), [words + entity, MOTION], "a shape of 4 patches");
    all.push(spawn(&mut app, 41, new));
    assert_eq!(uploaded(&mut app), [entity, MOTION], "the same shape again");
    for entity in [3, 40, 41, 0].map(|number: usize| all[number]) {
        app.world_mut().despawn(entity);
        assert_eq!(uploaded(&mut app), [8, 0], "it is hidden");
    }
    spawn(&mut app, 3, field(3, 2));
    let [again, _] = uploaded(&mut app);
    assert!((words..=words + entity).contains(&again), "{again}: as another one");
}

#[test]
fn what_came_and_went_leaves_no_trace() {
    let sizes = |number: u32| 1 + number * 7 % 5;
    let mut app = app();
    let own = |app: &mut App, number| spawn(app, number, field(number % 50, sizes(number)));
    let mut there: Vec<_> = (0..70).map(|number| (number, own(&mut app, number))).collect();
    for round in 0..6 {
        run(&mut app);
        let stays = |number: u32| !(number * 5 + round).is_multiple_of(4);
        for (_, gone) in there.extract_if(.., |(number, _)| !stays(*number)) {
            app.world_mut().despawn(gone);
        }
        let new = 70 + 12 * round..82 + 12 * round;
        there.extend(new.map(|number| (number, own(&mut app, number))));
    }
    run(&mut app);
    let observed = picture(&mut app);
    let mut fresh = self::app();
    let last: Vec<_> = there.iter().map(|&(number, _)| own(&mut fresh, number)).collect();
    run(&mut fresh);
    assert_eq!(observed, picture(&mut fresh), "as if the others had never been");
    fresh.world_mut().despawn(last[20]);
    run(&mut fresh);
    assert_ne!(observed, picture(&mut fresh), "one fewer would be seen");
}

/// The numbers of compute and of render pipelines.
fn pipelines(app: &App) -> [usize; 2] {
    let report = app.sub_app(RenderApp).world().resource::<RenderInstance>().generate_report();
    let report = report.expect("natively");
    let hub = report.hub_report();
    [&hub.compute_pipelines, &hub.render_pipelines].map(|one| one.num_kept_from_user)
}

#[test]
fn no_pipeline_is_made_when_surfaces_come() {
    let mut app = app();
    let first = spawn(&mut app, 0, field(0, 2));
    run(&mut app);
    let before = pipelines(&app);
    assert!(before[0] > 7 && before[1] > 0, "{before:?}");
    for number in 1..85 {
        spawn(&mut app, number, field(number, 14));
        if number % 8 == 0 {
            app.update();
        }
    }
    app.world_mut().despawn(first);
    run(&mut app);
    assert_eq!(pipelines(&app), before, "16464 patches more");
}

/// `cargo test --release -- --ignored --nocapture hitch`: the times of frames in which 10 000
/// patches come and go next to a terrain.
#[test]
#[ignore = "it measures time"]
fn no_frame_is_a_hitch() {
    let mut app = app();
    let texels = 512;
    let heights = (0..texels * texels).map(|i| (i % 97) as f32 / 97.0).collect();
    let terrain = HeightField::new(UVec2::splat(texels), heights).expect("as many");
    let terrain = terrain.with_patches(UVec2::splat(64)).expect("4096");
    spawn(&mut app, 0, Arc::new(terrain));
    for _ in 0..30 {
        app.update();
    }
    let shapes: Vec<_> = (0..100).map(|number| field(number, 10)).collect();
    let mut there = Vec::new();
    let frame = |app: &mut App| {
        let begin = Instant::now();
        app.update();
        begin.elapsed()
    };
    let (mut steady, mut times) = (Vec::new(), Vec::new());
    for _ in 0..2 {
        for few in shapes.chunks(2) {
            let new = few.iter().zip(there.len() as u32..);
            let new: Vec<_> = new.map(|(shape, n)| spawn(&mut app, n, Arc::clone(shape))).collect();
            there.extend(new);
            times.push(frame(&mut app));
        }
        steady.extend((0..20).map(|_| frame(&mut app)));
        while !there.is_empty() {
            for gone in there.drain(..2) {
                app.world_mut().despawn(gone);
            }
            times.push(frame(&mut app));
        }
    }
    let median_and_worst = |mut times: Vec<Duration>| {
        times.sort_unstable();
        [times[times.len() / 2], times[times.len() - 1]]
    };
    println!("all are there: {:?}", median_and_worst(steady));
    println!("10 000 patches come and go, twice: {:?}", median_and_worst(times));
}
