//! From a model file to a tessellated mesh or a picture.
//!
//! [`input`] reads and checks the whole model; [`pipeline`] sends its patches through factors,
//! tessellation and evaluation, a block at a time; [`output`] takes the blocks as they come.
#![expect(clippy::float_arithmetic, reason = "surfaces and pictures are made of floats")]

pub mod input;
pub mod output;
pub mod pipeline;
pub mod statistics;
pub mod view;
