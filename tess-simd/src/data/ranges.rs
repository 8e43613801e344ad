//! The caller's ranges.

use crate::data::output::PatchRange;
use core::mem::take;

/// The ranges of patches, written from front to back if the caller wants them. There is no way to
/// ask whether they are wanted or how many are left, so the output cannot depend on it.
#[derive(Debug)]
pub(crate) struct Ranges<'a>(Option<&'a mut [PatchRange]>);

impl<'a> Ranges<'a> {
    /// The caller's ranges, one for each patch, or `None`.
    pub(crate) const fn new(all: Option<&'a mut [PatchRange]>) -> Self {
        Self(all)
    }

    /// Room for the next `own.len()` ranges: the caller's, or else `own`. Its contents are stale;
    /// write before you read.
    pub(crate) fn next_or<'b>(&mut self, own: &'b mut [PatchRange]) -> &'b mut [PatchRange]
    where
        'a: 'b,
    {
        self.next(own.len()).unwrap_or(own)
    }

    /// Writes the ranges of the `more` patches after `patch`, which have the same sizes.
    #[inline(always)]
    pub(crate) fn repeat(&mut self, patch: PatchRange, more: usize) {
        let mut range = patch;
        for next in self.next(more).unwrap_or_default() {
            range.first_point = range.first_point.wrapping_add(range.points);
            range.first_index = range.first_index.wrapping_add(range.indices);
            *next = range;
        }
    }

    /// The next ranges, which then count as written; `None` if the caller wants none.
    #[inline(always)]
    fn next(&mut self, patches: usize) -> Option<&'a mut [PatchRange]> {
        let (next, rest) = take(&mut self.0)?.split_at_mut(patches);
        self.0 = Some(rest);
        Some(next)
    }

    /// Splits the ranges after the first `patches`.
    #[cfg(feature = "rayon")]
    pub(crate) fn split_at(mut self, patches: usize) -> (Self, Self) {
        (Self(self.next(patches)), self)
    }
}
