//! Runs what is not Rust: the header in a C and a C++ compiler, the C example, the tessellator
//! for Mesa, the Verilog benches of the circuit, the UVM package.
//!
//! Where a tool is missing, its tests are reported as ignored, with the tool's name; with the
//! environment variable `CI` set they fail.

mod foreign {
    pub(crate) mod c;
    pub(crate) mod clocks;
    pub(crate) mod mesa;
    pub(crate) mod rtl;
    pub(crate) mod tools;
    pub(crate) mod uvm;
}

use foreign::{c, clocks, mesa, rtl, tools, uvm};
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
    ("rtl_equals_model", &["c++", "make", "verilator"], rtl::equals_model),
    ("rtl_buffered_equals_model", &["c++", "make", "verilator"], rtl::buffered_equals_model),
    ("rtl_two_points_equal_model", &["c++", "make", "verilator"], rtl::two_points_equal_model),
    ("rtl_four_points_equal_model", &["c++", "make", "verilator"], rtl::four_points_equal_model),
    (
        "rtl_clocks_are_those_of_the_document",
        &["c++", "make", "verilator"],
        clocks::are_those_of_the_document,
    ),
    ("rtl_faults_are_caught", &["c++", "make", "verilator"], rtl::faults_are_caught),
    ("rtl_stages_equal_model", &["c++", "make", "verilator"], rtl::stages_equal_model),
    ("rtl_stages_faults_are_caught", &["c++", "make", "verilator"], rtl::stages_faults_are_caught),
    (
        "rtl_systemc_modules_are_equal",
        &["c++", "make", "verilator", "systemc"],
        rtl::systemc_modules_are_equal,
    ),
    ("rtl_stimuli_are_checked", &["c++", "make", "verilator"], rtl::stimuli_are_checked),
    ("uvm_compiles_and_runs", &["c++", "make", "UVM_HOME"], uvm::compiles_and_runs),
];

fn main() {
    let in_ci = std::env::var_os("CI").is_some();
    let trials = TESTS.iter().map(|&(name, needed, test)| {
        // `cargo xtask rtl` asks for these: they are the circuit's.
        let is_circuits = needed.iter().any(|tool| ["verilator", "UVM_HOME"].contains(tool));
        let name = if is_circuits { format!("{name}_on_request") } else { name.to_owned() };
        let missing: Vec<&str> = needed.iter().copied().filter(|tool| !tools::has(tool)).collect();
        if missing.is_empty() {
            return Trial::test(name, test).with_ignored_flag(is_circuits);
        }
        let missing = format!("not run, missing: {}", missing.join(" "));
        let failing = missing.clone();
        let trial = Trial::test(name, move || Err(failing.into())).with_kind(missing);
        trial.with_ignored_flag(is_circuits || !in_ci)
    });
    libtest_mimic::run(&Arguments::from_args(), trials.collect()).exit();
}
