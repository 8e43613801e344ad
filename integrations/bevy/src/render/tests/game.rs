//! The README's game: tiles come and go without cracks or traces, in two materials, with shadows.

use super::{Target, app, picture, run};
use bevy::camera::RenderTarget;
use bevy::core_pipeline::tonemapping::{DebandDither, Tonemapping};

include!("../../../examples/game/game.rs");

/// The game, drawn into the tests' image, with the camera at `z`.
fn played(z: f32) -> App {
    let mut app = app();
    let world = app.world_mut();
    let own = world.query_filtered::<Entity, With<Camera3d>>().single(world).expect("one");
    world.despawn(own);
    game(&mut app);
    app.update();
    let target = app.world().resource::<Target>().0.clone();
    let plain = (Tonemapping::None, DebandDither::Disabled);
    let camera = camera(&mut app);
    app.world_mut().entity_mut(camera).insert((RenderTarget::Image(target.into()), plain));
    place(&mut app, |camera| camera.translation.z = z);
    run(&mut app);
    app
}

fn camera(app: &mut App) -> Entity {
    let world = app.world_mut();
    world.query_filtered::<Entity, With<Camera3d>>().single(world).expect("the game's")
}

fn place(app: &mut App, change: impl Fn(&mut Transform)) {
    let camera = camera(app);
    change(&mut app.world_mut().get_mut::<Transform>(camera).expect("a camera has one"));
}

/// The pixels that differ.
fn differing(a: &[[u8; 4]], b: &[[u8; 4]]) -> usize {
    a.iter().zip(b).filter(|(a, b)| a != b).count()
}

#[test]
fn the_readme_has_the_game() {
    let [readme, game] =
        [include_str!("../../../README.md"), include_str!("../../../examples/game/game.rs")];
    assert!(
        readme.contains(&format!("```rust,no_run\n{game}```")),
        "copy the game into the README"
    );
}

#[test]
fn the_game_has_ground_water_and_shadows() {
    let mut app = played(0.0);
    let lit = picture(&mut app);
    let [ground, water] = [1, 2].map(|channel| {
        let is_it = |pixel: &&[u8; 4]| (0..3).all(|other| pixel[other] <= pixel[channel]);
        lit.iter().filter(is_it).filter(|pixel| pixel[channel] > 20).count()
    });
    assert!(ground > 300 && water > 100, "{ground} pixels of ground, {water} of water");
    let world = app.world_mut();
    for mut sun in world.query::<&mut DirectionalLight>().iter_mut(world) {
        sun.shadow_maps_enabled = false;
    }
    run(&mut app);
    let shaded = differing(&lit, &picture(&mut app));
    assert!(shaded > 50, "only {shaded} pixels are in the shadow");
}

#[test]
fn tiles_of_the_game_come_and_go_without_a_trace() {
    let mut app = played(0.0);
    app.world_mut().resource_mut::<ButtonInput<KeyCode>>().press(KeyCode::ArrowUp);
    let start = picture(&mut app);
    run(&mut app);
    place(&mut app, |camera| assert!(camera.translation.z < 0.0, "it walks ahead: {camera:?}"));
    app.world_mut().resource_mut::<ButtonInput<KeyCode>>().release_all();
    place(&mut app, |camera| camera.translation.z = -200.0);
    run(&mut app);
    let observed = picture(&mut app);
    assert!(differing(&observed, &start) > 1000, "other hills");
    let fresh = picture(&mut played(-200.0));
    assert_eq!(differing(&observed, &fresh), 0, "as if the first tiles had never been");
}

#[test]
fn tiles_of_the_game_have_no_cracks() {
    let mut app = played(0.0);
    app.insert_resource(ClearColor(Color::srgb(1.0, 0.0, 1.0)));
    let world = app.world_mut();
    // Under the lakes a crack would not be seen.
    let lakes = world.query_filtered::<Entity, With<ChildOf>>().iter(world).collect::<Vec<_>>();
    assert_eq!(lakes.len(), 25, "one for each tile");
    for lake in lakes {
        world.entity_mut(lake).insert(Visibility::Hidden);
    }
    // So steep that no sky is seen. A gap is upright, so it is not seen from straight above.
    for [x, z] in [[1.0, 0.0], [-0.6, 0.8], [0.0, -1.0]] {
        place(&mut app, |camera| {
            *camera = camera.looking_to(Vec3::new(x, -1.0, z), Vec3::Y);
        });
        run(&mut app);
        let is_hole = |[red, green, blue, _]: &[u8; 4]| red.min(blue) > &green.saturating_add(40);
        let holes = picture(&mut app).iter().filter(|pixel| is_hole(pixel)).count();
        assert_eq!(holes, 0, "one sees through the ground towards {x}, {z}");
    }
}
