//! Compares every kernel at every level with the model's stage: see
//! `dev/testkit/src/kernels.rs`.
//!
//! `TESS_KERNEL="stages/points/quad 6"` runs one entry in one round, as a message suggests; a name
//! without a round runs all its rounds.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::thread::scope;
use tess_simd::{Kernel, Level};
use tess_testkit::kernels::{Entry, SEED, TABLE};
use tess_testkit::levels::levels;

/// Rounds in which every partitioning, output and split order occurs, with random inputs and with
/// extreme ones.
const ROUNDS: u32 = 64;

/// The first difference of an entry, if any.
fn failure(entry: &Entry, levels: &[Level], rounds: impl Iterator<Item = u32>) -> Option<String> {
    for round in rounds {
        let mut case = entry.case(round);
        let expected = entry.expected(&mut case);
        for &level in levels {
            let compared =
                catch_unwind(AssertUnwindSafe(|| entry.compare(&case, &expected, level)));
            let what = match compared {
                Ok(Ok(())) => continue,
                Ok(Err(difference)) => difference.to_string(),
                Err(panic) => {
                    let text = panic.downcast_ref::<String>().map(String::as_str);
                    let text = text.or_else(|| panic.downcast_ref::<&str>().copied());
                    format!("panics: {}", text.unwrap_or("see above"))
                }
            };
            let name = entry.name;
            return Some(format!(
                "{} at {level}, round {round} of seed {SEED:#x}: {what}\n    again: \
                 TESS_KERNEL=\"{name} {round}\" cargo test -p tess-simd --all-features --test kernels",
                entry.name_at(level)
            ));
        }
    }
    None
}

/// The entries and rounds that `TESS_KERNEL` names, or all if it is not set.
fn chosen(text: &str) -> (String, Option<u32>) {
    let parts = text.rsplit_once(' ').and_then(|(name, round)| Some((name, round.parse().ok()?)));
    parts.map_or((text.to_owned(), None), |(name, round)| (name.to_owned(), Some(round)))
}

#[test]
fn every_kernel_gives_what_the_model_gives() {
    let levels = levels();
    let (name, round) = chosen(&std::env::var("TESS_KERNEL").unwrap_or_default());
    let entries: Vec<_> =
        TABLE.iter().filter(|entry| name.is_empty() || entry.name == name).collect();
    assert!(!entries.is_empty(), "no kernel is called {name:?}");
    let rounds = || round.map_or(0..ROUNDS, |round| round..round + 1);
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    let mut failures = vec![None; entries.len()];
    scope(|scope| {
        let mut shares: Vec<Vec<_>> = (0..threads).map(|_| Vec::new()).collect();
        for (number, one) in entries.iter().zip(&mut failures).enumerate() {
            shares[number % threads].push(one);
        }
        for share in shares {
            let levels = &levels;
            scope.spawn(move || {
                for (entry, found) in share {
                    *found = failure(entry, levels, rounds());
                }
            });
        }
    });
    let found: Vec<_> = failures.iter().flatten().collect();
    let others: Vec<_> = found.iter().skip(1).filter_map(|text| text.lines().next()).collect();
    assert!(
        found.is_empty(),
        "a kernel differs from the model:\n\n{}\n\n{} later ones, which may get wrong inputs from it:\n{}\n",
        found[0],
        others.len(),
        others.join("\n")
    );
}

#[test]
fn every_kernel_has_an_entry() {
    for kernel in Kernel::ALL {
        assert!(
            TABLE.iter().any(|entry| entry.kernel == *kernel),
            "{kernel:?} is compared nowhere"
        );
    }
    for (number, entry) in TABLE.iter().enumerate() {
        let first = TABLE.iter().position(|other| other.name == entry.name);
        assert_eq!(first, Some(number), "two entries are called {}", entry.name);
    }
}

/// The test detects one wrong bit anywhere, and each entry compares something in most rounds.
#[test]
fn planted_faults_are_seen() {
    for entry in TABLE {
        let mut empty = 0;
        for round in 0..ROUNDS {
            let mut case = entry.case(round);
            let words = entry.expected(&mut case).count();
            empty += u32::from(words == 0);
            for word in [0, words / 2, words.saturating_sub(1)] {
                let mut wrong = entry.expected(&mut case);
                if word < words && round < 4 {
                    wrong.spoil(word);
                    let difference = entry.compare(&case, &wrong, Level::Baseline);
                    let text = difference.map_err(|error| error.to_string());
                    assert!(text.is_err(), "{}, round {round}: word {word}", entry.name);
                }
            }
        }
        assert!(empty <= ROUNDS / 4, "{}: {empty} rounds compare nothing", entry.name);
    }
}
