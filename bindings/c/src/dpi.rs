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
use crate::types::{TessConfig, TessContext, TessPoint, listed, parity};
use tess_core::{Counts, Domain, FactorContext, FixedFactor, PatchFactors, SplitOrder};
use tess_verify::Case;
use tess_verify::cover::bins_hit;

/// A function that `tess_dpi.sv` imports: numbers in, and a number through each pointer out, or none if a pointer is null
/// or misaligned. `patch` stands for the ten numbers of a patch's configuration and factors.
macro_rules! imported {
    ($(#[$doc:meta])* $name:ident(patch $(, $input:ident)*) -> [$($output:ident),*], |$patch:ident| $values:expr) => {
        imported! {
            $(#[$doc])*
            $name(
                domain, partitioning, output, split_order, f0, f1, f2, f3, f4, f5 $(, $input)*
            ) -> [$($output),*], {
                let $patch = case(
                    TessConfig { domain, partitioning, output, split: split_order },
                    [f0, f1, f2, f3, f4, f5],
                )?;
                $values
            }
        }
    };
    ($(#[$doc:meta])* $name:ident($($input:ident),*) -> [$($output:ident),*], $values:expr) => {
        $(#[$doc])*
        ///
        /// # Safety
        /// - Every pointer, if not null and aligned, must be valid for writing one number.
        #[unsafe(no_mangle)]
        pub unsafe extern "C" fn $name($($input: u32,)* $($output: *mut u32),*) -> TessStatus {
            answer(|| {
                let values = $values;
                // SAFETY: every pointer is writable, as the caller promises.
                unsafe { write_each([$($output),*], values) }
            })
        }
    };
}

imported! {
    /// The context of a 15.16 factor: `tess_context` in scalars.
    tess_dpi_context(factor, parity_number, split_order)
        -> [inv_floor, inv_ceil, fraction, half_points, split, points],
    {
        let c = TessContext::from(context(factor, parity_number, split_order)?);
        [c.inv_floor, c.inv_ceil, c.fraction, c.half_points, c.split, c.points]
    }
}

imported! {
    /// The placement of point `p` of an edge, every signal on the way.
    tess_dpi_place(factor, parity_number, split_order, p)
        -> [flip, position, coarse, fine, half_location, location],
    {
        place_steps(&context(factor, parity_number, split_order)?, p)?
    }
}

imported! {
    /// Factor `number` of a patch after factor processing; `outcome` alone if the patch is culled.
    tess_dpi_process(domain, partitioning, split_order, f0, f1, f2, f3, f4, f5, number)
        -> [outcome, clamped, rounded, fixed, parity],
    {
        let config = TessConfig { domain, partitioning, output: 0, split: split_order };
        let case = case(config, [f0, f1, f2, f3, f4, f5])?;
        if number as usize >= case.factors.domain().factors() {
            return Err(TESS_OUT_OF_RANGE);
        }
        let processed = TessProcessedPatch::from(case.patch().processed());
        let factor = listed(&processed.factors, number)?;
        [processed.outcome, factor.clamped, factor.rounded, factor.fixed, factor.context.parity]
    }
}

imported! {
    /// The sizes of a patch: `tess_count` in scalars.
    tess_dpi_count(patch) -> [points, primitives, indices], |case| sizes(case.patch().counts())
}

imported! {
    /// Point `i` of a patch: `tess_point` in scalars.
    tess_dpi_point(patch, i) -> [u, v], |case| {
        let point = TessPoint::from(case.patch().point(i).ok_or(TESS_OUT_OF_RANGE)?);
        [point.u, point.v]
    }
}

imported! {
    /// Primitive `t` of a patch: `tess_primitive` in scalars.
    tess_dpi_primitive(patch, t) -> [size, i0, i1, i2], |case| {
        let primitive = case.patch().primitive(t).ok_or(TESS_OUT_OF_RANGE)?;
        let TessPrimitive { size, indices: [i0, i1, i2], .. } = primitive.into();
        [size, i0, i1, i2]
    }
}

imported! {
    /// The number of the `i`-th coverage bin that a patch hits; `TESS_OUT_OF_RANGE` behind the last.
    ///
    /// Bins are numbered as `tess_verify::cover` lists them, in alphabetical order; one that is hit
    /// twice comes twice. Unlike the other functions this one allocates.
    tess_dpi_coverage(patch, i) -> [bin], |case| {
        let hit = bins_hit(&case);
        let number = hit.get(i as usize).and_then(|number| u32::try_from(*number).ok());
        [number.ok_or(TESS_OUT_OF_RANGE)?]
    }
}

fn context(factor: u32, parity_number: u32, split: u32) -> Result<FactorContext, TessStatus> {
    let split = listed(&SplitOrder::ALL, split)?;
    Ok(FactorContext::new(FixedFactor::from_bits(factor), parity(parity_number)?, split))
}

/// The patch with these bits of binary32 factors, of which the first of its domain's number count.
fn case(config: TessConfig, factors: [u32; 6]) -> Result<Case, TessStatus> {
    let (config, domain) = config.decode()?;
    Ok(Case { config, factors: factors_of(domain, factors) })
}

/// The first of these bits of binary32, as many as a patch of the domain has.
fn factors_of(domain: Domain, factors: [u32; 6]) -> PatchFactors {
    PatchFactors::from_fn(domain, |i| f32::from_bits(factors[i]))
}

fn sizes(counts: Counts) -> [u32; 3] {
    [counts.points, counts.primitives, counts.indices]
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
