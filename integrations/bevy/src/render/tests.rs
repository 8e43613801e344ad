//! Whole frames without a window: the domain points equal the CPU's, user shaders are drawn, and
//! errors in them do not end the program.

#[expect(dead_code, reason = "the game's `main` opens a window")]
mod game;
mod images;
mod materials;
mod passes;
#[cfg(feature = "picking")]
mod picking;
mod streaming;
mod values;

use super::stages::Stages;
use crate::cpu::Tessellators;
use crate::shape::Shape;
use crate::{HeightField, LevelOfDetail, TessPlugin, Tessellated};
use bevy::app::PluginsState;
use bevy::asset::RenderAssetUsages;
use bevy::camera::RenderTarget;
use bevy::camera::primitives::Aabb;
use bevy::core_pipeline::tonemapping::{DebandDither, Tonemapping};
use bevy::prelude::*;
use bevy::render::pipelined_rendering::PipelinedRenderingPlugin;
use bevy::render::render_resource::{Extent3d, TextureDimension, TextureFormat, TextureUsages};
use bevy::render::renderer::{RenderDevice, RenderQueue};
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured};
use bevy::render::{RenderApp, RenderPlugin};
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;
use std::borrow::Cow;
use std::sync::{Arc, Mutex};
use tess_core::{Config, Domain, PatchFactors};
use tess_wgpu::TessellationStage;

/// Pixels across and down.
const SIZE: u32 = 64;
/// The frames until shaders are loaded and the room has grown.
const FRAMES: usize = 12;

/// An app with a camera at (0, 0, 2) that looks at the origin, before its first frame.
fn app() -> App {
    let window =
        WindowPlugin { primary_window: None, exit_condition: ExitCondition::DontExit, ..default() };
    let render = RenderPlugin { synchronous_pipeline_compilation: true, ..default() };
    let mut app = App::new();
    app.add_plugins((
        DefaultPlugins
            .set(window)
            .set(render)
            .disable::<WinitPlugin>()
            .disable::<PipelinedRenderingPlugin>(),
        TessPlugin,
        MaterialPlugin::<materials::Tinted>::default(),
    ));
    while app.plugins_state() == PluginsState::Adding {
        bevy::tasks::tick_global_task_pools_on_main_thread();
    }
    app.finish();
    app.cleanup();
    let size = Extent3d { width: SIZE, height: SIZE, depth_or_array_layers: 1 };
    let format = TextureFormat::Rgba8UnormSrgb;
    let mut image =
        Image::new_fill(size, TextureDimension::D2, &[0; 4], format, RenderAssetUsages::default());
    image.texture_descriptor.usage |= TextureUsages::RENDER_ATTACHMENT | TextureUsages::COPY_SRC;
    let image = app.world_mut().resource_mut::<Assets<Image>>().add(image);
    app.insert_resource(Target(image.clone()));
    app.insert_resource(ClearColor(Color::BLACK));
    app.world_mut().spawn((
        Camera3d::default(),
        RenderTarget::Image(image.into()),
        (Tonemapping::None, DebandDither::Disabled),
        Transform::from_xyz(0.0, 0.0, 2.0),
    ));
    app
}

#[derive(Debug, Resource)]
struct Target(Handle<Image>);

fn run(app: &mut App) {
    for _ in 0..FRAMES {
        app.update();
    }
}

/// The pixel in the middle of the picture.
fn middle(app: &mut App) -> [u8; 4] {
    picture(app)[(SIZE * (SIZE + 1) / 2) as usize]
}

/// The pixels of the picture, row by row.
fn picture(app: &mut App) -> Vec<[u8; 4]> {
    let seen = Arc::new(Mutex::new(None));
    let target = app.world().resource::<Target>().0.clone();
    let to = Arc::clone(&seen);
    app.world_mut().spawn(Screenshot::image(target)).observe(
        move |captured: On<ScreenshotCaptured>| {
            *to.lock().expect("nobody panics") = captured.image.data.clone();
        },
    );
    for _ in 0..100 {
        app.update();
        if let Some(bytes) = seen.lock().expect("nobody panics").take() {
            return bytes.as_chunks().0.to_vec();
        }
    }
    panic!("no picture came");
}

/// A quad around the origin, facing the camera.
#[derive(Debug)]
struct Wall {
    surface: &'static str,
    fragment: &'static str,
}

const SURFACE: &str = "
fn hull(number: u32) -> QuadFactors {
    return tess_quad_factors(vec4<f32>(3.5));
}

fn domain(number: u32, uv: vec2<f32>) -> Vertex {
    let at = tess_place(number);
    let local = vec3<f32>(uv - 0.5, 0.0);
    return tess_vertex_of(at, local, vec3<f32>(0.0, 0.0, 1.0), uv, vec4<f32>(1.0));
}
";

impl Shape for Wall {
    fn domain(&self) -> Domain {
        Domain::Quad
    }

    fn patches(&self) -> u32 {
        1
    }

    fn bounds(&self) -> Aabb {
        Aabb::from_min_max(Vec3::splat(-0.5), Vec3::splat(0.5))
    }

    fn surface(&self) -> Cow<'static, str> {
        self.surface.into()
    }

    fn fragment(&self) -> Cow<'static, str> {
        self.fragment.into()
    }

    fn words(&self) -> Vec<u32> {
        Vec::new()
    }
}

const GREEN: &str = "
import bevy_pbr::render::mesh_view_bindings::view;

@fragment
fn fragment(in: Vertex) -> @location(0) vec4<f32> {
    let is_seen = dot(normalize(view.world_position - in.world), in.normal) > 0.9;
    return vec4<f32>(0.0, select(0.0, 1.0, is_seen), 0.0, 1.0);
}
";

#[test]
fn a_fragment_function_of_ones_own_is_drawn() {
    let mut app = app();
    run(&mut app);
    assert_eq!(middle(&mut app), [0, 0, 0, 255], "before there is a surface");
    let wall = Tessellated::new(Wall { surface: SURFACE, fragment: GREEN });
    let entity = app.world_mut().spawn(wall).id();
    run(&mut app);
    assert_eq!(middle(&mut app), [0, 255, 0, 255], "green, facing the camera");
    app.world_mut().entity_mut(entity).insert(Visibility::Hidden);
    run(&mut app);
    assert_eq!(middle(&mut app), [0, 0, 0, 255], "hidden");
    app.world_mut().despawn(entity);
    run(&mut app);
    assert_eq!(middle(&mut app), [0, 0, 0, 255], "gone");
}

#[test]
fn wrong_wgsl_is_not_drawn_and_ends_nothing() {
    let mut app = app();
    let broken =
        Wall { surface: "fn hull(number: u32) -> QuadFactors { nonsense }", fragment: GREEN };
    app.world_mut().spawn(Tessellated::new(broken));
    let right = Tessellated::new(Wall { surface: SURFACE, fragment: GREEN });
    app.world_mut().spawn((right, Transform::from_xyz(0.0, 0.0, -0.5)));
    run(&mut app);
    assert_eq!(middle(&mut app), [0, 255, 0, 255], "the other one is drawn");
}

/// As when the text of a shape is loaded again from its file.
#[test]
fn a_new_text_replaces_the_one_that_was_drawn() {
    let mut app = app();
    let entity = app.world_mut().spawn_empty().id();
    let red = GREEN.replace("(0.0, select(0.0, 1.0, is_seen), 0.0", "(1.0, 0.0, 0.0").leak();
    let wider = SURFACE.replace("uv - 0.5", "2.0 * uv - 1.0").leak();
    let broken = SURFACE.replace("tess_place(number)", "tess_place(uv)").leak();
    for (surface, fragment, expected) in [
        (SURFACE, GREEN, [0, 255, 0, 255]),
        (SURFACE, red, [255, 0, 0, 255]),
        (broken, red, [0, 0, 0, 255]),
        (wider, red, [255, 0, 0, 255]),
        (SURFACE, GREEN, [0, 255, 0, 255]),
    ] {
        app.world_mut().entity_mut(entity).insert(Tessellated::new(Wall { surface, fragment }));
        run(&mut app);
        assert_eq!(middle(&mut app), expected, "{surface}{fragment}");
        let covered = picture(&mut app).iter().filter(|pixel| **pixel == expected).count() as u32;
        let is_wide = surface == wider;
        assert!(is_wide == (covered > SIZE * SIZE / 2) || surface == broken, "{covered} pixels");
    }
}

/// The points of a stage: patch, u and v.
fn points_of(app: &App, stage: &TessellationStage, count: usize) -> Vec<(u32, [f32; 2])> {
    let world = app.sub_app(RenderApp).world();
    let device = world.resource::<RenderDevice>().wgpu_device().clone();
    let queue = world.resource::<RenderQueue>();
    let points = stage.vertices().expect("they are stored");
    let size = 8 * count as u64;
    let usage = wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST;
    let staging = device.create_buffer(&wgpu::BufferDescriptor {
        label: None,
        size,
        usage,
        mapped_at_creation: false,
    });
    let mut encoder = device.create_command_encoder(&Default::default());
    encoder.copy_buffer_to_buffer(&points, 0, &staging, 0, size);
    queue.submit([encoder.finish()]);
    staging.map_async(wgpu::MapMode::Read, .., |outcome| outcome.expect("it can be mapped"));
    device.poll(wgpu::PollType::wait_indefinitely()).expect("the device answers");
    let view = staging.get_mapped_range(..).expect("it is mapped");
    let words: Vec<[u32; 2]> = bytemuck::pod_collect_to_vec(&view);
    let unpack = |[low, high]: [u32; 2]| {
        let [u, v] = [low & 0x1_ffff, low >> 17 | (high & 3) << 15];
        (high >> 2, [u, v].map(|bits| bits as f32 / 65536.0))
    };
    words.into_iter().map(unpack).collect()
}

/// The points that the CPU makes for a uniform factor: patch, u and v.
fn expected(map: &HeightField, config: Config, factor: f32) -> Vec<(u32, [f32; 2])> {
    let factors = vec![PatchFactors::uniform(Domain::Quad, factor); map.patches() as usize];
    let mut made = Vec::new();
    let keep = |patch, points: &[[f32; 2]], _: &mut _| {
        made.extend(points.iter().map(|&uv| (patch, uv)));
    };
    Tessellators::default().run(config, &factors, keep).expect("it fits");
    made
}

#[test]
fn both_ways_have_the_same_domain_points() {
    let map = HeightField::new(UVec2::splat(2), vec![0.0; 4]).expect("four texels");
    let map = map.with_patches(UVec2::new(3, 2)).expect("six patches");
    let mut app = app();
    let surface = Tessellated::new(map.clone());
    let config = surface.config();
    // The rectangle is level, so the camera sees its edge; no patch is culled.
    let entity = app.world_mut().spawn(surface).id();
    for factor in [2.7, 5.3, 17.01] {
        let rule = LevelOfDetail::Uniform(factor);
        let mut entity = app.world_mut().entity_mut(entity);
        entity.get_mut::<Tessellated>().expect("it is there").detail = rule;
        run(&mut app);
        let stages = app.sub_app(RenderApp).world().resource::<Stages>();
        let stage = stages.first().expect("there is one");
        let expected = expected(&map, config, factor);
        let observed = points_of(&app, stage, expected.len());
        assert_eq!(observed, expected, "factor {factor}");
        let other = self::expected(&map, config, factor + 0.01);
        assert_ne!(observed, other, "a hundredth more would be seen");
    }
}
