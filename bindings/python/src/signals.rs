//! Signals such as Ctrl-C. Python handles them only between its own steps, so long calls must ask
//! for them.

use crate::errors::TessError;
use pyo3::prelude::*;
use std::fs::File;
use std::io::{self, Read, Write};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{RecvTimeoutError, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// The number of steps of a loop between two checks for signals.
pub(crate) const STEPS: u32 = 256;
/// The time that a call waits for its thread between two checks for signals.
const PATIENCE: Duration = Duration::from_millis(20);
/// The time that an interrupted call waits for its thread to end.
const GRACE: Duration = Duration::from_millis(500);

/// Checks for signals in a loop that runs without the interpreter.
#[derive(Default)]
pub(crate) struct Watch {
    steps: u32,
    raised: Option<PyErr>,
}

impl Watch {
    /// Whether the loop may continue: no signal handler has raised an exception.
    pub(crate) fn goes_on(&mut self) -> bool {
        self.steps += 1;
        if self.steps.is_multiple_of(STEPS) && self.raised.is_none() {
            self.raised = Python::attach(|py| py.check_signals()).err();
        }
        self.raised.is_none()
    }

    /// The exception that ended the loop, if one did.
    pub(crate) fn finish(self) -> PyResult<()> {
        self.raised.map_or(Ok(()), Err)
    }
}

/// The exception that a signal handler raised, if one did.
pub(crate) type Raised = Arc<Mutex<Option<PyErr>>>;

/// A file whose reader or writer can be interrupted, even while it waits for a pipe.
pub(crate) struct Watched {
    file: File,
    stop: Arc<AtomicBool>,
    raised: Raised,
}

impl Watched {
    /// A file that is read or written until `stop` is set.
    pub(crate) fn new(file: File, stop: Arc<AtomicBool>) -> Self {
        Self { file, stop, raised: Arc::default() }
    }

    /// The place of an exception that a signal handler raises while this is read.
    pub(crate) fn raised(&self) -> Raised {
        Arc::clone(&self.raised)
    }
}

impl Watched {
    fn goes_on(&self) -> io::Result<()> {
        let is_stopped = self.stop.load(Ordering::Relaxed);
        if is_stopped { Err(io::Error::other("interrupted")) } else { Ok(()) }
    }
}

impl Write for Watched {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        self.goes_on()?;
        self.file.write(buffer)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

impl Read for Watched {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        loop {
            self.goes_on()?;
            match self.file.read(buffer) {
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {
                    if let Err(error) = Python::attach(|py| py.check_signals()) {
                        *self.raised.lock().unwrap_or_else(PoisonError::into_inner) = Some(error);
                        self.stop.store(true, Ordering::Relaxed);
                    }
                }
                read => return read,
            }
        }
    }
}

/// Runs `work` on another thread while this one checks for signals. If a handler raises an
/// exception, the flag that was passed to `work` is set. Work that checks the flag has ended when
/// this returns; a thread that waits for a pipe, perhaps for ever, is left to end by itself.
/// Errors: a signal handler's exception; no thread can be started; the work panicked.
pub(crate) fn interruptible<T: Send + 'static>(
    py: Python<'_>,
    work: impl FnOnce(Arc<AtomicBool>) -> T + Send + 'static,
) -> PyResult<T> {
    let stop = Arc::new(AtomicBool::new(false));
    let (give, take) = sync_channel(1);
    let take = Mutex::new(take);
    let own = Arc::clone(&stop);
    // The result of interrupted work is not received.
    let run = move || _ = give.send(work(own));
    let started = std::thread::Builder::new().spawn(run);
    started.map_err(|error| TessError::new_err(format!("a thread cannot be started: {error}")))?;
    loop {
        let wait = || take.lock().unwrap_or_else(PoisonError::into_inner).recv_timeout(PATIENCE);
        match py.detach(wait) {
            Ok(result) => return Ok(result),
            Err(RecvTimeoutError::Timeout) => py.check_signals().inspect_err(|_| {
                stop.store(true, Ordering::Relaxed);
                let take = || take.lock().unwrap_or_else(PoisonError::into_inner);
                _ = py.detach(|| take().recv_timeout(GRACE));
            })?,
            Err(RecvTimeoutError::Disconnected) => {
                return Err(TessError::new_err("the work ended without a result"));
            }
        }
    }
}
