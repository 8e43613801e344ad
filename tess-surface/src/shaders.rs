//! The formulas as WGSL text, for shaders that compute factors or evaluate domain points themselves.
//!
//! Each module has functions only: no bindings and no entry points. Join the modules that you need, and those that they
//! need, with your own text, in any order.
//!
//! The tessellation stage of `tess-wgpu` joins [`HELPERS`] to every hull and domain function by itself; leave the modules
//! in it out there. Names that begin with `tess_` are in `HELPERS`, all others are not.
//!
//! Within one pipeline both sides of an edge get the same bits, because they call the same function with the same
//! values. The CPU's results and other devices' may differ in their last bits: WGSL allows devices to fuse operations,
//! and to divide and take roots with errors of some units in the last place.

/// The modules that the stage of `tess-wgpu` joins to the user's functions: [`FLAT`], [`PN_EDGE`], [`FACTORS`],
/// [`CULLING`], [`HEIGHT`].
pub const HELPERS: &str = concat!(
    include_str!("../shaders/flat.wgsl"),
    "\n",
    include_str!("../shaders/pn_edge.wgsl"),
    "\n",
    include_str!("../shaders/factors.wgsl"),
    "\n",
    include_str!("../shaders/culling.wgsl"),
    "\n",
    include_str!("../shaders/height.wgsl"),
);

/// Lines, bilinear quads and flat triangles, closed along edges.
pub const FLAT: &str = include_str!("../shaders/flat.wgsl");

/// The inner control points of a point-normal edge.
pub const PN_EDGE: &str = include_str!("../shaders/pn_edge.wgsl");

/// Factor rules for edges and insides: [`crate::factors`]. Needs [`PN_EDGE`].
pub const FACTORS: &str = include_str!("../shaders/factors.wgsl");

/// Tests that cull patches: [`crate::culling`].
pub const CULLING: &str = include_str!("../shaders/culling.wgsl");

/// Height images: [`HeightMap`](crate::HeightMap).
pub const HEIGHT: &str = include_str!("../shaders/height.wgsl");

/// Curves, edges in canonical direction, bicubic patches and their normals.
pub const BEZIER: &str = include_str!("../shaders/bezier.wgsl");

/// Factor rules for cubic edges. Needs [`BEZIER`], [`FACTORS`] and [`PN_EDGE`].
pub const BEZIER_FACTORS: &str = include_str!("../shaders/bezier_factors.wgsl");

/// Point-normal triangles and quads. Needs [`PN_EDGE`].
pub const POINT_NORMAL: &str = include_str!("../shaders/pn.wgsl");

/// A point-normal triangle at a domain point, closed along its edges. Needs [`BEZIER`], [`POINT_NORMAL`] and
/// [`PN_EDGE`].
pub const PN_TRIANGLE: &str = include_str!("../shaders/pn_triangle.wgsl");

/// Positions and normals of displaced surfaces.
pub const DISPLACEMENT: &str = include_str!("../shaders/displacement.wgsl");
