//! The calling thread alone.

use crate::format::{IndexFormat, PointFormat};
use crate::part::{self, Part, Workspace};
use crate::share::{Plan, Share};

/// The one workspace.
#[derive(Clone, Debug)]
pub(crate) struct Workspaces(Workspace);

impl Workspaces {
    pub(crate) fn new() -> Self {
        Self(Workspace::new())
    }

    /// How many threads write at a time.
    #[expect(clippy::unused_self, reason = "the same interface as with a pool")]
    pub(crate) const fn threads(&self) -> usize {
        1
    }

    /// Bytes of memory that it takes.
    pub(crate) fn bytes(&self) -> usize {
        self.0.bytes()
    }

    /// Writes a share, which has one slice.
    pub(crate) fn emit<P: PointFormat, I: IndexFormat>(
        &mut self,
        plan: Plan<'_>,
        share: Share<'_, P, I>,
    ) {
        let Share { batch, buffers, first, .. } = share;
        let part = Part { batch, buffers, first, numbering: plan.numbering };
        part::emit((plan.level, plan.config), plan.stitches, part, &mut self.0);
    }
}

/// Runs both.
pub(crate) fn join(one: impl FnOnce(), other: impl FnOnce()) {
    one();
    other();
}
