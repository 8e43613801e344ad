//! Counting and writing on the calling thread only.

use crate::data::format::IndexFormat;
use crate::data::point_writer::PointRoom;
use crate::threads::part::{self, Job, Workspace};
use crate::threads::slices::{CountShare, Share};
use tess_core::Config;
use tess_level::Level;

/// The only workspace.
#[derive(Clone, Debug)]
pub(crate) struct Workspaces(Workspace);

impl Workspaces {
    pub(crate) fn new() -> Self {
        Self(Workspace::new())
    }

    /// Drops everything that was kept from earlier batches.
    pub(crate) fn forget(&mut self) {
        self.0 = Workspace::new();
    }

    /// The workspace of the calling thread.
    pub(crate) fn one(&mut self) -> &mut Workspace {
        &mut self.0
    }

    /// The number of threads that write: 1.
    #[expect(clippy::unused_self, reason = "the same interface as with a pool")]
    pub(crate) const fn threads(&self) -> usize {
        1
    }

    /// Allocates all the memory that the workspace may ever need.
    pub(crate) fn reserve(&mut self) {
        self.0.reserve();
    }

    /// Bytes of heap memory.
    pub(crate) fn bytes(&self) -> usize {
        self.0.bytes()
    }

    /// Counts a share, slice by slice.
    #[expect(clippy::unused_self, reason = "the same interface as with a pool")]
    pub(crate) fn count(&self, level: Level, config: Config, share: CountShare<'_>) {
        share.count(level, config);
    }

    /// Writes a share, which has one slice.
    pub(crate) fn emit<P: PointRoom, I: IndexFormat>(
        &mut self,
        job: Job<'_>,
        share: Share<'_, P, I>,
    ) {
        part::emit(job, share.part, &mut self.0);
    }
}
