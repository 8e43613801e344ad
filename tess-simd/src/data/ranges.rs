//! The caller's ranges.

use crate::data::output::PatchRange;
use core::mem::take;

/// The ranges of patches, written from front to back where the caller wants them. Nobody can ask
/// whether they are there or how many are left, so that nothing depends on it.
#[derive(Debug)]
pub(crate) struct Ranges<'a>(Option<&'a mut [PatchRange]>);

impl<'a> Ranges<'a> {
    /// A range for each patch, or none.
    pub(crate) const fn new(all: Option<&'a mut [PatchRange]>) -> Self {
        Self(all)
    }

    /// Room for the next ranges, to be written before it is read: the caller's, or all of `own`,
    /// which has as many.
    pub(crate) fn next_or<'b>(&mut self, own: &'b mut [PatchRange]) -> &'b mut [PatchRange]
    where
        'a: 'b,
    {
        self.next(own.len()).unwrap_or(own)
    }

    /// Writes the next ranges: those of `more` patches that follow a patch and have its sizes.
    #[inline(always)]
    pub(crate) fn repeat(&mut self, patch: PatchRange, more: usize) {
        let mut range = patch;
        for next in self.next(more).unwrap_or_default() {
            range.first_point = range.first_point.wrapping_add(range.points);
            range.first_index = range.first_index.wrapping_add(range.indices);
            *next = range;
        }
    }

    /// The next ranges, which count as written.
    #[inline(always)]
    fn next(&mut self, patches: usize) -> Option<&'a mut [PatchRange]> {
        let (next, rest) = take(&mut self.0)?.split_at_mut(patches);
        self.0 = Some(rest);
        Some(next)
    }

    /// Splits them after the first patches.
    #[cfg(feature = "rayon")]
    pub(crate) fn split_at(mut self, patches: usize) -> (Self, Self) {
        (Self(self.next(patches)), self)
    }
}
