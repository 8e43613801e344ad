//! Batches on whatever adapter there is, against the golden model. One program, since each links wgpu again.

mod alike;
mod catalogue;
#[path = "../common/mod.rs"]
mod common;
mod contract;
mod cracks;
mod cut;
mod driver;
mod exact;
mod faults;
mod groups;
mod hostile;
#[allow(dead_code, reason = "its parts are tested")]
#[path = "../../examples/meshes/meshes.rs"]
mod meshes;
mod order;
mod pull;
mod short;
mod surface;
mod tour;
