//! Threads, on systems that may not start one per processor.

use rayon::ThreadPoolBuilder;
use std::sync::Mutex;
use std::thread::{Builder, available_parallelism, scope};

/// The largest number of threads that are tried.
const MOST: usize = 1024;

/// Starts rayon's pool with as many threads as can be started, at most [`MOST`]. By itself, rayon
/// panics if it gets fewer threads than it wants, and starts tens of thousands if
/// `RAYON_NUM_THREADS` asks for them. If none can be started, the pool is this thread.
pub(crate) fn start_pool() {
    let asked = std::env::var("RAYON_NUM_THREADS").ok().and_then(|number| number.parse().ok());
    let asked = asked.filter(|&number: &usize| number > 0);
    let wanted = asked.unwrap_or_else(|| available_parallelism().map_or(1, usize::from)).min(MOST);
    let pool = match startable(wanted) {
        0 => ThreadPoolBuilder::new().num_threads(1).use_current_thread(),
        there => ThreadPoolBuilder::new().num_threads(there),
    };
    // It fails if a pool exists already, which is just as good.
    _ = pool.build_global();
}

/// The number of threads, up to `wanted`, that can currently run besides this one.
pub(crate) fn startable(wanted: usize) -> usize {
    let gate = Mutex::new(());
    scope(|scope| {
        let _closed = gate.lock();
        let start = |_: &usize| Builder::new().spawn_scoped(scope, || drop(gate.lock())).is_ok();
        (0..wanted).take_while(start).count()
    })
}
