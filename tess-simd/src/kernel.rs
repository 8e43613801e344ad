//! The kernels: what is compiled once for each CPU level.
//!
//! `dispatch` calls them; they call the stages and nothing above. All of it is inlined into the
//! level's functions, which is what makes it use the level's instructions.

pub(crate) mod count;
pub(crate) mod emit;
pub(crate) mod front_end;
pub(crate) mod probe;
pub(crate) mod repeat;
