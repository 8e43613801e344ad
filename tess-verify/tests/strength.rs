//! Tests of each strength of comparison: what it accepts, and what it must not accept.

use tess_core::{DomainPoint, Tessellation};
use tess_verify::Case;
use tess_verify::check::{Conversion, Denormals, Elements, ListOrder, Strength, flushed};

const QUAD: &str = "case quad fractional_odd triangle_cw ruler \
                    40600000 40200000 40a00000 40400000 40900000 40d00000";

fn case(line: &str) -> Case {
    line.parse().unwrap_or_else(|error| panic!("{line}: {error}"))
}

fn output(case: &Case) -> Tessellation {
    case.patch().tessellate()
}

fn any_order() -> Strength {
    Strength { order: ListOrder::Any, ..Strength::default() }
}

/// The same mesh with its points reversed, its triangles reversed and each triangle turned.
fn shuffled(tessellation: &Tessellation) -> Tessellation {
    let last = u32::try_from(tessellation.points.len()).expect("small") - 1;
    let mut points = tessellation.points.clone();
    points.reverse();
    let triangles = tessellation.indices.chunks(3).rev();
    let indices = triangles.flat_map(|t| [last - t[1], last - t[2], last - t[0]]).collect();
    Tessellation { points, indices }
}

#[test]
fn every_strength_accepts_the_model() {
    let case = case(QUAD);
    for order in [ListOrder::Exact, ListOrder::Any] {
        for elements in [Elements::Primitives, Elements::Points] {
            let strength = Strength { order, elements, ..Strength::default() };
            assert!(strength.accepts(&case, &output(&case)), "{strength:?}");
        }
    }
}

#[test]
fn order_is_free_only_where_asked() {
    let case = case(QUAD);
    let shuffled = shuffled(&output(&case));
    assert!(!Strength::default().accepts(&case, &shuffled), "the sequence differs");
    assert!(any_order().accepts(&case, &shuffled), "the mesh is the same");
}

#[test]
fn free_order_still_sees_faults() {
    let case = case(QUAD);
    let good = output(&case);
    let mut flipped = good.clone();
    flipped.indices.swap(4, 5);
    assert!(!any_order().accepts(&case, &flipped), "a triangle's orientation");
    let mut moved = good.clone();
    moved.points[9] = DomainPoint::from_bits(moved.points[9].u.to_bits() ^ 1, 0);
    assert!(!any_order().accepts(&case, &moved), "a point's place");
    let mut short = good.clone();
    short.indices.truncate(short.indices.len() - 3);
    assert!(!any_order().accepts(&case, &short), "a triangle less");
    let mut twice = good.clone();
    twice.indices.extend_from_slice(&good.indices[..3]);
    assert!(!any_order().accepts(&case, &twice), "a triangle more");
    let mut outside = good;
    outside.indices[0] = 9999;
    assert!(!any_order().accepts(&case, &outside), "an index out of range");
}

#[test]
fn points_alone() {
    let case = case(QUAD);
    let strength = Strength { elements: Elements::Points, ..any_order() };
    let mut other = shuffled(&output(&case));
    other.indices.clear();
    other.points.push(other.points[0]);
    assert!(strength.accepts(&case, &other), "indices and repetitions do not count");
    let mut fewer = other.clone();
    let gone = fewer.points[3];
    fewer.points.retain(|point| *point != gone);
    assert!(!strength.accepts(&case, &fewer), "a point less");
    other.points[3] = DomainPoint::from_bits(1, 2);
    assert!(!strength.accepts(&case, &other), "a point's place does");
}

/// Without indices, in the model's order.
#[test]
fn points_alone_in_order() {
    let case = case(QUAD);
    for order in [ListOrder::Exact, ListOrder::Sequence] {
        let strength = Strength { order, elements: Elements::Points, ..Strength::default() };
        let good = Tessellation { indices: Vec::new(), ..output(&case) };
        assert!(strength.accepts(&case, &good), "{order:?}: indices do not count");
        let mut reversed = good.clone();
        reversed.points.reverse();
        assert!(!strength.accepts(&case, &reversed), "{order:?}: the order does");
        let mut longer = good;
        longer.points.push(longer.points[0]);
        assert!(!strength.accepts(&case, &longer), "{order:?}: a repetition does");
    }
}

/// A sequence must have as many primitives as the model's.
#[test]
fn a_sequence_has_its_length() {
    let case = case(QUAD);
    let strength = Strength { order: ListOrder::Sequence, ..Strength::default() };
    let good = output(&case);
    let mut longer = good.clone();
    longer.indices.extend_from_slice(&good.indices[..3]);
    assert!(!strength.accepts(&case, &longer), "a triangle more");
    let mut shorter = good;
    shorter.indices.truncate(shorter.indices.len() - 3);
    assert!(!strength.accepts(&case, &shorter), "a triangle less");
}

/// The factor 3 + 2^-17 is halfway between 0x30000 and 0x30001.
#[test]
fn both_neighbours_of_a_tie_are_legal_where_asked() {
    let tie = case(&QUAD.replace("40600000", "40400020"));
    let upper = case(&QUAD.replace("40600000", "40400040"));
    assert_ne!(output(&tie), output(&upper), "the neighbours place points differently");
    let lenient = Strength { conversion: Conversion::Within06Ulp, ..Strength::default() };
    assert!(lenient.accepts(&tie, &output(&upper)), "the upper neighbour");
    assert!(lenient.accepts(&tie, &output(&tie)), "the nearest");
    assert!(!Strength::default().accepts(&tie, &output(&upper)), "the exact model rounds down");
    let beyond = case(&QUAD.replace("40600000", "40400400"));
    assert!(!lenient.accepts(&tie, &output(&beyond)), "sixteen units away");
    let nearer_the_upper = case(&QUAD.replace("40600000", "40400023"));
    let lower = case(&QUAD.replace("40600000", "40400000"));
    assert!(lenient.accepts(&nearer_the_upper, &output(&lower)), "0.547 of a unit away");
}

/// If two values lie between numbers, either may be converted to the neighbour without the other.
#[test]
fn each_value_has_a_neighbour_of_its_own() {
    let with = |u0: &str, v0: &str| case(&QUAD.replace("40600000", u0).replace("40200000", v0));
    let [lower, tie, upper] = ["40400000", "40400020", "40400040"];
    let [other_lower, other_tie, other_upper] = ["40a00000", "40a00010", "40a00020"];
    let lenient = Strength { conversion: Conversion::Within06Ulp, ..Strength::default() };
    let mut seen = Vec::new();
    for u0 in [lower, upper] {
        for v0 in [other_lower, other_upper] {
            let output = output(&with(u0, v0));
            assert!(lenient.accepts(&with(tie, other_tie), &output), "{u0} {v0}");
            assert!(!seen.contains(&output), "{u0} {v0} place points differently");
            seen.push(output);
        }
    }
}

/// Everything that is accepted as the model's sequence is accepted in any order: points that the
/// model lacks, points of a culled patch, and points that no primitive uses are wrong in both.
#[test]
fn a_sequence_is_never_weaker_than_any_order() {
    let sequence = Strength { order: ListOrder::Sequence, ..Strength::default() };
    let [quad, culled] = [case(QUAD), case(&QUAD.replace("40600000", "00000000"))];
    let changes: [fn(&mut Tessellation); 6] = [
        |_| {},
        |output| output.points.push(DomainPoint::from_bits(1, 2)),
        |output| output.points.push(DomainPoint::from_bits(0, 0)),
        |output| output.points.push(DomainPoint::from_bits(u32::MAX, 0)),
        |output| _ = output.points.pop(),
        |output| output.points.reverse(),
    ];
    for case in [quad, culled] {
        for (number, change) in changes.iter().enumerate() {
            let mut observed = output(&case);
            change(&mut observed);
            let accepted =
                [sequence, any_order()].map(|strength| strength.accepts(&case, &observed));
            assert!(!accepted[0] || accepted[1], "change {number}: {case}");
            let is_planted = number > 0 && observed != output(&case);
            assert_eq!(accepted[0], !is_planted, "change {number}: {case}");
        }
    }
}

/// Where points are the primitives, a point that is drawn twice is wrong in any order.
#[test]
fn a_point_is_drawn_once() {
    let case = case(&QUAD.replace("triangle_cw", "point"));
    let mut twice = output(&case);
    twice.indices.push(5);
    assert!(!any_order().accepts(&case, &twice), "point 5 twice");
    let mut again = output(&case);
    again.indices[6] = 5;
    assert!(!any_order().accepts(&case, &again), "point 5 in place of point 6");
}

/// In each outer position, and in no inner one.
#[test]
fn denormals_are_flushed_in_every_outer_position() {
    let flush = Strength { denormals: Denormals::Flush, ..Strength::default() };
    for domain in tess_core::Domain::ALL {
        for position in 0..domain.factors() {
            let factor = |at| if at == position { f32::from_bits(1) } else { 3.0 };
            let config = case(QUAD).config;
            let case = Case { config, factors: tess_core::PatchFactors::from_fn(domain, factor) };
            let is_flushed = flush.accepts(&case, &Tessellation::default());
            assert_eq!(is_flushed, position < domain.outer_factors(), "{domain:?} {position}");
        }
    }
}

/// The case that a culled patch answers keeps its inside factors.
#[test]
fn outer_denormals_alone_become_zero() {
    let given = QUAD.replace("40600000", "00000001").replace("40d00000", "00000001");
    let flushed = flushed(&case(&given)).expect("the first factor is flushed");
    assert_eq!(flushed, case(&given.replacen("00000001", "00000000", 1)), "the last one is not");
}

#[test]
fn denormals_may_be_flushed_where_asked() {
    let case = case(&QUAD.replace("40600000", "00000001"));
    let culled = Tessellation::default();
    let flush = Strength { denormals: Denormals::Flush, ..Strength::default() };
    assert!(!Strength::default().accepts(&case, &culled), "greater than zero");
    assert!(flush.accepts(&case, &culled), "flushed");
    assert!(flush.accepts(&case, &output(&case)), "kept");
}

/// From 1 to 2 a binary32 has 128 steps per unit of 2^-16: 52 of them are 0.406 units, 51 are 0.398
/// units.
#[test]
fn both_neighbours_are_legal_from_four_tenths_on() {
    let with = |bits: u32| case(&QUAD.replace("40600000", &format!("{bits:08x}")));
    let fixed = |fixed: u32| DomainPoint::from_bits(fixed, 0).to_f32()[0].to_bits();
    let shows = |low: &u32| output(&with(fixed(*low))) != output(&with(fixed(low + 1)));
    let low = (0x1_4000..0x1_5000).find(shows).expect("a unit that shows");
    let lenient = Strength { conversion: Conversion::Within06Ulp, ..Strength::default() };
    let above = output(&with(fixed(low + 1)));
    let accepts = |steps: u32| lenient.accepts(&with(fixed(low) + steps), &above);
    assert_eq!([51, 52].map(accepts), [false, true], "0.4 of a unit");
}
