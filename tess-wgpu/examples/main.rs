//! The examples of `tess-wgpu`: `cargo example NAME`. The folder NAME has the example and its
//! README.

#[path = "shared/app.rs"]
mod app;
#[path = "batch/batch.rs"]
mod batch;
#[path = "terrain/bench.rs"]
mod bench;
#[path = "shared/bindings.rs"]
mod bindings;
#[path = "shared/camera.rs"]
mod camera;
#[path = "character/show.rs"]
mod character;
#[path = "compute_only/compute_only.rs"]
mod compute_only;
#[path = "character/gltf.rs"]
mod gltf;
#[path = "meshes/meshes.rs"]
mod meshes;
#[path = "passes/show.rs"]
mod passes;
#[path = "pick/show.rs"]
mod pick;
#[path = "quickstart/show.rs"]
mod quickstart;
#[path = "rays/show.rs"]
mod rays;
#[path = "shared/scene.rs"]
mod scene;
#[path = "teapot/show.rs"]
mod show;
#[path = "teapot/teapot.rs"]
mod teapot;
#[path = "terrain/terrain.rs"]
mod terrain;
#[path = "shared/window.rs"]
mod window;

use app::{Args, Show};
use std::error::Error;
use std::fs::File;
use tess_wgpu::Gpu;

fn main() -> Result<(), Box<dyn Error>> {
    let mut words = std::env::args().skip(1);
    let name = words.next().unwrap_or_default();
    let args = Args::new(words)?;
    match name.as_str() {
        "batch" => run::<batch::Batch>(args),
        "character" => run::<character::Character>(args),
        "compute_only" => compute_only::run(),
        "meshes" => run::<meshes::Meshes>(args),
        "passes" => run::<passes::Passes>(args),
        "pick" => run::<pick::Pick>(args),
        "pull" => run::<terrain::Terrain>(args.or("points", "none")),
        "quickstart" => run::<quickstart::Quickstart>(args),
        "rays" => rays::run(&args),
        "teapot" => run::<show::Teapot>(args),
        "terrain" if args.text("bench").is_some() => bench::run(&args),
        "terrain" => run::<terrain::Terrain>(args),
        _ => {
            Err("cargo example NAME: batch, character, compute_only, meshes, passes, pick, pull, \
                  quickstart, rays, teapot or terrain"
                .into())
        }
    }
}

/// Runs an example. `--screenshot FILE` draws one frame into a file (`--width PIXELS`,
/// `--seconds S`). Otherwise there is a window, which `--frames COUNT` closes after that number of
/// frames.
fn run<S: Show>(args: Args) -> Result<(), Box<dyn Error>> {
    let Some(path) = args.text("screenshot") else { return window::run::<S>(args) };
    let gpu = pollster::block_on(Gpu::open())?;
    let width = args.number("width", 960_u32)?.next_multiple_of(64);
    let size = [width, width * 3 / 4];
    let pixels = app::picture::<S>(&gpu, &args, size)?;
    save(path, size, &pixels)
}

/// Writes a picture into a file.
fn save(path: &str, size: [u32; 2], pixels: &[u8]) -> Result<(), Box<dyn Error>> {
    let mut encoder = png::Encoder::new(File::create(path)?, size[0], size[1]);
    encoder.set_color(png::ColorType::Rgba);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.write_header()?.write_image_data(pixels)?;
    Ok(())
}
