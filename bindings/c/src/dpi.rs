//! Functions that `verilog/tess_dpi.sv` imports. They pass only scalars and bit patterns.
//!
//! In `SystemVerilog` every argument, including outputs, is an `int unsigned` or the `chandle` of a
//! held patch, so that calls are the same in every simulator. That file declares and documents the
//! functions and has typed wrappers for them; the C header does not have them.
//!
//! A function on a patch takes the four numbers of its configuration and the bits of six binary32
//! factors, of which it reads the first two, four or six, as the domain has. Points and primitives
//! are those of a [`held`] patch. Results are written through pointers: all of them, or none if
//! a pointer is null or misaligned.

pub mod held;

use crate::boundary;
use crate::context::place_signals;
use crate::process::TessProcessedPatch;
use crate::status::{TESS_OUT_OF_RANGE, TessStatus, answer};
use crate::types::{TessConfig, TessContext, listed, parity};
use tess_core::{FactorContext, FixedFactor, PatchFactors, SplitOrder};
use tess_verify::Case;
use tess_verify::cover::bins_hit;

/// The context of a 15.16 factor: `tess_context` in scalars.
///
/// # Safety
/// - Every pointer, if not null and aligned, must be valid for writing one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_dpi_context(
    factor: u32,
    parity_number: u32,
    split_order: u32,
    inv_floor: *mut u32,
    inv_ceil: *mut u32,
    fraction: *mut u32,
    half_points: *mut u32,
    split: *mut u32,
    points: *mut u32,
) -> TessStatus {
    answer(|| {
        let c = TessContext::from(context(factor, parity_number, split_order)?);
        let values = [c.inv_floor, c.inv_ceil, c.fraction, c.half_points, c.split, c.points];
        let pointers = [inv_floor, inv_ceil, fraction, half_points, split, points];
        // SAFETY: every pointer is writable, as the caller promises.
        unsafe { write_each(pointers, values) }
    })
}

/// The placement of point `p` of an edge, with every intermediate signal.
///
/// # Safety
/// - Every pointer, if not null and aligned, must be valid for writing one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_dpi_place(
    factor: u32,
    parity_number: u32,
    split_order: u32,
    p: u32,
    flip: *mut u32,
    position: *mut u32,
    coarse: *mut u32,
    fine: *mut u32,
    half_location: *mut u32,
    location: *mut u32,
) -> TessStatus {
    answer(|| {
        let values = place_signals(&context(factor, parity_number, split_order)?, p)?;
        let pointers = [flip, position, coarse, fine, half_location, location];
        // SAFETY: every pointer is writable, as the caller promises.
        unsafe { write_each(pointers, values) }
    })
}

/// Factor `number` of a patch after factor processing. If the patch is culled, only `outcome` is
/// meaningful.
///
/// # Safety
/// - Every pointer, if not null and aligned, must be valid for writing one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_dpi_process(
    domain: u32,
    partitioning: u32,
    split_order: u32,
    f0: u32,
    f1: u32,
    f2: u32,
    f3: u32,
    f4: u32,
    f5: u32,
    number: u32,
    outcome: *mut u32,
    clamped: *mut u32,
    rounded: *mut u32,
    fixed: *mut u32,
    parity: *mut u32,
) -> TessStatus {
    let config = TessConfig { domain, partitioning, output: 0, split: split_order };
    let values = |case: &Case| {
        if number as usize >= case.factors.domain().factors() {
            return Err(TESS_OUT_OF_RANGE);
        }
        let patch = TessProcessedPatch::from(case.patch().processed());
        let f = listed(&patch.factors, number)?;
        Ok([patch.outcome, f.clamped, f.rounded, f.fixed, f.context.parity])
    };
    let pointers = [outcome, clamped, rounded, fixed, parity];
    // SAFETY: every pointer is writable, as the caller promises.
    unsafe { of_patch(config, [f0, f1, f2, f3, f4, f5], pointers, values) }
}

/// The number of the `i`-th coverage bin that a patch hits; `TESS_OUT_OF_RANGE` past the last one.
///
/// Bins are numbered in the alphabetical order of `tess_verify::cover`. A bin that is hit twice
/// occurs twice. This function allocates.
///
/// # Safety
/// - `bin`, if not null and aligned, must be valid for writing one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_dpi_coverage(
    domain: u32,
    partitioning: u32,
    output: u32,
    split_order: u32,
    f0: u32,
    f1: u32,
    f2: u32,
    f3: u32,
    f4: u32,
    f5: u32,
    i: u32,
    bin: *mut u32,
) -> TessStatus {
    let config = TessConfig { domain, partitioning, output, split: split_order };
    let values = |case: &Case| {
        let hit = bins_hit(case);
        let number = hit.get(i as usize).and_then(|number| u32::try_from(*number).ok());
        Ok([number.ok_or(TESS_OUT_OF_RANGE)?])
    };
    // SAFETY: `bin` is writable, as the caller promises.
    unsafe { of_patch(config, [f0, f1, f2, f3, f4, f5], [bin], values) }
}

/// The body of a function on a patch: decodes the patch and writes the values that it has there.
///
/// # Safety
/// - Every pointer, if not null and aligned, must be valid for writing one number.
unsafe fn of_patch<const N: usize>(
    config: TessConfig,
    factors: [u32; 6],
    pointers: [*mut u32; N],
    values: impl FnOnce(&Case) -> Result<[u32; N], TessStatus>,
) -> TessStatus {
    answer(|| {
        let values = values(&case(config, factors)?)?;
        // SAFETY: every pointer is writable, as the caller promises.
        unsafe { write_each(pointers, values) }
    })
}

fn context(factor: u32, parity_number: u32, split: u32) -> Result<FactorContext, TessStatus> {
    let split = listed(&SplitOrder::ALL, split)?;
    Ok(FactorContext::new(FixedFactor::from_bits(factor), parity(parity_number)?, split))
}

/// The patch with these bits of binary32 factors, of which only the domain's number are read.
fn case(config: TessConfig, factors: [u32; 6]) -> Result<Case, TessStatus> {
    let (config, domain) = config.decode()?;
    Ok(Case { config, factors: PatchFactors::from_fn(domain, |i| f32::from_bits(factors[i])) })
}

/// Writes all numbers, or none if any pointer is null or misaligned.
///
/// # Safety
/// - Every pointer, if not null and aligned, must be valid for writing one number.
unsafe fn write_each<const N: usize>(
    pointers: [*mut u32; N],
    values: [u32; N],
) -> Result<(), TessStatus> {
    for pointer in pointers {
        boundary::check(pointer)?;
    }
    for (pointer, value) in pointers.into_iter().zip(values) {
        // SAFETY: `pointer` is writable, as the caller promises.
        unsafe { boundary::write(pointer, value) }?;
    }
    Ok(())
}
