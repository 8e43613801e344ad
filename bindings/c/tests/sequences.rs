//! Sequences of calls on several batches, compared with the model after every call.
//!
//! A sequence is drawn at random: batches of three slots are made, used and freed in any order,
//! with calls between that must be refused. Every buffer lies between guards, and after each call
//! every byte of every buffer, guards included, must be what the model says: the output, or what it
//! was before.
//!
//! A sequence that fails is shrunk, and printed as a call of [`replay`] that a test can hold.
//! `TESS_LONG_SECONDS` draws sequences for that long instead of a fixed number.
#![expect(
    clippy::undocumented_unsafe_blocks,
    clippy::multiple_unsafe_ops_per_block,
    reason = "each call gets memory of the test's own, which is as large as it says"
)]
#![expect(clippy::disallowed_methods, reason = "a caller's memory has the machine's byte order")]
#![expect(clippy::print_stdout, clippy::print_stderr, reason = "it says what it tried")]

mod sequences {
    pub(super) mod arguments;
    pub(super) mod calls;
    pub(super) mod draw;
    pub(super) mod memory;
    pub(super) mod model;
    pub(super) mod output;
    pub(super) mod slot;
}

use proptest::test_runner::{Config, RngAlgorithm, TestCaseError, TestError, TestRng, TestRunner};
use sequences::calls::{
    Base::*, Bits, BufferName::*, Call::*, PatchRuns, Room::*, Threads::*, To, Wrong::*,
};
use sequences::calls::{Call, Sequence, Threads};
use sequences::draw;
use sequences::slot::{Fault, Slot};
use std::collections::BTreeMap;
use std::sync::Mutex;
use std::time::{Duration, Instant};
use tess_capi::status::{
    TESS_BUFFER_TOO_SMALL, TESS_INDEX_TOO_LARGE, TESS_MISALIGNED, TESS_NULL_POINTER, TESS_OK,
    TESS_OUT_OF_RANGE, TESS_OVERLAP, TESS_TOO_LARGE, TESS_UNKNOWN_VALUE, TESS_WRONG_FACTOR_COUNT,
    TessStatus,
};

/// Rounds of sequences, and the sequences of each.
const ROUNDS: u64 = 60;
const SEQUENCES: u32 = 100;

/// How often each status was answered.
type Tally = BTreeMap<TessStatus, u64>;

/// The sequence that runs now: a panic inside the library ends the program, and the hook prints
/// this.
static RUNNING: Mutex<String> = Mutex::new(String::new());

/// Makes the calls of a sequence.
fn run(sequence: &Sequence, fault: Option<Fault>) -> Result<Tally, String> {
    let mut slots: [Slot; draw::SLOTS] = std::array::from_fn(|_| Slot::new(fault));
    let mut tally = Tally::new();
    let mut count = |(number, call): (usize, &Call), status: Result<TessStatus, String>| {
        let named = |wrong| format!("call {number}, {call:?}: {wrong}");
        *tally.entry(status.map_err(named)?).or_default() += 1;
        Ok::<_, String>(())
    };
    let steps = sequence.steps.iter().enumerate();
    match sequence.threads {
        One => {
            for (number, (slot, call)) in steps {
                count((number, call), slots[*slot].perform(call))?;
            }
        }
        Alternating => {
            for (number, (slot, call)) in steps {
                let slot = &mut slots[*slot];
                let status = std::thread::scope(|scope| scope.spawn(|| slot.perform(call)).join());
                count((number, call), status.map_err(|_| "the call panicked".to_owned())?)?;
            }
        }
        Together => {
            let all = |number: usize, slot: &mut Slot| -> Vec<_> {
                let own = sequence.steps.iter().enumerate().filter(|(_, (of, _))| *of == number);
                own.map(|(at, (_, call))| (at, slot.perform(call))).collect()
            };
            let statuses: Vec<_> = std::thread::scope(|scope| {
                let threads: Vec<_> = slots
                    .iter_mut()
                    .enumerate()
                    .map(|(number, slot)| scope.spawn(move || all(number, slot)))
                    .collect();
                threads.into_iter().map(std::thread::ScopedJoinHandle::join).collect()
            });
            for (number, status) in statuses.into_iter().flat_map(|one| one.expect("no panic")) {
                count((number, &sequence.steps[number].1), status)?;
            }
        }
    }
    Ok(tally)
}

/// Makes the calls of a sequence that failed once, as it was printed.
fn replay(threads: Threads, steps: &[(usize, Call)]) {
    let sequence = Sequence { threads, steps: steps.to_vec() };
    run(&sequence, None).unwrap_or_else(|wrong| panic!("{wrong}\n{sequence:?}"));
}

/// Draws sequences and runs them; gives the shortest one that fails.
fn draw(
    seed: u64,
    sequences: u32,
    fault: Option<Fault>,
    tally: &Mutex<Tally>,
) -> Result<(), (Sequence, String)> {
    let config = Config {
        cases: sequences,
        failure_persistence: None,
        max_shrink_iters: 20_000,
        max_shrink_time: 120_000,
        ..Config::default()
    };
    let mut bytes = [0; 32];
    bytes[..8].copy_from_slice(&seed.to_le_bytes());
    let rng = TestRng::from_seed(RngAlgorithm::ChaCha, &bytes);
    let tried = TestRunner::new_with_rng(config, rng).run(&draw::sequences(), |sequence| {
        *RUNNING.lock().expect("no panic") = format!("{sequence:?}");
        let statuses = run(&sequence, fault).map_err(TestCaseError::fail)?;
        let mut tally = tally.lock().expect("no panic");
        statuses.into_iter().for_each(|(status, times)| *tally.entry(status).or_default() += times);
        Ok(())
    });
    RUNNING.lock().expect("no panic").clear();
    match tried {
        Ok(()) => Ok(()),
        Err(TestError::Fail(wrong, sequence)) => Err((sequence, wrong.to_string())),
        Err(TestError::Abort(reason)) => panic!("{reason}"),
    }
}

/// The seconds that `TESS_LONG_SECONDS` asks for.
fn long() -> Option<Duration> {
    let seconds = std::env::var("TESS_LONG_SECONDS").ok()?;
    Some(Duration::from_secs(seconds.parse().expect("TESS_LONG_SECONDS is a number of seconds")))
}

#[test]
fn any_sequence_of_calls_equals_the_model() {
    let hook = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| {
        let running = RUNNING.lock().map_or_else(|_| String::new(), |running| running.clone());
        if !running.is_empty() {
            eprintln!("the sequence that runs:\n{running}");
        }
        hook(panic);
    }));
    let (began, long, tally) = (Instant::now(), long(), Mutex::default());
    let mut round = 0;
    while long.map_or(round < ROUNDS, |long| began.elapsed() < long) {
        if let Err((sequence, wrong)) = draw(round, SEQUENCES, None, &tally) {
            panic!("seed {round}: {wrong}\n\nThe shortest sequence, as a test:\n\n{sequence:?}");
        }
        round += 1;
    }
    let tally = tally.into_inner().expect("no panic");
    let calls: u64 = tally.values().sum();
    println!("{} sequences, {calls} calls; by status {tally:?}", round * u64::from(SEQUENCES));
    for status in [
        TESS_OK,
        TESS_NULL_POINTER,
        TESS_MISALIGNED,
        TESS_UNKNOWN_VALUE,
        TESS_WRONG_FACTOR_COUNT,
        TESS_BUFFER_TOO_SMALL,
        TESS_OUT_OF_RANGE,
        TESS_OVERLAP,
        TESS_TOO_LARGE,
        TESS_INDEX_TOO_LARGE,
    ] {
        assert!(tally.get(&status) > Some(&30), "status {status} was hardly answered: {tally:?}");
    }
    assert!(tally[&TESS_OK] > calls / 3, "most calls are refused: {tally:?}");
}

/// Faults on the observed side are found, and little is left of the sequences that show them.
#[test]
fn planted_faults_are_found_and_shrunk() {
    let tally = Mutex::default();
    for (fault, longest, words) in [
        (Fault::IndexAfterRefusal, 3, "indices: element 0, observed "),
        (Fault::BehindExact, 2, "points: byte "),
    ] {
        let found = (0..20).find_map(|seed| draw(seed, SEQUENCES, Some(fault), &tally).err());
        let (sequence, wrong) = found.expect("the fault is found");
        // Each slot's batch is made first.
        let steps = sequence.steps.len() - draw::SLOTS;
        assert!(steps <= longest, "{fault:?}: {steps} steps are left: {sequence:?}");
        assert!(wrong.contains(words), "{fault:?}: {wrong}");
    }
}

/// A chunk that begins with equal patches, once wrong in `tess-simd` where batches had no ranges.
/// It is also what a printed sequence looks like.
#[test]
fn equal_patches_before_others() {
    let quads = |times: u8, factor: u32| (times, Bits([factor; 6]));
    let patches = vec![quads(8, 0x4000_0000), quads(56, 0x4040_0000), quads(1, 0x4110_0000)];
    let to = To {
        room: [Exact, More(70), Short],
        point_format: 0,
        index_type: 1,
        numbering: 1,
        base: Limit(0),
        memory: 0,
        keep: false,
    };
    let enough = To { room: [Exact; 3], memory: 1, keep: true, ..to };
    replay(
        One,
        &[
            (0, Create { config: [2, 0, 2, 0], level: 0 }),
            (0, Run { patches: PatchRuns(patches.clone()), to, wrong: Nothing }),
            (0, Run { patches: PatchRuns(patches.clone()), to: enough, wrong: Nothing }),
            (0, Count { patches: PatchRuns(patches), wrong: Null(Counts) }),
            (0, Groups { starts: [0, 8, 65] }),
            (0, Single { factors: Bits([0x4000_0000; 6]), to: enough, wrong: Nothing }),
        ],
    );
}
