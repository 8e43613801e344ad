//! The examples' pictures equal those that a rasteriser on the CPU draws from the CPU's
//! tessellation.

#![expect(
    clippy::float_arithmetic,
    clippy::cast_precision_loss,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "pictures are made of floats, and of bytes"
)]

#[allow(dead_code, reason = "its command line is not used here")]
#[path = "../../examples/shared/app.rs"]
mod app;
#[path = "../../examples/batch/batch.rs"]
mod batch;
#[path = "../../examples/shared/bindings.rs"]
mod bindings;
#[path = "../../examples/shared/camera.rs"]
mod camera;
#[path = "../../examples/meshes/meshes.rs"]
mod meshes;
#[allow(dead_code, reason = "only its picture is used here")]
#[path = "../../examples/passes/show.rs"]
mod passes;
#[allow(dead_code, clippy::print_stdout, reason = "only its picture is used here")]
#[path = "../../examples/pick/show.rs"]
mod pick;
#[allow(dead_code, reason = "only its picture is used here")]
#[path = "../../examples/quickstart/show.rs"]
mod quickstart;
#[allow(dead_code, reason = "the picture does not say more")]
#[path = "../../../tools/cli/src/commands/mesh/output/raster.rs"]
mod raster;
mod reference;
#[path = "../../examples/shared/scene.rs"]
mod scene;
#[path = "../../examples/teapot/show.rs"]
mod show;
#[path = "../../examples/teapot/teapot.rs"]
mod teapot;
#[allow(dead_code, reason = "nothing is measured here")]
#[path = "../../examples/terrain/terrain.rs"]
mod terrain;

use app::{Args, Show};
use tess_wgpu::Gpu;

/// Pixels across and down; a row has a multiple of 256 bytes.
const SIZE: [u32; 2] = [512, 384];

/// The width and height of pictures in which single pixels count.
const LARGE: [u32; 2] = [960, 720];

/// A pixel differs if a channel differs by more than this. Devices round colours and positions
/// differently.
const CHANNEL: i16 = 12;
/// The most pixels of a thousand that may differ: those on outlines and on the edges of triangles.
const PER_MILLE: usize = 10;

fn gpu() -> Gpu {
    pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"))
}

fn picture<S: Show>(gpu: &Gpu, args: &Args) -> Vec<u8> {
    picture_of::<S>(gpu, args, SIZE)
}

fn picture_of<S: Show>(gpu: &Gpu, args: &Args, size: [u32; 2]) -> Vec<u8> {
    app::picture::<S>(gpu, args, size).unwrap_or_else(|error| panic!("{error}"))
}

/// The pixels of a thousand that differ.
fn difference(observed: &[u8], expected: &[[u8; 3]]) -> usize {
    assert_eq!(observed.len(), 4 * expected.len(), "pictures of one size");
    let differs = |(a, b): &(&[u8; 4], &[u8; 3])| {
        (0..3).any(|k| (i16::from(a[k]) - i16::from(b[k])).abs() > CHANNEL)
    };
    let pairs = observed.as_chunks::<4>().0.iter().zip(expected);
    1000 * pairs.filter(differs).count() / expected.len()
}

#[test]
fn the_teapot_is_the_cpus() {
    let observed = picture::<show::Teapot>(&gpu(), &Args::default());
    let found = difference(&observed, &reference::teapot(SIZE, 0.0));
    assert!(found <= PER_MILLE, "{found} pixels of a thousand differ");
    let found = difference(&observed, &reference::teapot(SIZE, 0.02));
    assert!(found > PER_MILLE, "a teapot that stands elsewhere differs in only {found}");
}

#[test]
fn the_sea_of_the_quickstart_is_the_cpus() {
    let observed = picture::<quickstart::Quickstart>(&gpu(), &Args::default());
    let found = difference(&observed, &reference::sea(SIZE, 1.0));
    assert!(found <= PER_MILLE, "{found} pixels of a thousand differ");
    let found = difference(&observed, &reference::sea(SIZE, 0.9));
    assert!(found > PER_MILLE, "lower waves differ in only {found}");
}

#[test]
fn passes_draw_what_was_prepared_once() {
    let gpu = gpu();
    let of = |prepass| picture::<passes::Passes>(&gpu, &Args::default().with("prepass", prepass));
    let observed = of("on");
    assert!(observed == of("off"), "depths that are equal are the nearest");
    let stored = picture::<passes::Passes>(&gpu, &Args::default().with("points", "stored"));
    assert!(observed == stored, "vertices that are evaluated once have the same bits");
    let found = difference(&observed, &reference::hills(SIZE, true));
    assert!(found <= PER_MILLE / 2, "{found} pixels of a thousand differ");
    let found = difference(&observed, &reference::hills(SIZE, false));
    assert!(found > PER_MILLE, "hills without shadows differ in only {found}");
}

/// The found triangle surrounds the place where the ray meets the hills.
#[test]
fn the_picked_triangle_is_the_one_that_the_pixel_shows() {
    let gpu = gpu();
    let mut patches = std::collections::BTreeSet::new();
    for [x, y] in [[0.36, 0.55], [0.53, 0.5], [0.7, 0.75], [0.2, 0.62], [0.5, 0.02]] {
        let args = Args::default().with("x", &x.to_string()).with("y", &y.to_string());
        let aspect = SIZE[0] as f32 / SIZE[1] as f32;
        let direction = pick::direction(&pick::camera(), glam::Vec2::new(x, y), aspect);
        let expected = reference::hit(pick::camera().eye, direction);
        let found = picked(&gpu, &args);
        assert_eq!(found.is_some(), expected.is_some(), "at {x}, {y}: {expected:?}");
        let Some((found, expected)) = found.zip(expected) else { continue };
        let corners = found.corners.map(|corner| glam::Vec3::from(corner.world));
        for corner in corners {
            let away = corner.distance(expected);
            assert!(
                away < 0.25,
                "at {x}, {y}: {corner:?} of {corners:?} is {away} from {expected:?}"
            );
        }
        let place = pick::camera().eye + found.distance * direction;
        let away = place.distance(expected);
        assert!(away < 0.03, "at {x}, {y}: {place:?}, not {expected:?}");
        let cell = expected.truncate().floor();
        assert_eq!(found.corners[0].number, (cell.x + 8.0 * cell.y) as u32, "at {x}, {y}");
        patches.insert(found.corners[0].number);
    }
    assert!(patches.len() > 3, "{patches:?}");
}

/// The triangle that the example `pick` finds.
fn picked(gpu: &Gpu, args: &Args) -> Option<pick::Picked> {
    let mut show = pick::Pick::new(gpu, wgpu::TextureFormat::Rgba8Unorm, args)
        .unwrap_or_else(|error| panic!("{error}"));
    // The first frame is coarser than asked for.
    for _ in 0..3 {
        let mut encoder = gpu.device.create_command_encoder(&Default::default());
        let frame = app::Frame { gpu, encoder: &mut encoder, seconds: 0.0, size: SIZE };
        show.prepare(frame).unwrap_or_else(|error| panic!("{error}"));
        gpu.run(encoder).unwrap_or_else(|error| panic!("{error}"));
    }
    show.picked(gpu).unwrap_or_else(|error| panic!("{error}"))
}

/// The source of points does not change a single pixel.
#[test]
fn the_terrain_is_the_same_without_buffers() {
    let gpu = gpu();
    let of = |points| picture::<terrain::Terrain>(&gpu, &Args::default().with("points", points));
    let stored = of("stored");
    let colours: std::collections::BTreeSet<_> = stored.as_chunks::<4>().0.iter().collect();
    assert!(colours.len() > 5000, "{} colours of a terrain", colours.len());
    assert!(of("pull") == stored, "without points");
    assert!(of("none") == stored, "without points and indices");
    assert!(of("evaluated") == stored, "evaluated once");
}

/// The picture has the red, green and blue teapots of the example, and nothing else.
#[test]
fn each_mesh_is_drawn_with_its_material() {
    let pixels = picture_of::<meshes::Meshes>(&gpu(), &Args::default(), LARGE);
    let counts = [0, 1, 2].map(|own: usize| {
        let others = [(own + 1) % 3, (own + 2) % 3];
        let is_own = |pixel: &&[u8; 4]| others.iter().all(|&o| pixel[own] / 3 > pixel[o] / 2);
        pixels.as_chunks::<4>().0.iter().filter(is_own).count()
    });
    assert!(counts.iter().all(|&count| count > 3000), "{counts:?} pixels of each colour");
}

/// The pixels inside the terrain of the example `batch` that show the background colour, which the
/// terrain does not have.
fn background_pixels(gpu: &Gpu, args: &Args) -> usize {
    let pixels = picture_of::<batch::Batch>(gpu, args, LARGE);
    assert_eq!(pixels.len(), 4 * 960 * 720, "the whole picture");
    pixels.as_chunks::<4>().0.iter().filter(|&pixel| *pixel == [255, 0, 255, 255]).count()
}

#[test]
fn the_terrain_of_a_batch_has_no_cracks() {
    let gpu = gpu();
    assert_eq!(background_pixels(&gpu, &Args::default()), 0, "background inside the surface");
    // Patches in the middle of the picture, each with one changed factor.
    for patch in [6 * 32 + 16, 8 * 32 + 15, 9 * 32 + 17] {
        let wrong = Args::default().with("wrong", &patch.to_string());
        assert!(background_pixels(&gpu, &wrong) > 0, "patch {patch} shows no crack");
    }
}
