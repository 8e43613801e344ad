//! What is done before a signal ends the process: half-written files go, reports are ended.

#[cfg(unix)]
use signal_hook::{iterator::Signals, low_level};
use std::collections::BTreeMap;
use std::io;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Something to do before the process ends early.
pub(crate) type Cleanup = Box<dyn FnOnce() + Send>;

struct Cleanups {
    /// In the order in which they were asked for; the last is done first.
    pending: BTreeMap<u64, Cleanup>,
    next: u64,
    is_listening: bool,
}

static CLEANUPS: Mutex<Cleanups> =
    Mutex::new(Cleanups { pending: BTreeMap::new(), next: 0, is_listening: false });

fn lock() -> MutexGuard<'static, Cleanups> {
    CLEANUPS.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Dropped when the cleanup is no longer needed.
#[derive(Debug)]
pub(crate) struct Guard(u64);

impl Drop for Guard {
    fn drop(&mut self) {
        let cleanup = lock().pending.remove(&self.0);
        drop(cleanup);
    }
}

/// Makes something and says what undoes it. No signal ends the process between the two.
///
/// # Errors
/// It cannot be made, or signals cannot be listened to.
pub(crate) fn guarded<T>(
    make: impl FnOnce() -> io::Result<(T, Cleanup)>,
) -> io::Result<(T, Guard)> {
    let mut cleanups = lock();
    if !cleanups.is_listening {
        listen()?;
        cleanups.is_listening = true;
    }
    let (made, cleanup) = make()?;
    let number = cleanups.next;
    cleanups.next += 1;
    cleanups.pending.insert(number, cleanup);
    Ok((made, Guard(number)))
}

/// Does something that no signal may interrupt; a signal that comes meanwhile waits.
///
/// No [`Guard`] may be made or dropped in it.
pub(crate) fn undisturbed<T>(work: impl FnOnce() -> T) -> T {
    let _held = lock();
    work()
}

/// Does every pending cleanup, then what ends the process. Nothing is guarded any more meanwhile.
#[cfg(unix)]
pub(super) fn end(last: impl FnOnce()) {
    let mut cleanups = lock();
    while let Some((_, cleanup)) = cleanups.pending.pop_last() {
        cleanup();
    }
    last();
}

/// Starts to listen to the signals that end a process: the first one does the cleanups before it
/// ends the process as it would have without; a second one ends it at once.
///
/// Where no thread can be started, signals end the process at once.
#[cfg(unix)]
fn listen() -> io::Result<()> {
    use std::sync::mpsc::sync_channel;
    let (give, take) = sync_channel::<Signals>(1);
    let wait = move || {
        if let Some(signal) = take.recv().ok().and_then(|mut signals| signals.forever().next()) {
            end(|| {
                // The exit code of a shell, should the signal not be in the crate's table.
                if low_level::emulate_default_handler(signal).is_err() {
                    low_level::exit(128 + signal);
                }
            });
        }
    };
    // The signals are caught only when there is a thread that takes them.
    if std::thread::Builder::new().spawn(wait).is_ok() {
        // The thread waits for them, so the channel is open.
        _ = give.send(caught()?);
    }
    Ok(())
}

/// The signals that end a process, but for those that it was started to ignore. From here on the first
/// does nothing by itself, and the second ends the process.
#[cfg(unix)]
fn caught() -> io::Result<Signals> {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::flag;
    use std::sync::Arc;
    use std::sync::atomic::AtomicBool;

    let heard: Vec<i32> =
        [SIGHUP, SIGINT, SIGTERM].into_iter().filter(|&signal| !is_ignored(signal)).collect();
    let second = Arc::new(AtomicBool::new(false));
    for &signal in &heard {
        flag::register_conditional_default(signal, Arc::clone(&second))?;
        flag::register(signal, Arc::clone(&second))?;
    }
    Signals::new(heard)
}

/// Elsewhere temporary files stay behind when the process is ended from outside.
#[cfg(not(unix))]
const fn listen() -> io::Result<()> {
    Ok(())
}

/// Whether the process was started to ignore a signal, as `nohup` does. Known on Linux alone.
#[cfg(unix)]
fn is_ignored(signal: i32) -> bool {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
    let mask = mask.and_then(|hex| u64::from_str_radix(hex.trim(), 16).ok()).unwrap_or(0);
    mask >> (signal - 1) & 1 == 1
}
