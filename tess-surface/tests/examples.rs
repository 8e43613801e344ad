//! The examples run to their end, and their assertions hold.

#[path = "../examples/displaced_mesh.rs"]
mod displaced_mesh;
#[path = "../examples/teapot_points.rs"]
mod teapot_points;

#[test]
fn every_example_runs() {
    teapot_points::main().expect("the teapot is sound");
    displaced_mesh::main().expect("the cube is sound");
}
