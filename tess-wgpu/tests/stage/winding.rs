//! The winding of triangles, as docs/porting.md describes it.

use crate::drawing::scene;
use crate::one_patch;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
use wgpu::FrontFace;

#[test]
fn clockwise_triangles_are_counter_clockwise_where_v_points_up() {
    for domain in [Domain::Triangle, Domain::Quad] {
        let scene = scene(domain, Partitioning::FractionalOdd);
        for output in [OutputPrimitive::TriangleCw, OutputPrimitive::TriangleCcw] {
            for is_v_up in [true, false] {
                for front_face in [FrontFace::Ccw, FrontFace::Cw] {
                    let config = Config::new(Partitioning::FractionalOdd, output);
                    // Patches over the whole picture: u to the right, v upwards or downwards.
                    let y = if is_v_up { "2.0 * uv.y - 1.0" } else { "1.0 - 2.0 * uv.y" };
                    let position = format!("2.0 * uv.x - 1.0, {y}");
                    let cull_mode = Some(wgpu::Face::Back);
                    let primitive =
                        wgpu::PrimitiveState { front_face, cull_mode, ..Default::default() };
                    let pixels = one_patch::pixels(&scene, domain, config, &position, primitive);
                    let is_clockwise = (output == OutputPrimitive::TriangleCw) != is_v_up;
                    let is_front = is_clockwise == (front_face == FrontFace::Cw);
                    let what = format!("{domain:?}, {output:?}, {front_face:?}, v up: {is_v_up}");
                    assert_eq!(pixels > 10_000, is_front, "{what}: {pixels} pixels");
                    assert!(is_front || pixels == 0, "{what}: {pixels} pixels");
                }
            }
        }
    }
}
