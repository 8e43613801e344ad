//! shared/finish.wgsl: whether everything fits, the draw arguments and the sizes of the indirect
//! dispatches.

use super::buffers::{Bound, PRIMITIVES, Pass, STATUS_OVERFLOW, constant};
use super::totals::low;
use tess_gpu::Resource::{Arguments, Status};
use tess_gpu::layout::Job;
use tess_gpu::sizes::WORKGROUP;

pub(crate) fn finish(pass: &Pass<'_>, totals: [u64; 2], b: &mut Bound<'_>) {
    let job = &pass.job;
    let room = [job.point_capacity, job.primitive_capacity].map(u64::from);
    let overflow = u32::from(totals[0] > room[0]) | u32::from(totals[1] > room[1]) << 1;
    b.set(Status, STATUS_OVERFLOW, overflow);
    let indices = totals[PRIMITIVES] * u64::from(pass.setup.indices_per_primitive());
    let draw = [if overflow == 0 { low(indices) } else { 0 }, 1, 0, 0, 0];
    (0..).zip(draw).for_each(|(word, argument)| b.set(Arguments, word, argument));
    let first = constant(pass.setup, "DISPATCHES_AT");
    let parts = 1 + job.point_windows + job.primitive_windows;
    for number in 0..job.portions * parts {
        let portion = Job { portion: number / parts, ..*job };
        let workgroups = match overflow {
            0 => workgroups(&portion, number % parts, b.ranges(&portion)),
            _ => 0,
        };
        // In rows no longer than the limit.
        let rows = workgroups.div_ceil(job.max_workgroups);
        let size = [workgroups.min(job.max_workgroups), rows.max(1), 1];
        (first + 3 * number..).zip(size).for_each(|(word, size)| b.set(Arguments, word, size));
    }
}

/// The workgroups of a portion's dispatch: `partition`, then one for each window of points and of
/// primitives.
fn workgroups(job: &Job, part: u32, [points, primitives]: [[u32; 2]; 2]) -> u32 {
    let window_of = |window: u32, tiles: u32| [window * tiles, (window + 1) * tiles];
    match part.checked_sub(1) {
        None => {
            let everywhere = [0, u32::MAX];
            let tiles = tiles(job, points, everywhere) + tiles(job, primitives, everywhere);
            // An entry for each tile, and one after those of each output.
            (tiles + 2).div_ceil(WORKGROUP)
        }
        Some(window) if window < job.point_windows => {
            tiles(job, points, window_of(window, job.point_window_tiles))
        }
        Some(window) => {
            let window = window - job.point_windows;
            tiles(job, primitives, window_of(window, job.primitive_window_tiles))
        }
    }
}

/// The number of tiles of a window that have elements of a range.
fn tiles(job: &Job, [begin, end]: [u32; 2], [first, last]: [u32; 2]) -> u32 {
    if begin == end {
        return 0;
    }
    let begin = (begin >> job.tile_bits).max(first);
    end.div_ceil(1 << job.tile_bits).min(last).saturating_sub(begin)
}
