//! Terrain, characters, a teapot, stones, light and the camera's flight.

use crate::args::Args;
use crate::water::Water;
use crate::wool::{self, Wool};
use crate::{gltf, hills};
use bevy::core_pipeline::tonemapping::Tonemapping;
use bevy::light::NotShadowCaster;
use bevy::math::ops;
use bevy::pbr::{DistanceFog, FogFalloff};
use bevy::prelude::*;
use bevy_tess::{
    BezierPatches, GroundColors, HeightField, LevelOfDetail, PointNormalMesh, Shape, TessValues,
    Tessellated,
};
use std::f32::consts::{FRAC_PI_2, TAU};
use std::sync::Arc;
use tess_surface::{BezierPatch, teapot};

/// Texels along each side of the height map.
const TEXELS: u32 = 512;
/// The terrain's extent.
const SIZE: Vec3 = Vec3::new(64.0, 9.0, 64.0);
/// The height of the water.
const WATER: f32 = 2.6;
const CHARACTERS: u16 = 50;
const STONES: u16 = 12;

pub(crate) fn set_up(
    mut commands: Commands,
    args: Res<Args>,
    mut meshes: ResMut<Assets<Mesh>>,
    mut materials: ResMut<Assets<StandardMaterial>>,
) -> Result {
    let factors = LevelOfDetail::Pixels(args.pixels);
    let ground = ground()?;
    for number in 0..CHARACTERS {
        let at = ground.surface_at(place(number));
        let nods = (Moving::Head(f32::from(number)), TessValues::default());
        let (character, wool) = character(number)?;
        let wool = MeshMaterial3d(materials.add(wool));
        commands.spawn((character.with_detail(factors), wool, standing(number, at), nods));
    }
    let base_color = Color::srgb(0.25, 0.4, 0.75);
    let glaze = StandardMaterial { base_color, perceptual_roughness: 0.25, ..default() };
    let glaze = MeshMaterial3d(materials.add(glaze));
    commands.spawn((teapot()?.with_detail(factors), glaze, at_the_flight(&ground)));
    let stone = meshes.add(Cuboid::new(0.8, 5.0, 0.8));
    let grey = materials.add(Color::srgb(0.5, 0.5, 0.55));
    for number in 0..STONES {
        let at = ground.surface_at(place(number + 1000)) + 1.5 * Vec3::Y;
        let (mesh, material) = (Mesh3d(stone.clone()), MeshMaterial3d(grey.clone()));
        commands.spawn((mesh, material, Transform::from_translation(at)));
    }
    let earth = StandardMaterial { perceptual_roughness: 0.9, reflectance: 0.2, ..default() };
    let earth = MeshMaterial3d(materials.add(earth));
    commands.spawn((Tessellated::new(ground).with_detail(factors), earth));
    let deep = StandardMaterial {
        base_color: Color::srgba(0.1, 0.3, 0.4, 0.7),
        alpha_mode: AlphaMode::Blend,
        perceptual_roughness: 0.3,
        ..default()
    };
    let deep = MeshMaterial3d(materials.add(deep));
    let water = (Tessellated::new(Water(SIZE.x)).with_detail(factors), deep);
    let waves = (Moving::Water, TessValues::default(), NotShadowCaster);
    commands.spawn((water, waves, Transform::from_xyz(0.0, WATER, 0.0)));
    let sun = DirectionalLight { illuminance: 9000.0, shadow_maps_enabled: true, ..default() };
    commands.spawn((sun, Transform::from_xyz(0.6, 0.6, 0.5).looking_at(Vec3::ZERO, Vec3::Y)));
    let sky = Color::srgb(0.66, 0.76, 0.88);
    let behind = if args.above { Color::srgb(1.0, 0.0, 1.0) } else { sky };
    commands.insert_resource(ClearColor(behind));
    commands.spawn((
        Camera3d::default(),
        Projection::Perspective(PerspectiveProjection { fov: 1.17, ..default() }),
        // A tone mapping that needs no texture.
        Tonemapping::AcesFitted,
        DistanceFog {
            color: sky,
            falloff: FogFalloff::Exponential { density: 0.014 },
            ..default()
        },
        AmbientLight { brightness: 300.0, ..default() },
        flight(&args, args.seconds),
    ));
    Ok(())
}

fn ground() -> Result<HeightField> {
    let colors = GroundColors {
        low: Vec3::new(0.10, 0.22, 0.06),
        high: Vec3::new(0.80, 0.82, 0.85),
        steep: Vec3::new(0.22, 0.17, 0.12),
    };
    let map = HeightField::new(UVec2::splat(TEXELS), hills::heights(TEXELS))?;
    Ok(map.with_size(SIZE).with_colors(colors).with_patches(UVec2::splat(64))?)
}

/// A character in one of five colours. All characters share one shape.
fn character(number: u16) -> Result<(Tessellated, StandardMaterial)> {
    static SHAPE: std::sync::OnceLock<Arc<dyn Shape>> = std::sync::OnceLock::new();
    let mesh = gltf::animal();
    let made = PointNormalMesh::new(&mesh.positions, &mesh.normals, mesh.triangles)?;
    let shape = SHAPE.get_or_init(|| Arc::new(Wool(made)));
    let hue = 72.0 * f32::from(number % 5);
    let base_color = Color::hsl(hue, 0.25, 0.8);
    let wool = StandardMaterial { base_color, perceptual_roughness: 0.8, ..default() };
    Ok((Tessellated::shared(Arc::clone(shape)), wool))
}

/// 32 patches of control points.
fn teapot() -> Result<Tessellated> {
    let net = |patch: BezierPatch| patch.points.map(|row| row.map(|p| [p.x, p.y, p.z]));
    let patches = teapot::patches().into_iter().map(net).collect();
    Ok(Tessellated::new(BezierPatches::new(patches)?))
}

/// A place that the camera flies past.
fn at_the_flight(ground: &HeightField) -> Transform {
    let at = ground.surface_at(Vec2::new(0.54, 0.22));
    let upright = Quat::from_rotation_x(-FRAC_PI_2);
    Transform::from_translation(at).with_rotation(upright).with_scale(Vec3::splat(0.8))
}

/// The model's z is up, Bevy's y.
fn standing(number: u16, at: Vec3) -> Transform {
    let turned = Quat::from_rotation_y(TAU * spread(number, 0.754_878));
    let upright = Quat::from_rotation_x(-FRAC_PI_2);
    Transform::from_translation(at).with_rotation(turned * upright).with_scale(Vec3::splat(0.6))
}

/// Places all over the terrain, evenly spread.
fn place(number: u16) -> Vec2 {
    let at = Vec2::new(spread(number, 0.754_878), spread(number, 0.569_84));
    0.1 + 0.8 * at
}

fn spread(number: u16, step: f32) -> f32 {
    (0.5 + step * f32::from(number)).fract()
}

/// The camera's place after a number of seconds: on a circle over the terrain, or above it.
fn flight(args: &Args, seconds: f32) -> Transform {
    if args.above {
        return Transform::from_xyz(0.0, 24.0, 0.0).looking_at(Vec3::ZERO, Vec3::NEG_Z);
    }
    let angle = 0.12 * seconds - 2.0;
    let at = |angle: f32, radius: f32, height| {
        Vec3::new(radius * ops::cos(angle), height, radius * ops::sin(angle))
    };
    Transform::from_translation(at(angle, 24.0, 9.0))
        .looking_at(at(angle + 0.9, 16.0, 4.0), Vec3::Y)
}

/// Moves the camera, except for a screenshot.
pub(crate) fn fly(
    time: Res<Time>,
    args: Res<Args>,
    mut cameras: Query<&mut Transform, With<Camera3d>>,
) {
    for mut camera in &mut cameras {
        camera.set_if_neq(flight(&args, seconds(&args, &time)));
    }
}

/// The time in seconds; it stands still for a screenshot.
fn seconds(args: &Args, time: &Time) -> f32 {
    match args.screenshot {
        Some(_) => args.seconds,
        None => args.seconds + time.elapsed_secs(),
    }
}

/// The part of the scene that moves by values of each frame.
#[derive(Clone, Copy, Component, Debug)]
pub(crate) enum Moving {
    Water,
    /// The seconds by which it is ahead of the others.
    Head(f32),
}

/// Moves the water and the heads.
pub(crate) fn animate(
    time: Res<Time>,
    args: Res<Args>,
    mut surfaces: Query<(&Moving, &mut TessValues)>,
) {
    let seconds = seconds(&args, &time);
    for (moving, mut values) in &mut surfaces {
        values.set_if_neq(TessValues(match moving {
            Moving::Water => vec![seconds],
            Moving::Head(ahead) => wool::nod(seconds + ahead),
        }));
    }
}
