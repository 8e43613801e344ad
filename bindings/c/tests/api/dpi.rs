//! The scalar functions that simulators import, against the model.

use super::samples::samples;
use std::ptr::null_mut;
use tess_capi::dpi::{
    tess_dpi_context, tess_dpi_count, tess_dpi_place, tess_dpi_point, tess_dpi_primitive,
    tess_dpi_process,
};
use tess_capi::process::{TESS_OUTCOME_CULLED, TessProcessedPatch};
use tess_capi::status::{TESS_NULL_POINTER, TESS_OK, TESS_OUT_OF_RANGE, TESS_UNKNOWN_VALUE};
use tess_capi::types::{TessContext, TessCounts};
use tess_core::place;

#[test]
fn patches_and_their_elements() {
    for s in samples() {
        let mut bits = [0xFFC0_0000; 6]; // factors that the domain has not are not looked at
        for (slot, factor) in bits.iter_mut().zip(&s.factors) {
            *slot = factor.to_bits();
        }
        let [f0, f1, f2, f3, f4, f5] = bits;
        let c = s.config;
        let mut out = [0u32; 4];
        let [a, b, d, e] = out.each_mut().map(|slot| &raw mut *slot);
        let counts = TessCounts::from(s.patch.counts());
        let status = unsafe {
            tess_dpi_count(
                c.domain,
                c.partitioning,
                c.output,
                c.split,
                f0,
                f1,
                f2,
                f3,
                f4,
                f5,
                a,
                b,
                d,
            )
        };
        assert_eq!(status, TESS_OK, "counts of {:?}", s.factors);
        assert_eq!(out[..3], [counts.points, counts.primitives, counts.indices], "{:?}", s.factors);

        let i = counts.points / 2;
        let status = unsafe {
            tess_dpi_point(
                c.domain,
                c.partitioning,
                c.output,
                c.split,
                f0,
                f1,
                f2,
                f3,
                f4,
                f5,
                i,
                a,
                b,
            )
        };
        let expected = s.patch.point(i).map(|p| [p.u.to_bits(), p.v.to_bits()]);
        let observed = (status == TESS_OK).then_some([out[0], out[1]]);
        assert_eq!(observed, expected, "point {i} of {:?}, status {status}", s.factors);

        let t = counts.primitives / 2;
        let status = unsafe {
            tess_dpi_primitive(
                c.domain,
                c.partitioning,
                c.output,
                c.split,
                f0,
                f1,
                f2,
                f3,
                f4,
                f5,
                t,
                a,
                b,
                d,
                e,
            )
        };
        let observed = (status == TESS_OK).then(|| out[1..=out[0] as usize].to_vec());
        let expected = s.patch.primitive(t).map(|p| p.indices().to_vec());
        assert_eq!(observed, expected, "primitive {t} of {:?}, status {status}", s.factors);
    }
}

#[test]
fn processed_factors_and_places() {
    for s in samples() {
        let mut bits = [0; 6];
        for (slot, factor) in bits.iter_mut().zip(&s.factors) {
            *slot = factor.to_bits();
        }
        let [f0, f1, f2, f3, f4, f5] = bits;
        let c = s.config;
        let model = TessProcessedPatch::from(s.patch.processed());
        for number in 0..=6 {
            let mut out = [9u32; 5];
            let [o0, o1, o2, o3, o4] = out.each_mut().map(|slot| &raw mut *slot);
            let status = unsafe {
                tess_dpi_process(
                    c.domain,
                    c.partitioning,
                    c.split,
                    f0,
                    f1,
                    f2,
                    f3,
                    f4,
                    f5,
                    number,
                    o0,
                    o1,
                    o2,
                    o3,
                    o4,
                )
            };
            if number as usize >= s.factors.len() {
                assert_eq!((status, out), (TESS_OUT_OF_RANGE, [9; 5]), "factor {number}");
                continue;
            }
            let f = &model.factors[number as usize];
            let expected = [model.outcome, f.clamped, f.rounded, f.fixed, f.context.parity];
            assert_eq!((status, out), (TESS_OK, expected), "factor {number} of {:?}", s.factors);
            if model.outcome != TESS_OUTCOME_CULLED {
                check_edge(f.fixed, &f.context, c.split);
            }
        }
    }
}

/// The context, and the first and last step of placing each point.
fn check_edge(factor: u32, context: &TessContext, split: u32) {
    let mut out = [0u32; 6];
    let [a, b, c, d, e, f] = out.each_mut().map(|slot| &raw mut *slot);
    let parity = context.parity;
    let status = unsafe { tess_dpi_context(factor, parity, split, a, b, c, d, e, f) };
    let TessContext { inv_floor, inv_ceil, fraction, half_points, split: position, points, .. } =
        *context;
    let expected = [inv_floor, inv_ceil, fraction, half_points, position, points];
    assert_eq!((status, out), (TESS_OK, expected), "context of {factor:#x}");
    let model = tess_core::FactorContext::new(
        tess_core::FixedFactor::from_bits(factor),
        [tess_core::Parity::Even, tess_core::Parity::Odd][parity as usize],
        tess_core::SplitOrder::ALL[split as usize],
    );
    for p in 0..points {
        let status = unsafe { tess_dpi_place(factor, parity, split, p, a, b, c, d, e, f) };
        let flip = u32::from(p >= half_points);
        assert_eq!((status, out[0]), (TESS_OK, flip), "flip of {p}, {context:?}");
        assert_eq!(out[5], place(&model, p).to_bits(), "location of {p}, {context:?}");
    }
    let status = unsafe { tess_dpi_place(factor, parity, split, points, a, b, c, d, e, f) };
    assert_eq!(status, TESS_OUT_OF_RANGE, "a point behind the last");
}

#[test]
fn refusals_write_nothing() {
    let mut out = [7u32; 6];
    let [a, b, c, d, e, f] = out.each_mut().map(|slot| &raw mut *slot);
    unsafe {
        assert_eq!(tess_dpi_context(0x2_0000, 2, 0, a, b, c, d, e, f), TESS_UNKNOWN_VALUE);
        assert_eq!(tess_dpi_context(0x2_0000, 0, 9, a, b, c, d, e, f), TESS_UNKNOWN_VALUE);
        let last = tess_dpi_context(0x2_0000, 0, 0, a, b, c, d, e, null_mut());
        assert_eq!(last, TESS_NULL_POINTER, "the last output is null");
        let last = tess_dpi_place(0x2_0000, 0, 0, 0, a, b, c, d, e, null_mut());
        assert_eq!(last, TESS_NULL_POINTER, "the last output is null");
    }
    assert_eq!(out, [7; 6], "nothing was written");
}
