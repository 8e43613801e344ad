//! Bit-exact tessellation in WGSL compute shaders, for WebGPU.
//!
//! From a buffer of tessellation factors to domain points, indices and indirect draw arguments,
//! all on the GPU, with no read-back and no worst-case buffers: every bit, and the order of
//! everything, as `docs/specification.md` and `tess-core` have them.
//!
//! The library itself depends on no graphics interface. It gives what any of them needs: the
//! WGSL of each [`Stage`] for a [`Setup`] ([`shaders`]), its bindings ([`bindings`]), the layouts
//! of the structures that host and shaders share ([`layout`]), the constant tables
//! ([`tables`]), and the buffers and dispatches of a batch as pure functions ([`plan`], [`sizes`]). The crate
//! `tess-wgpu` runs them on wgpu.
//!
//! The stages, in the order in which they run: `factors` (one thread per patch), `scan` and
//! `totals` (prefix sums over the patches; draw arguments, dispatch sizes, whether everything
//! fits), `partition` (which patches a tile of the output belongs to), `expand_points` and
//! `expand_primitives` (one workgroup per tile).
//!
//! ```
//! use tess_core::{Config, Domain, OutputPrimitive, Partitioning};
//! use tess_gpu::{Setup, Stage};
//!
//! let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
//! let setup = Setup::new(Domain::Quad, config);
//! for stage in Stage::ALL {
//!     let wgsl = stage.source(setup);
//!     assert!(wgsl.contains(&format!("fn {}(", stage.entry_point())));
//!     assert!(stage.bindings().len() <= 9, "one uniform and at most eight storage buffers");
//! }
//! ```

pub mod bindings;
pub mod layout;
pub mod plan;
pub mod setup;
pub mod shaders;
pub mod sizes;
pub mod tables;

pub use bindings::{Access, Binding, Resource};
pub use plan::{Dispatch, Plan, Workgroups};
pub use setup::{IndexType, Numbering, PointFormat, Setup};
pub use shaders::{Probe, Pull, Stage};
pub use sizes::{Capacity, Limits, Span};
