//! The scalar functions that simulators import, against the model.

use super::samples::{self, Sample, samples};
use std::ptr::null_mut;
use tess_capi::dpi::held::{
    TessHeldPatch, tess_dpi_close, tess_dpi_open, tess_dpi_patch, tess_dpi_point,
    tess_dpi_primitive,
};
use tess_capi::dpi::{tess_dpi_context, tess_dpi_coverage, tess_dpi_place, tess_dpi_process};
use tess_capi::process::{TESS_OUTCOME_CULLED, TessProcessedPatch};
use tess_capi::status::{TESS_NULL_POINTER, TESS_OK, TESS_OUT_OF_RANGE, TESS_UNKNOWN_VALUE};
use tess_capi::types::{TessConfig, TessContext};
use tess_core::fixed_point::{HALF, ONE};
use tess_core::place::place;
use tess_core::{Domain, PatchFactors};
use tess_verify::Case;
use tess_verify::cover::Coverage;

/// The bits of a sample's factors; those that the domain has not are not looked at.
fn bits(sample: &Sample) -> [u32; 6] {
    let mut bits = [0xFFC0_0000; 6];
    for (slot, factor) in bits.iter_mut().zip(&sample.factors) {
        *slot = factor.to_bits();
    }
    bits
}

/// All patches in one handle, one after another: every element, and none behind.
#[test]
fn held_patches() {
    let mut held = null_mut();
    assert_eq!(unsafe { tess_dpi_open(&mut held) }, TESS_OK, "a handle");
    assert_eq!(unsafe { elements(held, 0, 0) }, (Vec::new(), Vec::new()), "no patch yet");
    for s in samples() {
        let counts = samples::counts(s.patch.counts());
        let expected = [counts.points, counts.primitives, counts.indices];
        assert_eq!(held_as(held, &s, s.config.domain), (TESS_OK, expected), "{:?}", s.factors);
        let refused = held_as(held, &s, 3);
        assert_eq!(refused, (TESS_UNKNOWN_VALUE, [0; 3]), "a refused patch leaves the one before");
        let [mut points, mut primitives] = [7; 2];
        let status = unsafe {
            let (a, b) = (&raw mut points, &raw mut primitives);
            tess_dpi_patch(held, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, a, b, null_mut())
        };
        assert_eq!((status, points, primitives), (TESS_NULL_POINTER, 7, 7), "and so does this");
        let (points, indices) = unsafe { elements(held, counts.points, counts.primitives) };
        let whole = s.patch.tessellate();
        let bits = |point: &tess_core::DomainPoint| [point.u.to_bits(), point.v.to_bits()];
        let expected: Vec<_> = whole.points.iter().map(bits).collect();
        assert_eq!(points, expected, "points of {:?} {:?}", s.config, s.factors);
        assert_eq!(indices, whole.indices, "indices of {:?} {:?}", s.config, s.factors);
    }
    unsafe { tess_dpi_close(held) };
    unsafe { tess_dpi_close(null_mut()) };
}

/// Sets a sample's patch, with this number for its domain; the status and the sizes.
fn held_as(held: *mut TessHeldPatch, s: &Sample, domain: u32) -> (u32, [u32; 3]) {
    let TessConfig { partitioning, output, split, .. } = s.config;
    let [f0, f1, f2, f3, f4, f5] = bits(s);
    let mut sizes = [0u32; 3];
    let [a, b, c] = sizes.each_mut().map(|slot| &raw mut *slot);
    let status = unsafe {
        tess_dpi_patch(held, domain, partitioning, output, split, f0, f1, f2, f3, f4, f5, a, b, c)
    };
    (status, sizes)
}

/// All points and indices of the patch that is held; there are no elements behind them.
unsafe fn elements(
    held: *const TessHeldPatch,
    points: u32,
    primitives: u32,
) -> (Vec<[u32; 2]>, Vec<u32>) {
    let point = |i| {
        let [mut u, mut v] = [0; 2];
        let status = unsafe { tess_dpi_point(held, i, &mut u, &mut v) };
        assert_eq!(status == TESS_OK, i < points, "point {i} of {points}: status {status}");
        [u, v]
    };
    let primitive = |t| {
        let [mut size, mut a, mut b, mut c] = [0u32; 4];
        let status = unsafe { tess_dpi_primitive(held, t, &mut size, &mut a, &mut b, &mut c) };
        assert_eq!(status == TESS_OK, t < primitives, "primitive {t}: status {status}");
        let indices = [a, b, c];
        let (own, others) = indices.split_at(size as usize);
        assert!(others.iter().all(|index| *index == 0), "those that it has not are 0");
        own.to_vec()
    };
    let behind = (point(points), primitive(primitives));
    assert_eq!(behind, ([0, 0], Vec::new()), "nothing is written");
    ((0..points).map(point).collect(), (0..primitives).flat_map(primitive).collect())
}

/// The numbers of the bins give the coverage that the verification kit counts.
#[test]
fn coverage_bins() {
    let names: Vec<String> = Coverage::default().bins().map(|(bin, _)| bin.to_owned()).collect();
    for s in samples() {
        let mut observed = Coverage::default();
        for i in 0.. {
            let (status, bin) = bin(&s, i);
            if status != TESS_OK {
                assert_eq!(status, TESS_OUT_OF_RANGE, "behind the last bin of {:?}", s.factors);
                break;
            }
            assert!(observed.add(&names[bin as usize], 1), "bin {bin}");
        }
        let factors = PatchFactors::from_slice(Domain::ALL[s.config.domain as usize], &s.factors);
        let case = Case { config: s.patch.config(), factors: factors.expect("all factors") };
        let mut expected = Coverage::default();
        expected.record_stream(None, [case]);
        assert_eq!(observed, expected, "{case}");
    }
}

/// The status and the number of the `i`-th bin.
fn bin(s: &Sample, i: u32) -> (u32, u32) {
    let TessConfig { domain, partitioning, output, split } = s.config;
    let [f0, f1, f2, f3, f4, f5] = bits(s);
    let mut bin = 0;
    let status = unsafe {
        tess_dpi_coverage(domain, partitioning, output, split, f0, f1, f2, f3, f4, f5, i, &mut bin)
    };
    (status, bin)
}

#[test]
fn processed_factors_and_places() {
    for s in samples() {
        let [f0, f1, f2, f3, f4, f5] = bits(&s);
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
        assert_eq!(status, TESS_OK, "point {p} of {context:?}");
        check_steps(context, p, out);
        assert_eq!(out[5], place(&model, p).to_bits(), "location of {p}, {context:?}");
    }
    let status = unsafe { tess_dpi_place(factor, parity, split, points, a, b, c, d, e, f) };
    assert_eq!(status, TESS_OUT_OF_RANGE, "a point behind the last");
}

/// Each step of placing a point follows from the one before (specification, section 5).
fn check_steps(context: &TessContext, p: u32, steps: [u32; 6]) {
    let [flip, position, coarse, fine, half_location, location] = steps;
    let TessContext { fraction, half_points, points, .. } = *context;
    assert_eq!(flip, u32::from(p >= half_points), "flip of {p}, {context:?}");
    let mirrored = if flip == 1 { points - 1 - p } else { p };
    assert_eq!(position, mirrored, "position of {p}, {context:?}");
    let blended = if position == half_points {
        assert_eq!((coarse, fine), (0, 0), "the middle has no places, {context:?}");
        HALF
    } else {
        (coarse * (ONE - fraction) + fine * fraction + HALF) >> 16
    };
    assert_eq!(half_location, blended, "blend at {p}, {context:?}");
    let back = if flip == 1 { ONE - half_location } else { half_location };
    assert_eq!(location, back, "location of {p}, {context:?}");
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
        let none = null_mut();
        assert_eq!(tess_dpi_open(null_mut()), TESS_NULL_POINTER, "no room for a handle");
        let patch = |held, c| tess_dpi_patch(held, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, a, b, c);
        assert_eq!(patch(none, c), TESS_NULL_POINTER, "no handle");
        assert_eq!(tess_dpi_point(none, 0, a, b), TESS_NULL_POINTER, "no handle");
        assert_eq!(tess_dpi_primitive(none, 0, a, b, c, d), TESS_NULL_POINTER, "no handle");
        let mut held = none;
        assert_eq!(tess_dpi_open(&mut held), TESS_OK, "a handle");
        assert_eq!(patch(held, null_mut()), TESS_NULL_POINTER, "the last output is null");
        tess_dpi_close(held);
    }
    assert_eq!(out, [7; 6], "nothing was written");
}
