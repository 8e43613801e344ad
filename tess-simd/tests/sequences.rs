//! Any sequence of calls on one tessellator, compared with the core after every call.
//!
//! A sequence is drawn from every kind of call: batches of runs in every layout, buffers with and
//! without ranges that fit, are larger or lack an element, both numberings up to the largest index,
//! outputs that are kept, single patches, and changes of the tessellator in between. A failure
//! shrinks to the smallest sequence, which is printed as a test for `sequences/found.rs`.
//!
//! `TESS_LONG_SECONDS=600` draws other sequences in every run, for that many seconds at each level,
//! and prints their number.
#![cfg(not(target_family = "wasm"))]

#[path = "sequences/buffers.rs"]
mod buffers;
#[path = "sequences/calls.rs"]
mod calls;
#[path = "sequences/expected.rs"]
mod expected;
#[path = "sequences/found.rs"]
mod found;
#[path = "sequences/kept.rs"]
mod kept;
#[path = "common/patches.rs"]
#[expect(dead_code, reason = "batches are compared by columns here")]
mod patches;
#[path = "sequences/strategies.rs"]
mod strategies;
#[path = "sequences/subject.rs"]
mod subject;

use calls::{Start, as_test};
use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner};
use proptest_state_machine::ReferenceStateMachine;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};
use strategies::Drawn;
use subject::replay_counted;
use tess_simd::Level;

/// The number of sequences of each level, unless a time is given.
const SEQUENCES: u32 = 3000;

/// The environment variable with the seconds that each level takes.
const VARIABLE: &str = "TESS_LONG_SECONDS";

#[test]
fn sequences_at_baseline() {
    any_sequence(Level::Baseline);
}

#[test]
fn sequences_at_avx2() {
    any_sequence(Level::Avx2);
}

#[test]
fn sequences_at_avx512() {
    any_sequence(Level::Avx512);
}

/// Draws sequences and makes their calls at a level.
fn any_sequence(level: Level) {
    if !tess_testkit::levels::levels().contains(&level) {
        return;
    }
    let began = Instant::now();
    let Some(time) = seconds() else {
        draw(level, 1, SEQUENCES);
        return;
    };
    let (mut sequences, mut calls, mut seed) = (0, 0, fresh_seed());
    while began.elapsed() < time {
        calls += draw(level, seed, SEQUENCES);
        (sequences, seed) = (sequences + SEQUENCES, seed + 1);
    }
    use std::io::Write as _;
    let _ = writeln!(std::io::stderr(), "{level}: {sequences} sequences of {calls} calls");
}

/// Makes the calls of sequences that a seed determines; returns the number of calls.
fn draw(level: Level, seed: u64, sequences: u32) -> usize {
    let config = Config {
        cases: sequences,
        failure_persistence: None,
        max_shrink_iters: 20_000,
        ..Config::default()
    };
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    let random = TestRng::from_seed(RngAlgorithm::ChaCha, &bytes);
    let made = AtomicUsize::new(0);
    let at_level = |drawn: &Drawn| Start { level, ..drawn.start.clone() };
    let result = TestRunner::new_with_rng(config, random).run(
        &Drawn::sequential_strategy(1..12),
        |(drawn, calls, seen)| {
            made.fetch_add(calls.len(), Ordering::Relaxed);
            let made = replay_counted(&at_level(&drawn), &calls, &seen.unwrap_or_default());
            made.map_err(TestCaseError::fail)
        },
    );
    match result {
        Ok(()) => made.into_inner(),
        Err(TestError::Fail(reason, (drawn, calls, _))) => {
            panic!("{reason}\n\n{}", as_test(&at_level(&drawn), &calls))
        }
        Err(TestError::Abort(reason)) => panic!("{reason}"),
    }
}

/// The seconds that the environment asks for.
fn seconds() -> Option<Duration> {
    let text = std::env::var(VARIABLE).ok()?;
    let seconds = text.parse().unwrap_or_else(|_| panic!("{VARIABLE}={text} is no number"));
    Some(Duration::from_secs(seconds))
}

/// A seed that no other run has.
#[expect(clippy::disallowed_methods, reason = "a failure prints its calls, not its seed")]
fn fresh_seed() -> u64 {
    let now = std::time::SystemTime::now().duration_since(std::time::UNIX_EPOCH);
    u64::try_from(now.expect("after 1970").as_nanos()).expect("before 2554")
}
