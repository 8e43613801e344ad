//! The caller's ranges.

use crate::data::output::PatchRange;
use core::mem::take;

/// The ranges of patches, written from front to back where the caller wants them. Nobody can read them back, so that
/// nothing depends on whether they are there.
#[derive(Debug)]
pub(crate) struct Ranges<'a>(Option<&'a mut [PatchRange]>);

impl<'a> Ranges<'a> {
    /// A range for each patch, or none.
    pub(crate) const fn new(all: Option<&'a mut [PatchRange]>) -> Self {
        Self(all)
    }

    /// Writes the next ranges.
    pub(crate) fn put(&mut self, ranges: &[PatchRange]) {
        if let Some(next) = self.next(ranges.len()) {
            next.copy_from_slice(ranges);
        }
    }

    /// Writes the next `times` ranges: the first one, and those of patches of the same sizes behind it.
    pub(crate) fn repeat(&mut self, first: PatchRange, times: usize) {
        let mut range = first;
        for next in self.next(times).unwrap_or_default() {
            *next = range;
            range.first_point = range.first_point.wrapping_add(range.points);
            range.first_index = range.first_index.wrapping_add(range.indices);
        }
    }

    /// The next ranges, which count as written.
    fn next(&mut self, patches: usize) -> Option<&'a mut [PatchRange]> {
        let (next, rest) = take(&mut self.0)?.split_at_mut(patches);
        self.0 = Some(rest);
        Some(next)
    }

    /// Splits them behind the first patches.
    #[cfg(feature = "rayon")]
    pub(crate) fn split_at(mut self, patches: usize) -> (Self, Self) {
        (Self(self.next(patches)), self)
    }

    /// How many there are.
    #[cfg(all(test, feature = "rayon"))]
    pub(crate) fn len(&self) -> usize {
        self.0.as_ref().map_or(0, |all| all.len())
    }
}
