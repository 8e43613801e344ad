//! The threads of the current rayon pool.
//!
//! Each thread begins with the same slices every time, so that its part of a reused buffer stays in its core's
//! caches. A thread that is done helps the others. When nothing is left it waits for them: threads that leave a
//! batch together are still awake when the next one comes. Small batches use fewer threads, because waking takes
//! longer than they do.

use crate::cpu::level::Level;
use crate::data::format::IndexFormat;
use crate::data::point_writer::PointRoom;
use crate::stages::counts::PartCounts;
use crate::threads::part::{self, Job, Workspace};
use crate::threads::sizes::worth_waking;
use crate::threads::slices::{CountShare, Share};
use alloc::vec::Vec;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};
use tess_core::Config;

/// The most threads, and so workspaces, that a tessellator uses.
pub(crate) const MAX_THREADS: usize = 256;

/// The longest that a thread waits for the others. Then it may sleep.
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
        let threads = threads.clamp(1, MAX_THREADS);
        if threads > 1 {
            limit_global_pool();
        }
        Self((0..threads).map(|_| Mutex::new(Workspace::new())).collect())
    }

    /// Forgets what was kept from batch to batch.
    pub(crate) fn forget(&mut self) {
        self.0.fill_with(|| Mutex::new(Workspace::new()));
    }

    /// A workspace for the calling thread alone.
    pub(crate) fn one(&mut self) -> &mut Workspace {
        self.0[0].get_mut().unwrap_or_else(PoisonError::into_inner)
    }

    /// How many threads write at a time.
    pub(crate) fn threads(&self) -> usize {
        self.0.len()
    }

    /// Takes all the memory that they may ever need.
    pub(crate) fn reserve(&mut self) {
        for workspace in &mut self.0 {
            workspace.get_mut().unwrap_or_else(PoisonError::into_inner).reserve();
        }
    }

    /// Bytes of memory that they take on the heap.
    pub(crate) fn bytes(&self) -> usize {
        let bytes = |workspace: &Mutex<Workspace>| {
            let workspace = workspace.lock().unwrap_or_else(PoisonError::into_inner);
            size_of::<Mutex<Workspace>>() + workspace.bytes()
        };
        self.0.iter().map(bytes).sum()
    }

    /// Counts a share on all threads.
    pub(crate) fn count(&self, level: Level, config: Config, share: CountShare<'_>) {
        count_on(self.threads(), level, config, share);
    }

    /// Writes a share, slice by slice.
    pub(crate) fn emit<P: PointRoom, I: IndexFormat>(&self, job: Job<'_>, share: Share<'_, P, I>) {
        if share.counts.len() <= 1 {
            return self.lend(|workspace| part::emit(job, share.part, workspace));
        }
        let counts = share.counts;
        let threads = worth_waking(PartCounts::sum(counts).bytes(), self.threads());
        if threads == 1 {
            let write = |workspace: &mut Workspace| {
                share.into_parts().for_each(|part| part::emit(job, part, workspace));
            };
            return self.lend(write);
        }
        let slices: Vec<_> = share.into_parts().map(|part| Mutex::new(Some(part))).collect();
        let written = AtomicUsize::new(0);
        on_threads(threads, &|| {
            self.lend(|workspace| {
                for slice in self.own_first(counts, &slices) {
                    let part = slice.lock().unwrap_or_else(PoisonError::into_inner).take();
                    if let Some(part) = part {
                        part::emit(job, part, workspace);
                        written.fetch_add(1, Ordering::Relaxed);
                    }
                }
            });
            let start = Instant::now();
            while written.load(Ordering::Relaxed) < slices.len() && start.elapsed() < TOGETHER {
                std::thread::yield_now();
            }
        });
    }

    /// All slices, which have these counts, from the first one of this thread on. Threads' own slices
    /// have about the same output.
    fn own_first<'a, T>(
        &self,
        counts: &[PartCounts],
        slices: &'a [T],
    ) -> impl Iterator<Item = &'a T> {
        let (own, threads) = (self.own() as u64, self.0.len() as u64);
        let before = PartCounts::sum(counts).bytes() * own / threads;
        let mut sum = 0;
        let first = counts.iter().position(|slice| {
            sum += slice.bytes();
            sum > before
        });
        let (others, from_own) = slices.split_at(first.unwrap_or(0));
        from_own.iter().chain(others)
    }

    /// The number of the workspace and of the slices that are this thread's own.
    fn own(&self) -> usize {
        rayon::current_thread_index().unwrap_or(0) % self.0.len()
    }

    /// Lends a workspace that is free, if possible always the same one to a thread; waits for one
    /// if the pool has more threads than there are workspaces.
    fn lend<T>(&self, borrow: impl FnOnce(&mut Workspace) -> T) -> T {
        let own = self.own();
        let (before, from_own) = self.0.split_at(own);
        let free = from_own.iter().chain(before).find_map(|workspace| workspace.try_lock().ok());
        // Templates are entered when they are complete, so one that a panic left is still right.
        let mut workspace =
            free.unwrap_or_else(|| self.0[own].lock().unwrap_or_else(PoisonError::into_inner));
        borrow(&mut workspace)
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

/// Counts a share on this many threads, unless that takes less than waking them.
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

/// Starts rayon's global pool with [`MAX_THREADS`] if `RAYON_NUM_THREADS` asks for more. Starting a
/// hundred thousand takes minutes.
fn limit_global_pool() {
    let wanted = std::env::var("RAYON_NUM_THREADS").ok().and_then(|value| value.parse().ok());
    if wanted.is_some_and(|wanted: usize| wanted > MAX_THREADS) {
        // Fails if the pool was started before; its size is the program's own choice then.
        let _ = rayon::ThreadPoolBuilder::new().num_threads(MAX_THREADS).build_global();
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
