//! Cleanups before a signal ends the process: they remove partial files and complete reports.

use std::collections::BTreeMap;
use std::io;
use std::sync::{Mutex, MutexGuard, Once, PoisonError};

/// Work to do before the process ends early.
pub(crate) type Cleanup = Box<dyn FnOnce() + Send>;

struct Cleanups {
    /// In the order of registration; the last one runs first.
    pending: BTreeMap<u64, Cleanup>,
    next: u64,
    /// A signal came that ends the process.
    ending: bool,
}

static CLEANUPS: Mutex<Cleanups> = Mutex::new(Cleanups::new());

impl Cleanups {
    const fn new() -> Self {
        Self { pending: BTreeMap::new(), next: 0, ending: false }
    }

    /// Registers a cleanup, and returns its number.
    fn add(&mut self, cleanup: Cleanup) -> u64 {
        let number = self.next;
        self.next += 1;
        self.pending.insert(number, cleanup);
        number
    }
}

fn lock(cleanups: &Mutex<Cleanups>) -> MutexGuard<'_, Cleanups> {
    cleanups.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A registered cleanup. Dropping the guard cancels it.
#[derive(Debug)]
pub(crate) struct Guard(u64);

impl Drop for Guard {
    fn drop(&mut self) {
        let cleanup = lock(&CLEANUPS).pending.remove(&self.0);
        drop(cleanup);
    }
}

/// Makes something and registers the cleanup that undoes it. No signal ends the process between the
/// two. Errors: it cannot be made.
pub(crate) fn guarded<T>(
    make: impl FnOnce() -> io::Result<(T, Cleanup)>,
) -> io::Result<(T, Guard)> {
    static LISTENING: Once = Once::new();
    LISTENING.call_once(listen);
    let mut cleanups = lock(&CLEANUPS);
    let (made, cleanup) = make()?;
    Ok((made, Guard(cleanups.add(cleanup))))
}

/// Does work during which no signal ends the process.
pub(crate) fn uninterrupted<T>(work: impl FnOnce() -> T) -> T {
    let _cleanups = lock(&CLEANUPS);
    work()
}

/// Leaves the end of the process to a signal that has come: what failed because a cleanup removed
/// it is no error to report, and the cleanups run to their end.
pub(crate) fn leave_to_signal() {
    while lock(&CLEANUPS).ending {
        std::thread::park();
    }
}

/// Runs all cleanups, also those that are registered meanwhile. Nothing is registered while the
/// result is held.
#[cfg(unix)]
fn undo_all(all: &Mutex<Cleanups>) -> MutexGuard<'_, Cleanups> {
    loop {
        let mut cleanups = lock(all);
        cleanups.ending = true;
        let Some((_, cleanup)) = cleanups.pending.pop_last() else { return cleanups };
        // The lock is not held during a cleanup, because a cleanup may write a file.
        drop(cleanups);
        cleanup();
    }
}

/// Starts to listen for the signals with which users and batch systems end a process. The cleanups
/// run first; the process then ends as it would have without them. If no thread can be started,
/// signals end the process at once. A closing terminal is such a signal too, unless it is ignored,
/// as under `nohup`.
#[cfg(unix)]
fn listen() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::{iterator::Signals, low_level};
    let (give, take) = std::sync::mpsc::sync_channel::<Signals>(1);
    let wait = move || {
        let signal = take.recv().ok().and_then(|mut signals| signals.forever().next());
        let Some(signal) = signal else { return };
        // With nothing left to undo, the lock is held until the process ends: otherwise another
        // thread would make something that stays.
        let _nothing_new = undo_all(&CLEANUPS);
        _ = low_level::emulate_default_handler(signal);
    };
    // Signals are caught once there is a thread to handle them, and before anything is made.
    let hangup = (!hangup_is_ignored()).then_some(SIGHUP);
    if std::thread::Builder::new().spawn(wait).is_ok()
        && let Ok(signals) = Signals::new([SIGINT, SIGTERM].into_iter().chain(hangup))
    {
        _ = give.send(signals);
    }
}

/// Whether the process was started with the signal of a closing terminal ignored. Listening to it
/// would undo that. Only Linux tells; elsewhere it is taken as ignored.
#[cfg(unix)]
fn hangup_is_ignored() -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let ignored = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = ignored.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
    let bit = 1 << (signal_hook::consts::SIGHUP - 1);
    mask.is_none_or(|mask| mask & bit != 0)
}

/// On other systems, temporary files remain when the process is ended from outside.
#[cfg(not(unix))]
const fn listen() {}

#[cfg(all(test, unix))]
mod tests {
    use super::*;
    use std::sync::Arc;

    #[test]
    fn nothing_is_made_after_the_last_cleanup() {
        let all = Arc::new(Mutex::new(Cleanups::new()));
        let (undone, saw) = std::sync::mpsc::channel();
        let (early, late) = (undone.clone(), (Arc::clone(&all), undone.clone()));
        lock(&all).add(Box::new(move || early.send("the first").expect("heard")));
        let second: Cleanup = Box::new(move || {
            let (all, late) = late;
            lock(&all).add(Box::new(move || late.send("one made meanwhile").expect("heard")));
            undone.send("the second").expect("heard");
        });
        lock(&all).add(second);
        let held = undo_all(&all);
        let order = ["the second", "one made meanwhile", "the first"];
        assert!(saw.try_iter().eq(order), "all are undone, the last one first");
        assert!(held.ending && held.pending.is_empty(), "the process ends");
        assert!(all.try_lock().is_err(), "nobody can register another");
    }
}
