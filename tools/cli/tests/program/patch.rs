//! Tests of `tess patch`: its formats, its errors and where its output goes.

use crate::support::{directory, tess};
use serde_json::Value;
use std::fs;
use tess_verify::vectors::{Record, VectorFile};

const CASES: &str = include_str!("../../../../golden/cases.txt");

/// Every listing of golden/cases.txt is printed by the command for its case.
#[test]
fn golden_cases_are_reproduced() {
    let file = VectorFile::new("cases.txt", CASES.as_bytes()).expect("a vector file");
    let mut compared = 0;
    for record in file {
        let Record::Listing(listing) = record.expect("a listing") else { panic!("listings alone") };
        let command = listing.case.command();
        let run = tess(command.strip_prefix("tess ").expect("starts with the program"));
        run.exits(0);
        let expected = listing.to_string();
        let (header, text) = run.stdout.split_once('\n').expect("a header line");
        assert_eq!(header, "# tess-vectors 1 kind=listings count=1 source=tess-core", "{command}");
        assert!(text == expected, "{command}:\n{text}\nexpected:\n{expected}");
        assert!(CASES.contains(text), "{command}: the listing stands in the file as it is");
        compared += 1;
    }
    assert_eq!(compared, 51, "listings compared");
}

#[test]
fn json_has_exact_points_and_floats() {
    let run = tess("patch tri --outer 3,0x40800000,5 --inner nan --format json");
    let json: Value = serde_json::from_str(&run.stdout).expect("JSON");
    assert_eq!(json["domain"], "tri", "domain");
    assert_eq!(json["factors"][1]["bits"], "0x40800000", "factor bits");
    assert_eq!(json["factors"][3]["value"], Value::Null, "NaN is no JSON number");
    let points = json["points"].as_array().expect("points");
    for point in points {
        for (bits, float) in [("u_bits", "u"), ("v_bits", "v")] {
            let exact = point[bits].as_f64().expect("a number") / 65536.0;
            assert_eq!(point[float].as_f64().map(f64::to_bits), Some(exact.to_bits()), "{point}");
        }
    }
    let primitives = json["primitives"].as_array().expect("primitives");
    assert!(!primitives.is_empty(), "there are triangles");
    for index in primitives.iter().flat_map(|p| p.as_array().expect("a triangle")) {
        assert!(index.as_u64().is_some_and(|index| index < points.len() as u64), "{index}");
    }
}

#[test]
fn obj_has_vertices_and_elements() {
    let cases = [
        ("quad --outer 2,2,2,2 --inner 2,2", "f ", 8, 9),
        ("quad --outer 2,2,2,2 --inner 2,2 --output line", "l ", 8, 9),
        ("quad --outer 2,2,2,2 --inner 2,2 --output point", "p ", 9, 9),
        ("isoline --outer 2,3", "l ", 6, 8),
    ];
    for (patch, element, elements, vertices) in cases {
        let text = tess(&format!("patch {patch} --format obj")).stdout;
        let count = |start: &str| text.lines().filter(|line| line.starts_with(start)).count();
        assert_eq!((count(element), count("v ")), (elements, vertices), "{patch}:\n{text}");
    }
    let text = tess("patch quad --outer 2,2,2,2 --inner 2,2 --format obj").stdout;
    assert!(text.contains("\nv 0.5 0.5 0\n"), "the middle point:\n{text}");
}

#[test]
fn bad_arguments_say_what_would_be_right() {
    let cases = [
        ("patch", "--outer"),
        ("patch hexagon --outer 1,1", "isoline, tri, quad"),
        ("patch tri --outer 1,1 --inner 1", "3 factors"),
        ("patch quad --outer 1,1,1,1 --inner 1", "2 factors"),
        ("patch isoline --outer 1,1 --inner 1", "no --inner"),
        ("patch tri --outer 1,x,1 --inner 1", "hex digits after 0x"),
        ("patch tri --outer 1,,1 --inner 1", "hex digits after 0x"),
        ("patch tri --outer 1,1,1 --inner 1 --partitioning odd", "fractional_odd"),
        ("patch tri --outer 1,1,1 --inner 1 --output triangles", "triangle_cw"),
        ("patch tri --outer 1,1,1 --inner 1 --split centre", "center"),
        ("patch tri --outer 1,1,1 --inner 1 --format stl", "obj"),
        ("patch tri --outer 1,1,1 --inner 1 -o /nowhere/at/all.txt", "/nowhere/at/all.txt"),
    ];
    for (words, remedy) in cases {
        let run = tess(words);
        run.exits(2).says(remedy);
        assert_eq!(run.stdout, "", "{words}: nothing on stdout");
    }
}

/// A file is written whole and replaces the old one; a failure keeps the old one and leaves nothing
/// else.
#[test]
fn files_are_whole_or_untouched() {
    let directory = directory("files_are_whole_or_untouched");
    let file = directory.join("patch.txt");
    fs::write(&file, "old").expect("a file to write over");
    let patch = format!("patch tri --outer 1,1,1 --inner 1 -o {}", file.display());
    tess(&patch).exits(0);
    let written = fs::read_to_string(&file).expect("the file");
    assert_eq!(written, tess("patch tri --outer 1,1,1 --inner 1").stdout, "same as on stdout");

    let wrong = patch.replace("1,1,1", "1,1");
    tess(&wrong).exits(2);
    assert_eq!(fs::read_to_string(&file).expect("the file"), written, "untouched");
    let names: Vec<_> = fs::read_dir(&directory).expect("the directory").collect();
    assert_eq!(names.len(), 1, "nothing else: {names:?}");
}
