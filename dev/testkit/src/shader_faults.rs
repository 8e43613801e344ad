//! The faults of shaders that tests of `tess-gpu` and `tess-wgpu` plant on every run:
//! `faults/shaders.faults`.

use crate::listed::{ListedFault, parse};

/// Every fault of the list.
///
/// # Panics
/// The list does not have the form.
#[must_use]
pub fn all() -> Vec<ListedFault> {
    parse(include_str!("../faults/shaders.faults")).unwrap_or_else(|error| panic!("{error}"))
}

/// The fault of this name.
///
/// # Panics
/// There is no such fault.
#[must_use]
pub fn named(name: &str) -> ListedFault {
    let fault = all().into_iter().find(|fault| fault.name == name);
    fault.unwrap_or_else(|| panic!("no fault is called {name}"))
}
