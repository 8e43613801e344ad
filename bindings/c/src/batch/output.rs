//! The buffers and formats of a batch's output.

use crate::boundary::MemoryState;
use crate::status::{TESS_UNKNOWN_VALUE, TessStatus};
use std::ffi::c_void;
use std::mem::{align_of, offset_of, size_of};
use tess_core::DomainPoint;
use tess_simd::{BatchCounts, PatchRange};

/// Point format: `TessPoint`, a pair of unsigned 16.16 numbers.
pub const TESS_POINT_FIXED: u32 = 0;
/// Point format: two floats, exactly equal to the 16.16 numbers.
pub const TESS_POINT_F32: u32 = 1;

/// Point format: as `TESS_POINT_F32`, but u and v in two arrays. `points` has `2 * point_capacity`
/// floats: u of each point from float 0, v of each point from float `point_capacity`.
pub const TESS_POINT_F32_APART: u32 = 2;

/// Index type: `uint32_t`.
pub const TESS_INDEX_U32: u32 = 0;
/// Index type: `uint16_t`, which is always enough with `TESS_NUMBERING_PER_PATCH`. With
/// `TESS_NUMBERING_PER_BATCH` it numbers 65536 points. The last index, 65535, restarts primitives
/// in WebGL 2 and wherever primitive restart is on. There, `base_vertex` plus the number of points
/// in the batch must not exceed `TESS_POINTS_WITHOUT_RESTART_U16`.
pub const TESS_INDEX_U16: u32 = 1;
/// The points that `uint16_t` numbers from 0 without the index 65535.
pub const TESS_POINTS_WITHOUT_RESTART_U16: u32 = 65535;

/// Numbering: indices count from the first point of their patch.
pub const TESS_NUMBERING_PER_PATCH: u32 = 0;
/// Numbering: indices count from the first point of the batch, whose number is `base_vertex`.
pub const TESS_NUMBERING_PER_BATCH: u32 = 1;

/// Memory: the buffers may be uninitialised.
pub const TESS_MEMORY_ANY: u32 = 0;
/// Memory: every byte of the buffers has been written before, by `calloc`, `memset`, an earlier
/// call or the caller. This is faster, because the call need not clear them first.
pub const TESS_MEMORY_INITIALISED: u32 = 1;

/// Sizes of a batch's output.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TessBatchCounts {
    /// Patches, including culled ones: elements of `ranges`.
    pub patches: usize,
    /// Elements of `points`.
    pub points: usize,
    /// Elements of `indices`.
    pub indices: usize,
}

/// The part of a batch's output that belongs to one patch or one group. A culled patch has neither
/// points nor indices.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TessRange {
    /// Number of its first point in the batch's points.
    pub first_point: u32,
    /// Number of its points.
    pub points: u32,
    /// Number of its first index in the batch's indices.
    pub first_index: u32,
    /// Number of its indices.
    pub indices: u32,
}

/// The buffers and formats of a batch's output. Capacities count elements. A buffer of
/// capacity 0 may be null.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct TessBatchOutput {
    /// Receives the points of all patches, one patch after another.
    pub points: *mut c_void,
    /// Number of elements that `points` has room for.
    pub point_capacity: usize,
    /// Receives the indices of all patches, one patch after another.
    pub indices: *mut c_void,
    /// Number of elements that `indices` has room for.
    pub index_capacity: usize,
    /// Receives one range for each patch. Null, with a `range_capacity` of 0, if you do not want
    /// ranges.
    pub ranges: *mut TessRange,
    /// Number of elements that `ranges` has room for.
    pub range_capacity: usize,
    /// `TESS_POINT_FIXED`, `TESS_POINT_F32` or `TESS_POINT_F32_APART`
    pub point_format: u32,
    /// `TESS_INDEX_U32` or `TESS_INDEX_U16`
    pub index_type: u32,
    /// `TESS_NUMBERING_...`
    pub numbering: u32,
    /// The number of the batch's first point with `TESS_NUMBERING_PER_BATCH`, else ignored.
    pub base_vertex: u32,
    /// `TESS_MEMORY_ANY` or `TESS_MEMORY_INITIALISED`, which is a promise about all three buffers.
    pub memory: u32,
}

impl TessBatchOutput {
    /// The buffers' memory, as the caller describes it.
    ///
    /// # Safety
    /// - With `TESS_MEMORY_INITIALISED` the buffers are initialised, up to their capacities.
    pub(super) const unsafe fn memory(&self) -> Result<MemoryState, TessStatus> {
        match self.memory {
            TESS_MEMORY_ANY => Ok(MemoryState::ANY),
            // SAFETY: as the caller promises.
            TESS_MEMORY_INITIALISED => Ok(unsafe { MemoryState::initialised() }),
            _ => Err(TESS_UNKNOWN_VALUE),
        }
    }
}

/// The instance of a function for the formats of an output; `TESS_UNKNOWN_VALUE` if a format has an
/// unknown number.
macro_rules! in_formats {
    ($output:expr, $function:ident) => {{
        use crate::batch::points::{Apart, Together};
        use crate::batch::{TESS_INDEX_U16, TESS_INDEX_U32};
        use crate::batch::{TESS_POINT_F32, TESS_POINT_F32_APART, TESS_POINT_FIXED};
        match ($output.point_format, $output.index_type) {
            (TESS_POINT_FIXED, TESS_INDEX_U32) => $function::<Together<'_, DomainPoint>, u32>,
            (TESS_POINT_FIXED, TESS_INDEX_U16) => $function::<Together<'_, DomainPoint>, u16>,
            (TESS_POINT_F32, TESS_INDEX_U32) => $function::<Together<'_, [f32; 2]>, u32>,
            (TESS_POINT_F32, TESS_INDEX_U16) => $function::<Together<'_, [f32; 2]>, u16>,
            (TESS_POINT_F32_APART, TESS_INDEX_U32) => $function::<Apart<'_>, u32>,
            (TESS_POINT_F32_APART, TESS_INDEX_U16) => $function::<Apart<'_>, u16>,
            _ => return Err(crate::status::TESS_UNKNOWN_VALUE),
        }
    }};
}
pub(super) use in_formats;

// The structures that the batch backend writes have the same layout as those here.
const _: () = {
    assert!(size_of::<TessRange>() == size_of::<PatchRange>(), "ranges have the same size");
    assert!(align_of::<TessRange>() == align_of::<PatchRange>(), "ranges have the same alignment");
    assert!(offset_of!(TessRange, first_point) == offset_of!(PatchRange, first_point), "field 1");
    assert!(offset_of!(TessRange, points) == offset_of!(PatchRange, points), "field 2");
    assert!(offset_of!(TessRange, first_index) == offset_of!(PatchRange, first_index), "field 3");
    assert!(offset_of!(TessRange, indices) == offset_of!(PatchRange, indices), "field 4");
    assert!(size_of::<DomainPoint>() == 8 && align_of::<DomainPoint>() == 4, "a pair of words");
};

impl From<PatchRange> for TessRange {
    fn from(range: PatchRange) -> Self {
        let PatchRange { first_point, points, first_index, indices } = range;
        Self { first_point, points, first_index, indices }
    }
}

impl From<BatchCounts> for TessBatchCounts {
    fn from(counts: BatchCounts) -> Self {
        let BatchCounts { patches, points, indices } = counts;
        Self { patches, points, indices }
    }
}
