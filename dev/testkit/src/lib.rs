//! What the project's own tests need beside `tess-verify`: backends with planted faults, which every
//! comparison must notice, and the invariants of spec section 12.

pub mod faults;
pub mod invariants;
