//! Points are drawn as points and lines as lines.

use crate::drawing::scene;
use crate::one_patch;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};

/// The number of pixels that a patch over most of the picture covers.
fn pixels(domain: Domain, output: OutputPrimitive) -> usize {
    let scene = scene(domain, Partitioning::Integer);
    let config = Config::new(Partitioning::Integer, output);
    one_patch::pixels(&scene, domain, config, "1.8 * uv - 0.9", Default::default())
}

#[test]
fn points_are_one_pixel_each() {
    // Two lines of four points; nine points around three; a grid of four times four.
    for (domain, points) in [(Domain::Isoline, 8), (Domain::Triangle, 12), (Domain::Quad, 16)] {
        assert_eq!(pixels(domain, OutputPrimitive::Point), points, "{domain:?}");
    }
}

#[test]
fn lines_are_as_long_as_the_patch() {
    let lines = pixels(Domain::Isoline, OutputPrimitive::Line);
    let all = pixels(Domain::Quad, OutputPrimitive::TriangleCw);
    // The lines v = 0 and v = 1/2 are as wide as the quad, whose pixels are a multiple of half of
    // theirs.
    let width = lines / 2;
    assert!(width > 100 && all.is_multiple_of(width), "{lines} pixels; {all} of the quad");
}
