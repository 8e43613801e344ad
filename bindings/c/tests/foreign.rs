//! Runs what is not Rust: the header in a C and a C++ compiler, the C example, the tessellator
//! for Mesa.
//!
//! Where a tool is missing, its tests are reported as ignored, with the tool's name; with the
//! environment variable `CI` set they fail.

mod foreign {
    pub(crate) mod c;
    pub(crate) mod mesa;
    pub(crate) mod tools;
}

use foreign::{c, mesa, tools};
use libtest_mimic::{Arguments, Failed, Trial};

type Test = fn() -> Result<(), Failed>;

const TESTS: &[(&str, &[&str], Test)] = &[
    ("header_is_c99", &["cc"], c::header_is_c99),
    ("header_is_cpp", &["c++"], c::header_is_cpp),
    ("readme_program_runs", &["cc"], c::readme_program_runs),
    ("example_equals_golden_static", &["cc"], c::example_equals_golden_static),
    ("example_equals_golden_shared", &["cc"], c::example_equals_golden_shared),
    ("example_refuses_bad_usage", &["cc"], c::example_refuses_bad_usage),
    ("fuzz_finds_a_planted_fault", &["cc"], c::fuzz_finds_a_planted_fault),
    ("fuzz_entry_is_cpp", &["c++"], c::fuzz_entry_is_cpp),
    ("cpp_names_small_buffers", &["c++"], c::cpp_names_small_buffers),
    ("forked_children_have_threads", &["cc"], c::forked_children_have_threads),
    ("no_threads_is_a_status", &["cc"], c::no_threads_is_a_status),
    ("mesa_interface_equals_golden", &["cc"], mesa::equals_golden),
    ("mesa_draws_equal_model", &["cc"], mesa::draws_equal_model),
    ("rules_example_judges_the_model", &["cc"], c::rules_example_judges_the_model),
];

fn main() {
    let in_ci = std::env::var_os("CI").is_some();
    let trials = TESTS.iter().map(|&(name, needed, test)| {
        let missing: Vec<&str> = needed.iter().copied().filter(|tool| !tools::has(tool)).collect();
        if missing.is_empty() {
            return Trial::test(name, test);
        }
        let missing = format!("not run, missing: {}", missing.join(" "));
        let failing = missing.clone();
        let trial = Trial::test(name, move || Err(failing.into())).with_kind(missing);
        trial.with_ignored_flag(!in_ci)
    });
    libtest_mimic::run(&Arguments::from_args(), trials.collect()).exit();
}
