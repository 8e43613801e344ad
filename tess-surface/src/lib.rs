//! Surfaces over the domain points of a tessellator, and tessellation factors by rule, so that
//! no crack opens between patches.
//!
//! Works with the domain points of any backend, as `f32` pairs. `no_std` with `alloc`.
//!
//! ```
//! use glam::Vec3;
//! use tess_core::{Config, OutputPrimitive, Partitioning, Patch};
//! use tess_surface::{FactorRule, Model, teapot};
//!
//! let model = Model::bezier(teapot::patches())?;
//! let rule = FactorRule::Distance { eye: Vec3::new(6.0, 0.0, 2.0), scale: 30.0 };
//! let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
//!
//! let (patch, factors) = (model.patch(18), rule.patch(&model, 18, config.partitioning));
//! let domain = Patch::new(config, factors).tessellate();
//! let points: Vec<_> = domain.points.iter().map(|p| patch.sample(p.to_f32())).collect();
//! assert!(points.iter().all(|point| (1.5..3.6).contains(&point.position.x))); // the spout
//! # Ok::<(), tess_surface::MeshError>(())
//! ```
//!
//! A [`Model`] is made of polygons ([`mesh`]) or of bicubic patches ([`bezier`]) and knows its
//! patches' neighbours; a [`patch::Patch`] is evaluated at domain points, canonically along its
//! edges ([`curve`]); [`height`] displaces it; [`factors`] says how finely to cut it. The formulas
//! are in [`bezier`] and [`pn`], and once more as WGSL in [`shaders`].
//!
//! Units are the model's own. Triangles wound `triangle_cw` by the tessellator are
//! counter-clockwise seen from the side that the normals point to.
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
mod math;
pub mod mesh;
mod model;
pub mod patch;
pub mod pn;
pub mod shaders;
pub mod sides;
pub mod teapot;
mod topology;

pub use error::{Fault, MeshError};
pub use factors::FactorRule;
pub use frame::{Frame, Tangents};
pub use model::{Model, Style};
pub use topology::HalfEdge;
