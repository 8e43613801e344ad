//! Runs work on as many threads as can be started.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::thread::{Builder, scope};

/// Runs `work` for each worker: for the first on this thread, for each other one on a thread of its
/// own. If a thread cannot be started, its worker and those after it do nothing, so the remaining
/// workers must be able to do all the work. `None` stands for a panic.
pub(crate) fn run<W: Send, T: Send>(
    workers: &mut [W],
    work: impl Fn(&mut W) -> T + Sync,
) -> Vec<Option<T>> {
    let Some((first, others)) = workers.split_first_mut() else { return Vec::new() };
    let work = &work;
    scope(|scope| {
        let threads: Vec<_> = others
            .iter_mut()
            .map_while(|worker| Builder::new().spawn_scoped(scope, move || work(worker)).ok())
            .collect();
        let own = catch_unwind(AssertUnwindSafe(|| work(first))).ok();
        let others = threads.into_iter().map(|thread| thread.join().ok());
        [own].into_iter().chain(others).collect()
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicU32, Ordering};

    #[test]
    fn every_worker_works_and_panics_are_told() {
        let sum = AtomicU32::new(0);
        let results = run(&mut [1, 2, 3], |number| {
            assert_ne!(*number, 2, "a planted fault");
            sum.fetch_add(*number, Ordering::Relaxed);
            *number
        });
        assert_eq!(results, [Some(1), None, Some(3)]);
        assert_eq!(sum.into_inner(), 4);
        assert_eq!(run(&mut [2], |number| assert_ne!(*number, 2, "on this thread")), [None]);
        assert_eq!(run(&mut [], |number: &mut u32| *number), []);
    }
}
