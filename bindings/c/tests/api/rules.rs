//! `tess_check_rules`: devices that are right, break rules, fail, and have nothing that is asked
//! for.

use super::samples::{DeviceFault, device, text};
use std::ffi::{c_char, c_void};
use std::ptr::null_mut;
use tess_capi::device::{TESS_DEVICE_UNSUPPORTED, TessDevice};
use tess_capi::rules::{TESS_SPECIFICATION_D3D11, TESS_SPECIFICATION_VULKAN, tess_check_rules};
use tess_capi::status::{
    TESS_DIFFERENT, TESS_LEFT_OUT, TESS_NULL_POINTER, TESS_OK, TESS_UNKNOWN_VALUE,
};
use tess_capi::types::{TESS_DOMAIN_ISOLINE, TESS_OUTPUT_LINE, TessConfig};

/// Judges lines of isolines alone, which are quick.
fn judge(specification: u32, mut fault: DeviceFault) -> (u32, String) {
    let mut report: Vec<c_char> = vec![1; 16384];
    let user = (&raw mut fault).cast();
    let (room, size) = (report.as_mut_ptr(), report.len());
    // SAFETY: an array of this function, and a device that keeps to its type.
    let status = unsafe { tess_check_rules(specification, 0, 1, Some(device), user, room, size) };
    (status, text(&report))
}

const fn is_lines(config: &TessConfig) -> bool {
    config.domain == TESS_DOMAIN_ISOLINE && config.output == TESS_OUTPUT_LINE
}

#[test]
fn the_model_holds_direct3d_and_breaks_vulkan() {
    let lines: DeviceFault =
        |config, _, _| if is_lines(config) { 0 } else { TESS_DEVICE_UNSUPPORTED };
    let (status, report) = judge(TESS_SPECIFICATION_D3D11, lines);
    assert_eq!(status, TESS_OK, "{report}");
    assert!(report.contains("\nisolines      held ") && report.contains(" 0 broken"), "{report}");
    let (status, report) = judge(TESS_SPECIFICATION_VULKAN, lines);
    assert_eq!(status, TESS_DIFFERENT, "{report}");
    let is_shown = report.contains("segments      broken") && report.contains("\n  case isoline ");
    assert!(is_shown, "{report}");
}

#[test]
fn a_broken_rule_is_found() {
    let (status, report) = judge(TESS_SPECIFICATION_D3D11, |config, counts, _| {
        counts.indices = counts.indices.saturating_sub(2);
        if is_lines(config) { 0 } else { TESS_DEVICE_UNSUPPORTED }
    });
    assert_eq!(status, TESS_DIFFERENT, "{report}");
    assert!(report.contains("counts        broken"), "{report}");
}

#[test]
fn devices_that_fail_or_have_nothing() {
    let (status, report) = judge(TESS_SPECIFICATION_VULKAN, |_, _, _| 9);
    assert_eq!(status, TESS_DIFFERENT, "{report}");
    assert!(
        report.starts_with("case ") && report.ends_with("\nthe tessellator answered 9\n"),
        "{report}"
    );
    let (status, _) = judge(TESS_SPECIFICATION_VULKAN, |_, _, _| TESS_DEVICE_UNSUPPORTED);
    assert_eq!(status, TESS_LEFT_OUT, "nothing was judged");
}

#[test]
fn wrong_arguments_are_refused() {
    let mut fault: DeviceFault = |_, _, _| TESS_DEVICE_UNSUPPORTED;
    let user = (&raw mut fault).cast::<c_void>();
    let call = |specification, device: TessDevice| {
        // SAFETY: a device that keeps to its type, and no room.
        unsafe { tess_check_rules(specification, 0, 1, device, user, null_mut(), 0) }
    };
    assert_eq!(call(3, Some(device)), TESS_UNKNOWN_VALUE, "no such standard");
    assert_eq!(call(TESS_SPECIFICATION_VULKAN, None), TESS_NULL_POINTER, "no device");
}
