//! Tests of `tess explain`: the decisions that it names, and that its parts fit the patch.

use crate::support::{digest, directory, shell, tess};
use serde_json::{Value, json};

#[test]
fn decisions_are_named() {
    let cases = [
        ("tri --outer 1,nan,1 --inner 1", "culled: V=0 is NaN"),
        ("tri --outer 1,1,1 --inner 1", "minimum patch: every"),
        ("tri --outer 1,1,1 --inner 2", "not the minimum patch: inside"),
        ("tri --outer 70,1,1 --inner 1", "U=0: 70 is clamped to 64"),
        ("tri --outer 1.5,1,1 --inner 1", "U=0: 1.5 is rounded up to 2"),
        ("quad --outer 2,1,1,1 --inner 1,3", "inside U is 1 and counts as even"),
        ("tri --outer 2,1,1 --inner 1 --partitioning fractional_odd", "picture frame: U=0 is 2"),
        ("tri --outer 1,1,1 --inner 1 --partitioning fractional_odd", "no picture frame"),
        ("isoline --outer 3,4", "density is processed as integer"),
    ];
    for (patch, sentence) in cases {
        tess(&format!("explain {patch}")).exits(0).prints(sentence);
    }
}

/// Every word and number. Whoever changes an explanation records the new digest here, after reading
/// the text.
#[test]
fn explanations_are_the_recorded_ones() {
    let parts = [
        "",
        "--json",
        "--point 0",
        "--point 3",
        "--point 17",
        "--point 29",
        "--primitive 0",
        "--primitive 5",
        "--primitive 23",
        "--primitive 40",
        "--factor 0",
        "--factor 2 --json",
    ];
    for (patch, expected) in [
        ("quad --outer 3,4,5,6 --inner 4,7", "580b1190012f8821"),
        ("tri --outer 17,5.5,9 --inner 3.25 --partitioning fractional_odd", "64d9e44c6c8099d0"),
        (
            "quad --outer 2.5,1,64,7 --inner 1,30 --partitioning fractional_even --split center",
            "cdf67c20e0d801e2",
        ),
        ("isoline --outer 3,4 --output line", "d4d6037be4a70e54"),
        ("tri --outer 1,nan,1 --inner 1", "015a98597a6ead84"),
        ("tri --outer 1,1,1 --inner 1", "4835865b4aab0305"),
    ] {
        // What a patch does not have is refused, and prints nothing here.
        let said = parts.map(|part| tess(&format!("explain {patch} {part}")).stdout).concat();
        assert_eq!(digest(&said), expected, "{patch}:\n{said}");
    }
}

/// The runs of points and of primitives cover the patch, and each stitch has K + M - 2 triangles.
#[test]
fn json_adds_up() {
    for patch in ["quad --outer 3,4,5,6 --inner 4,7", "tri --outer 17,5,9 --inner 3"] {
        let run = tess(&format!("explain {patch} --json"));
        let json: Value = serde_json::from_str(&run.stdout).expect("JSON");
        let list = |key: &str| json[key].as_array().cloned().expect("a list");
        for (runs, total) in [("point_runs", "points"), ("stitches", "primitives")] {
            let mut next = 0;
            for run in list(runs) {
                assert_eq!(run["first"].as_u64(), Some(next), "{patch}: {run}");
                next += run["count"].as_u64().expect("a count");
            }
            assert_eq!(json[total].as_u64(), Some(next), "{patch}: all {total}");
        }
        for stitch in list("stitches") {
            let length = |key: &str| stitch[key].as_array().map_or(0, Vec::len);
            let rows = length("outer_row") + length("inner_row");
            if rows > 0 {
                assert_eq!(stitch["count"].as_u64(), Some(rows as u64 - 2), "{patch}: {stitch}");
            }
        }
    }
}

#[test]
fn elements_are_explained() {
    let patch = "explain quad --outer 3,4,5,6 --inner 4,7";
    let point = tess(&format!("{patch} --point 20"));
    assert!(point.stdout.starts_with("point 20: ring 1, edge 0"), "{}", point.stdout);
    point.prints("place(inside V, ");
    let primitive = tess(&format!("{patch} --primitive 0"));
    assert!(
        primitive.stdout.starts_with("primitive 0: transition, edge 0"),
        "{}",
        primitive.stdout
    );
    for element in ["--point 36", "--primitive 52", "--point x", "--point 1 --primitive 1"] {
        tess(&format!("{patch} {element}")).exits(2);
    }
}

/// A list of a circuit's signals, as `--signals` takes it; without the indices of primitives.
const SIGNALS: &str = "\
# part, stage, signal, module
patch	counts	points	counter
patch	counts	primitives	counter
factor	factors	fixed	converter
factor	factor_context	points	context_unit
point	points	u	placer
";

/// The output of a circuit is compared: each signal that differs is shown with its stage and, if a
/// list has it, its module. The run ends with exit code 1.
#[test]
fn mismatches_of_a_circuit_are_named() {
    let folder = directory("signals");
    std::fs::write(folder.join("signals.tsv"), SIGNALS).expect("written");
    let patch = "explain quad --outer 3,4,5,6 --inner 4,7";
    let cases = [
        ("--observed points=36,primitives=52", None),
        (
            "--observed points=36,primitives=51",
            Some(("primitives of stage counts", " (module counter)")),
        ),
        (
            "--factor 4 --observed fixed=0x40000,half_points=3",
            Some(("half_points of stage factor_context", "")),
        ),
        (
            "--factor 4 --observed points=3",
            Some(("points of stage factor_context", " (module context_unit)")),
        ),
        ("--factor 0 --observed odd=1,fixed=0x30000", None),
        ("--point 20 --observed u=1", Some(("u of stage points", " (module placer)"))),
        ("--primitive 0 --observed size=3,i0=0,i1=2", Some(("i1 of stage connect", ""))),
    ];
    for (element, difference) in cases {
        for (list, named) in [("", false), (" --signals signals.tsv", true)] {
            let run = shell(&format!("$TESS {patch} {element}{list}"), &folder);
            run.exits(i32::from(difference.is_some()));
            let said = difference.map_or("observed: equal".to_owned(), |(text, module)| {
                format!("differs: {text}{}: observed 0x", if named { module } else { "" })
            });
            run.prints(&said);
            let count = run.stdout.matches("differs: ").count();
            assert_eq!(count, usize::from(difference.is_some()), "{}", run.stdout);
        }
    }
    let command =
        format!("$TESS {patch} --factor 5 --observed points=1 --signals signals.tsv --json");
    let json: Value = serde_json::from_str(&shell(&command, &folder).stdout).expect("JSON");
    let expected = json!({
        "stage": "factor_context", "signal": "points", "observed": 1, "expected": 8, "module": "context_unit"
    });
    assert_eq!(json["differences"], json!([expected]), "{json}");
    assert_eq!(json["fixed"]["bits"], 0x70000, "the factor itself: {json}");
}

/// A list that is wrong is refused with its line, also where nothing differs, and is not replaced.
#[test]
fn lists_of_signals_are_checked() {
    let folder = directory("lists of signals");
    let write = |name, text: &str| std::fs::write(folder.join(name), text).expect("written");
    write("signals.tsv", SIGNALS);
    write("wrong.tsv", &SIGNALS.replace("placer", ""));
    let patch = "$TESS explain tri --outer 2,2,2 --inner 2";
    for (rest, message) in [
        ("--observed points=7 --signals wrong.tsv", "wrong.tsv, line 6: the last column is empty"),
        ("--observed points=7 --signals none.tsv", "cannot read none.tsv"),
        ("--signals signals.tsv", "--observed"),
        ("--observed points=7 --signals signals.tsv -o signals.tsv", "signals.tsv"),
    ] {
        shell(&format!("{patch} {rest}"), &folder).exits(2).says(message).prints_nothing();
    }
    let kept = std::fs::read_to_string(folder.join("signals.tsv")).expect("the list");
    assert_eq!(kept, SIGNALS, "as it was");
}

#[test]
fn observations_are_checked() {
    let cases = [
        ("--observed u=1", "expected one of: points, primitives"),
        ("--point 3 --observed i0=1", "expected one of: valid, u, v, last"),
        ("--factor 6", "there is no factor 6: the patch has 6 factors, from 0"),
        ("--observed points", "expected SIGNAL=N"),
        ("--observed points=0x1FFFFFFFF", "is not a 32-bit number"),
        ("--point 1 --factor 1", "cannot be used with"),
    ];
    for (element, message) in cases {
        tess(&format!("explain quad --outer 3,4,5,6 --inner 4,7 {element}")).exits(2).says(message);
    }
}
