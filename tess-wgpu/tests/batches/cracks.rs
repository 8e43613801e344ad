//! The terrain of the example `batch` has no cracks, and the test would see one.

#[path = "../../examples/batch/batch.rs"]
mod terrain;

use tess_wgpu::Gpu;

fn gpu() -> Gpu {
    pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn the_terrain_has_no_cracks() {
    let pixels = terrain::render(&gpu(), None).expect("it renders");
    assert_eq!(pixels.len(), 4 * 960 * 720, "the whole picture");
    assert_eq!(terrain::background_pixels(&pixels), 0, "background inside the surface");
}

/// Patches in the middle of the picture, each with one factor of its own.
#[test]
fn a_wrong_edge_factor_is_a_crack() {
    let gpu = gpu();
    for patch in [6 * 32 + 16, 8 * 32 + 15, 9 * 32 + 17] {
        let pixels = terrain::render(&gpu, Some(patch)).expect("it renders");
        assert!(terrain::background_pixels(&pixels) > 0, "patch {patch} shows no crack");
    }
}
