//! Stitches as tables (spec sections 7.2 to 7.4).
//!
//! The entries of its two rows that a stitch connects depend only on point counts and parities. A
//! table has one code for each index (`step_code`), made from the core's steps (`tables`); `rows`
//! turns codes into indices.

mod rows;
mod shared;
mod step_code;
mod tables;

pub(crate) use rows::{Codes, Replaced, Rows};
pub(crate) use shared::SharedStitches;
pub(crate) use step_code::CODES_AT_ONCE;
pub(crate) use tables::Stitches;
