//! Factor processing, step by step.

use crate::boundary;
use crate::status::{TessStatus, answer};
use crate::types::{self, TessConfig, TessContext};
use tess_core::{ProcessedFactor, ProcessedPatch};

/// The patch is culled: no points, no indices, no processed factors.
pub const TESS_OUTCOME_CULLED: u32 = 0;
/// Every factor is 1: the minimum patch, of one or two triangles.
pub const TESS_OUTCOME_MINIMUM: u32 = 1;
/// Every other patch.
pub const TESS_OUTCOME_REGULAR: u32 = 2;

/// One factor after each step of factor processing (specification, section 3).
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TessProcessedFactor {
    /// Bits of the binary32 factor after clamping (steps 2 and 5).
    pub clamped: u32,
    /// Bits of the binary32 factor after rounding (steps 3 and 5).
    pub rounded: u32,
    /// The factor as an unsigned 15.16 number (step 7).
    pub fixed: u32,
    /// Its parity (step 6) and the six numbers derived from it (section 4).
    pub context: TessContext,
}

/// Result of factor processing for a patch.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TessProcessedPatch {
    /// `TESS_OUTCOME_...`
    pub outcome: u32,
    /// Number of elements of `factors` that are used: 0 if culled, else as many as the domain has.
    pub factor_count: u32,
    /// The factors in the order of the input; elements past `factor_count` are zero.
    pub factors: [TessProcessedFactor; 6],
}

/// Processes the factors of a patch: cull, clamp, round, parity, conversion, context.
///
/// # Safety
/// Pointers that are not null and aligned must be valid:
/// - `config` for reading one configuration,
/// - `factors` for reading `factor_count` floats,
/// - `processed` for writing one structure.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_process(
    config: *const TessConfig,
    factors: *const f32,
    factor_count: usize,
    processed: *mut TessProcessedPatch,
) -> TessStatus {
    answer(|| {
        // SAFETY: `config` and `factors` are readable, as the caller promises.
        let patch = unsafe { types::patch(config, factors, factor_count) }?;
        // SAFETY: `processed` is writable, as the caller promises.
        unsafe { boundary::write(processed, patch.processed().into()) }
    })
}

impl From<&ProcessedPatch> for TessProcessedPatch {
    fn from(patch: &ProcessedPatch) -> Self {
        let (outcome, factors) = match patch {
            ProcessedPatch::Culled => return Self::default(),
            ProcessedPatch::Minimum(factors) => (TESS_OUTCOME_MINIMUM, factors),
            ProcessedPatch::Regular(factors) => (TESS_OUTCOME_REGULAR, factors),
        };
        let mut out = Self { outcome, ..Self::default() };
        for (slot, factor) in out.factors.iter_mut().zip(factors.iter()) {
            *slot = factor.into();
            out.factor_count += 1;
        }
        out
    }
}

impl From<ProcessedFactor> for TessProcessedFactor {
    fn from(factor: ProcessedFactor) -> Self {
        let ProcessedFactor { clamped, rounded, fixed, context } = factor;
        Self { clamped, rounded, fixed: fixed.to_bits(), context: context.into() }
    }
}
