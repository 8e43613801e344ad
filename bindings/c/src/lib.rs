//! C and `SystemVerilog` (DPI-C) interface of the bit-exact tessellator.
//!
//! `include/tess.h` is generated from this crate and documents every function for its users;
//! `verilog/tess_dpi.sv` does so for simulators. Three rules hold everywhere:
//!
//! - The caller owns all memory. Functions on one patch, and probes, allocate nothing;
//!   a batch has a handle, which holds tables and is made once.
//! - Every function answers a status. Null or misaligned pointers, unknown numbers and too small
//!   buffers are answers, never undefined behaviour. Enumerations cross as `uint32_t` and are checked.
//! - Nothing panics. Should a defect make it so, the program ends: a panic never unwinds into the
//!   caller (`extern "C"` aborts), so no call catches one.
//!
//! This is the one crate of the workspace with `unsafe`: in `boundary`, which looks through the
//! callers' pointers, and in the functions that hand pointers to it.

pub mod batch;
mod boundary;
mod context;
pub mod dpi;
pub mod patch;
pub mod prepare;
pub mod probe;
pub mod process;
pub mod status;
pub mod types;
pub mod version;
