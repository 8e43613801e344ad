//! All outputs of a patch agree: sinks, slices, vectors and predicted counts.

use proptest::prelude::*;
use tess_core::prepare::{QuadAxes, Reduction, Request, prepare};
use tess_core::{
    Buffer, BufferTooSmallError, Config, Counter, Counts, DomainPoint, MAX_INDICES, MAX_POINTS,
    OutputPrimitive, Partitioning, Patch, PatchFactors, QuadFactors,
};
use tess_testkit::strategies;

/// The value of unwritten elements.
const POINT: DomainPoint = DomainPoint::from_bits(0xDEAD_BEEF, 0xDEAD_BEEF);
const INDEX: u32 = 0xDEAD_BEEF;

fn check_buffers(config: Config, factors: PatchFactors) -> Result<(), TestCaseError> {
    let patch = Patch::new(config, factors);
    let counts = patch.counts();
    let (n, m) = (counts.points as usize, counts.indices as usize);
    prop_assert!(n <= MAX_POINTS && m <= MAX_INDICES, "limits of a patch: {counts:?}");
    let whole = patch.tessellate();
    prop_assert_eq!((whole.points.len(), whole.indices.len()), (n, m), "predicted sizes");
    let mut counter = Counter::default();
    patch.emit(&mut counter);
    let counted = (counter.points, counter.primitives, counter.indices);
    prop_assert_eq!(counted, (counts.points, counts.primitives, counts.indices), "counted");

    // Room for the output and two elements, which must stay unwritten.
    let (mut points, mut indices) = (vec![POINT; n + 2], vec![INDEX; m + 2]);
    prop_assert_eq!(patch.write(&mut points, &mut indices), Ok(counts), "room to spare");
    prop_assert!(points[..n] == whole.points && indices[..m] == whole.indices, "contents");
    prop_assert!(points[n..] == [POINT; 2] && indices[m..] == [INDEX; 2], "guards");
    prop_assert_eq!(patch.write(&mut points[..n], &mut indices[..m]), Ok(counts), "exact room");
    Ok(())
}

/// Both buffers keep their values if either is too small.
fn check_too_small(
    patch: &Patch,
    (points, indices): (usize, usize),
    expected: BufferTooSmallError,
) -> Result<(), TestCaseError> {
    let (mut points, mut indices) = (vec![POINT; points], vec![INDEX; indices]);
    prop_assert_eq!(patch.write(&mut points, &mut indices), Err(expected), "the error");
    prop_assert!(points.iter().all(|&point| point == POINT), "no point was written");
    prop_assert!(indices.iter().all(|&index| index == INDEX), "no index was written");
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn sinks_slices_vectors_and_counts(
        config in strategies::config(),
        factors in strategies::factors(),
    ) {
        check_buffers(config, factors)?;
    }

    #[test]
    fn buffers_that_are_too_small(
        config in strategies::config(),
        factors in strategies::factors(),
        fraction in 0u32..100,
    ) {
        let patch = Patch::new(config, factors);
        let (n, m) = (patch.counts().points as usize, patch.counts().indices as usize);
        for less in [1, n * fraction as usize / 100, n] {
            if let Some(got) = n.checked_sub(less).filter(|&got| got < n) {
                let error = BufferTooSmallError { buffer: Buffer::Points, needed: n, got };
                check_too_small(&patch, (got, m), error)?;
            }
        }
        for less in [1, m * fraction as usize / 100, m] {
            if let Some(got) = m.checked_sub(less).filter(|&got| got < m) {
                let error = BufferTooSmallError { buffer: Buffer::Indices, needed: m, got };
                check_too_small(&patch, (n, got), error)?;
            }
        }
    }

    /// Factor preparation: culled patches come back as they were, with zeros. The rounded factors
    /// of all others are in the partitioning's range, so the tessellator clamps none.
    #[test]
    fn prepared_factors_are_in_range(
        partitioning in prop::sample::select(&Partitioning::ALL[..]),
        reduction in prop::sample::select(
            &[Reduction::Min, Reduction::Max, Reduction::Average][..]
        ),
        axes in prop::sample::select(&[QuadAxes::One, QuadAxes::Two][..]),
        factors in strategies::factors(),
    ) {
        let outer_count = match factors {
            PatchFactors::Isoline(_) => 2,
            PatchFactors::Triangle(_) => 3,
            PatchFactors::Quad(_) => 4,
        };
        let raw = list(&factors);
        let prepared = prepare(partitioning, reduction, Request::from_record(factors, axes));
        let (unrounded, rounded) = (list(&prepared.unrounded), list(&prepared.rounded));
        if raw[..outer_count].iter().any(|factor| factor.is_nan() || *factor <= 0.0) {
            let bits = |factors: &[f32]| factors.iter().map(|f| f.to_bits()).collect::<Vec<_>>();
            let as_given = bits(&unrounded[..outer_count]) == bits(&raw[..outer_count]);
            prop_assert!(as_given, "unrounded outer factors are the inputs: {unrounded:?}");
            let rest = unrounded[outer_count..].iter().chain(&rounded);
            prop_assert!(rest.clone().all(|f| f.to_bits() == 0), "the rest is 0: {prepared:?}");
        } else {
            let (low, high) = partitioning.range();
            let low = if matches!(factors, PatchFactors::Isoline(_)) { 1.0 } else { low };
            let high = if matches!(factors, PatchFactors::Isoline(_)) { 64.0 } else { high };
            let in_range = rounded.iter().all(|factor| (low..=high).contains(factor));
            prop_assert!(in_range, "rounded factors in {low}..={high}: {rounded:?}");
        }
    }
}

fn list(factors: &PatchFactors) -> Vec<f32> {
    match factors {
        PatchFactors::Isoline(f) => vec![f.density, f.detail],
        PatchFactors::Triangle(f) => [&f.outer()[..], &[f.inside]].concat(),
        PatchFactors::Quad(f) => [&f.outer()[..], &f.inside()].concat(),
    }
}

#[test]
fn the_error_says_what_was_needed() {
    let error = BufferTooSmallError { buffer: Buffer::Indices, needed: 66, got: 65 };
    assert_eq!(
        error.to_string(),
        "the index buffer holds 65 elements, but the patch needs 66",
        "the message"
    );
}

/// The largest patch fills the largest buffers, and there is no element past its end.
#[test]
fn the_largest_patch() {
    let [u0, v0, u1, v1, inside_u, inside_v] = [64.0; 6];
    let factors = PatchFactors::Quad(QuadFactors { u0, v0, u1, v1, inside_u, inside_v });
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
    let patch = Patch::new(config, factors);
    let Counts { points, primitives, indices } = patch.counts();
    assert_eq!((points as usize, indices as usize), (MAX_POINTS, MAX_INDICES), "limits");
    assert!(patch.locate_point(points - 1).is_some(), "the last point");
    assert_eq!(patch.locate_point(points), None, "one past the last point");
    assert!(patch.locate_primitive(primitives - 1).is_some(), "the last primitive");
    assert_eq!(patch.locate_primitive(primitives), None, "one past the last primitive");
}

#[test]
fn coordinates_as_floats() {
    let bits = DomainPoint::from_bits(0x4000, 0x1_0000).to_f32().map(f32::to_bits);
    assert_eq!(bits, [0.25f32, 1.0].map(f32::to_bits), "a quarter and one");
}
