//! The threads of this process, for callers outside of any rayon pool.
//!
//! rayon's global pool is not used: where its threads cannot be started, every use of it panics
//! from then on, and a forked child, which has the pool without its threads, waits for them for
//! ever. The pool here is started by the first batch that needs it. A batch does without a pool
//! that cannot be started, and a forked child starts its own.

use crate::threads::MAX_THREADS;
use core::fmt;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::string::{String, ToString};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError, TryLockError};

/// The pool, and the process that has its threads. `None` for the pool: it could not be started.
type Started = (u32, Option<Arc<ThreadPool>>);

static STARTED: Mutex<Option<Started>> = Mutex::new(None);

/// The threads of this process could not be started.
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

/// The pool of this process; `None` if it cannot be started, or is being started by another thread.
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

/// Starts the pool of this process, unless it runs or another thread is starting it.
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
    // A pool that was there is a parent's. It has no threads here that could end.
    core::mem::forget(started.replace((this_process(), pool)));
}

/// The lock; `None` if it stays taken. A child that was forked while another thread had it never
/// gets it, so nobody waits for it.
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

/// As many threads as rayon's global pool would have, at most [`MAX_THREADS`].
fn build() -> Result<ThreadPool, ThreadsError> {
    let asked = std::env::var("RAYON_NUM_THREADS").ok().and_then(|value| value.parse().ok());
    let processors = || std::thread::available_parallelism().map_or(1, usize::from);
    let threads = asked.filter(|&threads| threads > 0).unwrap_or_else(processors).min(MAX_THREADS);
    let pool = ThreadPoolBuilder::new().num_threads(threads).build();
    pool.map_err(|error| ThreadsError { threads, reason: error.to_string() })
}

/// The number of this process, where processes fork.
fn this_process() -> u32 {
    if cfg!(unix) { std::process::id() } else { 0 }
}
