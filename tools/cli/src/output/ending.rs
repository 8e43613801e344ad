//! Cleanups before a signal ends the process: half-written files go, reports are ended.

use std::collections::BTreeMap;
use std::io;
use std::sync::{Mutex, MutexGuard, Once, PoisonError};

/// Something to do before the process ends early.
pub(crate) type Cleanup = Box<dyn FnOnce() + Send>;

struct Cleanups {
    /// In the order in which they were asked for; the last is done first.
    pending: BTreeMap<u64, Cleanup>,
    next: u64,
}

static CLEANUPS: Mutex<Cleanups> = Mutex::new(Cleanups { pending: BTreeMap::new(), next: 0 });

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

/// Makes something and says what undoes it. No signal ends the process between the two. Errors: it
/// cannot be made.
pub(crate) fn guarded<T>(
    make: impl FnOnce() -> io::Result<(T, Cleanup)>,
) -> io::Result<(T, Guard)> {
    static LISTENING: Once = Once::new();
    LISTENING.call_once(listen);
    let mut cleanups = lock();
    let (made, cleanup) = make()?;
    let number = cleanups.next;
    cleanups.next += 1;
    cleanups.pending.insert(number, cleanup);
    Ok((made, Guard(number)))
}

/// Starts to listen to the signals by which users and batch systems end a process: the cleanups are
/// done before it ends as it would have without. Where no thread can be started, signals end the
/// process at once. A terminal that closes does so too, as `nohup` has it ignored.
#[cfg(unix)]
fn listen() {
    use signal_hook::consts::{SIGINT, SIGTERM};
    use signal_hook::{iterator::Signals, low_level};
    let (give, take) = std::sync::mpsc::sync_channel::<Signals>(1);
    let wait = move || {
        let signal = take.recv().ok().and_then(|mut signals| signals.forever().next());
        let Some(signal) = signal else { return };
        loop {
            // Not locked meanwhile, as a cleanup may write a file.
            let cleanup = lock().pending.pop_last();
            let Some((_, cleanup)) = cleanup else { break };
            cleanup();
        }
        _ = low_level::emulate_default_handler(signal);
    };
    // Signals are caught once there is a thread that takes them, and before anything is made.
    if std::thread::Builder::new().spawn(wait).is_ok()
        && let Ok(signals) = Signals::new([SIGINT, SIGTERM])
    {
        _ = give.send(signals);
    }
}

/// Elsewhere temporary files stay behind when the process is ended from outside.
#[cfg(not(unix))]
const fn listen() {}
