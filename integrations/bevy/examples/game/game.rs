use bevy::math::ops::{cos, sin};
use bevy::platform::collections::HashMap;
use bevy::prelude::*;
use bevy_tess::{HeightField, TessPlugin, Tessellated};

/// The side of a tile, and the tiles in each direction from the camera.
const SIDE: f32 = 16.0;
const FAR: i32 = 2;

fn main() -> AppExit {
    App::new().add_plugins((DefaultPlugins, TessPlugin, game)).run()
}

fn game(app: &mut App) {
    app.init_resource::<Land>().add_systems(Startup, set_up);
    app.add_systems(Update, (walk, stream).chain());
}

/// The tiles, and what they are made of.
#[derive(Default, Resource)]
struct Land {
    tiles: HashMap<IVec2, Entity>,
    earth: Handle<StandardMaterial>,
    water: Handle<StandardMaterial>,
}

fn set_up(
    mut commands: Commands,
    mut land: ResMut<Land>,
    mut all: ResMut<Assets<StandardMaterial>>,
) {
    land.earth = all.add(Color::srgb(0.3, 0.5, 0.2));
    land.water = all.add(Color::srgb(0.1, 0.3, 0.6));
    let camera = Transform::from_xyz(0.0, 9.0, 0.0).looking_to(Vec3::new(0.0, -0.4, -1.0), Vec3::Y);
    commands.spawn((Camera3d::default(), camera));
    let sun = DirectionalLight { shadow_maps_enabled: true, ..default() };
    commands.spawn((sun, Transform::from_xyz(3.0, 1.0, 1.0).looking_at(Vec3::ZERO, Vec3::Y)));
}

/// The arrow keys move the camera.
fn walk(
    keys: Res<ButtonInput<KeyCode>>,
    time: Res<Time>,
    mut camera: Single<&mut Transform, With<Camera3d>>,
) {
    let held = |key| f32::from(u8::from(keys.pressed(key)));
    let right = held(KeyCode::ArrowRight) - held(KeyCode::ArrowLeft);
    let back = held(KeyCode::ArrowDown) - held(KeyCode::ArrowUp);
    camera.translation += 10.0 * time.delta_secs() * Vec3::new(right, 0.0, back);
}

/// Tiles that the camera comes near are spawned, those that it leaves despawned.
fn stream(
    mut commands: Commands,
    mut land: ResMut<Land>,
    camera: Single<&Transform, With<Camera3d>>,
) -> Result {
    let here = (camera.translation.xz() / SIDE).round().as_ivec2();
    let is_near = |tile: &IVec2| (*tile - here).abs().max_element() <= FAR;
    for (_, gone) in land.tiles.extract_if(|tile, _| !is_near(tile)) {
        commands.entity(gone).despawn();
    }
    for tile in (-FAR..=FAR).flat_map(|x| (-FAR..=FAR).map(move |z| here + IVec2::new(x, z))) {
        if !land.tiles.contains_key(&tile) {
            let lake = HeightField::new(UVec2::ONE, vec![1.5])?.with_patches(UVec2::ONE)?;
            let lake = Tessellated::new(lake.with_size(Vec3::new(SIDE, 1.0, SIDE)));
            let at =
                Transform::from_translation(SIDE * Vec3::new(tile.x as f32, 0.0, tile.y as f32));
            let ground = (Tessellated::new(hills(tile)?), MeshMaterial3d(land.earth.clone()), at);
            let new =
                commands.spawn((ground, children![(lake, MeshMaterial3d(land.water.clone()))]));
            land.tiles.insert(tile, new.id());
        }
    }
    Ok(())
}

/// 17 x 17 heights. Neighbours share those of their edge, so there are no cracks.
fn hills(tile: IVec2) -> Result<HeightField> {
    let height = |x, z| {
        let at = (16 * tile + IVec2::new(x, z)).as_vec2();
        2.0 + 1.5 * sin(0.3 * at.x) * cos(0.2 * at.y) + sin(0.07 * (at.x + at.y))
    };
    let heights = (0..17).flat_map(|z| (0..17).map(move |x| height(x, z)));
    Ok(HeightField::new(UVec2::splat(17), heights.collect())?.with_size(Vec3::new(SIDE, 1.0, SIDE)))
}
