//! The threads of this process, for callers outside of any rayon pool.
//!
//! rayon's global pool is not used for two reasons. If its threads cannot be started, every later
//! use of it panics. And a forked child has the pool without its threads, and waits for them
//! forever. The pool here is started by the first batch that needs it. If it cannot be started,
//! batches run without it; a forked child starts its own.

use crate::threads::MAX_THREADS;
use core::fmt;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::string::{String, ToString};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};

/// The process that tried to start the pool, and the pool; `None` if it could not be started.
type Started = (u32, Option<Arc<ThreadPool>>);

static STARTED: Mutex<Option<Started>> = Mutex::new(None);

/// The error that the threads of this process could not be started.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ThreadsError {
    threads: usize,
    reason: String,
}

impl fmt::Display for ThreadsError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { threads, reason } = self;
        write!(f, "{threads} threads cannot be started: {reason}")
    }
}

impl core::error::Error for ThreadsError {}

/// The pool of this process; `None` if it cannot be started or another thread is starting it.
pub(crate) fn pool() -> Option<Arc<ThreadPool>> {
    let mut started = lock()?;
    match &*started {
        Some((process, pool)) if *process == this_process() => pool.clone(),
        _ => {
            let pool = build().ok().map(Arc::new);
            put(&mut started, pool.clone());
            pool
        }
    }
}

/// Starts the pool of this process, unless it is running or another thread is starting it.
///
/// # Errors
/// [`ThreadsError`].
pub(crate) fn start() -> Result<(), ThreadsError> {
    let Some(mut started) = lock() else { return Ok(()) };
    match &*started {
        Some((process, Some(_))) if *process == this_process() => Ok(()),
        _ => build().map(|pool| put(&mut started, Some(Arc::new(pool)))),
    }
}

fn put(started: &mut Option<Started>, pool: Option<Arc<ThreadPool>>) {
    // An earlier pool belongs to the parent process. It has no threads here that dropping it could
    // end.
    core::mem::forget(started.replace((this_process(), pool)));
}

/// The lock; `None` if it stays taken. A child that was forked while another thread had the lock
/// never gets it, so it must not wait.
fn lock() -> Option<MutexGuard<'static, Option<Started>>> {
    const TRIES: usize = 64;
    for _ in 0..TRIES {
        match STARTED.try_lock() {
            Ok(started) => return Some(started),
            Err(TryLockError::Poisoned(started)) => return Some(PoisonError::into_inner(started)),
            Err(TryLockError::WouldBlock) => std::thread::yield_now(),
        }
    }
    None
}

/// Starts as many threads as rayon's global pool would have, at most [`MAX_THREADS`].
fn build() -> Result<ThreadPool, ThreadsError> {
    let asked = std::env::var("RAYON_NUM_THREADS").ok().and_then(|value| value.parse().ok());
    let processors = || std::thread::available_parallelism().map_or(1, usize::from);
    let threads = asked.filter(|&threads| threads > 0).unwrap_or_else(processors).min(MAX_THREADS);
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map_err(|error| ThreadsError { threads, reason: error.to_string() })
}

/// The number of this process, on systems that fork; 0 elsewhere.
fn this_process() -> u32 {
    if cfg!(unix) { std::process::id() } else { 0 }
}
