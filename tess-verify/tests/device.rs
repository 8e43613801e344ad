//! Tests of listings of a device under test: which differences are detected, and to which stage
//! they point.

use tess_core::{DomainPoint, Tessellation};
use tess_verify::check::{
    CheckError, Conversion, Denormals, Element, Elements, ListOrder, Report, SpecStage, Strength,
    Tested, check,
};
use tess_verify::vectors::{Listing, VectorFile};
use tess_verify::{Backend, Case, CoreBackend};

const TRIANGLE: &str =
    "case tri fractional_even triangle_ccw ruler 40733333 40a00000 40e66666 4119999a";

fn case(line: &str) -> Case {
    line.parse().unwrap_or_else(|error| panic!("{line}: {error}"))
}

/// Checks a device's output for `case`.
fn observe(case: Case, output: Tessellation, strength: Strength) -> Report {
    observe_all("device", &[(case, output)], strength, 1)
}

/// Checks the outputs of a device of this name on some threads.
fn observe_all(
    source: &str,
    outputs: &[(Case, Tessellation)],
    strength: Strength,
    threads: usize,
) -> Report {
    let listing = |(case, output): &(Case, Tessellation)| {
        Listing { line: 0, case: *case, output: output.clone() }.to_string()
    };
    let listings: String = outputs.iter().map(listing).collect();
    let count = outputs.len();
    let text = format!("# tess-vectors 1 kind=listings count={count} source={source}\n{listings}");
    let file = VectorFile::new("device", text.as_bytes()).expect("a header");
    let mut backends: Vec<Box<dyn Backend>> = Vec::new();
    backends.resize_with(threads, || Box::new(CoreBackend));
    check(file, &mut backends, Tested::Listings(strength), &|_| ()).expect("a verdict")
}

/// The stage to which a wrong output points.
fn stage(line: &str, output: Tessellation) -> SpecStage {
    let report = observe(case(line), output, Strength::default());
    assert_eq!((report.cases, report.mismatches), (1, 1), "the difference is seen");
    report.differences[0].mismatch.stage
}

fn right(line: &str) -> Tessellation {
    case(line).patch().tessellate()
}

#[test]
fn a_right_device_passes() {
    let report = observe(case(TRIANGLE), right(TRIANGLE), Strength::default());
    assert_eq!((report.cases, report.mismatches), (1, 0), "{report:?}");
}

/// A device that fails on every hundredth patch, whichever thread checks it, and a device that
/// fails once more often.
#[test]
fn differences_at_regular_distances_have_a_period() {
    let mut outputs = vec![(case(TRIANGLE), right(TRIANGLE)); 1000];
    (49..1000).step_by(100).for_each(|i| outputs[i].1.indices.rotate_left(3));
    for threads in [1, 3] {
        let report = observe_all("device", &outputs, Strength::default(), threads);
        assert_eq!((report.mismatches, report.period()), (10, Some(100)), "{threads} threads");
    }
    outputs[60].1.indices.rotate_left(3);
    let report = observe_all("device", &outputs, Strength::default(), 3);
    assert_eq!((report.mismatches, report.period()), (11, None), "one between");
    let report = observe_all("device", &outputs[..160], Strength::default(), 1);
    assert_eq!((report.mismatches, report.period()), (3, None), "50, 61 and 150");
    let report = observe_all("device", &outputs[100..300], Strength::default(), 1);
    assert_eq!((report.mismatches, report.period()), (2, None), "two are too few");
}

#[test]
fn stages_of_a_device_are_told_apart() {
    let changed = |change: fn(&mut Tessellation)| {
        let mut output = right(TRIANGLE);
        change(&mut output);
        output
    };
    let center = right(&TRIANGLE.replace("ruler", "center"));
    let mut reordered = center.clone();
    reordered.indices.rotate_left(3);
    let truncated = right(&TRIANGLE.replace("40733333", "40733300"));
    let moved = changed(|output| output.points[3] = DomainPoint::from_bits(0, 1));
    for (output, expected, what) in [
        (truncated, SpecStage::Factors, "converted by truncation"),
        (center, SpecStage::Context, "split in another order"),
        (reordered, SpecStage::Context, "and triangles in another order"),
        (moved, SpecStage::Location, "a point in the wrong place"),
        (changed(|output| output.points.swap(2, 9)), SpecStage::PointOrder, "another order"),
        (right(&TRIANGLE.replace("ccw", "cw")), SpecStage::Stitch, "the other winding"),
        (Tessellation::default(), SpecStage::Factors, "culled"),
        (changed(|output| output.indices.truncate(6)), SpecStage::Counts, "too few indices"),
    ] {
        assert_eq!(stage(TRIANGLE, output), expected, "{what}");
    }
}

#[test]
fn strength_applies_to_devices() {
    let mut turned = right(TRIANGLE);
    turned.indices[..3].rotate_left(1);
    let any = Strength { order: ListOrder::Any, ..Strength::default() };
    assert_eq!(observe(case(TRIANGLE), turned.clone(), any).mismatches, 0, "leading vertex");
    assert_eq!(observe(case(TRIANGLE), turned, Strength::default()).mismatches, 1, "exact order");

    let mut missing = right(TRIANGLE);
    let first = missing.indices[..3].to_vec();
    missing.indices[3..6].copy_from_slice(&first);
    let report = observe(case(TRIANGLE), missing, any);
    let shown = report.differences[0].mismatch.to_string();
    assert!(shown.starts_with("primitive ("), "{shown}");
    assert!(shown.contains(" times (but primitive ("), "the other one beside it: {shown}");

    let tie = TRIANGLE.replace("40733333", "40733320");
    let up = right(&TRIANGLE.replace("40733333", "40733340"));
    let lenient = Strength { conversion: Conversion::Within06Ulp, ..Strength::default() };
    assert_eq!(observe(case(&tie), up, lenient).mismatches, 0, "the other neighbour");
}

/// The model's sequence by coordinates: points may be numbered in any way, but primitives keep
/// their order.
#[test]
fn sequences_are_compared_by_coordinates() {
    let sequence = Strength { order: ListOrder::Sequence, ..Strength::default() };
    let right = right(TRIANGLE);
    let points = right.indices.iter().map(|&index| right.points[index as usize]).collect();
    let listed = Tessellation { points, indices: (0..).take(right.indices.len()).collect() };
    assert_eq!(observe(case(TRIANGLE), listed.clone(), sequence).mismatches, 0, "a point a vertex");

    let differs = |change: &dyn Fn(&mut Tessellation)| {
        let mut device = listed.clone();
        change(&mut device);
        observe(case(TRIANGLE), device, sequence).differences.remove(0).mismatch
    };
    let turned = differs(&|device| device.indices[3..6].rotate_left(1));
    assert!(turned.to_string().starts_with("index 0 of primitive 1: observed ("), "{turned}");
    assert_eq!(turned.stage, SpecStage::Stitch, "another leading vertex");
    let moved = differs(&|device| device.points[4] = DomainPoint::from_bits(0x123, 0x456));
    assert_eq!(moved.stage, SpecStage::Location, "a point that the model does not have");
    let lost = differs(&|device| device.indices.truncate(3));
    assert_eq!(lost.stage, SpecStage::Counts, "too few primitives");
    let nowhere = differs(&|device| device.indices[1] = 9999);
    assert!(nowhere.to_string().contains("no point"), "{nowhere}");
}

/// A device that has only points is told about a wrong point, not about the indices that it lacks.
#[test]
fn points_alone() {
    let strength = Strength { elements: Elements::Points, ..Strength::default() };
    let mut device = right(TRIANGLE);
    device.indices.clear();
    assert_eq!(observe(case(TRIANGLE), device.clone(), strength).mismatches, 0, "no indices");
    let v = device.points[3].v.to_bits();
    device.points[3] = DomainPoint::from_bits(0, v ^ 1);
    let report = observe(case(TRIANGLE), device.clone(), strength);
    let shown = report.differences[0].mismatch.to_string();
    assert!(shown.starts_with("point 3 v: observed"), "{shown}");
    device.points.pop();
    let report = observe(case(TRIANGLE), device, strength);
    assert_eq!(report.differences[0].mismatch.stage, SpecStage::Counts, "a point too few");
}

const ANY: Strength = Strength {
    order: ListOrder::Any,
    elements: Elements::Primitives,
    conversion: Conversion::Exact,
    denormals: Denormals::Keep,
};

/// The text of a report's only difference.
fn shown(report: &Report) -> String {
    assert_eq!(report.mismatches, 1, "{report:?}");
    report.differences[0].mismatch.to_string()
}

/// The name of a device has no effect: its listings are what is observed.
#[test]
fn devices_of_any_name_are_what_is_tested() {
    let mut wrong = right(TRIANGLE);
    wrong.indices[2] ^= 1;
    let expected = right(TRIANGLE).indices[2];
    for source in ["device", "tesseract-gpu", "tess-core", "d3d11-reference-like"] {
        let outputs = [(case(TRIANGLE), wrong.clone())];
        let shown = shown(&observe_all(source, &outputs, Strength::default(), 1));
        let both = format!("observed 0x{:x}, expected 0x{expected:x}", expected ^ 1);
        assert!(shown.contains(&both), "{source}: {shown}");
    }
}

/// Only listings can be the output of a device.
#[test]
fn other_kinds_cannot_be_tested() {
    let text = "# tess-vectors 1 kind=factors count=1 source=device\n\
                partitioning,exponent,outer_fnv1a64,inside_fnv1a64\n";
    let file = VectorFile::new("device", text.as_bytes()).expect("a header");
    let result = check(file, &mut [Box::new(CoreBackend)], Tested::Listings(ANY), &|_| ());
    assert!(matches!(result, Err(CheckError::NoListings(_))), "{result:?}");
}

/// Points that no primitive uses count as well: in any order, the places are a set in which each
/// occurs once.
#[test]
fn points_that_no_primitive_uses() {
    let with = |change: fn(&mut Vec<DomainPoint>)| {
        let mut output = right(TRIANGLE);
        change(&mut output.points);
        observe(case(TRIANGLE), output, ANY)
    };
    let junk = shown(&with(|points| points.push(DomainPoint::from_bits(1, 2))));
    assert!(junk.starts_with("point (00001, 00002): observed 1 times, expected 0"), "{junk}");
    let outside = shown(&with(|points| points.push(DomainPoint::from_bits(u32::MAX, 0))));
    assert!(outside.starts_with("point (ffffffff, 00000)"), "{outside}");
    let twice = shown(&with(|points| points.push(points[5])));
    assert!(twice.contains("observed 2 times, expected 1"), "{twice}");

    let culled = case(&TRIANGLE.replace("40733333", "00000000"));
    let points = vec![DomainPoint::from_bits(0, 0)];
    let report = observe(culled, Tessellation { points, indices: Vec::new() }, ANY);
    assert!(shown(&report).starts_with("point (00000, 00000)"), "{report:?}");
}

/// Just above 2, neighbouring points coincide (spec section 12), and may be merged (section 13).
#[test]
fn coinciding_points_may_be_merged() {
    let line = "case isoline fractional_even point ruler 3f800000 40000080";
    let all = right(line);
    let mut merged = all.clone();
    merged.points.dedup();
    assert!(merged.points.len() < all.points.len(), "some coincide: {all:?}");
    merged.indices.truncate(merged.points.len());
    assert_eq!(observe(case(line), all, ANY).mismatches, 0, "all of them");
    assert_eq!(observe(case(line), merged.clone(), ANY).mismatches, 0, "each place once");
    merged.points.pop();
    merged.indices.pop();
    assert_eq!(observe(case(line), merged, ANY).mismatches, 1, "a place less");
}

/// The stage is found with the same strength of comparison as the difference.
#[test]
fn stages_in_any_order() {
    let reversed = |output: &Tessellation| {
        let last = u32::try_from(output.points.len()).expect("small") - 1;
        Tessellation {
            points: output.points.iter().rev().copied().collect(),
            indices: output.indices.iter().map(|index| last - index).collect(),
        }
    };
    let mut moved = right(TRIANGLE);
    moved.points[9] = DomainPoint::from_bits(moved.points[9].u.to_bits() ^ 1, 0x4000);
    for (output, stage, what) in [
        (moved, SpecStage::Location, "a point in the wrong place"),
        (right(&TRIANGLE.replace("40733333", "40733300")), SpecStage::Factors, "truncation"),
        (right(&TRIANGLE.replace("ruler", "center")), SpecStage::Context, "another split order"),
        (right(&TRIANGLE.replace("ccw", "cw")), SpecStage::Stitch, "the other winding"),
    ] {
        let report = observe(case(TRIANGLE), reversed(&output), ANY);
        assert_eq!(report.mismatches, 1, "{what}");
        assert_eq!(report.differences[0].mismatch.stage, stage, "{what}");
    }
}

/// With `--points`, wrong indices do not explain a difference.
#[test]
fn stages_of_points_alone() {
    let mut truncated = right(&TRIANGLE.replace("40733333", "40733300"));
    truncated.indices.clear();
    let strength = Strength { elements: Elements::Points, ..Strength::default() };
    let report = observe(case(TRIANGLE), truncated, strength);
    assert_eq!(report.differences[0].mismatch.stage, SpecStage::Factors, "{report:?}");
}

const WITHIN_06_ULP: Strength = Strength { conversion: Conversion::Within06Ulp, ..ANY };
/// An edge factor of 3 + 2^-17: its fixed-point number is 0x30000 or 0x30001.
const TIE: &str = "case quad fractional_odd triangle_cw ruler \
                   40400020 40200000 40a00000 40500000 40900000 40d00000";

/// Two patches that share an edge cannot convert its factor in different ways.
#[test]
fn a_value_has_one_conversion_through_the_file() {
    let [low, high] = [right(TIE), right(&TIE.replace("40400020", "40400040"))];
    let other = "case tri fractional_odd line center 40a00000 40400020 40200000 40900000";
    let other_high = right(&other.replace("40400020", "40400040"));
    let (tie, other) = (case(TIE), case(other));
    for outputs in [
        vec![(tie, low.clone()), (other, right(&other.to_string()))],
        vec![(tie, high.clone()), (other, other_high.clone()), (tie, high.clone())],
    ] {
        let report = observe_all("device", &outputs, WITHIN_06_ULP, 1);
        assert_eq!(report.mismatches, 0, "one way throughout: {report:?}");
    }
    let mut outputs = vec![(tie, low); 600];
    outputs[400] = (other, other_high);
    outputs[500] = (tie, high);
    for threads in [1, 3] {
        let report = observe_all("device", &outputs, WITHIN_06_ULP, threads);
        assert_eq!((report.cases, report.mismatches), (600, 2), "{threads} threads");
        let first = &report.differences[0];
        assert_eq!((first.number, first.mismatch.stage), (401, SpecStage::Factors), "{first}");
        assert_eq!(
            first.mismatch.to_string(),
            "fixed-point number of factor 0x40400020: observed 0x030001, expected 0x030000, as \
             in record 1 (stage: factors)"
        );
    }
}

/// The first record whose output shows how a value was converted decides, whichever number it
/// shows.
#[test]
fn the_first_record_decides_which_conversion() {
    let [low, high] = [right(TIE), right(&TIE.replace("40400020", "40400040"))];
    let expected = [("0x030000", "0x030001"), ("0x030001", "0x030000")];
    let orders = [[low.clone(), high.clone()], [high, low]];
    for ([first, second], (known, other)) in orders.into_iter().zip(expected) {
        let outputs = [(case(TIE), first.clone()), (case(TIE), first), (case(TIE), second)];
        let report = observe_all("device", &outputs, WITHIN_06_ULP, 1);
        let message =
            format!("observed {other}, expected {known}, as in record 1 (stage: factors)");
        assert!(shown(&report).ends_with(&message), "{report:?}");
        assert_eq!(report.differences[0].number, 3, "the third differs");
    }
}

/// A record whose output is the same with either number tells nothing about the value's conversion.
#[test]
fn a_value_that_does_not_show_is_not_decided() {
    // The two split orders move different points, so that their locations round differently at
    // different values.
    let shows = "case isoline fractional_even point ruler 3f800000 VALUE";
    let at = |line: &str, fixed: u32| {
        let bits = DomainPoint::from_bits(fixed, 0).to_f32()[0].to_bits();
        line.replace("VALUE", &format!("{bits:08x}"))
    };
    let hides = shows.replace("ruler", "center");
    let value = (0xA_0001..0xB_0000)
        .find(|&low| {
            let same = right(&at(&hides, low)) == right(&at(&hides, low + 1));
            same && right(&at(shows, low)) != right(&at(shows, low + 1))
        })
        .expect("a value that shows here and not there");
    let tie = |line: &str| {
        let [low, high] =
            [value, value + 1].map(|fixed| DomainPoint::from_bits(fixed, 0).to_f32()[0].to_bits());
        let bits = u32::midpoint(low, high);
        case(&line.replace("VALUE", &format!("{bits:08x}")))
    };
    let outputs = [
        (tie(&hides), right(&at(&hides, value))),
        (tie(shows), right(&at(shows, value + 1))),
        (tie(shows), right(&at(shows, value))),
    ];
    let report = observe_all("device", &outputs, WITHIN_06_ULP, 1);
    assert!(shown(&report).contains(", as in record 2 "), "{report:?}");
    for choice in [value, value + 1] {
        let outputs =
            [(tie(&hides), right(&at(&hides, value))), (tie(shows), right(&at(shows, choice)))];
        assert_eq!(observe_all("device", &outputs, WITHIN_06_ULP, 1).mismatches, 0, "either");
    }
}

/// A factor that is wrong by a unit in the last place or by one, in each position and each
/// direction, and a patch that is culled point to the factors; the other split order points to the
/// context.
#[test]
fn the_stage_of_a_wrong_factor() {
    let quad =
        "case quad fractional_odd line ruler 40600000 40200000 40a00000 40500000 40900000 40d00000";
    for line in [TRIANGLE, quad] {
        let right_case = case(line);
        let patch = right_case.patch();
        let processed = patch.processed().factors().expect("not culled");
        let fixed: Vec<u32> = processed.iter().map(|factor| factor.fixed.to_bits()).collect();
        for (position, &fixed) in fixed.iter().enumerate() {
            for other in [fixed - 1, fixed + 1, fixed - 0x1_0000, fixed + 0x1_0000] {
                let mut words: Vec<String> = line.split_whitespace().map(str::to_owned).collect();
                let bits = DomainPoint::from_bits(other, 0).to_f32()[0].to_bits();
                words[5 + position] = format!("{bits:08x}");
                let output = right(&words.join(" "));
                let is_seen = output != patch.tessellate();
                assert!(is_seen || fixed.abs_diff(other) == 1, "{words:?}");
                if is_seen {
                    assert_eq!(stage(line, output), SpecStage::Factors, "{words:?}");
                }
            }
        }
        assert_eq!(stage(line, Tessellation::default()), SpecStage::Factors, "culled");
        let center = right(&line.replace("ruler", "center"));
        assert_eq!(stage(line, center), SpecStage::Context, "the other split order");
    }
}

/// Two edges of one patch cannot convert one value in different ways either.
#[test]
fn a_value_has_one_conversion_in_a_patch() {
    let both = TIE.replace("40a00000", "40400020");
    let one = right(&both.replacen("40400020", "40400040", 1));
    assert_eq!(observe(case(&both), one, WITHIN_06_ULP).mismatches, 1, "two ways");
    let all = right(&both.replace("40400020", "40400040"));
    assert_eq!(observe(case(&both), all, WITHIN_06_ULP).mismatches, 0, "one way");
}

/// The same holds in any order: the first difference is the moved point, not one of the points that
/// the other conversion moves.
#[test]
fn differences_beside_a_legal_conversion_in_any_order() {
    let bits = |fixed| DomainPoint::from_bits(fixed, 0).to_f32()[0].to_bits();
    let at = |bits: u32| format!("case isoline fractional_even point ruler 3f800000 {bits:08x}");
    let low = (0xA_0001..0xB_0000)
        .find(|&low| {
            let [one, other] = [low, low + 1].map(|fixed| right(&at(bits(fixed))).points);
            // Points before the last one distinguish the two conversions.
            one.iter().zip(&other).filter(|(one, other)| one != other).count() > 2
        })
        .expect("a value that shows");
    let tie = at(u32::midpoint(bits(low), bits(low + 1)));
    for fixed in [low, low + 1] {
        let mut wrong = right(&at(bits(fixed)));
        *wrong.points.last_mut().expect("points") = DomainPoint::from_bits(0xFFFE, 0);
        let report = observe(case(&tie), wrong, WITHIN_06_ULP);
        let element = &report.differences[0].mismatch.element;
        let expected = Element::Vertices(vec![[0xFFFE, 0]]);
        assert_eq!(*element, expected, "{fixed:x} of {tie}: {report:?}");
    }
}

/// Faults are found by comparison with the conversion that the device uses.
#[test]
fn differences_beside_a_legal_conversion() {
    let mut wrong = right(&TIE.replace("40400020", "40400040"));
    let last = wrong.points.len() - 1;
    wrong.points[last] = DomainPoint::from_bits(3, 4);
    let strength = Strength { order: ListOrder::Exact, ..WITHIN_06_ULP };
    let shown = shown(&observe(case(TIE), wrong, strength));
    assert!(shown.starts_with(&format!("point {last} u: observed 0x00003")), "{shown}");
}
