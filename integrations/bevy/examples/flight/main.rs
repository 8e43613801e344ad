//! A flight over a tessellated terrain with characters: see README.md in this folder.

mod args;
mod hud;
mod scene;
mod screenshot;
mod water;
mod wool;

#[allow(dead_code, reason = "the model is not written to a file here")]
#[path = "../../../../tess-wgpu/examples/character/gltf.rs"]
mod gltf;
#[path = "../../../../tess-wgpu/examples/shared/hills.rs"]
mod hills;

use args::Args;
use bevy::app::ScheduleRunnerPlugin;
use bevy::diagnostic::FrameTimeDiagnosticsPlugin;
use bevy::prelude::*;
use bevy::render::RenderPlugin;
use bevy::window::ExitCondition;
use bevy::winit::WinitPlugin;
use bevy_tess::{TessBackend, TessPlugin, TessSettings};
use std::process::ExitCode;
use std::time::Duration;

fn main() -> ExitCode {
    let args = match Args::from_command_line() {
        Ok(Some(args)) => args,
        Ok(None) => {
            println!("{}", args::HELP);
            return ExitCode::SUCCESS;
        }
        Err(problem) => {
            eprintln!("error: {problem}");
            return ExitCode::from(2);
        }
    };
    let mut app = App::new();
    let backend = if args.cpu { TessBackend::Cpu } else { TessBackend::Auto };
    app.insert_resource(TessSettings { backend, wireframe: args.wireframe });
    if args.screenshot.is_some() {
        app.add_plugins((without_window(), ScheduleRunnerPlugin::run_loop(Duration::ZERO)));
        app.add_systems(Startup, screenshot::set_up).add_systems(Update, screenshot::take);
    } else {
        app.add_plugins((DefaultPlugins, FrameTimeDiagnosticsPlugin::default()));
        app.add_systems(Startup, hud::set_up);
        app.add_systems(Update, (hud::press, hud::write.after(scene::fly)));
    }
    app.insert_resource(args);
    app.add_plugins(TessPlugin);
    app.add_systems(Startup, scene::set_up).add_systems(Update, (scene::fly, scene::animate));
    match app.run() {
        AppExit::Success => ExitCode::SUCCESS,
        AppExit::Error(_) => ExitCode::FAILURE,
    }
}

/// Bevy without a window; a frame waits for its pipelines.
fn without_window() -> impl PluginGroup {
    DefaultPlugins
        .set(WindowPlugin {
            primary_window: None,
            exit_condition: ExitCondition::DontExit,
            ..default()
        })
        .set(RenderPlugin { synchronous_pipeline_compilation: true, ..default() })
        .disable::<WinitPlugin>()
}
