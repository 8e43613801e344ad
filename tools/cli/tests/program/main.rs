//! Tests of the program as its users run it.

mod backends;
mod bench;
#[cfg(unix)]
mod campaigns;
mod captures;
mod check;
#[cfg(unix)]
mod commit;
#[cfg(unix)]
mod coverage;
mod crossed;
#[cfg(unix)]
mod distinct;
mod draw;
#[cfg(unix)]
mod earlier;
#[cfg(unix)]
mod evidence;
mod explain;
#[cfg(unix)]
mod files;
mod generate;
mod help;
#[cfg(unix)]
mod long;
#[cfg(unix)]
mod merge;
mod mesh;
mod mesh_gltf;
mod mesh_input;
mod mesh_pose;
mod mesh_repair;
mod mesh_size;
mod options;
mod patch;
#[cfg(all(feature = "probe", feature = "shaders"))]
mod probe;
mod rules;
mod support;
#[cfg(target_os = "linux")]
mod threads;
