//! A terrain to fly over: see README.md beside this file.
#![expect(clippy::float_arithmetic, clippy::cast_precision_loss, reason = "heights are floats")]
#![expect(clippy::print_stdout, reason = "it prints its measurements")]

#[path = "../shared/app.rs"]
mod app;
mod bench;
#[path = "../shared/bindings.rs"]
mod bindings;
#[path = "../shared/camera.rs"]
mod camera;
mod terrain;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    let args = app::Args::from_command_line()?;
    if args.text("bench").is_some() {
        bench::run(&args)
    } else {
        app::run::<terrain::Terrain>(args)
    }
}
