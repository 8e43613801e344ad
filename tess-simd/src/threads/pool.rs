//! The threads of the current rayon pool: each takes the next slice when it has finished one.

use crate::format::{IndexFormat, PointFormat};
use crate::part::{self, Part, Workspace};
use crate::share::{Plan, Share, halve};
use alloc::vec::Vec;
use std::sync::{Mutex, PoisonError};

/// A workspace for each thread. A copy starts with empty ones.
#[derive(Debug)]
pub(crate) struct Workspaces(Vec<Mutex<Workspace>>);

impl Workspaces {
    pub(crate) fn new() -> Self {
        Self::of_threads(1)
    }

    /// Workspaces for this many threads, at least one.
    pub(crate) fn of_threads(threads: usize) -> Self {
        Self((0..threads.max(1)).map(|_| Mutex::new(Workspace::new())).collect())
    }

    /// How many threads write at a time.
    pub(crate) fn threads(&self) -> usize {
        self.0.len()
    }

    /// Bytes of memory that they take.
    pub(crate) fn bytes(&self) -> usize {
        self.0.len() * self.lend(|workspace| workspace.bytes())
    }

    /// Writes a share, slice by slice.
    pub(crate) fn emit<P: PointFormat, I: IndexFormat>(
        &self,
        plan: Plan<'_>,
        share: Share<'_, P, I>,
    ) {
        if share.counts.len() > 1 {
            let (one, other) = halve(plan, share);
            join(|| self.emit(plan, one), || self.emit(plan, other));
            return;
        }
        let Share { batch, buffers, first, .. } = share;
        let part = Part { batch, buffers, first, numbering: plan.numbering };
        self.lend(|workspace| {
            part::emit((plan.level, plan.config), plan.stitches, part, workspace);
        });
    }

    /// Lends a workspace that is free, if possible always the same one to a thread; waits for one
    /// if the pool has more threads than there are workspaces.
    fn lend<T>(&self, borrow: impl FnOnce(&mut Workspace) -> T) -> T {
        let own = rayon::current_thread_index().unwrap_or(0) % self.0.len();
        let (before, from_own) = self.0.split_at(own);
        let free = from_own.iter().chain(before).find_map(|workspace| workspace.try_lock().ok());
        // Templates are entered when they are complete, so one that a panic left is still right.
        let mut workspace =
            free.unwrap_or_else(|| self.0[own].lock().unwrap_or_else(PoisonError::into_inner));
        borrow(&mut workspace)
    }
}

impl Clone for Workspaces {
    fn clone(&self) -> Self {
        Self::of_threads(self.threads())
    }
}

/// Runs both, on two threads if there are.
pub(crate) fn join(one: impl FnOnce() + Send, other: impl FnOnce() + Send) {
    rayon::join(one, other);
}
