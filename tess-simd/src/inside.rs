//! The unit tests, compiled with only the modules that have some: the whole library would compile
//! every kernel at every CPU level once more, which takes a minute.

#![allow(
    unused,
    unreachable_pub,
    unfulfilled_lint_expectations,
    reason = "the library uses and exports what the tests do not"
)]

extern crate alloc;

mod data;
#[path = "../tests/inside/document.rs"]
mod document;
mod stages;
mod threads {
    mod sizes;
}
mod tour;
