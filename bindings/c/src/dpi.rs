//! Functions that `verilog/tess_dpi.sv` imports: scalars and bit patterns alone.
//!
//! In `SystemVerilog` every argument is an `int unsigned`, outputs included, or the `chandle` of a patch
//! that is held, so that calls are the same in every simulator. The functions are declared and documented in that file, with
//! typed wrappers around them; they are no part of the C header.

pub mod held;

use crate::boundary;
use crate::context::place_steps;
use crate::probe::TessPrimitive;
use crate::process::TessProcessedPatch;
use crate::status::{TESS_OUT_OF_RANGE, TessStatus, answer};
use crate::types::{TessConfig, TessContext, TessCounts, TessPoint, listed, parity};
use tess_core::{Domain, FactorContext, FixedFactor, Patch, PatchFactors, SplitOrder};
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
        let context = TessContext::from(context(factor, parity_number, split_order)?);
        let outputs = [
            (inv_floor, context.inv_floor),
            (inv_ceil, context.inv_ceil),
            (fraction, context.fraction),
            (half_points, context.half_points),
            (split, context.split),
            (points, context.points),
        ];
        // SAFETY: every pointer is writable, as the caller promises.
        unsafe { write_each(outputs) }
    })
}

/// The placement of point `p` of an edge, every signal on the way.
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
        let steps = place_steps(&context(factor, parity_number, split_order)?, p)?;
        let outputs = [
            (flip, steps.flip),
            (position, steps.position),
            (coarse, steps.coarse),
            (fine, steps.fine),
            (half_location, steps.half_location),
            (location, steps.location),
        ];
        // SAFETY: every pointer is writable, as the caller promises.
        unsafe { write_each(outputs) }
    })
}

/// Factor `number` of a patch after factor processing; `outcome` alone if the patch is culled.
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
    answer(|| {
        let config = TessConfig { domain, partitioning, output: 0, split: split_order };
        let patch = patch(config, [f0, f1, f2, f3, f4, f5])?;
        let processed = TessProcessedPatch::from(patch.processed());
        if number as usize >= listed(&Domain::ALL, domain)?.factors() {
            return Err(TESS_OUT_OF_RANGE);
        }
        let factor = listed(&processed.factors, number)?;
        let outputs = [
            (outcome, processed.outcome),
            (clamped, factor.clamped),
            (rounded, factor.rounded),
            (fixed, factor.fixed),
            (parity, factor.context.parity),
        ];
        // SAFETY: every pointer is writable, as the caller promises.
        unsafe { write_each(outputs) }
    })
}

/// The sizes of a patch: `tess_count` in scalars.
///
/// # Safety
/// - Every pointer, if not null and aligned, must be valid for writing one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_dpi_count(
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
    points: *mut u32,
    primitives: *mut u32,
    indices: *mut u32,
) -> TessStatus {
    answer(|| {
        let config = TessConfig { domain, partitioning, output, split: split_order };
        let counts = TessCounts::from(patch(config, [f0, f1, f2, f3, f4, f5])?.counts());
        // SAFETY: every pointer is writable, as the caller promises.
        unsafe { write_counts(counts, points, primitives, indices) }
    })
}

/// Point `i` of a patch: `tess_point` in scalars.
///
/// # Safety
/// - Every pointer, if not null and aligned, must be valid for writing one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_dpi_point(
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
    u: *mut u32,
    v: *mut u32,
) -> TessStatus {
    answer(|| {
        let config = TessConfig { domain, partitioning, output, split: split_order };
        let point = patch(config, [f0, f1, f2, f3, f4, f5])?.point(i).ok_or(TESS_OUT_OF_RANGE)?;
        let point = TessPoint::from(point);
        // SAFETY: every pointer is writable, as the caller promises.
        unsafe { write_each([(u, point.u), (v, point.v)]) }
    })
}

/// Primitive `t` of a patch: `tess_primitive` in scalars.
///
/// # Safety
/// - Every pointer, if not null and aligned, must be valid for writing one number.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_dpi_primitive(
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
    t: u32,
    size: *mut u32,
    i0: *mut u32,
    i1: *mut u32,
    i2: *mut u32,
) -> TessStatus {
    answer(|| {
        let config = TessConfig { domain, partitioning, output, split: split_order };
        let patch = patch(config, [f0, f1, f2, f3, f4, f5])?;
        let primitive = TessPrimitive::from(patch.primitive(t).ok_or(TESS_OUT_OF_RANGE)?);
        let [a, b, c] = primitive.indices;
        // SAFETY: every pointer is writable, as the caller promises.
        unsafe { write_each([(size, primitive.size), (i0, a), (i1, b), (i2, c)]) }
    })
}

/// The number of the `i`-th coverage bin that a patch hits; `TESS_OUT_OF_RANGE` behind the last.
///
/// Bins are numbered as `tess_verify::cover` lists them, in alphabetical order; one that is hit
/// twice comes twice. Unlike the other functions this one allocates.
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
    answer(|| {
        let config = TessConfig { domain, partitioning, output, split: split_order };
        let (config, domain) = config.decode()?;
        let factors = [f0, f1, f2, f3, f4, f5].map(f32::from_bits);
        let factors = PatchFactors::from_fn(domain, |i| factors[i]);
        let hit = bins_hit(&Case { config, factors });
        let number = hit.get(i as usize).and_then(|number| u32::try_from(*number).ok());
        let number = number.ok_or(TESS_OUT_OF_RANGE)?;
        // SAFETY: the pointer is writable, as the caller promises.
        unsafe { write_each([(bin, number)]) }
    })
}

fn context(factor: u32, parity_number: u32, split: u32) -> Result<FactorContext, TessStatus> {
    let split = listed(&SplitOrder::ALL, split)?;
    Ok(FactorContext::new(FixedFactor::from_bits(factor), parity(parity_number)?, split))
}

/// The patch with these bits of binary32 factors, of which the first of its domain's number count.
fn patch(config: TessConfig, factors: [u32; 6]) -> Result<Patch, TessStatus> {
    let (config, domain) = config.decode()?;
    let factors = PatchFactors::from_fn(domain, |i| f32::from_bits(factors[i]));
    Ok(Patch::new(config, factors))
}

/// Writes the sizes of a patch, or none if any pointer is null or misaligned.
///
/// # Safety
/// - Every pointer, if not null and aligned, must be valid for writing one number.
unsafe fn write_counts(
    counts: TessCounts,
    points: *mut u32,
    primitives: *mut u32,
    indices: *mut u32,
) -> Result<(), TessStatus> {
    let outputs =
        [(points, counts.points), (primitives, counts.primitives), (indices, counts.indices)];
    // SAFETY: every pointer is writable, as the caller promises.
    unsafe { write_each(outputs) }
}

/// Writes all numbers, or none if any pointer is null or misaligned.
///
/// # Safety
/// - Every pointer, if not null and aligned, must be valid for writing one number.
unsafe fn write_each<const N: usize>(outputs: [(*mut u32, u32); N]) -> Result<(), TessStatus> {
    for (pointer, _) in outputs {
        boundary::check(pointer)?;
    }
    for (pointer, value) in outputs {
        // SAFETY: `pointer` is writable, as the caller promises.
        unsafe { boundary::write(pointer, value) }?;
    }
    Ok(())
}
