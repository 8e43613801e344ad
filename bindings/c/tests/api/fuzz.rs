//! `tess_fuzz`: devices that are right, wrong, and beyond all bounds; arguments that are refused.

use std::ffi::{CStr, c_char, c_void};
use std::ptr::{null, null_mut};
use tess_capi::fuzz::{TESS_ORDER_ANY, TESS_ORDER_EXACT, TessDevice, tess_fuzz};
use tess_capi::patch::tess_patch;
use tess_capi::status::{TESS_DIFFERENT, TESS_NULL_POINTER, TESS_OK, TESS_UNKNOWN_VALUE};
use tess_capi::types::{TESS_MAX_INDICES, TESS_MAX_POINTS, TessConfig, TessCounts, TessPoint};

/// What is done to the model's answer.
type Fault = fn(&mut TessCounts, *mut u32) -> i32;

/// The model's own answer, then the fault that `user` points to.
unsafe extern "C" fn device(
    user: *mut c_void,
    config: *const TessConfig,
    factors: *const f32,
    factor_count: usize,
    points: *mut TessPoint,
    indices: *mut u32,
    counts: *mut TessCounts,
) -> i32 {
    let (most_points, most_indices) = (TESS_MAX_POINTS as usize, TESS_MAX_INDICES as usize);
    // SAFETY: what `tess_fuzz` gives a device is what `tess_patch` asks for.
    let status = unsafe {
        tess_patch(
            config,
            factors,
            factor_count,
            points,
            most_points,
            indices,
            most_indices,
            counts,
        )
    };
    assert_eq!(status, TESS_OK, "a patch");
    // SAFETY: `user` is the fault that the test gave, `counts` ours to write.
    let (fault, counts) = unsafe { (*user.cast::<Fault>(), &mut *counts) };
    fault(counts, indices)
}

/// Asks about bytes that stand for a triangle patch with the factors 5, 4, 3 and 5.
fn ask(mut fault: Fault, order: u32) -> (u32, String) {
    let data = [2, 2, 0, 1, 60, 0, 3, 12, 4, 3, 12, 3, 3, 12, 2, 3, 12, 4];
    let mut message: [c_char; 400] = [1; 400];
    let user = (&raw mut fault).cast();
    let (size, room) = (data.len(), message.len());
    // SAFETY: arrays of this function, and a device that keeps to its type.
    let status = unsafe {
        tess_fuzz(data.as_ptr(), size, Some(device), user, order, message.as_mut_ptr(), room)
    };
    if status == TESS_OK {
        return (status, String::new());
    }
    // SAFETY: a message ends with a zero byte.
    let message = unsafe { CStr::from_ptr(message.as_ptr()) };
    (status, message.to_str().expect("text").to_owned())
}

#[test]
fn a_right_device_is_equal() {
    assert_eq!(ask(|_, _| 0, TESS_ORDER_EXACT), (TESS_OK, String::new()));
}

#[test]
fn faults_are_found_as_the_order_says() {
    let turned: Fault = |counts, indices| {
        assert!(counts.indices >= 3, "a triangle");
        // SAFETY: the patch has three indices.
        unsafe { std::slice::from_raw_parts_mut(indices, 3) }.rotate_left(1);
        0
    };
    let (status, message) = ask(turned, TESS_ORDER_EXACT);
    assert_eq!(status, TESS_DIFFERENT, "{message}");
    let is_whole = message.starts_with("case ") && message.contains("\ntess patch ");
    assert!(is_whole && message.contains("\nindex 0 of primitive 0: "), "{message}");
    assert_eq!(ask(turned, TESS_ORDER_ANY).0, TESS_OK, "the leading vertex is free");
}

#[test]
fn devices_beyond_bounds_are_findings() {
    let (status, message) = ask(
        |counts, _| {
            counts.points = 4226;
            0
        },
        TESS_ORDER_EXACT,
    );
    assert_eq!(status, TESS_DIFFERENT, "{message}");
    assert!(message.contains("4226 points and"), "{message}");
    let (status, message) = ask(|_, _| 7, TESS_ORDER_EXACT);
    assert_eq!((status, message.ends_with("answered 7")), (TESS_DIFFERENT, true), "{message}");
}

#[test]
fn wrong_arguments_are_refused_and_messages_cut_off() {
    let mut fault: Fault = |_, _| 7;
    let user = (&raw mut fault).cast::<c_void>();
    let mut message: [c_char; 8] = [1; 8];
    let mut call = |device: TessDevice, order, room| {
        // SAFETY: no data, an array of this function, and a device that keeps to its type.
        unsafe { tess_fuzz(null(), 0, device, user, order, message.as_mut_ptr(), room) }
    };
    assert_eq!(call(None, TESS_ORDER_EXACT, 8), TESS_NULL_POINTER, "no device");
    assert_eq!(call(Some(device), 3, 8), TESS_UNKNOWN_VALUE, "no such order");
    assert_eq!(call(Some(device), TESS_ORDER_EXACT, 5), TESS_DIFFERENT, "five bytes of room");
    assert_eq!(message.map(|byte| byte.to_ne_bytes()[0]), *b"case\0\x01\x01\x01", "cut off");
    // SAFETY: as above, and no room at all.
    let status =
        unsafe { tess_fuzz(null(), 0, Some(device), user, TESS_ORDER_EXACT, null_mut(), 0) };
    assert_eq!(status, TESS_DIFFERENT, "no room");
}
