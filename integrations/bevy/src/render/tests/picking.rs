//! Pointers over surfaces.

use super::{SIZE, Target, run};
use crate::{HeightField, Tessellated};
use bevy::camera::NormalizedRenderTarget;
use bevy::math::ops;
use bevy::picking::backend::{HitData, PointerHits};
use bevy::picking::pointer::{Location, PointerId, PointerLocation};
use bevy::prelude::*;
use bevy::window::PrimaryWindow;
use std::f32::consts::{FRAC_PI_2, FRAC_PI_8};

/// [`app`] with a window, without which Bevy's pointers do not look at an image.
fn app() -> App {
    let mut app = super::app();
    app.world_mut().spawn(PrimaryWindow);
    app
}

/// The hits at a place of the picture, nearest first: entity, place, normal.
fn hits(app: &mut App, position: Vec2) -> Vec<(Entity, Vec3, Vec3)> {
    let target = NormalizedRenderTarget::Image(app.world().resource::<Target>().0.clone().into());
    let location = PointerLocation::new(Location { target, position });
    let pointer = app.world_mut().spawn((PointerId::Touch(7), location)).id();
    app.world_mut().resource_mut::<Messages<PointerHits>>().clear();
    app.update();
    let mut messages = app.world_mut().resource_mut::<Messages<PointerHits>>();
    let mut picks: Vec<_> = messages.drain().flat_map(|hits| hits.picks).collect();
    app.world_mut().despawn(pointer);
    picks.sort_by(|(_, a), (_, b)| a.depth.total_cmp(&b.depth));
    let told = |(entity, hit): (Entity, HitData)| {
        (entity, hit.position.expect("it is known"), hit.normal.expect("it is known"))
    };
    picks.into_iter().map(told).collect()
}

/// The tolerance: places in height maps are rounded to 1/256 of a texel, which is at most 1/4096 in
/// height on the slope.
fn assert_near(observed: Vec3, expected: Vec3, what: &str) {
    let off = observed.distance(expected);
    assert!(off < 1.0 / 4000.0, "{what}: {observed}, expected {expected}");
}

#[test]
fn pointers_hit_a_slope_and_what_is_behind_it() {
    let mut app = app();
    let slope = (0..64).map(|i| (i % 8) as f32 / 8.0).collect();
    let slope = HeightField::new(UVec2::splat(8), slope).expect("64 texels");
    let facing = Transform::from_rotation(Quat::from_rotation_x(FRAC_PI_2));
    let slope = app.world_mut().spawn((Tessellated::new(slope), facing)).id();
    let level = HeightField::new(UVec2::ONE, vec![0.0]).expect("one texel");
    let level = level.with_size(Vec3::new(1.8, 1.0, 1.8));
    let level = (Tessellated::new(level), facing.with_translation(-0.5 * Vec3::Z));
    let level = app.world_mut().spawn(level).id();
    run(&mut app);
    for position in [Vec2::new(32.0, 32.0), Vec2::new(27.3, 38.1), Vec2::new(41.7, 21.9)] {
        let at = (2.0 * position / SIZE as f32 - 1.0) * ops::tan(FRAC_PI_8);
        // The slope is z = x + 7/16.
        let away = (2.0 - 7.0 / 16.0) / (1.0 + at.x);
        let hits = hits(&mut app, position);
        let [(first, place, normal), (second, behind, _)] = hits[..] else {
            panic!("{position}: {hits:?}");
        };
        assert_eq!([first, second], [slope, level], "{position}");
        assert_near(place, Vec3::new(at.x * away, -at.y * away, 2.0 - away), "the slope");
        assert_near(normal, Vec3::new(-1.0, 0.0, 1.0).normalize(), "its normal");
        assert_near(behind, Vec3::new(2.5 * at.x, -2.5 * at.y, -0.5), "behind it");
    }
    let beside: Vec<_> = hits(&mut app, Vec2::new(32.0, 58.3)).iter().map(|hit| hit.0).collect();
    assert_eq!(beside, [level], "beside the slope");
    assert_eq!(hits(&mut app, Vec2::new(32.0, 62.1)), [], "beside both");
    app.world_mut().entity_mut(slope).insert(Pickable::IGNORE);
    let left: Vec<_> = hits(&mut app, Vec2::new(32.0, 32.0)).iter().map(|hit| hit.0).collect();
    assert_eq!(left, [level], "what is not to be picked");
}

#[test]
fn the_nearest_of_two_ridges_is_hit() {
    let mut app = app();
    let ridges = vec![0.0, 0.0, 0.5, 0.0, 0.0, 0.5, 0.0, 0.0];
    let ridges = HeightField::new(UVec2::new(1, 8), ridges).expect("8 texels");
    let ridges = ridges.with_patches(UVec2::new(1, 2)).expect("two patches");
    let at = Transform::from_xyz(0.0, -0.25, 0.0);
    let ridges = app.world_mut().spawn((Tessellated::new(ridges), at)).id();
    run(&mut app);
    let hits = hits(&mut app, Vec2::new(32.0, 32.0));
    let [(entity, place, normal)] = hits[..] else { panic!("{hits:?}") };
    assert_eq!(entity, ridges, "there is nothing else");
    assert_near(place, Vec3::new(0.0, 0.0, 0.25), "the ridge in front");
    assert_near(normal, Vec3::new(0.0, 1.0, 1.0).normalize(), "its normal");
}
