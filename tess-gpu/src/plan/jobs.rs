//! The jobs of a batch, which tell the shaders about a portion and a window.

use super::Plan;
use crate::layout::Job;
use crate::sizes::ALIGNMENT;

/// The part of a portion's work that a job describes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum JobPart {
    /// All of it: counting, partitioning, and the expansions of a short batch.
    Whole,
    /// The points in a window.
    Points {
        /// Number of the window.
        window: u32,
    },
    /// The primitives in a window.
    Primitives {
        /// Number of the window.
        window: u32,
    },
}

impl Plan {
    /// The contents of the buffer of jobs.
    #[must_use]
    pub fn jobs(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        for number in 0..self.job_count() {
            let job = self.job(number / self.parts(), self.part(number % self.parts()));
            bytes.extend_from_slice(bytemuck::bytes_of(&job));
            bytes.resize(bytes.len().next_multiple_of(JOB_STRIDE), 0);
        }
        bytes
    }

    /// The number of jobs. A batch without patches has the jobs of an empty portion.
    pub(super) fn job_count(&self) -> u32 {
        self.portions().max(1) * self.parts()
    }

    /// The number of a job. Each portion has one job for the whole portion, one for each window of
    /// the points and one for each window of the primitives. `shared/finish.wgsl` numbers the sizes
    /// of dispatches in the same way.
    pub(super) fn job_number(&self, portion: u32, part: JobPart) -> u32 {
        let in_portion = match part {
            JobPart::Whole => 0,
            JobPart::Points { window } => 1 + window,
            JobPart::Primitives { window } => 1 + self.point_windows() + window,
        };
        portion * self.parts() + in_portion
    }

    /// Jobs of a portion.
    fn parts(&self) -> u32 {
        1 + self.point_windows() + self.primitive_windows()
    }

    /// The part that has this number within its portion.
    fn part(&self, number: u32) -> JobPart {
        match number.checked_sub(1) {
            None => JobPart::Whole,
            Some(window) if window < self.point_windows() => JobPart::Points { window },
            Some(window) => JobPart::Primitives { window: window - self.point_windows() },
        }
    }

    fn job(&self, portion: u32, part: JobPart) -> Job {
        let (window_first, window_tiles) = match part {
            JobPart::Whole => (0, u32::MAX),
            JobPart::Points { window } => {
                (window * self.point_window_tiles, self.point_window_tiles)
            }
            JobPart::Primitives { window } => {
                (window * self.primitive_window_tiles, self.primitive_window_tiles)
            }
        };
        Job {
            patches: self.patches_in(portion),
            first_patch: portion * self.portion_patches,
            portion,
            stride: self.portion_patches,
            blocks_at: self.blocks_at(),
            alike_at: self.alike_at(),
            sections_at: self.sections_at(),
            primitive_tiles_at: self.primitive_tiles_at(),
            window_first,
            window_tiles,
            portions: self.portions(),
            point_capacity: self.capacity.points,
            primitive_capacity: self.capacity.primitives,
            point_windows: self.point_windows(),
            primitive_windows: self.primitive_windows(),
            point_window_tiles: self.point_window_tiles,
            primitive_window_tiles: self.primitive_window_tiles,
            max_workgroups: self.max_workgroups,
            tile_bits: self.tile_bits,
            has_catalogue: self.has_catalogue().into(),
        }
    }
}

/// Bytes between two jobs.
#[expect(clippy::cast_possible_truncation, reason = "an alignment of 256")]
const JOB_STRIDE: usize = ALIGNMENT as usize;
const _: () = assert!(size_of::<Job>() <= JOB_STRIDE, "a job fits between two");
