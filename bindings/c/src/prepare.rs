//! Factor preparation: HLSL's `Process...TessFactors` functions (specification, section 9).

use crate::boundary;
use crate::status::{TessStatus, answer};
use crate::types::{self, listed};
use tess_core::prepare::{QuadAxes, Reduction, Request, prepare};
use tess_core::{Domain, Partitioning, PatchFactors};

/// Reduction: the smallest of the outer factors.
pub const TESS_REDUCTION_MIN: u32 = 0;
/// Reduction: the largest of the outer factors.
pub const TESS_REDUCTION_MAX: u32 = 1;
/// Reduction: the sum of the outer factors, divided by their number.
pub const TESS_REDUCTION_AVERAGE: u32 = 2;

/// Quad axes: one reduction over all four edges, with the U scale, for both inside factors.
pub const TESS_AXES_ONE: u32 = 0;
/// Quad axes: U from the edges V=0 and V=1, V from the edges U=0 and U=1.
pub const TESS_AXES_TWO: u32 = 1;

const REDUCTIONS: [Reduction; 3] = [Reduction::Min, Reduction::Max, Reduction::Average];
const AXES: [QuadAxes; 2] = [QuadAxes::One, QuadAxes::Two];

/// The kind of preparation. Each field is one of the constants with the given prefix.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct TessPreparation {
    /// `TESS_DOMAIN_...`
    pub domain: u32,
    /// `TESS_PARTITIONING_...`
    pub partitioning: u32,
    /// `TESS_REDUCTION_...`; checked on isolines too, where it has no effect.
    pub reduction: u32,
    /// `TESS_AXES_...`; checked on every domain, but has an effect only on quads.
    pub axes: u32,
}

/// Prepares the factors of one patch, as the HLSL functions `Process...TessFactors` do in Shader
/// Model 5 (compiler FXC). DXC compiles them to other operations, which this library does not have
/// (specification, section 9).
///
/// `requested` holds the outer factors and, in the places of the inside factors, the inside
/// scales. `unrounded` and `rounded` receive `factor_count` factors each; tessellate the rounded
/// ones. All three may be the same array or overlap: the input is read first, and `rounded` is
/// written last.
///
/// # Safety
/// Pointers that are not null and aligned must be valid:
/// - `preparation` for reading one structure,
/// - `requested` for reading `factor_count` floats,
/// - `unrounded` and `rounded` for writing `factor_count` floats each.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_prepare(
    preparation: *const TessPreparation,
    requested: *const f32,
    factor_count: usize,
    unrounded: *mut f32,
    rounded: *mut f32,
) -> TessStatus {
    answer(|| {
        // SAFETY: `preparation` is readable, as the caller promises.
        let preparation = unsafe { boundary::read(preparation) }?;
        let domain = listed(&Domain::ALL, preparation.domain)?;
        let partitioning = listed(&Partitioning::ALL, preparation.partitioning)?;
        let reduction = listed(&REDUCTIONS, preparation.reduction)?;
        let axes = listed(&AXES, preparation.axes)?;
        // SAFETY: `factor_count` readable floats, as the caller promises.
        let requested = unsafe { types::factors(domain, requested, factor_count) }?;
        boundary::check(unrounded)?;
        boundary::check(rounded)?;
        let prepared = prepare(partitioning, reduction, Request::from_record(requested, axes));
        // SAFETY: writable for the factors of the domain, which `factor_count` was checked to be.
        unsafe { store(prepared.unrounded, unrounded) }?;
        // SAFETY: as above.
        unsafe { store(prepared.rounded, rounded) }
    })
}

/// Writes factors in the specification's order.
///
/// # Safety
/// - If not null and aligned, `out` points to memory for the factors of the domain that can be
///   written and that nothing else uses during the call.
unsafe fn store(factors: PatchFactors, out: *mut f32) -> Result<(), TessStatus> {
    // SAFETY: as the caller promises.
    let out = unsafe { boundary::room(out, factors.domain().factors()) }?;
    for (slot, factor) in out.iter_mut().zip(factors.iter()) {
        slot.write(factor);
    }
    Ok(())
}
