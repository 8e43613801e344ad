//! One patch and its probes against the model.

use super::samples::{self, patch_factors, samples};
use std::ffi::CStr;
use tess_capi::patch::{tess_count, tess_patch};
use tess_capi::prepare::{TessPreparation, tess_prepare};
use tess_capi::probe::{
    TESS_POINT_ORIGIN_CENTRE, TESS_POINT_ORIGIN_CORNER, TESS_POINT_ORIGIN_LINE,
    TESS_POINT_ORIGIN_OUTER_EDGE, TESS_POINT_ORIGIN_RING, TESS_PRIMITIVE_ORIGIN_CENTRE,
    TESS_PRIMITIVE_ORIGIN_LINE, TESS_PRIMITIVE_ORIGIN_MINIMUM, TESS_PRIMITIVE_ORIGIN_RING,
    TESS_PRIMITIVE_ORIGIN_SEQUENCE, TESS_PRIMITIVE_ORIGIN_TRANSITION, TessPointOrigin,
    TessPrimitive, TessPrimitiveOrigin, tess_context, tess_fixed_factor, tess_locate_point,
    tess_locate_primitive, tess_place, tess_point, tess_primitive,
};
use tess_capi::process::{
    TESS_OUTCOME_CULLED, TESS_OUTCOME_MINIMUM, TESS_OUTCOME_REGULAR, TessProcessedPatch,
    tess_process,
};
use tess_capi::status::{TESS_OK, TESS_OUT_OF_RANGE, tess_status_message};
use tess_capi::types::{TESS_MAX_INDICES, TESS_MAX_POINTS, TessContext, TessCounts, TessPoint};
use tess_core::prepare::{QuadAxes, Reduction, Request, prepare};
use tess_core::{
    Domain, FixedFactor, Partitioning, PatchFactors, PointOrigin, PrimitiveOrigin, ProcessedPatch,
};

#[test]
fn whole_patches() {
    let mut points = vec![TessPoint::default(); TESS_MAX_POINTS as usize];
    let mut indices = vec![0; TESS_MAX_INDICES as usize];
    for s in samples() {
        let (factors, n) = (s.factors.as_ptr(), s.factors.len());
        let mut counts = TessCounts::default();
        assert_eq!(unsafe { tess_count(&s.config, factors, n, &mut counts) }, TESS_OK, "count");
        assert_eq!(counts, samples::counts(s.patch.counts()), "{:?} {:?}", s.config, s.factors);

        points.fill(TessPoint { u: 7, v: 7 });
        indices.fill(u32::MAX);
        let mut written = TessCounts::default();
        let (to_points, to_indices) = (points.as_mut_ptr(), indices.as_mut_ptr());
        // Exactly as much room as is needed.
        let status = unsafe {
            let (room, index_room) = (counts.points as usize, counts.indices as usize);
            tess_patch(&s.config, factors, n, to_points, room, to_indices, index_room, &mut written)
        };
        assert_eq!((status, written), (TESS_OK, counts), "patch");
        let whole = s.patch.tessellate();
        let (point_count, index_count) = (whole.points.len(), whole.indices.len());
        let expected: Vec<TessPoint> = whole.points.into_iter().map(samples::point).collect();
        assert_eq!(points[..point_count], expected, "points of {:?} {:?}", s.config, s.factors);
        assert_eq!(indices[..index_count], whole.indices, "indices of {:?}", s.factors);
        assert!(points[point_count..].iter().all(|p| p.u == 7 && p.v == 7), "points behind");
        assert!(indices[index_count..].iter().all(|&i| i == u32::MAX), "indices behind");
    }
}

#[test]
fn elements_and_their_locations() {
    let mut kinds_seen = ([0; 5], [0; 6]);
    for s in samples() {
        let (factors, n, counts) = (s.factors.as_ptr(), s.factors.len(), s.patch.counts());
        let step = |count: u32| (count / 50).max(1) as usize;
        for i in (0..counts.points).step_by(step(counts.points)) {
            let (mut point, mut location) = (TessPoint::default(), TessPointOrigin::default());
            let status = unsafe { tess_point(&s.config, factors, n, i, &mut point) };
            assert_eq!((status, Some(point)), (TESS_OK, s.patch.point(i).map(samples::point)));
            let status = unsafe { tess_locate_point(&s.config, factors, n, i, &mut location) };
            assert_eq!(status, TESS_OK, "location of point {i}");
            assert_eq!(s.patch.locate_point(i), Some(point_location(location)), "point {i}");
            kinds_seen.0[location.kind as usize] += 1;
        }
        for t in (0..counts.primitives).step_by(step(counts.primitives)) {
            let mut primitive = TessPrimitive::default();
            let mut location = TessPrimitiveOrigin::default();
            let status = unsafe { tess_primitive(&s.config, factors, n, t, &mut primitive) };
            assert_eq!(status, TESS_OK, "primitive {t}");
            let expected = s.patch.primitive(t).expect("a primitive of the patch");
            let (used, unused) = primitive.indices.split_at(primitive.size as usize);
            assert_eq!(used, expected.indices(), "primitive {t} of {:?}", s.factors);
            assert!(unused.iter().all(|&index| index == 0), "primitive {t} has more indices");
            let status = unsafe { tess_locate_primitive(&s.config, factors, n, t, &mut location) };
            assert_eq!(status, TESS_OK, "location of primitive {t}");
            assert_eq!(s.patch.locate_primitive(t), Some(primitive_location(location)), "{t}");
            kinds_seen.1[location.kind as usize] += 1;
        }
        let mut none = (TessPoint::default(), TessPrimitive::default());
        let beyond = unsafe {
            [
                tess_point(&s.config, factors, n, counts.points, &mut none.0),
                tess_primitive(&s.config, factors, n, counts.primitives, &mut none.1),
                tess_point(&s.config, factors, n, u32::MAX, &mut none.0),
                tess_primitive(&s.config, factors, n, u32::MAX, &mut none.1),
            ]
        };
        assert_eq!(beyond, [TESS_OUT_OF_RANGE; 4], "elements that {:?} has not", s.factors);
    }
    assert!(!kinds_seen.0.contains(&0), "a kind of point never came: {kinds_seen:?}");
    assert!(!kinds_seen.1.contains(&0), "a kind of primitive never came: {kinds_seen:?}");
}

/// Back to the model's type, by the names of the kinds.
fn point_location(location: TessPointOrigin) -> PointOrigin {
    let TessPointOrigin { kind, line, ring, edge, p } = location;
    match kind {
        TESS_POINT_ORIGIN_CORNER => PointOrigin::Corner { corner: p },
        TESS_POINT_ORIGIN_LINE => PointOrigin::Line { line, p },
        TESS_POINT_ORIGIN_OUTER_EDGE => PointOrigin::OuterEdge { edge, p },
        TESS_POINT_ORIGIN_RING => PointOrigin::Ring { ring, edge, p },
        TESS_POINT_ORIGIN_CENTRE => PointOrigin::Centre { p },
        _ => panic!("no such kind: {location:?}"),
    }
}

fn primitive_location(location: TessPrimitiveOrigin) -> PrimitiveOrigin {
    let TessPrimitiveOrigin { kind, line, ring, edge, step } = location;
    match kind {
        TESS_PRIMITIVE_ORIGIN_SEQUENCE => PrimitiveOrigin::Sequence { step },
        TESS_PRIMITIVE_ORIGIN_LINE => PrimitiveOrigin::Line { line, segment: step },
        TESS_PRIMITIVE_ORIGIN_MINIMUM => PrimitiveOrigin::Minimum { step },
        TESS_PRIMITIVE_ORIGIN_TRANSITION => PrimitiveOrigin::Transition { edge, step },
        TESS_PRIMITIVE_ORIGIN_RING => PrimitiveOrigin::Ring { ring, edge, step },
        TESS_PRIMITIVE_ORIGIN_CENTRE => PrimitiveOrigin::Centre { step },
        _ => panic!("no such kind: {location:?}"),
    }
}

#[test]
fn processed_factors_contexts_and_places() {
    let mut places = 0;
    for s in samples() {
        let mut processed = TessProcessedPatch::default();
        let (factors, n) = (s.factors.as_ptr(), s.factors.len());
        let status = unsafe { tess_process(&s.config, factors, n, &mut processed) };
        assert_eq!(status, TESS_OK, "process");
        let (outcome, model) = match s.patch.processed() {
            ProcessedPatch::Culled => (TESS_OUTCOME_CULLED, vec![]),
            ProcessedPatch::Minimum(factors) => (TESS_OUTCOME_MINIMUM, in_order(factors)),
            ProcessedPatch::Regular(factors) => (TESS_OUTCOME_REGULAR, in_order(factors)),
        };
        assert_eq!(processed.outcome, outcome, "{:?}", s.factors);
        let used = &processed.factors[..processed.factor_count as usize];
        assert_eq!(used.len(), model.len(), "{:?}", s.factors);
        for (ours, model) in used.iter().zip(model) {
            assert_eq!(ours.clamped, model.clamped, "clamped of {:?}", s.factors);
            assert_eq!(ours.rounded, model.rounded, "rounded of {:?}", s.factors);
            assert_eq!(ours.fixed, model.fixed.to_bits(), "fixed of {:?}", s.factors);
            assert_eq!(ours.context, samples::context(model.context), "context of {:?}", s.factors);
            let context = &ours.context;
            let mut again = TessContext::default();
            let split = s.config.split;
            let status = unsafe { tess_context(ours.fixed, context.parity, split, &mut again) };
            // The density of isolines and inside factors have their own partitionings or bounds,
            // but the same context for the same fixed-point factor.
            assert_eq!((status, &again), (TESS_OK, context), "context of {:#x}", ours.fixed);
            for p in 0..context.points {
                let mut location = 0;
                let status = unsafe { tess_place(context, p, &mut location) };
                let expected = tess_core::place::place(&model.context, p).to_bits();
                assert_eq!((status, location), (TESS_OK, expected), "point {p} of {context:?}");
                places += 1;
            }
            let status = unsafe { tess_place(context, context.points, &mut 0) };
            assert_eq!(status, TESS_OUT_OF_RANGE, "a point behind the last");
        }
    }
    assert!(places > 10_000, "only {places} places");
}

fn in_order<T: Copy>(factors: &PatchFactors<T>) -> Vec<T> {
    factors.iter().collect()
}

#[test]
fn conversions() {
    for bits in (0..=u32::MAX).step_by(65_521) {
        let expected = FixedFactor::from_f32(f32::from_bits(bits)).to_bits();
        assert_eq!(tess_fixed_factor(bits), expected, "{bits:#x}");
    }
}

#[test]
fn preparation() {
    const REDUCTIONS: [Reduction; 3] = [Reduction::Min, Reduction::Max, Reduction::Average];
    const AXES: [QuadAxes; 2] = [QuadAxes::One, QuadAxes::Two];
    let bits = |factors: &[f32]| factors.iter().map(|f| f.to_bits()).collect::<Vec<_>>();
    for s in samples() {
        for (number, reduction) in (0..).zip(REDUCTIONS) {
            for (axes_number, axes) in (0..).zip(AXES) {
                let domain = Domain::ALL[s.config.domain as usize];
                let partitioning = Partitioning::ALL[s.config.partitioning as usize];
                let request = Request::from_record(patch_factors(domain, &s.factors), axes);
                let model = prepare(partitioning, reduction, request);
                let preparation = TessPreparation {
                    domain: s.config.domain,
                    partitioning: s.config.partitioning,
                    reduction: number,
                    axes: axes_number,
                };
                // `rounded` may be the input array itself.
                let mut unrounded = vec![9.0; s.factors.len()];
                let mut rounded = s.factors.clone();
                let (io, n) = (rounded.as_mut_ptr(), rounded.len());
                let status =
                    unsafe { tess_prepare(&preparation, io, n, unrounded.as_mut_ptr(), io) };
                assert_eq!(status, TESS_OK, "{preparation:?}");
                let expected = [model.unrounded, model.rounded].map(|f| bits(&in_order(&f)));
                assert_eq!([bits(&unrounded), bits(&rounded)], expected, "{preparation:?}");
            }
        }
    }
}

#[test]
fn every_status_has_its_message() {
    let message = |status| unsafe { CStr::from_ptr(tess_status_message(status)) }.to_str();
    let messages: Vec<&str> = (0..=15).map(|status| message(status).expect("text")).collect();
    let mut distinct = messages.clone();
    distinct.sort_unstable();
    distinct.dedup();
    assert_eq!(distinct.len(), messages.len(), "messages are distinct: {messages:?}");
    assert_eq!(messages.first(), Some(&"done"), "the first is success");
    assert!(!messages.contains(&"unknown status"), "all are known");
    for status in [16, 1000, u32::MAX] {
        assert_eq!(message(status), Ok("unknown status"), "{status}");
    }
}
