//! `tess_fuzz`: devices that are right, wrong, and beyond all bounds; arguments that are refused.

use super::samples::{DeviceFault, answer, device, text};
use std::ffi::{c_char, c_void};
use std::ptr::{null, null_mut};
use tess_capi::device::{TESS_DEVICE_UNSUPPORTED, TessDevice};
use tess_capi::fuzz::{
    TESS_CONVERSION_WITHIN_0_6_ULP, TESS_DENORMALS_FLUSH, TESS_ORDER_ANY, TESS_ORDER_EXACT,
    TessFuzzOptions, tess_fuzz,
};
use tess_capi::status::{
    TESS_DIFFERENT, TESS_LEFT_OUT, TESS_NULL_POINTER, TESS_OK, TESS_OVERLAP, TESS_TOO_LARGE,
    TESS_UNKNOWN_VALUE,
};
use tess_capi::types::{
    TESS_DOMAIN_QUAD, TESS_OUTPUT_LINE, TESS_PARTITIONING_FRACTIONAL_EVEN, TESS_SPLIT_CENTER,
    TessConfig, TessCounts, TessPoint,
};

/// Every configuration, and an order.
fn in_order(order: u32) -> TessFuzzOptions {
    TessFuzzOptions { order, ..TessFuzzOptions::default() }
}

/// Asks about bytes that stand for a triangle patch with the factors 5, 4, 3 and 5.
fn ask(fault: DeviceFault, order: u32) -> (u32, String) {
    ask_for(fault, in_order(order))
}

fn ask_for(mut fault: DeviceFault, options: TessFuzzOptions) -> (u32, String) {
    let data = [2, 2, 0, 1, 60, 0, 3, 12, 4, 3, 12, 3, 3, 12, 2, 3, 12, 4];
    let mut message: [c_char; 400] = [1; 400];
    let user = (&raw mut fault).cast();
    let (size, room) = (data.len(), message.len());
    // SAFETY: arrays of this function, and a device that keeps to its type.
    let status = unsafe {
        tess_fuzz(data.as_ptr(), size, Some(device), user, &options, message.as_mut_ptr(), room)
    };
    assert!(status == TESS_DIFFERENT || message == [1; 400], "no message");
    (status, text(&message))
}

#[test]
fn a_right_device_is_equal() {
    assert_eq!(ask(|_, _, _| 0, TESS_ORDER_EXACT), (TESS_OK, String::new()));
}

#[test]
fn faults_are_found_as_the_order_says() {
    let turned: DeviceFault = |_, counts, indices| {
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
        |_, counts, _| {
            counts.points = 4226;
            0
        },
        TESS_ORDER_EXACT,
    );
    assert_eq!(status, TESS_DIFFERENT, "{message}");
    assert!(message.contains("4226 points and"), "{message}");
    let (status, message) = ask(|_, _, _| 7, TESS_ORDER_EXACT);
    assert_eq!((status, message.ends_with("answered 7")), (TESS_DIFFERENT, true), "{message}");
}

#[test]
fn wrong_arguments_are_refused_and_messages_cut_off() {
    let mut fault: DeviceFault = |_, _, _| 7;
    let user = (&raw mut fault).cast::<c_void>();
    let mut message: [c_char; 8] = [1; 8];
    let mut call = |device: TessDevice, order, room| {
        // SAFETY: no data, an array of this function, and a device that keeps to its type.
        unsafe {
            let options = in_order(order);
            tess_fuzz(null(), 0, device, user, &options, message.as_mut_ptr(), room)
        }
    };
    assert_eq!(call(None, TESS_ORDER_EXACT, 8), TESS_NULL_POINTER, "no device");
    assert_eq!(call(Some(device), 3, 8), TESS_UNKNOWN_VALUE, "no such order");
    assert_eq!(call(Some(device), TESS_ORDER_EXACT, 5), TESS_DIFFERENT, "five bytes of room");
    assert_eq!(message.map(|byte| byte.to_ne_bytes()[0]), *b"case\0\x01\x01\x01", "cut off");
    // SAFETY: as above, and no room at all.
    let status = unsafe { tess_fuzz(null(), 0, Some(device), user, null(), null_mut(), 0) };
    assert_eq!(status, TESS_DIFFERENT, "no room");
}

/// A message over the bytes that the patch comes from is refused before the device is asked.
#[test]
fn messages_do_not_overlap_the_data() {
    let mut bytes = [7u8; 32];
    let at = bytes.as_mut_ptr();
    let call = |(from, size), (to, room)| {
        // SAFETY: parts of an array of this function, and no device that could be asked.
        unsafe {
            let (data, message) = (at.add(from), at.add(to).cast());
            tess_fuzz(data, size, None, null_mut(), null(), message, room)
        }
    };
    assert_eq!(call((0, 16), (15, 16)), TESS_OVERLAP, "the last byte of the data");
    assert_eq!(call((15, 16), (0, 16)), TESS_OVERLAP, "the first one");
    assert_eq!(call((0, 32), (8, 8)), TESS_OVERLAP, "inside");
    assert_eq!(call((0, 16), (16, 16)), TESS_NULL_POINTER, "behind it: there is no device");
    assert_eq!(call((0, 32), (8, 0)), TESS_NULL_POINTER, "no message: there is no device");
    assert_eq!(call((0, 16), (16, usize::MAX)), TESS_TOO_LARGE, "a message beyond all memory");
    assert_eq!(bytes, [7; 32], "nothing is written");
}

/// A patch of a configuration that the device does not have is left out: neither equal nor
/// different.
#[test]
fn what_a_device_does_not_have_is_left_out() {
    let (status, message) = ask(|_, _, _| TESS_DEVICE_UNSUPPORTED, TESS_ORDER_EXACT);
    assert_eq!(status, TESS_LEFT_OUT, "{message}");
}

/// Whatever the bytes say, the device is asked for the configuration that it has.
#[test]
fn configurations_are_filtered() {
    let only = TessFuzzOptions {
        domain: TESS_DOMAIN_QUAD,
        partitioning: TESS_PARTITIONING_FRACTIONAL_EVEN,
        output: TESS_OUTPUT_LINE,
        split: TESS_SPLIT_CENTER,
        ..TessFuzzOptions::default()
    };
    let (status, message) = ask_for(|_, _, _| 7, only);
    assert_eq!(status, TESS_DIFFERENT, "{message}");
    // The bytes' factors 5, 4, 3 and 5, in turn.
    let line = "case quad fractional_even line center \
                40a00000 40800000 40400000 40a00000 40a00000 40800000\n";
    assert!(message.starts_with(line), "{message}");
    assert_eq!(ask_for(|_, _, _| 0, only).0, TESS_OK, "the model has it");
    for wrong in [
        TessFuzzOptions { domain: 3, ..only },
        TessFuzzOptions { partitioning: 4, ..only },
        TessFuzzOptions { output: 4, ..only },
        TessFuzzOptions { split: 2, ..only },
        TessFuzzOptions { denormals: 2, ..only },
        TessFuzzOptions { conversion: 2, ..only },
    ] {
        assert_eq!(ask_for(|_, _, _| 0, wrong).0, TESS_UNKNOWN_VALUE, "{wrong:?}");
    }
}

/// Gives the model's output for other factors: what a device does that has one of the freedoms.
unsafe extern "C" fn free_device(
    _: *mut c_void,
    config: *const TessConfig,
    factors: *const f32,
    factor_count: usize,
    points: *mut TessPoint,
    indices: *mut u32,
    counts: *mut TessCounts,
) -> i32 {
    // SAFETY: as `tess_fuzz` promises.
    let factors = unsafe { std::slice::from_raw_parts(factors, factor_count) };
    let change = |factor: f32| match factor.to_bits() {
        // A denormal is flushed to zero.
        1..0x0080_0000 => 0.0,
        // 3 + 2^-17, a tie, is rounded up.
        0x4040_0020 => f32::from_bits(0x4040_0040),
        _ => factor,
    };
    let changed: Vec<f32> = factors.iter().copied().map(change).collect();
    // SAFETY: the device is called as its type says, and there are as many factors as before.
    unsafe { answer(config, changed.as_ptr(), factor_count, points, indices, counts) };
    0
}

/// Pseudo-random bytes find the freedoms of a device, and none where they are granted.
#[test]
fn freedoms_are_granted() {
    let findings = |options: TessFuzzOptions| {
        let mut state = 1u64;
        (0..if cfg!(miri) { 10 } else { 20_000 })
            .filter(|_| {
                let bytes: [u8; 64] = std::array::from_fn(|_| {
                    state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
                    state.to_le_bytes()[7]
                });
                // SAFETY: an array of this function, and a device that keeps to its type.
                let status = unsafe {
                    tess_fuzz(
                        bytes.as_ptr(),
                        bytes.len(),
                        Some(free_device),
                        null_mut(),
                        &options,
                        null_mut(),
                        0,
                    )
                };
                status == TESS_DIFFERENT
            })
            .count()
    };
    let exact = findings(TessFuzzOptions::default());
    assert!(exact > 0 || cfg!(miri), "the device differs");
    let granted = TessFuzzOptions {
        denormals: TESS_DENORMALS_FLUSH,
        conversion: TESS_CONVERSION_WITHIN_0_6_ULP,
        ..TessFuzzOptions::default()
    };
    assert_eq!(findings(granted), 0, "of {exact} findings");
}
