//! Tests of captures: vertices by coordinates, files without a count, the cases that were asked,
//! and outputs that are mirrored or turned as a whole.

use std::fmt::Write;
use tess_core::fixed_point::ONE;
use tess_core::{Domain, DomainPoint, OutputPrimitive, Tessellation};
use tess_verify::check::{
    CheckError, Checked, Elements, Explanation, Known, ListOrder, Report, Strength, Tested, check,
    check_asked, vertices,
};
use tess_verify::generate::{GenLevel, Selection};
use tess_verify::vectors::{Cases, Coordinates, Listing, Record, VectorFile};
use tess_verify::{Backend, Case, CoreBackend};

const ANY: Strength = strength(ListOrder::Any);
const SEQUENCE: Strength = strength(ListOrder::Sequence);
const EXACT: Strength = strength(ListOrder::Exact);
const TRI: &str = "case tri fractional_odd triangle_cw ruler 40200000 40400000 40600000 40200000";
const QUAD: &str = "case quad integer triangle_cw ruler \
                    40400000 40400000 40400000 40400000 40400000 40400000";
const HEADER: &str = "# tess-vectors 1 kind=listings source=capture\n";

const fn strength(order: ListOrder) -> Strength {
    use tess_verify::check::{Conversion, Denormals};
    let (conversion, denormals) = (Conversion::Exact, Denormals::Keep);
    Strength { order, elements: Elements::Primitives, conversion, denormals }
}

fn run(text: &str, strength: Strength) -> Result<Report, CheckError> {
    run_tested(text, Tested::Listings(strength))
}

fn run_tested(text: &str, tested: Tested) -> Result<Report, CheckError> {
    let file = VectorFile::new("capture", text.as_bytes())?;
    check(file, &mut [Box::new(CoreBackend)], tested, &|_| ())
}

/// The mistake that explains every difference, if there is one. The freedoms that the specification
/// leaves to a device are not mistakes.
fn turn(report: &Report) -> Option<String> {
    report.mistake().map(Explanation::words)
}

/// A file of these records, with a mark at its end.
fn file(records: &str) -> String {
    format!("{HEADER}{records}# end\n")
}

fn verdict(records: &str, strength: Strength) -> Report {
    run(&file(records), strength).expect("a verdict")
}

fn error(text: &str) -> String {
    run(text, ANY).expect_err("refused").to_string()
}

/// The coordinates of an output's vertices.
fn places(output: &Tessellation) -> Vec<[u32; 2]> {
    vertices(output).flatten().map(|p| [p.u.to_bits(), p.v.to_bits()]).collect()
}

/// The model's record of a case by coordinates, each number written by `show`.
fn record(line: &str, notation: &str, show: impl Fn(u32) -> String) -> String {
    let case: Case = line.parse().expect("a case");
    let mut text = format!("{line}\ncoordinates {notation}\n");
    for [u, v] in places(&case.patch().tessellate()) {
        writeln!(text, "{} {}", show(u), show(v)).expect("written");
    }
    text + "end\n"
}

/// A record as it is read back.
fn coordinates(record: &str) -> Coordinates {
    let text = file(record);
    let record = VectorFile::new("capture", text.as_bytes()).expect("a header").next();
    let Some(Ok(Record::Coordinates(coordinates))) = record else { panic!("{record:?}") };
    coordinates
}

fn hex(number: u32) -> String {
    format!("{number:05x}")
}

fn float(number: u32) -> f32 {
    f32::from_bits(number_bits(number))
}

/// The binary32 of a 16.16 number.
fn number_bits(number: u32) -> u32 {
    tess_core::fixed_point::coordinate_to_f32(DomainPoint::from_bits(number, 0).u).to_bits()
}

/// A record is written as it was read, with third coordinates or without.
#[test]
fn records_are_written_as_they_are_read() {
    let right = record(TRI, "hex", hex);
    let is_vertex = |line: &str| line.len() == "00000 00000".len();
    let third = |line: &str| if is_vertex(line) { " 10000\n" } else { "\n" };
    let with_third: String = right.lines().map(|line| line.to_owned() + third(line)).collect();
    for text in [right, with_third] {
        let vertices = text.lines().count() - 3;
        let coordinates = coordinates(&text);
        let announced = format!("coordinates hex {vertices}\n");
        assert_eq!(coordinates.to_string(), text.replace("coordinates hex\n", &announced));
    }
}

/// A correct capture tests a backend: one changed coordinate is one difference.
#[test]
fn captures_test_a_backend() {
    let check_backend =
        |records: &str| run_tested(&file(records), Tested::Backend).expect("a verdict");
    let right = record(TRI, "hex", hex);
    assert_eq!(check_backend(&right).mismatches, 0, "the model's");
    let report = check_backend(&right.replacen("10000", "10001", 1));
    assert_eq!((report.cases, report.mismatches), (1, 1), "{report}");
}

#[test]
fn each_notation_is_the_models_sequence() {
    for line in
        [TRI, QUAD, &TRI.replace("triangle_cw", "line"), &QUAD.replace("triangle_cw", "point")]
    {
        let texts = [
            record(line, "hex", hex),
            record(line, "decimal", |number| number.to_string()),
            record(line, "float", |number| format!("{:.9}", float(number))),
            record(line, "float", |number| format!("0x{:08x}", number_bits(number))),
        ];
        for text in texts {
            for strength in [EXACT, SEQUENCE, ANY] {
                let report = verdict(&text, strength);
                assert_eq!((report.cases, report.mismatches), (1, 0), "{text}{report:?}");
            }
        }
    }
}

#[test]
fn another_order_and_a_moved_vertex_are_seen() {
    let right = record(TRI, "hex", hex);
    let lines: Vec<&str> = right.lines().collect();
    let mut swapped = lines.clone();
    swapped.swap(2, 3);
    swapped.swap(3, 4); // another leading vertex
    let swapped = swapped.join("\n") + "\n";
    assert_ne!(swapped, right, "a fault is planted");
    assert_eq!(verdict(&swapped, ANY).mismatches, 0, "any order");
    let report = verdict(&swapped, SEQUENCE);
    assert_eq!(report.mismatches, 1, "the model's order");
    let shown = report.differences[0].to_string();
    assert!(shown.contains("index 0 of primitive 0: observed ("), "{shown}");
    let moved = right.replacen("\n10000 00000", "\n10000 00001", 1);
    assert_ne!(moved, right, "a fault is planted");
    for strength in [EXACT, SEQUENCE, ANY] {
        assert_eq!(verdict(&moved, strength).mismatches, 1, "{strength:?}");
    }
    let [a, b, c] = [2, 3, 4].map(|number| format!("{}\n", lines[number]));
    let lost = right.replacen(&(a + &b + &c), "", 1);
    assert_eq!(verdict(&lost, ANY).mismatches, 1, "a lost primitive");
}

/// A list with three vertices per triangle, for the largest patch: 24576 points.
#[test]
fn listings_without_an_index_buffer() {
    let line = QUAD.replace("40400000", "42800000");
    let case: Case = line.parse().expect("a case");
    let points: Vec<DomainPoint> = vertices(&case.patch().tessellate()).flatten().collect();
    assert_eq!(points.len(), 24576, "the largest patch");
    let output = Tessellation { indices: (0..).take(points.len()).collect(), points };
    let listing = Listing { line: 0, case, output };
    assert_eq!(verdict(&listing.to_string(), ANY).mismatches, 0, "the same triangles");
}

/// Either all vertices of a record have a third coordinate or none does, so a wrong one cannot be
/// left out.
#[test]
fn third_coordinates_stand_everywhere_or_nowhere() {
    for rows in ["0 1 0\n0 0\n1 0 0\n", "0 1\n0 0\n1 0 0\n"] {
        let error = error(&file(&format!("{TRI}\ncoordinates float\n{rows}end\n")));
        assert!(error.contains("all vertices have a third coordinate, or none has"), "{error}");
    }
}

/// Points get the model's numbers: the model's sequence becomes its listing, and anything that
/// differs is visible.
#[test]
fn coordinates_with_the_models_numbers() {
    let listing = |text: &str| coordinates(text).numbered();
    // Just above 2, points coincide.
    let coinciding = "case isoline fractional_even line ruler 3f800000 40000080";
    for line in [TRI, QUAD, coinciding] {
        let case: Case = line.parse().expect("a case");
        assert_eq!(listing(&record(line, "hex", hex)).output, case.patch().tessellate(), "{line}");
    }
    let moved = listing(&record(TRI, "hex", hex).replacen("\n10000 00000", "\n10000 00001", 1));
    let model = moved.case.patch().tessellate();
    assert_eq!(moved.output.points.len(), model.points.len() + 1, "a place more");
    let differing = moved.output.indices.iter().zip(&model.indices).filter(|(a, b)| a != b).count();
    assert_eq!(differing, 1, "one vertex is another point");
}

#[test]
fn third_coordinates_are_compared() {
    let with_third = |third: fn(u32, u32) -> u32, line| {
        let mut text = String::new();
        for row in record(line, "hex", hex).lines() {
            let numbers: Vec<_> =
                row.split(' ').filter_map(|word| u32::from_str_radix(word, 16).ok()).collect();
            match numbers[..] {
                [u, v] if row.len() == 11 => {
                    writeln!(text, "{row} {:05x}", third(u, v)).expect("written");
                }
                _ => writeln!(text, "{row}").expect("written"),
            }
        }
        verdict(&text, SEQUENCE)
    };
    assert_eq!(with_third(|u, v| ONE - u - v, TRI).mismatches, 0, "1 - u - v");
    assert_eq!(with_third(|_, _| 0, QUAD).mismatches, 0, "0");
    let report = with_third(|u, v| (ONE - u - v) ^ u32::from(u == 0 && v == ONE), TRI);
    assert_eq!(report.mismatches, 1, "one is wrong");
    let shown = report.differences[0].mismatch.to_string();
    assert!(shown.contains("third coordinate of vertex"), "{shown}");
    assert!(shown.contains("observed 0x00001, expected 0x00000"), "{shown}");
    assert_eq!(with_third(|_, _| 1, QUAD).mismatches, 1, "1 on a quad");
}

#[test]
fn numbers_that_mean_something_else_are_refused() {
    for (line, rows, expected) in [
        (
            "coordinates hex",
            "0 1\n",
            "capture:4: coordinates: `0 1` is not u, v and perhaps w: 5 to 8",
        ),
        ("coordinates float", "0.1 1\n", "`0.1 1` is not u, v and perhaps w: multiples of 2^-16"),
        ("coordinates float", "0 1.5\n", "multiples of 2^-16 from 0 to 1"),
        ("coordinates float", "0 nan\n", "multiples of 2^-16 from 0 to 1"),
        ("coordinates float", "1e-50 1\n", "`1e-50 1` is not u, v and perhaps w: multiples"),
        ("coordinates float", "0 0.999999999\n", "`0 0.999999999` is not u, v and perhaps w"),
        ("coordinates decimal", "0.5 1\n", "`0.5 1` is not u, v and perhaps w: whole numbers"),
        ("coordinates decimal", "0 1\n1 0\n0 0\n", "no coordinate is above 1"),
        ("coordinates", "", "unknown notation ``, expected one of: hex, decimal, float"),
        ("coordinates hex 2 3", "", "`3` is one word too many"),
        ("coordinates hex 99999", "", "99999 is too many: a patch has at most 24576"),
        ("coordinates hex 24577", "", "24577 is too many: a patch has at most 24576"),
        ("coordinates hex 24576", "", "24576 vertices are announced, but there are 0"),
        (
            "coordinates hex",
            &"00000 00000\n".repeat(24_577),
            "24577 is too many: a patch has at most 24576",
        ),
        (
            "coordinates hex 4",
            "00000 00000\n00000 00000\n00000 00000\n",
            "4 vertices are announced",
        ),
        ("coordinates hex 1", "00000 00000\n00000 00000\n", "a listing ends with `end`"),
        ("coordinates hex", "00000 00000\n", "1 is not a multiple of 3"),
        ("points 1", "0 1\n", "`0 1` is not a point: u and v as 5 to 8 hex digits each"),
    ] {
        let error = error(&file(&format!("{TRI}\n{line}\n{rows}end\n")));
        assert!(error.contains(expected), "{line} {rows:?}: {error}");
    }
    let points = Strength { elements: Elements::Points, ..SEQUENCE };
    let file = file(&record(TRI, "hex", hex));
    let refused = run(&file, points).expect_err("no order of points").to_string();
    assert!(
        refused.starts_with("capture:2: coordinates: vertices by coordinates do not"),
        "{refused}"
    );
    let points = Strength { elements: Elements::Points, ..ANY };
    assert_eq!(run(&file, points).map(|report| report.mismatches).ok(), Some(0), "in any order");
}

#[test]
fn a_file_without_a_count_marks_its_end() {
    let record = record(QUAD, "hex", hex);
    let cut = error(&format!("{HEADER}{record}"));
    assert!(cut.contains("the last line must be `# end`, but the file ends after 1"), "{cut}");
    let more = error(&format!("{HEADER}{record}# end\n{record}"));
    assert!(more.contains("`# end` marks the end, but the file goes on"), "{more}");
    let none = error(&format!("{HEADER}# end\n"));
    assert!(none.contains("a file without records shows nothing"), "{none}");
    let both = HEADER.replace("source", "count=1 source");
    assert!(run(&format!("{both}{record}# end\n"), ANY).is_ok(), "a count and the mark");
    let short = HEADER.replace("source", "count=2 source");
    let error = error(&format!("{short}{record}# end\n"));
    assert!(error.contains("case: a case is"), "the mark comes too early: {error}");
}

/// The report on records, and for each record whether it is wrong for the case that it states.
fn asked(asked: &str, records: &str) -> Result<(Report, Vec<bool>), CheckError> {
    let text = file(records);
    let file = VectorFile::new("capture", text.as_bytes())?;
    let mut cases = Cases::new("asked", asked.as_bytes())?;
    let mut one: [Box<dyn Backend>; 1] = [Box::new(CoreBackend)];
    let seen = std::sync::Mutex::new(Vec::new());
    let see = |checked: Checked<'_>| seen.lock().expect("no panic").extend(checked.different);
    let (known, tested) = (Known::default(), Tested::Listings(ANY));
    let report = check_asked(file, Some(&mut cases), &known, &mut one, tested, &see)?;
    Ok((report, seen.into_inner().expect("no panic")))
}

#[test]
fn what_was_asked_must_be_answered() {
    let [tri, quad] = [TRI, QUAD].map(|line| record(line, "hex", hex));
    let cases = format!("# two\n{TRI}\n\n{QUAD}\n");
    let mismatches = |records: &str| asked(&cases, records).expect("a verdict").0.mismatches;
    assert_eq!(mismatches(&format!("{tri}{quad}")), 0, "both");
    assert_eq!(mismatches(&format!("{tri}{tri}")), 1, "the easy one twice");
    assert_eq!(mismatches(&tri), 1, "one is missing");
    assert_eq!(mismatches(&format!("{tri}{quad}{quad}")), 1, "one too many");
    assert_eq!(mismatches(&format!("{quad}{tri}")), 2, "exchanged");
    let wrong = tri.replacen("\n10000 00000", "\n10000 00001", 1);
    let (_, different) = asked(&cases, &format!("{tri}{wrong}{wrong}")).expect("a verdict");
    assert_eq!(different, [false, true, true], "what answers another case is compared, too");
    let (report, _) = asked(&cases, &format!("{tri}{tri}")).expect("a verdict");
    let shown = report.differences[0].to_string();
    assert!(shown.starts_with("record 2 (line "), "{shown}");
    assert!(shown.contains(&format!("observed {TRI}, expected {QUAD}")), "{shown}");
    let recorded = format!("{}{tri}{quad}", HEADER.replace("source", "count=2 source"));
    let (report, _) = asked(&recorded, &format!("{tri}{quad}")).expect("a verdict");
    assert_eq!(report.mismatches, 0, "cases of a vector file");
    let error = |asked_for: &str| asked(asked_for, &tri).expect_err("refused").to_string();
    assert_eq!(error("# none\n"), "asked:2: case: there is no case");
    assert!(error("case tri\n").starts_with("asked:1: case: a case is"), "{}", error("case tri\n"));
}

/// An answer with more indices than a patch can have does not hide the differences before it,
/// whether answers are in step or not.
#[test]
fn what_differs_before_a_malformed_answer_is_reported() {
    let [tri, quad] = [TRI, QUAD].map(|line| record(line, "hex", hex));
    let wrong = tri.replacen("\n10000 00000", "\n10000 00001", 1);
    let overlong = format!("{QUAD}\npoints 3\n{}indices 24579\n", "00000 00000\n".repeat(3));
    let before = |error: CheckError| match error {
        CheckError::Malformed { error, before } => {
            let error = error.to_string();
            assert!(
                error.contains(", from line ") && error.ends_with(&format!(": {QUAD})")),
                "{error}"
            );
            (before.cases, before.mismatches)
        }
        other => panic!("{other}"),
    };
    let alone = run(&file(&format!("{tri}{wrong}{overlong}{wrong}")), ANY).expect_err("malformed");
    assert_eq!(before(alone), (2, 1), "what follows is not read");
    let first = run(&file(&overlong), ANY).expect_err("malformed");
    assert!(matches!(first, CheckError::Vectors(_)), "nothing was checked");
    let cases = format!("{TRI}\n{QUAD}\n{TRI}\n{QUAD}\n{TRI}\n{QUAD}\n");
    let answers = |records: &str| before(asked(&cases, records).expect_err("malformed"));
    assert_eq!(answers(&format!("{tri}{quad}{overlong}")), (2, 0), "in step");
    assert_eq!(answers(&format!("{tri}{quad}{wrong}{overlong}")), (3, 1), "in step, and wrong");
    assert_eq!(answers(&format!("{tri}{tri}{quad}{overlong}")), (4, 1), "the second is missing");
}

/// Outputs of many cases, each changed by `change`.
fn turned(strength: Strength, change: impl Fn(&Case) -> Tessellation) -> Report {
    let cases: Vec<Case> = Selection { random: Some(300), ..Selection::level(GenLevel::Three, 1) }
        .cases()
        .filter(|case| case.config.output == OutputPrimitive::TriangleCw)
        .collect();
    let listing = |case: &Case| Listing { line: 0, case: *case, output: change(case) }.to_string();
    verdict(&cases.iter().map(listing).collect::<String>(), strength)
}

fn with_points(case: &Case, change: fn([u32; 2]) -> [u32; 2]) -> Tessellation {
    let Tessellation { points, indices } = case.patch().tessellate();
    let place = |point: DomainPoint| {
        let [u, v] = change([point.u.to_bits(), point.v.to_bits()]);
        DomainPoint::from_bits(u, v)
    };
    Tessellation { points: points.into_iter().map(place).collect(), indices }
}

#[test]
fn one_mistake_that_explains_everything_is_named() {
    let reversed = |case: &Case| {
        let mut output = case.patch().tessellate();
        if case.domain() != Domain::Isoline {
            output.indices.chunks_mut(3).for_each(|triangle| triangle.swap(1, 2));
        }
        output
    };
    let report = turned(ANY, reversed);
    assert!(report.mismatches > 30, "{report}");
    assert_eq!(turn(&report).as_deref(), Some("every triangle turns the other way"));
    // Points keep their numbers and triangles their vertices, so the picture is mirrored and its
    // order is kept.
    for strength in [EXACT, SEQUENCE, ANY] {
        let transposed = |case: &Case| with_points(case, |[u, v]| [v, u]);
        let report = turned(strength, transposed);
        assert!(report.mismatches > 30, "{report}");
        let kept = "u and v are exchanged: order of vertices kept";
        assert_eq!(turn(&report).as_deref(), Some(kept), "{strength:?}");
    }
}

#[test]
fn one_other_difference_and_no_mistake_explains_everything() {
    let report = turned(ANY, |case| {
        let mut output = with_points(case, |[u, v]| [v, u]);
        if case.domain() == Domain::Isoline {
            output.points.truncate(1);
        }
        output
    });
    assert!(report.mismatches > 30, "{report}");
    assert_eq!(turn(&report), None, "not all");
    assert_eq!(turn(&turned(ANY, |case| case.patch().tessellate())), None, "nothing differs");
}
