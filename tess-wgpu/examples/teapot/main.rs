//! The teapot: see README.md beside this file.

#[path = "../shared/app.rs"]
mod app;
#[path = "../shared/bindings.rs"]
mod bindings;
mod show;
#[allow(dead_code, reason = "other examples and tests compute the factors on the CPU")]
mod teapot;

fn main() -> Result<(), Box<dyn std::error::Error>> {
    app::run::<show::Teapot>(app::Args::from_command_line()?)
}
