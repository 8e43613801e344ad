//! Materials: textures, normal maps and alpha look the same on the GPU and on the CPU.

use super::passes::square;
use super::{SIZE, SURFACE, Wall, app, middle, picture, run};
use crate::{HeightField, TessBackend, TessSettings, Tessellated};
use bevy::asset::RenderAssetUsages;
use bevy::core_pipeline::prepass::{DepthPrepass, NormalPrepass};
use bevy::image::ImageSampler;
use bevy::light::NotShadowReceiver;
use bevy::math::ops;
use bevy::pbr::{ExtendedMaterial, MaterialExtension};
use bevy::prelude::*;
use bevy::render::render_resource::{AsBindGroup, Extent3d, TextureDimension, TextureFormat};
use std::f32::consts::FRAC_PI_2;

/// An image of two texels, left and right.
fn image(world: &mut World, texels: [[u8; 4]; 2], format: TextureFormat) -> Handle<Image> {
    let size = Extent3d { width: 2, height: 1, depth_or_array_layers: 1 };
    let usage = RenderAssetUsages::default();
    let bytes = texels.as_flattened();
    let mut image = Image::new_fill(size, TextureDimension::D2, bytes, format, usage);
    image.sampler = ImageSampler::nearest();
    world.resource_mut::<Assets<Image>>().add(image)
}

fn add(world: &mut World, material: StandardMaterial) -> MeshMaterial3d<StandardMaterial> {
    MeshMaterial3d(world.resource_mut::<Assets<StandardMaterial>>().add(material))
}

/// Red to the left, with an alpha of 0.2, and green to the right, with 0.8.
fn half(world: &mut World, alpha_mode: AlphaMode) -> MeshMaterial3d<StandardMaterial> {
    let texels = [[255, 0, 0, 51], [0, 255, 0, 204]];
    let base_color_texture = Some(image(world, texels, TextureFormat::Rgba8Unorm));
    add(world, StandardMaterial { base_color_texture, alpha_mode, unlit: true, ..default() })
}

/// Compares the pictures of GPU and CPU, which are the same except for a few pixels on edges, and
/// returns the GPU's.
fn same(name: &str, set_up: impl Fn(&mut World)) -> Vec<[u8; 4]> {
    let [gpu, cpu] = [TessBackend::Auto, TessBackend::Cpu].map(|backend| {
        let mut app = app();
        app.insert_resource(TessSettings { backend, ..default() });
        set_up(app.world_mut());
        run(&mut app);
        picture(&mut app)
    });
    let is_off = |(a, b): &(&[u8; 4], &[u8; 4])| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > 3);
    let off = gpu.iter().zip(&cpu).filter(is_off).count();
    assert!(off <= 8, "{name}: {off} pixels differ");
    gpu
}

/// The pixels to the left and to the right of the middle.
fn sides(picture: &[[u8; 4]]) -> [[u8; 3]; 2] {
    let middle = SIZE * SIZE / 2 + SIZE / 2;
    [middle - 8, middle + 8].map(|at| picture[at as usize].first_chunk().copied().unwrap_or([0; 3]))
}

#[test]
fn textures_have_colours_and_alpha() {
    let linear = |rgb: [f32; 3]| {
        let [r, g, b] = rgb;
        Srgba::from(LinearRgba::rgb(r, g, b)).to_u8_array_no_alpha()
    };
    let blue = [0, 0, 255];
    for (mode, expected) in [
        (AlphaMode::Opaque, [[255, 0, 0], [0, 255, 0]]),
        (AlphaMode::Mask(0.5), [blue, [0, 255, 0]]),
        (AlphaMode::Blend, [linear([0.2, 0.0, 0.8]), linear([0.0, 0.8, 0.2])]),
    ] {
        let seen = same(&format!("{mode:?}"), |world| {
            let material = half(world, mode);
            world.spawn((square(Vec3::ZERO), material));
            let base_color = Color::srgb(0.0, 0.0, 1.0);
            let behind = StandardMaterial { base_color, unlit: true, ..default() };
            let behind = add(world, behind);
            world.spawn((square(Vec3::new(0.0, 0.0, -0.2)), behind));
        });
        let seen = sides(&seen);
        let mut channels = seen.as_flattened().iter().zip(expected.as_flattened());
        assert!(channels.all(|(a, b)| a.abs_diff(*b) <= 1), "{mode:?}: {seen:?}, {expected:?}");
    }
}

#[test]
fn what_is_behind_is_blended_first() {
    let blend = |world: &mut World, base_color| {
        let alpha_mode = AlphaMode::Blend;
        add(world, StandardMaterial { base_color, alpha_mode, unlit: true, ..default() })
    };
    let [near_first, far_first] = [[0.1, -0.1], [-0.1, 0.1]].map(|depths| {
        let seen = same("two", |world| {
            for depth in depths {
                let red = if depth > 0.0 { 1.0 } else { 0.0 };
                let material = blend(world, Color::srgba(red, 0.0, 1.0 - red, 0.5));
                world.spawn((square(Vec3::new(0.0, 0.0, depth)), material));
            }
        });
        sides(&seen)[0]
    });
    assert_eq!(near_first, far_first, "whichever was there first");
    let [red, _, blue] = near_first;
    assert!(red > blue + 40, "red is near: {near_first:?}");
}

#[test]
fn a_mask_casts_the_shadow_of_what_is_there() {
    let cast = |mode| {
        same("shadow", |world| {
            let sun = DirectionalLight { shadow_maps_enabled: true, ..default() };
            world.spawn((sun, Transform::from_xyz(6.0, 0.0, 6.0).looking_at(Vec3::ZERO, Vec3::Y)));
            world.spawn(square(Vec3::ZERO));
            let material = half(world, mode);
            // This square, which casts the shadow, is behind the camera.
            world.spawn((square(Vec3::new(3.0, 0.0, 3.0)), material, NotShadowReceiver));
        })
    };
    let [[open, ..], [shaded, ..]] = sides(&cast(AlphaMode::Mask(0.5)));
    assert!(open > shaded + 60, "the left half lets light through: {open}, {shaded}");
    let [[left, ..], [right, ..]] = sides(&cast(AlphaMode::Opaque));
    assert!(left.abs_diff(right) < 9, "opaque, neither does: {left}, {right}");
}

/// Hills that face the camera, lit from the right, with this normal to the left and its mirror
/// image to the right.
fn bumpy(world: &mut World, normal: Option<[u8; 4]>, has_prepass: bool) {
    world.spawn((
        DirectionalLight { illuminance: 2000.0, ..default() },
        Transform::from_xyz(2.0, 1.0, 2.0).looking_at(Vec3::ZERO, Vec3::Y),
    ));
    let normal_map_texture = normal.map(|[x, y, z, w]| {
        image(world, [[x, y, z, w], [255 - x, 255 - y, z, w]], TextureFormat::Rgba8Unorm)
    });
    let material = StandardMaterial { normal_map_texture, perceptual_roughness: 0.9, ..default() };
    let material = add(world, material);
    let height = |at: u16| ops::sin(0.4 * f32::from(at % 16)) * ops::cos(0.3 * f32::from(at / 16));
    let hills = HeightField::new(UVec2::splat(16), (0..256).map(height).collect()).expect("256");
    let hills = Tessellated::new(hills.with_size(Vec3::new(1.0, 0.1, 1.0)));
    world.spawn((hills, material, Transform::from_rotation(Quat::from_rotation_x(FRAC_PI_2))));
    if has_prepass {
        let camera = world.query_filtered::<Entity, With<Camera3d>>().single(world).expect("one");
        world.entity_mut(camera).insert((DepthPrepass, NormalPrepass, Msaa::Off));
    }
}

#[test]
fn normal_maps_bend_the_light() {
    let light = |normal, has_prepass| {
        let seen = same(&format!("{normal:?}"), |world| bumpy(world, normal, has_prepass));
        sides(&seen).map(|[_, green, _]| green)
    };
    let plain = light(None, false);
    let along_u = light(Some([204, 128, 230, 255]), false);
    let along_v = light(Some([128, 204, 230, 255]), false);
    for [left, right] in [along_u, along_v] {
        let is_bent = left > plain[0] + 5 && right + 5 < plain[1];
        assert!(is_bent, "{along_u:?}, {along_v:?}, {plain:?}");
    }
    let through_prepass = light(Some([204, 128, 230, 255]), true);
    let near = |(a, b): (&u8, &u8)| a.abs_diff(*b) <= 4;
    let is_same = through_prepass.iter().zip(&along_u).all(near);
    assert!(is_same, "from the prepass: {through_prepass:?}, {along_u:?}");
}

/// The extension of a material of the user's own.
#[derive(Asset, AsBindGroup, Clone, Debug, TypePath)]
pub(super) struct Tint {
    #[uniform(100)]
    color: LinearRgba,
}

impl MaterialExtension for Tint {}

pub(super) type Tinted = ExtendedMaterial<StandardMaterial, Tint>;

const TINTED: &str = "
@group(3) @binding(100) var<uniform> tint: vec4<f32>;

@fragment
fn fragment(in: Vertex) -> @location(0) vec4<f32> {
    var pbr = tess_pbr_input(in);
    pbr.material.base_color *= tint;
    return tess_lit(pbr);
}
";

#[test]
fn an_extended_material_has_its_bindings() {
    let mut app = app();
    let base_color = Color::linear_rgb(1.0, 0.5, 0.0);
    let base = StandardMaterial { base_color, unlit: true, ..default() };
    let extension = Tint { color: LinearRgba::rgb(0.0, 1.0, 1.0) };
    let tinted = ExtendedMaterial { base, extension };
    let world = app.world_mut();
    let tinted = world.resource_mut::<Assets<Tinted>>().add(tinted);
    let wall = Tessellated::new(Wall { surface: SURFACE, fragment: TINTED });
    let mut wall = world.spawn((wall, MeshMaterial3d(tinted)));
    wall.remove::<MeshMaterial3d<StandardMaterial>>();
    run(&mut app);
    let [red, green, blue, _] = middle(&mut app);
    assert!(green.abs_diff(188) <= 1, "half of the green is left: {green}");
    assert_eq!([red, blue], [0; 2], "and nothing else");
}
