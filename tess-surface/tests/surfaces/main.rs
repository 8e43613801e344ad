//! Promises of the surfaces: no cracks, right normals, bounded deviation, and errors that name the
//! fault.
#![expect(
    clippy::float_arithmetic,
    clippy::float_cmp,
    clippy::cast_possible_truncation,
    reason = "tests compute in floats, and compare bits"
)]

mod bends;
mod cracks;
mod creases;
mod culling;
mod displacement;
mod edges;
mod errors;
mod factors;
mod flatness;
mod javascript;
mod models;
mod normals;
mod point_normal;
mod range;
mod samples;
mod sheets;
mod teapot;
mod weld;
