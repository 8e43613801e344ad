//! The tessellation stage draws the model's triangles, in every form and with any room.

#![expect(clippy::float_arithmetic, reason = "pixels and factors are floats")]

mod ball;
#[path = "../../examples/shared/bindings.rs"]
mod bindings;
mod both;
#[path = "../../examples/shared/camera.rs"]
mod camera;
#[path = "../common/mod.rs"]
mod common;
mod cracks;
mod drawing;
mod draws;
mod errors;
mod evaluated;
mod frames;
#[path = "../common/sequences.rs"]
mod hold;
mod loaded;
#[cfg(target_os = "linux")]
mod lost;
mod model;
mod one_patch;
mod porting;
mod rising;
mod room;
mod scene;
mod sequences;
mod shared;
mod topology;
mod winding;
