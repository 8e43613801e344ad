//! Refused arguments: null, misaligned, unknown, too small, too large, overlapping.

use std::ptr::{null, null_mut};
use tess_capi::patch::{tess_count, tess_patch};
use tess_capi::prepare::{TessPreparation, tess_prepare};
use tess_capi::probe::{
    TessPointOrigin, TessPrimitive, TessPrimitiveOrigin, tess_context, tess_locate_point,
    tess_locate_primitive, tess_place, tess_point, tess_primitive,
};
use tess_capi::process::{TessProcessedPatch, tess_process};
use tess_capi::shortage::{TESS_BUFFER_INDICES, TESS_BUFFER_POINTS, TessShortage, tess_shortage};
use tess_capi::status::{
    TESS_BUFFER_TOO_SMALL, TESS_MISALIGNED, TESS_NOT_A_CONTEXT, TESS_NULL_POINTER, TESS_OK,
    TESS_OUT_OF_RANGE, TESS_OVERLAP, TESS_TOO_LARGE, TESS_UNKNOWN_VALUE, TESS_WRONG_FACTOR_COUNT,
    TessStatus,
};
use tess_capi::types::{TessConfig, TessContext, TessCounts, TessPoint};

/// A quad that is fine; integer, triangles, ruler.
static CONFIG: TessConfig = TessConfig { domain: 2, partitioning: 0, output: 2, split: 0 };
static FACTORS: [f32; 6] = [3.0, 4.0, 5.0, 6.0, 4.0, 7.0];

/// What was too small in this thread's last call that said so: the buffer, needed and got.
fn shortage() -> Option<(u32, usize, usize)> {
    let mut told = TessShortage { buffer: 9, needed: 9, got: 9 };
    match unsafe { tess_shortage(&mut told) } {
        TESS_OK => Some((told.buffer, told.needed, told.got)),
        status => {
            assert_eq!((status, told.buffer), (TESS_OUT_OF_RANGE, 9), "nothing is written");
            None
        }
    }
}

/// The same pointer, one byte on.
fn askew<T>(pointer: *mut T) -> *mut T {
    pointer.wrapping_byte_add(1)
}

/// Calls every function that takes a patch and an output, the output being null or askew if asked.
fn patch_functions(
    config: *const TessConfig,
    factors: *const f32,
    count: usize,
) -> [TessStatus; 7] {
    let (mut counts, mut point, mut primitive, mut processed) = (
        TessCounts::default(),
        TessPoint::default(),
        TessPrimitive::default(),
        TessProcessedPatch::default(),
    );
    let (mut at, mut of) = (TessPointOrigin::default(), TessPrimitiveOrigin::default());
    let mut points = vec![TessPoint::default(); 100];
    let mut indices = vec![0; 1000];
    let (p, i) = (points.as_mut_ptr(), indices.as_mut_ptr());
    unsafe {
        [
            tess_count(config, factors, count, &mut counts),
            tess_patch(config, factors, count, p, 100, i, 1000, &mut counts),
            tess_process(config, factors, count, &mut processed),
            tess_point(config, factors, count, 0, &mut point),
            tess_primitive(config, factors, count, 0, &mut primitive),
            tess_locate_point(config, factors, count, 0, &mut at),
            tess_locate_primitive(config, factors, count, 0, &mut of),
        ]
    }
}

#[test]
fn inputs_of_patch_functions() {
    let f = FACTORS.as_ptr();
    let mut room = [CONFIG; 2];
    let config: *const TessConfig = &raw const CONFIG;
    assert_eq!(patch_functions(config, f, 6), [TESS_OK; 7], "a good patch");
    assert_eq!(patch_functions(null(), f, 6), [TESS_NULL_POINTER; 7], "no configuration");
    assert_eq!(patch_functions(config, null(), 6), [TESS_NULL_POINTER; 7], "no factors");
    assert_eq!(
        patch_functions(askew(room.as_mut_ptr()), f, 6),
        [TESS_MISALIGNED; 7],
        "a configuration askew"
    );
    assert_eq!(
        patch_functions(config, askew(f.cast_mut()), 6),
        [TESS_MISALIGNED; 7],
        "factors askew"
    );
    for count in [0, 2, 4, 5, 7, usize::MAX / 4, usize::MAX] {
        assert_eq!(patch_functions(config, f, count), [TESS_WRONG_FACTOR_COUNT; 7], "{count}");
    }
    for bad in [
        TessConfig { domain: 3, ..CONFIG },
        TessConfig { domain: u32::MAX, ..CONFIG },
        TessConfig { partitioning: 4, ..CONFIG },
        TessConfig { output: 4, ..CONFIG },
        TessConfig { split: 2, ..CONFIG },
        TessConfig { split: 0x8000_0000, ..CONFIG },
    ] {
        assert_eq!(patch_functions(&raw const bad, f, 6), [TESS_UNKNOWN_VALUE; 7], "{bad:?}");
    }
}

#[test]
fn outputs_of_patch_functions() {
    let (c, f) = (&raw const CONFIG, FACTORS.as_ptr());
    let mut words = [0xAAAA_AAAAu32; 128];
    let memory = words.as_mut_ptr();
    let calls = |to: *mut u32| unsafe {
        [
            tess_count(c, f, 6, to.cast()),
            tess_patch(c, f, 6, null_mut(), 0, null_mut(), 0, to.cast()),
            tess_process(c, f, 6, to.cast()),
            tess_point(c, f, 6, 0, to.cast()),
            tess_primitive(c, f, 6, 0, to.cast()),
            tess_locate_point(c, f, 6, 0, to.cast()),
            tess_locate_primitive(c, f, 6, 0, to.cast()),
            tess_context(0x3_0000, 1, 0, to.cast()),
        ]
    };
    assert_eq!(calls(null_mut()), [TESS_NULL_POINTER; 8], "no output");
    assert_eq!(calls(askew(memory)), [TESS_MISALIGNED; 8], "an output askew");
    assert_eq!(words, [0xAAAA_AAAA; 128], "nothing was written");
}

#[test]
fn buffers_of_patches() {
    let (c, f) = (&raw const CONFIG, FACTORS.as_ptr());
    let mut needed = TessCounts::default();
    assert_eq!(unsafe { tess_count(c, f, 6, &mut needed) }, TESS_OK, "a good patch");
    let (n, m) = (needed.points as usize, needed.indices as usize);
    let mut points = vec![TessPoint { u: 5, v: 5 }; n + 1];
    let mut indices = vec![5; m + 1];
    let (p, i) = (points.as_mut_ptr(), indices.as_mut_ptr());
    let call = |p, n, i, m| {
        let mut counts = TessCounts::default();
        let status = unsafe { tess_patch(c, f, 6, p, n, i, m, &mut counts) };
        let is_reported = matches!(status, TESS_OK | TESS_BUFFER_TOO_SMALL);
        let expected = if is_reported { needed } else { TessCounts::default() };
        assert_eq!(counts, expected, "what is reported with status {status}");
        status
    };
    assert_eq!(call(p, n - 1, i, m), TESS_BUFFER_TOO_SMALL, "one point too few");
    assert_eq!(shortage(), Some((TESS_BUFFER_POINTS, n, n - 1)), "one point too few");
    assert_eq!(call(p, n, i, m - 1), TESS_BUFFER_TOO_SMALL, "one index too few");
    assert_eq!(shortage(), Some((TESS_BUFFER_INDICES, m, m - 1)), "one index too few");
    assert_eq!(call(null_mut(), 0, null_mut(), 0), TESS_BUFFER_TOO_SMALL, "no buffers");
    assert_eq!(shortage(), Some((TESS_BUFFER_POINTS, n, 0)), "no buffers");
    assert_eq!(std::thread::spawn(shortage).join().ok(), Some(None), "another thread's call");
    assert_eq!(call(null_mut(), n, i, m), TESS_NULL_POINTER, "null points");
    assert_eq!(call(p, n, null_mut(), m), TESS_NULL_POINTER, "null indices");
    assert_eq!(call(askew(p), n, i, m), TESS_MISALIGNED, "points askew");
    assert_eq!(call(p, n, askew(i), m), TESS_MISALIGNED, "indices askew");
    assert_eq!(call(p, n, p.cast(), m), TESS_OVERLAP, "one buffer twice");
    assert_eq!(call(p, n, unsafe { p.add(n - 1) }.cast(), m), TESS_OVERLAP, "one point shared");
    assert!(points.iter().all(|p| p.u == 5 && p.v == 5), "no point was written");
    assert!(indices.iter().all(|&i| i == 5), "no index was written");
    for impossible in [usize::MAX, usize::MAX / 8 + 1, isize::MAX.unsigned_abs() / 4 + 1] {
        assert_eq!(call(p, impossible, i, m), TESS_TOO_LARGE, "{impossible} points");
        assert_eq!(call(p, n, i, impossible), TESS_TOO_LARGE, "{impossible} indices");
    }
    for inside in
        [p.cast(), unsafe { p.add(n - 2) }.cast(), i.cast(), unsafe { i.add(m - 1) }.cast()]
    {
        let status = unsafe { tess_patch(c, f, 6, p, n, i, m, inside) };
        assert_eq!(status, TESS_OVERLAP, "the counts lie in a buffer");
    }
    assert!(points.iter().all(|p| p.u == 5 && p.v == 5), "no point was written");
    assert!(indices.iter().all(|&i| i == 5), "no index was written");
    assert_eq!(call(p, n + 1, i, m + 1), TESS_OK, "more room than is needed");
    assert!(points[n].u == 5 && indices[m] == 5, "something was written behind the patch");
    // A culled patch needs no memory.
    let culled = [0.0; 6];
    let mut counts = needed;
    let status =
        unsafe { tess_patch(c, culled.as_ptr(), 6, null_mut(), 0, null_mut(), 0, &mut counts) };
    assert_eq!((status, counts), (TESS_OK, TessCounts::default()), "a culled patch");
    // Where there is said to be memory, there must be some.
    for (points, status) in [(null_mut(), TESS_NULL_POINTER), (askew(p), TESS_MISALIGNED)] {
        let given = culled.as_ptr();
        let told = unsafe { tess_patch(c, given, 6, points, 1, null_mut(), 0, &mut counts) };
        assert_eq!(told, status, "a culled patch and {points:?}");
    }
}

#[test]
fn places_and_contexts() {
    let mut context = TessContext::default();
    unsafe {
        assert_eq!(tess_context(0x3_0000, 2, 0, &mut context), TESS_UNKNOWN_VALUE, "parity");
        assert_eq!(tess_context(0x3_0000, 1, 2, &mut context), TESS_UNKNOWN_VALUE, "split");
        assert_eq!(context, TessContext::default(), "nothing was written");
        for factor in [0, 1, 0xFFFF, 0x1_8000, 0x7FFF_FFFF, 0x8000_0000, u32::MAX] {
            for (parity, split) in [(0, 0), (0, 1), (1, 0), (1, 1)] {
                assert_eq!(tess_context(factor, parity, split, &mut context), TESS_OK, "total");
                assert!((2..=65).contains(&context.points), "{factor:#x}: {context:?}");
                let (mut first, mut last) = (9, 9);
                assert_eq!(tess_place(&context, 0, &mut first), TESS_OK, "{context:?}");
                assert_eq!(tess_place(&context, context.points - 1, &mut last), TESS_OK, "last");
                assert_eq!((first, last), (0, 0x1_0000), "ends of {context:?}");
            }
        }
        let mut location = 9;
        let odd = TessContext { inv_floor: u32::MAX, ..context };
        assert_eq!(tess_place(&odd, 1, &mut location), TESS_NOT_A_CONTEXT, "no such reciprocal");
        assert_eq!(tess_place(null(), 1, &mut location), TESS_NULL_POINTER, "no context");
        assert_eq!(tess_place(&context, 1, null_mut()), TESS_NULL_POINTER, "no output");
        assert_eq!(tess_place(&context, 1, askew(&raw mut location)), TESS_MISALIGNED, "askew");
        assert_eq!(location, 9, "nothing was written");
    }
}

#[test]
fn preparations() {
    let good = TessPreparation { domain: 2, partitioning: 2, reduction: 1, axes: 1 };
    let f = FACTORS.as_ptr();
    let mut out = [[8.0f32; 6]; 2];
    let [a, b] = [out[0].as_mut_ptr(), out[1].as_mut_ptr()];
    unsafe {
        for bad in [
            TessPreparation { domain: 3, ..good },
            TessPreparation { partitioning: 4, ..good },
            TessPreparation { reduction: 3, ..good },
            TessPreparation { axes: 2, ..good },
        ] {
            assert_eq!(tess_prepare(&bad, f, 6, a, b), TESS_UNKNOWN_VALUE, "{bad:?}");
        }
        assert_eq!(tess_prepare(null(), f, 6, a, b), TESS_NULL_POINTER, "no preparation");
        assert_eq!(tess_prepare(&good, null(), 6, a, b), TESS_NULL_POINTER, "no factors");
        assert_eq!(tess_prepare(&good, f, 6, null_mut(), b), TESS_NULL_POINTER, "no unrounded");
        assert_eq!(tess_prepare(&good, f, 6, a, null_mut()), TESS_NULL_POINTER, "no rounded");
        assert_eq!(tess_prepare(&good, f, 6, a, askew(b)), TESS_MISALIGNED, "rounded askew");
        assert_eq!(tess_prepare(&good, f, 5, a, b), TESS_WRONG_FACTOR_COUNT, "five factors");
        assert_eq!(tess_prepare(&good, f, usize::MAX, a, b), TESS_WRONG_FACTOR_COUNT, "many");
    }
    assert_eq!(out.map(|o| o.map(f32::to_bits)), [[8.0f32.to_bits(); 6]; 2], "nothing written");
}
