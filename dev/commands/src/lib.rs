//! What development commands share, those of `dev/xtask` and of workspaces of their own: running
//! programs, installing what they need, and digests of files. It has no dependencies, so that a
//! fresh checkout tests soon.
#![expect(clippy::print_stdout, reason = "commands talk to their user")]

pub mod command;
pub mod digest;
pub mod setup;
