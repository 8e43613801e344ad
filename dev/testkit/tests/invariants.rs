//! The invariants of spec section 12 hold for any factors, and each can fail.

use proptest::prelude::*;
use tess_core::{Config, DomainPoint, OutputPrimitive, Tessellation};
use tess_testkit::invariants::{
    Violation, all, area, counts, crack_free, manifold, range, separability, symmetry, winding,
};
use tess_testkit::strategies;
use tess_verify::Case;

proptest! {
    #![proptest_config(ProptestConfig::with_cases(20_000))]

    #[test]
    fn hold_for_any_factors(config in strategies::config(), factors in strategies::factors()) {
        let case = Case { config, factors };
        let holds = all(&case, &case.patch().tessellate());
        prop_assert!(holds.is_ok(), "{case}: {holds:?}");
        if !matches!(factors, tess_core::PatchFactors::Isoline(_)) {
            let windings = [OutputPrimitive::TriangleCw, OutputPrimitive::TriangleCcw];
            let [cw, ccw] = windings.map(|output| {
                Case { config: Config { output, ..config }, factors }.patch().tessellate()
            });
            let holds = winding(&cw, &ccw);
            prop_assert!(holds.is_ok(), "{case}: {holds:?}");
        }
    }
}

const TRIANGLE: &str =
    "case tri fractional_odd triangle_cw ruler 40200000 40400000 40f00000 40b00000";
const QUAD: &str = "case quad fractional_even triangle_ccw center \
                    40200000 40400000 40f00000 40b00000 40c00000 40900000";

fn example(line: &str) -> (Case, Tessellation) {
    let case: Case = line.parse().expect("a case");
    let output = case.patch().tessellate();
    assert_eq!(all(&case, &output), Ok(()), "{line} as it is");
    (case, output)
}

fn moved(point: DomainPoint, u: i32, v: i32) -> DomainPoint {
    let [u, v] = [(point.u, u), (point.v, v)].map(|(c, by)| c.to_bits().wrapping_add_signed(by));
    DomainPoint::from_bits(u, v)
}

/// Checks that `check` refuses both examples after `damage`, under its own name.
fn refuses(
    name: &str,
    check: impl Fn(&Case, &Tessellation) -> Result<(), Violation>,
    damage: impl Fn(&mut Tessellation),
) {
    for line in [TRIANGLE, QUAD] {
        let (case, mut output) = example(line);
        assert_eq!(check(&case, &output), Ok(()), "{name} of {line}");
        damage(&mut output);
        let found = check(&case, &output).expect_err("damaged");
        assert_eq!(found.invariant, name, "{found}");
    }
}

#[test]
fn range_is_seen_to_fail() {
    refuses("range", range, |t| t.points[3] = DomainPoint::from_bits(0, 0x1_0001));
    refuses("range", range, |t| t.points[3] = DomainPoint::from_bits(u32::MAX, 0));
    let (case, mut output) = example(TRIANGLE);
    output.points[3] = DomainPoint::from_bits(0x8000, 0x8001);
    assert!(range(&case, &output).is_err(), "u + v above one");
    let (case, mut output) = example(QUAD);
    output.points[3] = DomainPoint::from_bits(0x8000, 0x8001);
    assert!(range(&case, &output).is_ok(), "inside the square");
}

#[test]
fn symmetry_is_seen_to_fail() {
    assert_eq!(symmetry(&[0, 0x4000, 0xC000, 0x1_0000]), Ok(()), "symmetric");
    assert!(symmetry(&[0, 0x4001, 0xC000, 0x1_0000]).is_err(), "one bit");
    assert!(symmetry(&[0, 0x8001, 0x1_0000]).is_err(), "the middle");
}

#[test]
fn counts_are_seen_to_fail() {
    refuses("counts", counts, |t| _ = t.points.pop());
    refuses("counts", counts, |t| t.points.push(DomainPoint::default()));
    refuses("counts", counts, |t| t.indices.truncate(t.indices.len() - 3));
    refuses("counts", counts, |t| t.indices[4] = u32::try_from(t.points.len()).expect("small"));
    refuses("counts", counts, |t| {
        let last = t.indices.iter().copied().max().expect("indices");
        t.indices.iter_mut().for_each(|index| *index -= u32::from(*index == last));
    });
    refuses("counts", counts, |t| *t = Tessellation::default());
}

#[test]
fn area_is_seen_to_fail() {
    // An inner point is surrounded, so moving it does not change the sum; moving an outer point
    // does.
    refuses("area", area, |t| t.points[1] = moved(t.points[1], 1, 0));
    refuses("area", area, |t| t.indices.swap(0, 1));
    refuses("area", area, |t| t.indices[0] = u32::MAX);
}

#[test]
fn manifold_is_seen_to_fail() {
    refuses("manifold", manifold, |t| t.indices.swap(0, 1)); // one triangle turned over
    refuses("manifold", manifold, |t| t.indices.extend_from_within(0..3)); // one twice
    refuses("manifold", manifold, |t| t.indices[1] = t.indices[0]); // one without area
    refuses("manifold", manifold, |t| t.points.push(DomainPoint::default())); // one apart
    refuses("manifold", manifold, |t| {
        let hole = t.indices.len() - 3; // in the centre
        t.indices.truncate(hole);
    });
}

#[test]
fn crack_free_is_seen_to_fail() {
    refuses("crack-free", crack_free, |t| t.points[1] = moved(t.points[1], 0, 1));
    refuses("crack-free", crack_free, |t| t.points[0] = moved(t.points[0], 1, -1));
    refuses("crack-free", crack_free, |t| t.points.swap(1, 2));
    refuses("crack-free", crack_free, |t| t.points.truncate(5));
    // No neighbour shares an inner point, so it may move.
    let (case, mut output) = example(QUAD);
    let last = output.points.len() - 1;
    output.points[last] = moved(output.points[last], 1, 1);
    assert_eq!(crack_free(&case, &output), Ok(()), "an inner point");
}

#[test]
fn separability_is_seen_to_fail() {
    refuses("separability", separability, |t| t.indices.swap(0, 3));
    refuses("separability", separability, |t| _ = t.indices.pop());
}

#[test]
fn winding_is_seen_to_fail() {
    let (case, cw) = example(TRIANGLE);
    let output = OutputPrimitive::TriangleCcw;
    let config = Config { output, ..case.config };
    let ccw = Case { config, ..case }.patch().tessellate();
    assert_eq!(winding(&cw, &ccw), Ok(()), "as they are");
    assert!(winding(&cw, &cw).is_err(), "the same winding twice");
    let mut damaged = ccw.clone();
    damaged.indices.swap(0, 1);
    assert!(winding(&cw, &damaged).is_err(), "another leading vertex");
    let mut damaged = ccw;
    damaged.points[0] = moved(damaged.points[0], 1, 0);
    assert!(winding(&cw, &damaged).is_err(), "another point");
}
