//! Shadow maps and prepasses.

use super::{SIZE, SURFACE, Wall, app, middle, picture, run};
use crate::{HeightField, TessBackend, TessSettings, Tessellated};
use bevy::core_pipeline::prepass::{DepthPrepass, MotionVectorPrepass, NormalPrepass};
use bevy::light::{NotShadowCaster, NotShadowReceiver};
use bevy::math::ops;
use bevy::prelude::*;
use std::f32::consts::FRAC_PI_2;

/// A square that faces the camera of [`app`].
pub(super) fn square(at: Vec3) -> impl Bundle {
    let level = HeightField::new(UVec2::ONE, vec![0.0]).expect("one texel");
    let facing = Quat::from_rotation_x(FRAC_PI_2);
    (Tessellated::new(level), Transform::from_translation(at).with_rotation(facing))
}

/// The brightness of the middle of a square if another one is behind the camera, towards the light:
/// in general, if the other casts no shadow, if the first receives none, and without the other.
fn brightness(backend: TessBackend, light: fn(&mut World) -> Entity) -> [u8; 4] {
    let mut app = app();
    app.insert_resource(TessSettings { backend, ..default() });
    let light = light(app.world_mut());
    let at = Transform::from_xyz(6.0, 0.0, 6.0).looking_at(Vec3::ZERO, Vec3::Y);
    app.world_mut().entity_mut(light).insert(at);
    let receiver = app.world_mut().spawn(square(Vec3::ZERO)).id();
    let caster = app.world_mut().spawn(square(Vec3::new(3.0, 0.0, 3.0))).id();
    let mut seen = |change: fn(&mut World, Entity, Entity)| {
        change(app.world_mut(), receiver, caster);
        run(&mut app);
        middle(&mut app)[1]
    };
    [
        seen(|_, _, _| {}),
        seen(|world, _, caster| {
            world.entity_mut(caster).insert(NotShadowCaster);
        }),
        seen(|world, receiver, caster| {
            world.entity_mut(caster).remove::<NotShadowCaster>();
            world.entity_mut(receiver).insert(NotShadowReceiver);
        }),
        seen(|world, receiver, caster| {
            world.entity_mut(receiver).remove::<NotShadowReceiver>();
            world.despawn(caster);
        }),
    ]
}

#[test]
fn shadows_fall_from_what_the_camera_does_not_see() {
    let sun = |world: &mut World| {
        world.spawn(DirectionalLight { shadow_maps_enabled: true, ..default() }).id()
    };
    let lamp = |world: &mut World| {
        world.spawn(PointLight { shadow_maps_enabled: true, intensity: 1e7, ..default() }).id()
    };
    for (name, light) in [("sun", sun as fn(&mut World) -> Entity), ("lamp", lamp)] {
        for backend in [TessBackend::Auto, TessBackend::Cpu] {
            let [shaded, lit @ ..] = brightness(backend, light);
            assert!(lit[0] > shaded.saturating_add(60), "{name}, {backend:?}: {shaded}, {lit:?}");
            assert_eq!(lit, [lit[0]; 3], "{name}, {backend:?}: as without the other square");
        }
    }
}

/// The motion to the right, the part of the normal towards the camera, and whether the depth is the
/// prepass's.
const STORED: &str = "
import bevy_pbr::prepass::utils::{prepass_depth, prepass_motion_vector, prepass_normal};

@fragment
fn fragment(in: Vertex) -> @location(0) vec4<f32> {
    let motion = abs(prepass_motion_vector(in.position, 0u).x);
    let is_same = prepass_depth(in.position, 0u) == in.position.z;
    return vec4<f32>(8.0 * motion, prepass_normal(in.position, 0u).z, select(0.0, 1.0, is_same), 1.0);
}
";

#[test]
fn a_prepass_has_the_depth_the_normal_and_the_motion() {
    let mut app = app();
    let world = app.world_mut();
    let camera = world.query_filtered::<Entity, With<Camera3d>>().single(world).expect("one");
    world.entity_mut(camera).insert((DepthPrepass, NormalPrepass, MotionVectorPrepass, Msaa::Off));
    let wall = Tessellated::new(Wall { surface: SURFACE, fragment: STORED });
    let tilted = Transform::from_rotation(Quat::from_rotation_x(0.7));
    let wall = world.spawn((wall, tilted)).id();
    app.add_systems(Update, move |mut all: Query<&mut Transform>, mut times: Local<u32>| {
        *times += 1;
        all.get_mut(wall).expect("it is there").translation.x = 0.1 * (*times % 2) as f32;
    });
    run(&mut app);
    let [motion, normal, _, _] = middle(&mut app);
    // At distance 1, the picture is as high as twice the tangent of half the angle.
    let moved = 0.1 / 2.0 / (2.0 * ops::tan(std::f32::consts::FRAC_PI_8));
    for (seen, expected) in [(motion, 8.0 * moved), (normal, ops::cos(0.7))] {
        let expected = Srgba::from(LinearRgba::rgb(expected, 0.0, 0.0)).to_u8_array()[0];
        assert!(seen.abs_diff(expected) <= 2, "{seen}, expected {expected}");
    }
    let drawn = picture(&mut app).into_iter().filter(|pixel| pixel[1] > 0);
    let (same, other): (Vec<_>, Vec<_>) = drawn.partition(|pixel| pixel[2] == 255);
    assert_eq!(other.len(), 0, "of {} pixels", same.len());
    assert!(same.len() as u32 > SIZE * SIZE / 20, "{} pixels are drawn", same.len());
}
