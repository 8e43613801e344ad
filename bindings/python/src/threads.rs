//! The threads of batches, in a forked child too.
//!
//! `tess-simd` uses rayon's global pool. Its threads belong to the process that starts it: a child that is forked
//! later has the pool and none of the threads, and would wait for them for ever. So the process that makes the first
//! tessellator with several threads owns the global pool, and a child of it gets a pool of its own.
//!
//! Whoever takes a lock here is attached to the interpreter and stays so, and the interpreter does not fork
//! meanwhile: no child gets a lock that is taken.

use crate::errors::TessError;
use pyo3::prelude::*;
use rayon::{ThreadPool, ThreadPoolBuilder};
use std::sync::atomic::{AtomicU32, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use tess_simd::Tessellator;

/// The process that owns the global pool; 0 before there is one.
static OWNER: AtomicU32 = AtomicU32::new(0);
/// The pool of a process that does not.
static OWN: Mutex<Option<(u32, Arc<ThreadPool>)>> = Mutex::new(None);

/// The threads that a tessellator's calls run on.
#[derive(Clone)]
pub(crate) struct Threads(Option<Arc<ThreadPool>>);

impl Threads {
    /// Those of this process, for a tessellator with this many. The interpreter's lock is held. Errors: no thread can
    /// be started.
    pub(crate) fn of_this_process(threads: usize) -> PyResult<Self> {
        let process = std::process::id();
        if threads == 1 || claimed_by() == process {
            return Ok(Self(None));
        }
        let mut own = OWN.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((of, pool)) = &*own
            && *of == process
        {
            return Ok(Self(Some(Arc::clone(pool))));
        }
        let processors = std::thread::available_parallelism().map_or(1, usize::from);
        let pool = ThreadPoolBuilder::new().num_threads(processors.min(Tessellator::MAX_THREADS));
        let pool = Arc::new(pool.build().map_err(|error| TessError::new_err(error.to_string()))?);
        // The pool before is a parent's: it has no threads here that could end.
        std::mem::forget(own.replace((process, Arc::clone(&pool))));
        Ok(Self(Some(pool)))
    }

    /// Does work of a tessellator.
    pub(crate) fn run<T: Send>(&self, work: impl FnOnce() -> T + Send) -> T {
        match &self.0 {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }
}

/// The owner of the global pool: this process, if there was none.
fn claimed_by() -> u32 {
    let process = std::process::id();
    match OWNER.compare_exchange(0, process, Ordering::Relaxed, Ordering::Relaxed) {
        Ok(_) => process,
        Err(owner) => owner,
    }
}
