//! Groups: the meshes of a batch, each with its own part of the output.

use crate::data::output::PatchRange;
use core::fmt;

/// The range of the output that belongs to each group of patches.
///
/// `ranges` are the ranges of a batch's patches. `starts` has the number of the first patch of each
/// group. A group ends where the next one begins, and the last one ends with the batch. A group's
/// output is contiguous, because the output is in the order of the patches. A renderer can
/// therefore tessellate all meshes of a frame in one call and draw each mesh separately.
///
/// ```
/// use tess_simd::tess_core::{Config, OutputPrimitive, Partitioning, QuadFactors};
/// use tess_simd::{Numbering, Output, Tessellator, group_ranges};
///
/// let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
/// let patches = [1.0, 1.0, 1.0, 2.0, 2.0].map(QuadFactors::uniform);
/// let mut output: Output = Output::new();
/// Tessellator::new(config).tessellate(&patches, Numbering::PerPatch, &mut output)?;
///
/// let groups: Vec<_> = group_ranges(output.ranges(), &[0, 3])?.collect();
/// assert_eq!((groups[0].first_index, groups[0].indices), (0, 3 * 6));
/// assert_eq!((groups[1].first_index, groups[1].indices), (18, 2 * 24));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// [`BadGroupError`] if a group begins before its predecessor, or past the end of the batch.
pub fn group_ranges<'a>(
    ranges: &'a [PatchRange],
    starts: &'a [u32],
) -> Result<impl ExactSizeIterator<Item = PatchRange> + 'a, BadGroupError> {
    let mut lowest = 0;
    for (group, &start) in starts.iter().enumerate() {
        if start < lowest || start as usize > ranges.len() {
            return Err(BadGroupError { group, start, lowest, patches: ranges.len() });
        }
        lowest = start;
    }
    Ok((0..starts.len()).map(move |group| {
        let start = starts[group] as usize;
        let end = starts.get(group + 1).map_or(ranges.len(), |&next| next as usize);
        joined(&ranges[start..end], end_of(&ranges[..start]))
    }))
}

/// The joint range of consecutive patches; an empty one at `first` if there are none.
fn joined(ranges: &[PatchRange], first: (u32, u32)) -> PatchRange {
    let (first_point, first_index) = first;
    let (end_point, end_index) = if ranges.is_empty() { first } else { end_of(ranges) };
    PatchRange {
        first_point,
        points: end_point.wrapping_sub(first_point),
        first_index,
        indices: end_index.wrapping_sub(first_index),
    }
}

/// The first point and the first index after these patches.
fn end_of(ranges: &[PatchRange]) -> (u32, u32) {
    ranges.last().map_or((0, 0), |last| {
        (last.first_point.wrapping_add(last.points), last.first_index.wrapping_add(last.indices))
    })
}

/// A group of patches begins out of order or past the end of the batch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct BadGroupError {
    /// Number of the group.
    pub group: usize,
    /// The patch at which it begins.
    pub start: u32,
    /// The patch at which the previous group begins; 0 for the first group.
    pub lowest: u32,
    /// Number of patches of the batch.
    pub patches: usize,
}

impl fmt::Display for BadGroupError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { group, start, lowest, patches } = self;
        write!(f, "group {group} begins at patch {start}; it must be in {lowest}..={patches}")
    }
}

impl core::error::Error for BadGroupError {}
