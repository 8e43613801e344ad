//! The caller's buffers, in formats that are known at run time.
//!
//! Below the public interface nothing depends on the formats' types, so that everything is compiled
//! once, in this crate, for each pair of formats.

use crate::data::format::{AnyIndices, AnyPoints, IndexFormat, OutputPoint};
#[cfg(feature = "apart")]
use crate::data::output::ApartBuffers;
use crate::data::output::Buffers;
use crate::data::ranges::Ranges;

/// Buffers for exactly one part of a batch.
#[derive(Debug)]
pub(crate) struct Target<'a> {
    pub(crate) points: AnyPoints<'a>,
    pub(crate) indices: AnyIndices<'a>,
    pub(crate) ranges: Ranges<'a>,
}

impl<'a, P: OutputPoint, I: IndexFormat> From<Buffers<'a, P, I>> for Target<'a> {
    fn from(buffers: Buffers<'a, P, I>) -> Self {
        let Buffers { points, indices, ranges } = buffers;
        Self { points: P::any(points), indices: I::any(indices), ranges: Ranges::new(ranges) }
    }
}

#[cfg(feature = "apart")]
impl<'a, I: IndexFormat> From<ApartBuffers<'a, I>> for Target<'a> {
    fn from(buffers: ApartBuffers<'a, I>) -> Self {
        let ApartBuffers { u, v, indices, ranges } = buffers;
        let points = AnyPoints::F32Apart([u, v]);
        Self { points, indices: I::any(indices), ranges: Ranges::new(ranges) }
    }
}

#[cfg(feature = "rayon")]
impl Target<'_> {
    /// Splits the buffers behind the output of the first patches, which has these sizes.
    pub(crate) fn split_at(self, sizes: crate::data::output::BatchCounts) -> (Self, Self) {
        let (points, more_points) = match self.points {
            AnyPoints::F32(all) => both(all.split_at_mut(sizes.points), AnyPoints::F32),
            AnyPoints::Fixed(all) => both(all.split_at_mut(sizes.points), AnyPoints::Fixed),
            #[cfg(feature = "apart")]
            AnyPoints::F32Apart(arrays) => {
                let [(u, more_u), (v, more_v)] = arrays.map(|all| all.split_at_mut(sizes.points));
                both(([u, v], [more_u, more_v]), AnyPoints::F32Apart)
            }
        };
        let (indices, more_indices) = match self.indices {
            AnyIndices::U16(all) => both(all.split_at_mut(sizes.indices), AnyIndices::U16),
            AnyIndices::U32(all) => both(all.split_at_mut(sizes.indices), AnyIndices::U32),
        };
        let (ranges, more_ranges) = self.ranges.split_at(sizes.patches);
        (
            Self { points, indices, ranges },
            Self { points: more_points, indices: more_indices, ranges: more_ranges },
        )
    }
}

#[cfg(feature = "rayon")]
fn both<T, U>((one, other): (T, T), f: impl Fn(T) -> U) -> (U, U) {
    (f(one), f(other))
}
