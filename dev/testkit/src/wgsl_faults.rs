//! The faults of `dev/faults/wgsl.faults` that tests plant on every run.

use crate::listed::{ListedFault, parse};

/// The tests that plant faults in the shaders of a batch.
const OF_BATCHES: &str = "tess-wgpu/tests";

/// The tests that plant faults in the helpers of hull and domain functions.
const OF_HELPERS: &str = "tess-wgpu/tests/helpers/main.rs";

/// The faults that the tests of this file or folder plant themselves.
///
/// # Panics
/// The list does not have the form, or has a fault of `planted by` that no test asks for.
fn planted_by(tests: &str) -> Vec<ListedFault> {
    let list = parse(include_str!("../../faults/wgsl.faults"));
    let mut faults = list.unwrap_or_else(|error| panic!("wgsl.faults: {error}"));
    faults.retain(|fault| fault.is_planted_by_tests);
    let is_asked_for = |fault: &ListedFault| [OF_BATCHES, OF_HELPERS].contains(&&*fault.tests);
    assert!(faults.iter().all(is_asked_for), "wgsl.faults: a `planted by` of other tests");
    faults.retain(|fault| fault.tests == tests);
    faults
}

/// The faults of the shaders of a batch, which tests of `tess-gpu` and `tess-wgpu` plant by name.
///
/// # Panics
/// The list does not have the form, or has a fault of `planted by` that no test asks for.
#[must_use]
pub fn of_batches() -> Vec<ListedFault> {
    planted_by(OF_BATCHES)
}

/// The faults of the helpers; the words of each are the table that must see it.
///
/// # Panics
/// The list does not have the form, or has a fault of `planted by` that no test asks for.
#[must_use]
pub fn of_helpers() -> Vec<ListedFault> {
    planted_by(OF_HELPERS)
}

/// The fault of this name in the shaders of a batch.
///
/// # Panics
/// There is no such fault.
#[must_use]
pub fn named(name: &str) -> ListedFault {
    let fault = of_batches().into_iter().find(|fault| fault.name == name);
    fault.unwrap_or_else(|| panic!("no fault is called {name}"))
}
