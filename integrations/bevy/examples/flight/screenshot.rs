//! A picture without a window.

use crate::args::Args;
use bevy::camera::RenderTarget;
use bevy::image::Image;
use bevy::prelude::*;
use bevy::render::render_resource::TextureFormat;
use bevy::render::view::screenshot::{Screenshot, ScreenshotCaptured, save_to_disk};
use bevy_tess::TessStats;

/// The frames in a row that must have the same number of triangles.
const STEADY: u32 = 4;
/// The frames after which the attempt is given up.
const PATIENCE: u32 = 300;

/// The image that the camera draws into.
#[derive(Debug, Resource)]
pub(crate) struct Target(Handle<Image>);

pub(crate) fn set_up(mut commands: Commands, args: Res<Args>, mut images: ResMut<Assets<Image>>) {
    let [width, height] = args.size;
    let image = Image::new_target_texture(width, height, TextureFormat::Rgba8UnormSrgb, None);
    commands.insert_resource(Target(images.add(image)));
}

/// Frames seen so far.
#[derive(Debug, Default)]
pub(crate) struct Progress {
    frames: u32,
    steady: u32,
    triangles: u64,
    is_taken: bool,
}

/// Gives the camera its target, waits until the number of triangles is steady, and takes the
/// picture.
pub(crate) fn take(
    mut commands: Commands,
    args: Res<Args>,
    target: Res<Target>,
    stats: Res<TessStats>,
    cameras: Query<Entity, (With<Camera3d>, Without<Targeted>)>,
    mut progress: Local<Progress>,
    mut exit: MessageWriter<AppExit>,
) {
    for camera in &cameras {
        commands.entity(camera).insert((RenderTarget::Image(target.0.clone().into()), Targeted));
    }
    progress.frames += 1;
    let triangles = stats.triangles();
    let is_same = triangles > 0 && triangles == progress.triangles;
    progress.steady = if is_same { progress.steady + 1 } else { 0 };
    progress.triangles = triangles;
    if progress.frames > PATIENCE {
        error!("the picture is not steady after {PATIENCE} frames: {triangles} triangles");
        exit.write(AppExit::error());
    }
    let Some(path) = args.screenshot.clone() else { return };
    if !progress.is_taken && progress.steady >= STEADY {
        progress.is_taken = true;
        let mut save = save_to_disk(path);
        commands.spawn(Screenshot::image(target.0.clone())).observe(
            move |captured: On<ScreenshotCaptured>, mut exit: MessageWriter<AppExit>| {
                save(captured);
                println!("{triangles} triangles");
                exit.write(AppExit::Success);
            },
        );
    }
}

/// A camera that has its target.
#[derive(Component, Debug)]
pub(crate) struct Targeted;
