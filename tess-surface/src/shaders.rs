//! The formulas as WGSL text, for vertex shaders that evaluate domain points themselves.
//!
//! The modules have functions only, no bindings and no entry points. Put those you need in front of
//! your own text. Results may differ from the CPU's in their last bits, and from device to device;
//! within one pipeline both sides of an edge agree, as they call the same function with the same
//! values.

/// Curves, edges in canonical direction, bicubic patches and their normals.
pub const BEZIER: &str = include_str!("../shaders/bezier.wgsl");

/// Point-normal triangles and quads.
pub const POINT_NORMAL: &str = include_str!("../shaders/pn.wgsl");

/// A point-normal triangle at a domain point, closed along its edges. Needs [`BEZIER`] and [`POINT_NORMAL`].
pub const PN_TRIANGLE: &str = include_str!("../shaders/pn_triangle.wgsl");

/// Flat triangles, bilinear quads and displacement.
pub const FLAT: &str = include_str!("../shaders/flat.wgsl");

/// Factor rules. Needs [`BEZIER`].
pub const FACTORS: &str = include_str!("../shaders/factors.wgsl");
