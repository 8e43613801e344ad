//! The terrain without buffers of points and indices: see README.md beside this file.
#![expect(clippy::float_arithmetic, clippy::cast_precision_loss, reason = "heights are floats")]

#[path = "../shared/app.rs"]
mod app;
#[path = "../shared/bindings.rs"]
mod bindings;
#[path = "../shared/camera.rs"]
mod camera;
#[allow(dead_code, reason = "nothing is measured here")]
#[path = "../terrain/terrain.rs"]
mod terrain;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let args = app::Args::from_command_line()?.or("points", "none");
    app::run::<terrain::Terrain>(args)
}
