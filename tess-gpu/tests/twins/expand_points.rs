//! The pass `expand_points`: the points of the portion that are in the window, each patch's at its
//! offset.

use super::buffers::{Bound, POINTS, Pass};
use std::ops::Range;
use tess_core::DomainPoint;
use tess_gpu::layout::{Job, PackedPoint};
use tess_gpu::{PointFormat, Resource};

pub(crate) fn expand_points(pass: &Pass<'_>, b: &mut Bound<'_>) {
    if b.is_overflow() {
        return;
    }
    let window = window(&pass.job);
    for (number, patch) in (0..).zip(pass.patches) {
        let begin = b.patch_offset(&pass.job, number)[POINTS];
        let elements = u64::from(begin)..u64::from(begin) + u64::from(patch.counts().points);
        if elements.end <= window.start || window.end <= elements.start {
            continue;
        }
        for (element, point) in elements.zip(patch.tessellate().points) {
            if window.contains(&element) {
                let entry = u32::try_from(element - window.start).expect("below 2^32");
                let words =
                    format_point(pass.setup.point_format, point, pass.job.first_patch + number);
                b.set_pair(Resource::Points, entry, words);
            }
        }
    }
}

/// The elements of the window that is bound.
pub(crate) fn window(job: &Job) -> Range<u64> {
    let [first, tiles] = [job.window_first, job.window_tiles].map(u64::from);
    first << job.tile_bits..(first + tiles) << job.tile_bits
}

/// `layout/point_format.wgsl`: a point in two words.
pub(crate) fn format_point(format: PointFormat, point: DomainPoint, patch: u32) -> [u32; 2] {
    match format {
        PointFormat::Packed => PackedPoint::new(point, patch).0,
        PointFormat::F32 => point.to_f32().map(f32::to_bits),
    }
}
