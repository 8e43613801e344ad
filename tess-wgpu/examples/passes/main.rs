//! One frame's tessellation in several passes: see README.md beside this file.
#![expect(clippy::float_arithmetic, clippy::cast_precision_loss, reason = "a camera has floats")]

#[path = "../shared/app.rs"]
mod app;
#[path = "../shared/bindings.rs"]
mod bindings;
#[path = "../shared/camera.rs"]
mod camera;
mod show;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    app::run::<show::Passes>(app::Args::from_command_line()?)
}
