//! The program as its users run it.

mod backends;
mod bench;
mod check;
mod draw;
mod explain;
mod generate;
mod help;
mod mesh;
mod mesh_gltf;
mod mesh_input;
mod patch;
mod support;
