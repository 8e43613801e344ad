//! Differential fuzzing: a tessellator behind a function pointer, against the model.

use crate::boundary;
use crate::status::{TESS_DIFFERENT, TESS_NULL_POINTER, TessStatus, answer};
use crate::types::{TESS_MAX_INDICES, TESS_MAX_POINTS, TessConfig, TessCounts, TessPoint, listed};
use arbitrary::{Arbitrary, Unstructured};
use std::ffi::{c_char, c_void};
use std::mem::MaybeUninit;
use tess_core::{DomainPoint, Tessellation};
use tess_verify::case::Case;
use tess_verify::checker::check_device;
use tess_verify::strength::{Order, Strength};

/// Order: the model's, index for index.
pub const TESS_ORDER_EXACT: u32 = 0;
/// Order: the model's order of primitives and of their vertices, each vertex by its coordinates.
pub const TESS_ORDER_SEQUENCE: u32 = 1;
/// Order: any, and any leading vertex of a triangle.
pub const TESS_ORDER_ANY: u32 = 2;

const ORDERS: [Order; 3] = [Order::Exact, Order::Sequence, Order::Any];

/// A tessellator under test: it writes the points and indices of one patch and their counts.
///
/// `points` has room for `TESS_MAX_POINTS` points and `indices` for `TESS_MAX_INDICES` indices; both and
/// `counts` are zero before the call, and `counts->primitives` is not looked at. `user` is what
/// `tess_fuzz` was given. It answers 0, or any other number if it could not run, which is a finding.
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

/// Compares a tessellator with the model on the patch that a fuzzer's bytes stand for.
///
/// Any bytes are a patch; most are small, and boundaries are frequent. `order` is `TESS_ORDER_...`.
/// `TESS_OK`: equal. `TESS_DIFFERENT`: a finding, and `message` has the case as a line that
/// `tess patch --cases` takes, a command that shows what is right, and the first difference. The
/// message ends with a zero byte and is cut off at `message_capacity` bytes; 1024 are enough. This
/// function allocates.
///
/// # Safety
/// Pointers that are not null and aligned must be valid:
/// - `data` for reading `size` bytes,
/// - `device` for calls as its type says,
/// - `message` for writing `message_capacity` bytes.
#[unsafe(no_mangle)]
pub unsafe extern "C" fn tess_fuzz(
    data: *const u8,
    size: usize,
    device: TessDevice,
    user: *mut c_void,
    order: u32,
    message: *mut c_char,
    message_capacity: usize,
) -> TessStatus {
    answer(|| {
        let device = device.ok_or(TESS_NULL_POINTER)?;
        let strength = Strength { order: listed(&ORDERS, order)?, ..Strength::default() };
        // SAFETY: `size` readable bytes, as the caller promises.
        let data = unsafe { boundary::list(data, size) }?;
        // SAFETY: room for `message_capacity` bytes, as the caller promises.
        let message = unsafe { boundary::room(message, message_capacity) }?;
        let Ok(case) = Case::arbitrary(&mut Unstructured::new(data)) else { return Ok(()) };
        let mut room = Answer::default();
        let config = TessConfig::encode(case.config, case.domain());
        let factors: Vec<f32> = case.factors.iter().collect();
        let (points, indices) = (room.points.as_mut_ptr(), room.indices.as_mut_ptr());
        let count = factors.len();
        // SAFETY: the caller promises that `device` may be called with a patch and with this room.
        let answered = unsafe {
            device(user, &config, factors.as_ptr(), count, points, indices, &mut room.counts)
        };
        let Some(wrong) = room.difference(&case, answered, strength) else { return Ok(()) };
        write(message, &format!("{case}\n{}\n{wrong}", case.command()));
        Err(TESS_DIFFERENT)
    })
}

/// Where a tessellator writes.
struct Answer {
    points: Vec<TessPoint>,
    indices: Vec<u32>,
    counts: TessCounts,
}

impl Default for Answer {
    fn default() -> Self {
        Self {
            points: vec![TessPoint::default(); TESS_MAX_POINTS as usize],
            indices: vec![0; TESS_MAX_INDICES as usize],
            counts: TessCounts::default(),
        }
    }
}

impl Answer {
    /// What is wrong, in words.
    fn difference(&self, case: &Case, answered: i32, strength: Strength) -> Option<String> {
        if answered != 0 {
            return Some(format!("the tessellator answered {answered}"));
        }
        let TessCounts { points, indices, .. } = self.counts;
        let written = (self.points.get(..points as usize), self.indices.get(..indices as usize));
        let (Some(points), Some(indices)) = written else {
            return Some(format!("{points} points and {indices} indices: more than any patch has"));
        };
        let points = points.iter().map(|point| DomainPoint::from_bits(point.u, point.v)).collect();
        let output = Tessellation { points, indices: indices.to_vec() };
        let report = check_device([(*case, output)], strength);
        report.differences.first().map(|difference| difference.mismatch.to_string())
    }
}

/// Writes a text and a zero byte, as much of it as there is room for.
fn write(room: &mut [MaybeUninit<c_char>], text: &str) {
    let Some(most) = room.len().checked_sub(1) else { return };
    let bytes = text.bytes().take(most).chain([0]);
    room.iter_mut().zip(bytes).for_each(|(slot, byte)| {
        slot.write(c_char::from_ne_bytes([byte]));
    });
}
