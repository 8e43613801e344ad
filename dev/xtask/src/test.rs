//! Runs every test, and prints how many there were.

use crate::suite::{self, Extent, TestSelection};
use crate::tally::{Job, Tally, TestReport};
use crate::{command, examples, levels, models, setup};

/// Runs the tests of the workspace that need only a Vulkan driver and a C compiler, or those of a
/// [`TestSelection`], on every CPU level that this machine should have. The last line printed is
/// the tally.
///
/// # Errors
/// A test fails, something cannot be installed, or a path has no tests.
pub(crate) fn run(arguments: &[&str]) -> Result<(), String> {
    setup::for_comparisons()?;
    // A test that is named is wanted, whatever it needs.
    let extent = if arguments.is_empty() { Extent::Comparisons } else { Extent::All };
    let mut report = TestReport::default();
    let suite = suite::build(extent, &TestSelection::of(arguments))?;
    report.beside_each_other(suite.jobs)?;
    if extent == Extent::Comparisons {
        println!("\nNOT RUN; `cargo xtask test all` runs them, and so does `cargo xtask ci`:");
        report.not_run(&suite.left_out).for_each(|line| println!("  {line}"));
        println!("  tests inside the libraries; {BESIDE}");
    }
    finish(report).map(drop)
}

/// What only [`run_all`] runs beside the workspace's programs.
const BESIDE: &str =
    "models judged by other programs; the examples of tess-wgpu and those in the documentation";

/// Runs every test of the product; the last line printed is the tally, which is also returned.
///
/// # Errors
/// As for [`run`].
pub(crate) fn run_all() -> Result<Tally, String> {
    setup::run()?;
    // The program is built once, so that nothing else of the suite builds it with other features.
    let suite = suite::build(Extent::All, &TestSelection::default())?;
    suite.left_out.iter().for_each(|program| println!("NOT RUN: {program}"));
    let mut jobs = suite.jobs;
    jobs.insert(0, Job::new(models::judge_made(&command::built_program())?));
    jobs.insert(0, Job::new(examples::cargo("test")?));
    let mut report = TestReport::default();
    report.beside_each_other(jobs)?;
    finish(report)
}

/// Prints what this machine cannot compare, then the tally.
fn finish(report: TestReport) -> Result<Tally, String> {
    if let Some(sentence) = levels::not_compared() {
        println!("\n{sentence}");
    }
    report.finish()
}
