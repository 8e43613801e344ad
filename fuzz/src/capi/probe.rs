//! Probes: one element of a patch, one context, one place.

use super::hostile::{CANARY, Hostile, NO_POINT, Wrongs};
use crate::input::Bytes;
use crate::repeatable;
use tess_capi::probe::{TessPrimitive, tess_context, tess_place, tess_point, tess_primitive};
use tess_capi::status::{TESS_NOT_A_CONTEXT, TESS_OK, TESS_OUT_OF_RANGE, TESS_UNKNOWN_VALUE};
use tess_capi::types::{TessContext, TessPoint};
use tess_core::fixed_point::ONE;

/// A point and a primitive of any number.
pub(super) fn check_element(bytes: &mut Bytes<'_>) -> Result<(), String> {
    let mut wrongs = Wrongs::default();
    let mut hostile = Hostile::new(bytes, &mut wrongs);
    let patch = hostile.case.patch();
    let (n, number) = (hostile.factor_count, bytes.word() % 30_000);
    let config = wrongs.pointer(bytes, &raw mut hostile.config);
    let factors = wrongs.pointer(bytes, hostile.factors.as_mut_ptr());

    let mut point = NO_POINT;
    let mut point_wrongs = Wrongs::default();
    point_wrongs.add_if(number >= patch.counts().points, TESS_OUT_OF_RANGE);
    // SAFETY: each pointer is null, misaligned or to memory as large as the call claims.
    let status = unsafe { tess_point(config, factors, n, number, &mut point) };
    judge(&wrongs, &point_wrongs, "tess_point", &hostile, status)?;
    let expected = match patch.point(number) {
        Some(point) if wrongs.is_empty() => TessPoint::from(point),
        _ => NO_POINT,
    };
    if point != expected {
        let message = format!("tess_point {number}: {point:x?}, expected {expected:x?}");
        return Err(repeatable(&hostile.case, &message));
    }

    let nothing = TessPrimitive { size: CANARY, indices: [CANARY; 3] };
    let mut primitive = nothing;
    let mut primitive_wrongs = Wrongs::default();
    primitive_wrongs.add_if(number >= patch.counts().primitives, TESS_OUT_OF_RANGE);
    // SAFETY: as above.
    let status = unsafe { tess_primitive(config, factors, n, number, &mut primitive) };
    judge(&wrongs, &primitive_wrongs, "tess_primitive", &hostile, status)?;
    let expected = match patch.primitive(number) {
        Some(primitive) if wrongs.is_empty() => TessPrimitive::from(primitive),
        _ => nothing,
    };
    if primitive == expected {
        return Ok(());
    }
    let message = format!("tess_primitive {number}: {primitive:?}, expected {expected:?}");
    Err(repeatable(&hostile.case, &message))
}

fn judge(
    shared: &Wrongs,
    own: &Wrongs,
    call: &str,
    hostile: &Hostile,
    status: u32,
) -> Result<(), String> {
    let wrongs = if shared.is_empty() { own } else { shared };
    wrongs.judge(call, &hostile.case, status)
}

/// A place with a context that may be altered: it is refused, or consistent with itself.
pub(super) fn check_place(bytes: &mut Bytes<'_>) -> Result<(), String> {
    let [factor, parity, split] = [bytes.word(), bytes.word() % 2, bytes.word() % 2];
    let mut context = TessContext::default();
    // SAFETY: the pointer is to a structure of this function.
    let status = unsafe { tess_context(factor, parity, split, &mut context) };
    if status != TESS_OK {
        return Err(format!("tess_context({factor:#x}, {parity}, {split}) answered {status}"));
    }
    let mask = bytes.word();
    let altered = match bytes.byte() % 9 {
        0 => TessContext { inv_floor: context.inv_floor ^ mask, ..context },
        1 => TessContext { inv_ceil: context.inv_ceil ^ mask, ..context },
        2 => TessContext { fraction: context.fraction ^ mask, ..context },
        3 => TessContext { half_points: context.half_points ^ mask, ..context },
        4 => TessContext { split: context.split ^ mask, ..context },
        5 => TessContext { points: context.points ^ mask, ..context },
        6 => TessContext { parity: context.parity ^ mask, ..context },
        _ => context,
    };
    let (p, mut location, mut mirrored) = (bytes.word() % 80, CANARY, CANARY);
    // SAFETY: the pointers are to structures of this function.
    let status = unsafe { tess_place(&altered, p, &mut location) };
    let right = match status {
        TESS_OK => {
            let other = altered.points - 1 - p;
            // SAFETY: as above.
            let again = unsafe { tess_place(&altered, other, &mut mirrored) };
            again == TESS_OK && p < altered.points && location + mirrored == ONE
        }
        TESS_OUT_OF_RANGE => p >= altered.points && location == CANARY,
        TESS_NOT_A_CONTEXT | TESS_UNKNOWN_VALUE => altered != context && location == CANARY,
        _ => false,
    };
    if right && !crate::fault_is_planted() {
        return Ok(());
    }
    Err(format!("tess_place({altered:x?}, {p}) answered {status}, {location:#x}, {mirrored:#x}"))
}
