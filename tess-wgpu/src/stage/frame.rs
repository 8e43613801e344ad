//! A prepared frame, the only thing that a material draws.

use super::StageError;
use super::output::StageOutput;
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Arc, Weak};

/// A frame that a stage has prepared.
///
/// [`TessellationStage::prepare`](super::TessellationStage::prepare) returns it and
/// [`Material::draw`](super::Material::draw) takes it, so that nothing can be drawn that was not
/// prepared. It can be drawn any number of times, also in later render passes and encoders, until
/// its stage prepares the next frame or is dropped. A clone is another handle to the same frame.
#[derive(Clone, Debug)]
pub struct Frame {
    pub(super) number: u64,
    pub(super) output: StageOutput,
    pub(super) stage: WeakCount,
}

/// The number of frames that a stage has prepared. It is gone when the stage is.
#[derive(Debug, Default)]
pub(super) struct FrameCount(Arc<AtomicU64>);

/// The identity of a stage for its frames and materials.
#[derive(Clone, Debug)]
pub(super) struct WeakCount(Weak<AtomicU64>);

impl FrameCount {
    pub(super) fn get(&self) -> u64 {
        self.0.load(Ordering::Relaxed)
    }

    /// Counts a frame, and returns its number.
    pub(super) fn next(&mut self) -> u64 {
        self.0.fetch_add(1, Ordering::Relaxed)
    }

    pub(super) fn downgrade(&self) -> WeakCount {
        WeakCount(Arc::downgrade(&self.0))
    }
}

impl Frame {
    /// The number of the frame, as in [`Feedback::frame`](super::Feedback::frame).
    #[must_use]
    pub const fn number(&self) -> u64 {
        self.number
    }

    /// Refuses a frame that a material of the stage `of` must not draw: the frame of another stage,
    /// of a stage that is gone, or an earlier one than the stage's last.
    pub(super) fn check(&self, of: &WeakCount) -> Result<(), StageError> {
        let (Some(count), true) = (self.stage.0.upgrade(), of.0.strong_count() > 0) else {
            return Err(StageError::StageGone);
        };
        if !Weak::ptr_eq(&self.stage.0, &of.0) {
            return Err(StageError::OtherStage);
        }
        let last = count.load(Ordering::Relaxed).saturating_sub(1);
        if last != self.number {
            return Err(StageError::OldFrame { frame: self.number, last });
        }
        Ok(())
    }
}
