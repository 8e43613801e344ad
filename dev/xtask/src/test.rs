//! Runs every test, and prints how many there were.

use crate::suite::{self, Extent, TestSelection};
use crate::tally::{Job, TestReport};
use crate::{command, dist, examples, explorer, levels, models, python, setup};

/// What happens if no browser is available.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Browser {
    /// The tests of the explorer fail.
    Demanded,
    /// They are left out, and the output says so.
    IfThere,
}

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
    report.beside_each_other(suite::jobs(extent, &TestSelection::of(arguments))?)?;
    if arguments.is_empty() {
        println!(
            "\nNOT RUN: tests inside the libraries, all recorded results in batches and on the GPU, long sequences \
             of frames, every pass of the shaders beside its twin, shaders in other languages, pictures, every \
             mistake under every rule, OpenGL, a window, simulators, Python, models judged by other programs, \
             the explorer, the programs that measure. `cargo xtask test all` runs them, and so does \
             `cargo xtask ci`."
        );
    }
    finish(report)
}

/// Runs every test; the last line printed is the tally.
///
/// # Errors
/// As for [`run`].
pub(crate) fn run_all(browser: Browser) -> Result<(), String> {
    setup::run()?;
    // The program is built once, so that nothing else of the suite builds it with other features.
    let mut jobs = suite::jobs(Extent::All, &TestSelection::default())?;
    let program = command::built_program();
    jobs.insert(0, Job::new(models::judge_made(&program)?));
    jobs.insert(0, Job::new(python::in_a_process(&program)?));
    jobs.insert(0, Job::new(examples::cargo("test")?));
    let lacking = explorer::lacking();
    if let Some(lacking) = &lacking {
        if browser == Browser::Demanded {
            return Err(lacking.clone());
        }
        println!("\nNOT RUN: the tests of the explorer in a browser. {lacking}");
    }
    let mut report = TestReport::default();
    let explorer = std::thread::scope(|scope| {
        // Compiling the page mostly uses one processor, so tests fill the others.
        let page = scope.spawn(|| lacking.is_none().then(|| explorer::tests(&program)).transpose());
        report.beside_each_other(jobs)?;
        page.join().map_err(|_| "building the explorer panicked".to_owned())?
    })?;
    // This runs by itself, because a page waits for a picture only for a limited time.
    report.one_by_one(explorer)?;
    if lacking.is_none() {
        report.one_by_one([dist::for_browsers(&program)?])?;
    }
    finish(report)
}

/// Prints what this machine cannot compare, then the tally.
fn finish(report: TestReport) -> Result<(), String> {
    if let Some(sentence) = levels::not_compared() {
        println!("\n{sentence}");
    }
    report.finish()
}
