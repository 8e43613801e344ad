#![doc = include_str!("../README.md")]
#![no_std]
#![expect(clippy::float_arithmetic, reason = "surfaces are evaluated in floating point")]

extern crate alloc;

pub mod bend;
pub mod bezier;
pub mod curve;
mod error;
pub mod factors;
mod frame;
pub mod height;
mod lanes;
mod math;
pub mod mesh;
mod model;
pub mod patch;
pub mod pn;
mod samples;
pub mod shaders;
pub mod sides;
pub mod teapot;
mod topology;

pub use bend::Bend;
pub use bezier::BezierPatch;
pub use curve::{Curve, Direction, Edge};
pub use error::{Fault, MAX_COORDINATE, MeshError, WrongDomain};
pub use factors::FactorRule;
pub use frame::{Frame, Tangents};
pub use glam;
pub use height::{DisplacedModel, DisplacedPatch, Displacement, HeightMap};
pub use mesh::{Face, PolygonMesh};
pub use model::{Model, Style};
pub use patch::{Patch, Sample, Surface};
pub use pn::{PnCorner, PnQuad, PnTriangle};
pub use sides::{Place, Sides};
pub use tess_core;
pub use topology::HalfEdge;
