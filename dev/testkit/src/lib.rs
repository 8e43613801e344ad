//! Tools of the project's own tests beside `tess-verify`: backends with planted faults, which every
//! comparison must notice, lists of faults in sources, the invariants of spec section 12, options
//! crossed by pairs, and the verdict of the circuit's bench.

pub mod circuit;
pub mod faults;
pub mod invariants;
pub mod listed;
pub mod pairs;
pub mod shader_faults;
pub mod verdict;
