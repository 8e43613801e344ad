//! Counting and writing on the threads of the rayon pool that the caller runs in, or else on those
//! of this process's own pool.
//!
//! Each thread begins with the same slices every time, so that its part of a reused buffer stays in
//! its core's caches. A thread that is done helps the others. When nothing is left it waits for
//! them, because threads that leave a batch together are still awake when the next one comes. Small
//! batches use fewer threads, because waking a thread would take longer than the batch.

use crate::data::format::IndexFormat;
use crate::data::point_writer::PointRoom;
use crate::stages::counts::PartCounts;
use crate::threads::part::{self, Job, Workspace};
use crate::threads::process;
use crate::threads::sizes::worth_waking;
use crate::threads::slices::{CountShare, Share};
use alloc::vec::Vec;
use rayon::ThreadPool;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};
use tess_core::Config;
use tess_level::Level;

/// The most threads, and so the most workspaces, of a tessellator.
pub(crate) const MAX_THREADS: usize = 256;

/// The longest time that a thread waits for the others. Then it may sleep.
const TOGETHER: Duration = Duration::from_micros(100);

/// Patches that are counted in a few microseconds.
const SOON_COUNTED: usize = 1024;

/// A workspace for each thread.
#[derive(Debug)]
pub(crate) struct Workspaces(Vec<Mutex<Workspace>>);

impl Workspaces {
    pub(crate) fn new() -> Self {
        Self::of_threads(1)
    }

    /// Workspaces for this many threads, at least one and at most [`MAX_THREADS`].
    pub(crate) fn of_threads(threads: usize) -> Self {
        Self((0..threads.clamp(1, MAX_THREADS)).map(|_| Mutex::new(Workspace::new())).collect())
    }

    /// Drops everything that was kept from earlier batches.
    pub(crate) fn forget(&mut self) {
        self.0.fill_with(|| Mutex::new(Workspace::new()));
    }

    /// A workspace for the calling thread.
    pub(crate) fn one(&mut self) -> &mut Workspace {
        self.0[0].get_mut().unwrap_or_else(PoisonError::into_inner)
    }

    /// The most threads that write at a time.
    pub(crate) fn threads(&self) -> usize {
        self.0.len()
    }

    /// Allocates all the memory that the workspaces may ever need.
    pub(crate) fn reserve(&mut self) {
        for workspace in &mut self.0 {
            workspace.get_mut().unwrap_or_else(PoisonError::into_inner).reserve();
        }
    }

    /// Bytes of heap memory.
    pub(crate) fn bytes(&self) -> usize {
        let bytes = |workspace: &Mutex<Workspace>| {
            let workspace = workspace.lock().unwrap_or_else(PoisonError::into_inner);
            size_of::<Mutex<Workspace>>() + workspace.bytes()
        };
        self.0.iter().map(bytes).sum()
    }

    /// Counts a share on all threads.
    pub(crate) fn count(&self, level: Level, config: Config, share: CountShare<'_>) {
        let threads = self.threads();
        let is_long = share.batch.len() > SOON_COUNTED && share.counts.len() > 1;
        match Pool::of_caller(if is_long { threads } else { 1 }) {
            Some(pool) => pool.install(|| count_on(threads, level, config, share)),
            None => share.count(level, config),
        }
    }

    /// Writes a share, slice by slice.
    // Inlined, so that a small batch passes its slice on without a call: 8 to 15 % of a batch of
    // one patch, depending on how the compiler divides a caller's crate into units.
    #[inline]
    pub(crate) fn emit<P: PointRoom, I: IndexFormat>(&self, job: Job<'_>, share: Share<'_, P, I>) {
        if share.counts.len() <= 1 {
            self.lend(|workspace| part::emit(job, share.part, workspace));
        } else {
            self.emit_slices(job, share);
        }
    }

    /// Writes a share of several slices, on several threads if it is worth waking them.
    #[inline(never)]
    fn emit_slices<P: PointRoom, I: IndexFormat>(&self, job: Job<'_>, share: Share<'_, P, I>) {
        let counts = share.counts;
        let threads = worth_waking(PartCounts::sum(counts).bytes(), self.threads());
        let Some(pool) = Pool::of_caller(threads) else {
            let write = |workspace: &mut Workspace| {
                share.into_parts().for_each(|part| part::emit(job, part, workspace));
            };
            return self.lend(write);
        };
        // A slice is taken out of its lock by the thread that writes it. Each thread takes each
        // lock once, which is little beside the slice that it protects.
        let slices: Vec<_> = share.into_parts().map(|part| Mutex::new(Some(part))).collect();
        let written = AtomicUsize::new(0);
        let write = || {
            self.lend(|workspace| {
                // Every thread goes through all slices, its own first: a slice is written by
                // whoever reaches it first, and found empty by the others.
                for slice in self.own_first(counts, &slices) {
                    let part = slice.lock().unwrap_or_else(PoisonError::into_inner).take();
                    if let Some(part) = part {
                        part::emit(job, part, workspace);
                        written.fetch_add(1, Ordering::Relaxed);
                    }
                }
            });
            // Nothing is left to take. `Relaxed` is enough: the count only ends a wait, and
            // rayon's join orders the writes before the caller reads them.
            let start = Instant::now();
            while written.load(Ordering::Relaxed) < slices.len() && start.elapsed() < TOGETHER {
                std::thread::yield_now();
            }
        };
        pool.install(|| on_threads(threads, &write));
    }

    /// All slices, beginning with the first one of this thread's own. `counts` are the slices'
    /// counts. Every thread's own slices have about the same output.
    fn own_first<'a, T>(
        &self,
        counts: &[PartCounts],
        slices: &'a [T],
    ) -> impl Iterator<Item = &'a T> {
        let (own, threads) = (self.own() as u64, self.0.len() as u64);
        // The byte at which this thread's share of the output begins. The same batch gives the same
        // byte every time, so a thread finds its part of the buffer in its caches.
        let before = PartCounts::sum(counts).bytes() * own / threads;
        let mut sum = 0;
        let first = counts.iter().position(|slice| {
            sum += slice.bytes();
            sum > before
        });
        let (others, from_own) = slices.split_at(first.unwrap_or(0));
        from_own.iter().chain(others)
    }

    /// The number of this thread's own workspace and slices.
    fn own(&self) -> usize {
        rayon::current_thread_index().unwrap_or(0) % self.0.len()
    }

    /// Lends a free workspace, if possible always the same one to each thread. Waits for one if the
    /// pool has more threads than there are workspaces.
    #[inline]
    fn lend<T>(&self, borrow: impl FnOnce(&mut Workspace) -> T) -> T {
        // A thread's own workspace has the templates of the slices that it writes every time.
        let own = self.own();
        let mut workspace = self.0[own].try_lock().ok().unwrap_or_else(|| self.other(own));
        borrow(&mut workspace)
    }

    /// A free workspace, searched from a thread's own; if there is none, its own when it is free.
    #[cold]
    fn other(&self, own: usize) -> MutexGuard<'_, Workspace> {
        let (before, from_own) = self.0.split_at(own);
        let free = from_own.iter().chain(before).find_map(|workspace| workspace.try_lock().ok());
        // A template is entered only when it is complete, so a workspace is still right after a
        // panic.
        free.unwrap_or_else(|| self.0[own].lock().unwrap_or_else(PoisonError::into_inner))
    }
}

/// A pool that a batch is spread over.
enum Pool {
    /// The pool that the caller runs in.
    Current,
    /// The pool of this process.
    Process(Arc<ThreadPool>),
}

impl Pool {
    /// The pool for a batch on this many threads; `None` if the calling thread does it alone.
    fn of_caller(threads: usize) -> Option<Self> {
        match threads {
            0 | 1 => None,
            _ if rayon::current_thread_index().is_some() => Some(Self::Current),
            _ => process::pool().map(Self::Process),
        }
    }

    /// Does work in which `rayon::join` uses this pool.
    fn install(&self, work: impl FnOnce() + Send) {
        match self {
            Self::Current => work(),
            Self::Process(pool) => pool.install(work),
        }
    }
}

/// Runs `work` on up to `threads` idle threads.
fn on_threads(threads: usize, work: &(impl Fn() + Sync)) {
    if threads > 1 {
        rayon::join(|| on_threads(threads / 2, work), || on_threads(threads - threads / 2, work));
    } else {
        work();
    }
}

/// Counts a share on up to this many threads; fewer if counting takes less time than waking them.
fn count_on(threads: usize, level: Level, config: Config, share: CountShare<'_>) {
    if threads > 1 && share.batch.len() > SOON_COUNTED && share.counts.len() > 1 {
        let (one, other) = share.halve();
        rayon::join(
            || count_on(threads / 2, level, config, one),
            || count_on(threads - threads / 2, level, config, other),
        );
    } else {
        share.count(level, config);
    }
}

impl Clone for Workspaces {
    fn clone(&self) -> Self {
        let copy = |workspace: &Mutex<Workspace>| {
            let workspace = workspace.lock().unwrap_or_else(PoisonError::into_inner);
            Mutex::new(workspace.clone())
        };
        Self(self.0.iter().map(copy).collect())
    }
}
