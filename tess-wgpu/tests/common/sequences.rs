//! Random sequences of calls. One that fails is shrunk to the shortest that still fails, and
//! printed as code.

use proptest::collection::vec;
use proptest::strategy::Strategy;
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner};
use std::cell::{Cell, RefCell};
use std::fmt::Debug;
use std::time::{Duration, Instant};

/// The seconds of the long run, from the variable `TESS_LONG_SECONDS`, or `None` for the short run.
pub(crate) fn long() -> Option<Duration> {
    let seconds = std::env::var("TESS_LONG_SECONDS").ok()?;
    let seconds = seconds.parse().unwrap_or_else(|_| panic!("TESS_LONG_SECONDS is {seconds:?}"));
    Some(Duration::from_secs(seconds))
}

/// Runs sequences of 1 to `most` calls: `short` of them, or as many as the time of the long run
/// allows. `run` returns the number of compared words, or the difference. `names` are the imports
/// that the printed calls need.
#[expect(clippy::print_stdout, reason = "the long run's numbers")]
pub(crate) fn hold<C: Clone + Debug>(
    names: &str,
    (short, most): (u32, usize),
    call: impl Strategy<Value = C> + Clone,
    run: impl FnMut(&[C]) -> Result<u64, String>,
) {
    let (begin, mut sequences) = (Instant::now(), 0_u64);
    // The clock is read after this many sequences.
    let cases = if long().is_some() { 10 } else { short };
    let (run, words) = (RefCell::new(run), Cell::new(0_u64));
    for seed in 0_u64.. {
        let mut bytes = [0; 32];
        bytes[..8].copy_from_slice(&seed.to_le_bytes());
        let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &bytes);
        let config = Config { cases, failure_persistence: None, ..Config::default() };
        let outcome =
            TestRunner::new_with_rng(config, rng).run(&vec(call.clone(), 1..=most), |calls| {
                let compared = (run.borrow_mut())(&calls).map_err(TestCaseError::fail)?;
                words.set(words.get() + compared);
                Ok(())
            });
        match outcome {
            Ok(()) => sequences += u64::from(cases),
            Err(TestError::Fail(reason, calls)) => panic!("{reason}\n\n{}", pasted(names, &calls)),
            Err(TestError::Abort(reason)) => panic!("seed {seed}: {reason}"),
        }
        if long().is_none_or(|time| begin.elapsed() >= time) {
            break;
        }
    }
    let (words, time) = (words.get(), begin.elapsed());
    assert!(words > 0, "nothing was compared");
    println!("{sequences} sequences, {words} words compared, {time:?}");
}

/// The calls as the text of a failing test.
fn pasted(names: &str, calls: &[impl Debug]) -> String {
    let lines: String = calls.iter().map(|call| format!("        {call:?},\n")).collect();
    format!("#[test]\nfn found() {{\n    use {names};\n    replay(&[\n{lines}    ]);\n}}")
}

/// The text of a difference.
pub(crate) fn equal<T: PartialEq + Debug>(
    what: &str,
    observed: T,
    expected: T,
) -> Result<(), String> {
    if observed == expected {
        return Ok(());
    }
    Err(format!("{what}: observed {observed:?}, expected {expected:?}"))
}
