//! The examples run to their end, and their assertions hold.

#[path = "../examples/intermediate_values.rs"]
mod intermediate_values;
#[path = "../examples/one_patch.rs"]
mod one_patch;
#[path = "../examples/random_access.rs"]
mod random_access;

#[test]
fn every_example_runs() {
    one_patch::main();
    random_access::main();
    intermediate_values::main();
}
