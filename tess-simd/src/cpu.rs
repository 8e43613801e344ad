//! The CPU: its levels, and functions that are compiled once for each level.

pub(crate) mod instructions;
pub(crate) mod level;
