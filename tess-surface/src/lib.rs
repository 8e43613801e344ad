#![doc = include_str!("../README.md")]
#![no_std]
#![expect(clippy::float_arithmetic, reason = "surfaces are evaluated in floating point")]

extern crate alloc;
#[cfg(feature = "std")]
extern crate std;

pub mod bend;
pub mod bezier;
mod boundary;
mod crease;
pub mod culling;
pub mod curve;
mod dispatch;
pub mod displaced;
mod edges;
mod error;
pub mod factors;
mod formulas;
mod frame;
pub mod height;
mod lanes;
mod math;
pub mod mesh;
mod model;
pub mod patch;
pub mod pn;
mod samples;
mod sheets;
pub mod sides;
mod smooth;
pub mod teapot;
mod topology;

pub use bend::Bend;
pub use bezier::BezierPatch;
pub use crease::Creases;
pub use curve::{Curve, Direction, Edge};
pub use displaced::{DisplacedModel, DisplacedPatch};
pub use error::{FaceError, HeightError, MAX_COORDINATE, MeshError, WrongDomainError};
pub use factors::FactorRule;
pub use frame::{Frame, Tangents};
pub use glam;
pub use height::{Address, Displacement, HeightMap};
pub use mesh::{Face, PolygonMesh};
pub use model::{Model, Style};
pub use patch::{Sample, Surface, SurfacePatch};
pub use pn::{PnCorner, PnQuad, PnTriangle};
pub use sides::{Place, Sides};
pub use tess_core;
pub use tess_level::{Level, LevelUnavailableError};
pub use topology::HalfEdge;
