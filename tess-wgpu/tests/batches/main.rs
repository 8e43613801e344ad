//! Batches on any adapter, compared with the golden model. This is one program, because each
//! program links wgpu again.

mod alike;
mod catalogue;
#[path = "../common/mod.rs"]
mod common;
mod contract;
mod cut;
mod driver;
mod exact;
mod faults;
mod groups;
mod hostile;
mod order;
mod pull;
mod short;
mod surface;
#[allow(dead_code, reason = "it is not drawn here")]
#[path = "../../examples/teapot/teapot.rs"]
mod teapot;
mod tour;
