//! Files that people have, as small inputs: what is read, repaired, refused and written.

#![expect(
    clippy::float_arithmetic,
    clippy::cast_possible_truncation,
    reason = "meshes are made of floats, and tests of small numbers"
)]

mod edges;
mod harm;
mod heights;
mod materials;
mod output;
mod polygons;
mod rules;
mod slivers;
mod support;
mod unneeded;
mod weld;
mod whole;
