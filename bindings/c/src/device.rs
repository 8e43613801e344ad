//! A tessellator under test, behind a function pointer.

use crate::status::{TESS_NULL_POINTER, TessStatus};
use crate::types::{TESS_MAX_INDICES, TESS_MAX_POINTS, TessConfig, TessCounts, TessPoint};
use std::ffi::{c_char, c_void};
use std::mem::MaybeUninit;
use tess_core::{DomainPoint, Tessellation};
use tess_verify::Case;

/// A device's answer: it does not have the requested configuration. Not a finding.
pub const TESS_DEVICE_UNSUPPORTED: i32 = -1;

/// A tessellator under test: it writes the points and indices of one patch and their counts.
///
/// `points` has room for `TESS_MAX_POINTS` points and `indices` for `TESS_MAX_INDICES` indices.
/// Both and `counts` are zero before the call; `counts->primitives` is ignored. `user` is the
/// pointer that was passed to `tess_fuzz` or `tess_check_rules`. The tessellator returns 0, or
/// `TESS_DEVICE_UNSUPPORTED`, or any other number if it failed, which is a finding.
pub type TessDevice = Option<
    unsafe extern "C" fn(
        user: *mut c_void,
        config: *const TessConfig,
        factors: *const f32,
        factor_count: usize,
        points: *mut TessPoint,
        indices: *mut u32,
        counts: *mut TessCounts,
    ) -> i32,
>;

/// Outcome of a question to a device.
pub(crate) enum Asked {
    /// It produced an output.
    Output(Tessellation),
    /// It does not have the configuration.
    Unsupported,
    /// It failed, with a description.
    Failed(String),
}

/// Asks a device about one case.
///
/// # Errors
/// There is no device.
///
/// # Safety
/// `device` may be called with `user` as its type says.
pub(crate) unsafe fn ask(
    device: TessDevice,
    user: *mut c_void,
    case: &Case,
) -> Result<Asked, TessStatus> {
    let device = device.ok_or(TESS_NULL_POINTER)?;
    let config = TessConfig::encode(case.config, case.domain());
    let factors: Vec<f32> = case.factors.iter().collect();
    let mut points = vec![TessPoint::default(); TESS_MAX_POINTS as usize];
    let mut indices = vec![0; TESS_MAX_INDICES as usize];
    let mut counts = TessCounts::default();
    let (to, list) = (points.as_mut_ptr(), indices.as_mut_ptr());
    // SAFETY: the caller promises that `device` may be called with a patch and with this room.
    let answered =
        unsafe { device(user, &config, factors.as_ptr(), factors.len(), to, list, &mut counts) };
    Ok(match answered {
        0 => output(&points, &indices, counts),
        TESS_DEVICE_UNSUPPORTED => Asked::Unsupported,
        other => Asked::Failed(format!("the tessellator answered {other}")),
    })
}

fn output(points: &[TessPoint], indices: &[u32], counts: TessCounts) -> Asked {
    let TessCounts { points: p, indices: i, .. } = counts;
    let (Some(points), Some(indices)) = (points.get(..p as usize), indices.get(..i as usize))
    else {
        return Asked::Failed(format!("{p} points and {i} indices: more than any patch has"));
    };
    let points = points.iter().map(|point| DomainPoint::from_bits(point.u, point.v)).collect();
    Asked::Output(Tessellation { points, indices: indices.to_vec() })
}

/// Writes a text, as much of it as fits, and a zero byte.
pub(crate) fn write(room: &mut [MaybeUninit<c_char>], text: &str) {
    let Some(most) = room.len().checked_sub(1) else { return };
    let bytes = text.bytes().take(most).chain([0]);
    room.iter_mut().zip(bytes).for_each(|(slot, byte)| {
        slot.write(c_char::from_ne_bytes([byte]));
    });
}
