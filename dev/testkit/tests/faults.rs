//! Every comparison can fail: each planted fault is reported, with its element and stage.

use std::fs::read_to_string;
use std::sync::atomic::Ordering;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_testkit::faults::{Fault, Faulty};
use tess_verify::check::{
    CheckError, Conversion, Element, ListOrder, MAX_DIFFERENCES, Report, SpecStage, Strength,
    Tested, check, check_device,
};
use tess_verify::vectors::VectorFile;
use tess_verify::{Backend, Case, CoreBackend};

/// Rows of a golden file as a file of its own; of listings, all of them.
fn excerpt(name: &str, keep: impl Fn(usize, &str) -> bool) -> String {
    let path = format!("{}/../../golden/{name}", env!("CARGO_MANIFEST_DIR"));
    let text = read_to_string(path).expect("readable");
    let [header, columns, rows @ ..] = &text.lines().collect::<Vec<_>>()[..] else {
        panic!("{name} has a header and columns")
    };
    let kind = header.split_whitespace().nth(3).expect("a kind");
    if kind == "kind=listings" {
        return text;
    }
    let kept = rows.iter().enumerate().filter(|(i, row)| keep(*i, row)).map(|(_, row)| *row);
    let rows: Vec<_> = kept.collect();
    let header = format!("# tess-vectors 1 {kind} count={} source=tess", rows.len());
    format!("{header}\n{columns}\n{}\n", rows.join("\n"))
}

fn run(text: &str, backends: &mut [Box<dyn Backend>]) -> Result<Report, CheckError> {
    check(VectorFile::new("excerpt", text.as_bytes())?, backends, Tested::Backend, &|_| ())
}

/// Checks `text` with a faulty backend; fails if the fault was not committed.
fn run_faulty(text: &str, fault: Fault, calls_before: u32) -> Result<Report, CheckError> {
    let backend = Faulty::new(CoreBackend, fault, calls_before);
    let committed = backend.committed();
    let result = run(text, &mut [Box::new(backend)]);
    assert!(committed.load(Ordering::Relaxed), "{fault:?} was committed");
    result
}

fn run_core(text: &str) -> Report {
    run(text, &mut [Box::new(CoreBackend)]).expect("a verdict")
}

/// Whether a difference in `element` and `stage` fits this fault of patches.
fn looks_like(fault: Fault, element: &Element, stage: SpecStage) -> bool {
    let first = |wanted| match element {
        Element::Point { index: 0, coordinate } => *coordinate == wanted,
        _ => false,
    };
    let Fault::Patch(mistake) = fault else { return true };
    let coordinate =
        |wanted| matches!(element, Element::Point { coordinate, .. } if *coordinate == wanted);
    match (mistake.family(), mistake.variant()) {
        ("a bit of a point is wrong", variant) => {
            let is_first = !variant.contains(" first ") || first("u") || first("v");
            let is_coordinate = coordinate(if variant.ends_with('u') { "u" } else { "v" });
            is_first && is_coordinate && stage == SpecStage::Location
        }
        ("the first and the last point are exchanged", _) => {
            (first("u") || first("v")) && stage == SpecStage::PointOrder
        }
        (
            "the last point is missing"
            | "there is a point that no primitive uses"
            | "a patch has no output",
            _,
        ) => *element == Element::Count("points") && stage == SpecStage::Counts,
        ("the first and the last index are exchanged", _) => {
            *element == Element::Index { primitive: 0, position: 0 } && stage == SpecStage::Stitch
        }
        ("the last index is one too high", _) => {
            matches!(element, Element::Index { .. }) && stage == SpecStage::Stitch
        }
        ("the last index is missing" | "there is an index too many", _) => {
            *element == Element::Count("indices") && stage == SpecStage::Counts
        }
        ("the output is that of the patch before", _) => true,
        (family, _) => panic!("{family}: say what it looks like"),
    }
}

#[test]
fn faults_of_patches_in_every_kind_that_has_patches() {
    let files = [
        excerpt("cases.txt", |_, _| true),
        excerpt("patches.csv", |i, _| i < 400),
        excerpt("corners.csv", |i, _| i % 8 == 3),
        excerpt("hlsl.csv", |i, _| i < 400),
        excerpt("sweep.csv", |i, _| i % 100 == 40),
        excerpt("uniform.csv", |i, _| i % 100 == 40),
    ];
    for text in &files {
        let clean = run_core(text);
        assert_eq!(clean.mismatches, 0, "without a fault");
        for fault in Fault::of_patches() {
            for calls_before in [0, 3] {
                let result = run_faulty(text, fault, calls_before);
                if fault == Fault::ShortAnswer {
                    assert!(matches!(result, Err(CheckError::Backend(_))), "{result:?}");
                    continue;
                }
                let report = result.expect("a verdict");
                assert_eq!((report.cases, report.mismatches), (clean.cases, 1), "{fault:?}");
                let mismatch = &report.differences[0].mismatch;
                let as_expected = looks_like(fault, &mismatch.element, mismatch.stage);
                assert!(as_expected, "{fault:?} looks like {mismatch}");
                assert!(report.differences[0].case.is_some(), "{fault:?}: the patch is named");
            }
        }
    }
}

#[test]
fn faults_of_contexts_and_locations() {
    let text = excerpt("place.csv", |i, _| i % 60 == 2 || i == 63);
    let rows = run_core(&text).cases;
    assert_eq!(rows, 6, "rows of the excerpt");
    for (faults, stage) in [
        (&Fault::OF_CONTEXTS[..], SpecStage::Context),
        (&Fault::OF_LOCATIONS[..], SpecStage::Location),
    ] {
        for &fault in faults {
            let result = run_faulty(&text, fault, 4);
            if fault == Fault::ShortAnswer {
                assert!(matches!(result, Err(CheckError::Backend(_))), "{result:?}");
                continue;
            }
            let report = result.expect("a verdict");
            assert_eq!((report.cases, report.mismatches), (rows, rows - 4), "{fault:?}");
            let mismatch = &report.differences[0].mismatch;
            let counted = fault == Fault::DroppedLocation;
            let stage = if counted { SpecStage::Counts } else { stage };
            assert_eq!(mismatch.stage, stage, "{fault:?}: {mismatch}");
            let found = matches!(
                (fault, mismatch.element.clone()),
                (Fault::Context(_), Element::Context { .. })
                    | (Fault::LastLocation | Fault::SwappedLocations, Element::Location { .. })
                    | (Fault::DroppedLocation, Element::Count("locations"))
            );
            assert!(found, "{fault:?} looks like {mismatch}");
        }
    }
}

#[test]
fn faults_of_factors() {
    let text = excerpt("factor.csv", |_, row| row.starts_with("fractional_odd,0,"));
    assert_eq!(run_core(&text).cases, 1, "rows of the excerpt");
    for (fault, expected) in [(Fault::OuterFactor, "outer"), (Fault::InsideFactor, "inside")] {
        // It strikes in the last of the 128 batches, at the number just below two.
        let report = run_faulty(&text, fault, 127).expect("a verdict");
        assert_eq!(report.mismatches, 1, "{fault:?}");
        let mismatch = &report.differences[0].mismatch;
        assert_eq!(mismatch.stage, SpecStage::Factors, "{fault:?}: {mismatch}");
        let found = matches!(mismatch.element, Element::Factor { role, .. } if role == expected);
        assert!(found, "{fault:?} looks like {mismatch}");
    }
    let result = run_faulty(&text, Fault::ShortAnswer, 127);
    assert!(matches!(result, Err(CheckError::Backend(_))), "{result:?}");
}

/// A patch's difference is traced to the first stage that is wrong on its own.
#[test]
fn stages_are_told_apart() {
    let text = excerpt("patches.csv", |i, _| i < 40);
    for (fault, stage) in [
        (Fault::OuterFactor, SpecStage::Factors),
        (Fault::InsideFactor, SpecStage::Factors),
        (Fault::OF_CONTEXTS[3], SpecStage::Context),
        (Fault::LastLocation, SpecStage::Location),
    ] {
        let patch_fault = Faulty::new(CoreBackend, Fault::patch("the last point is missing"), 0);
        let backend = Faulty::new(patch_fault, fault, 0);
        let report = run(&text, &mut [Box::new(backend)]).expect("a verdict");
        let [difference] = &report.differences[..] else { panic!("one difference: {report}") };
        assert_eq!(difference.mismatch.stage, stage, "{fault:?}: {difference}");
    }
}

/// A wrong number in any result column of any kind of file is a difference.
#[test]
#[ignore = "slow: every column of every kind of file"]
fn wrong_records() {
    let files = [
        (excerpt("patches.csv", |i, _| i == 8), &[5, 6, 7, 8][..]),
        (excerpt("sweep.csv", |i, _| i == 8), &[5]),
        (excerpt("uniform.csv", |i, _| i == 8), &[5]),
        (excerpt("place.csv", |i, _| i == 62), &[3, 4, 5]),
        (excerpt("factor.csv", |i, _| i == 0), &[2, 3]),
        (excerpt("hlsl.csv", |i, _| i == 1), &[6, 7, 8, 9, 10, 11]),
    ];
    for (text, columns) in &files {
        assert_eq!(run_core(text).mismatches, 0, "as recorded");
        for &column in *columns {
            let (start, row) = text.trim_end().rsplit_once('\n').expect("a row");
            let mut fields: Vec<_> = row.split(',').map(str::to_owned).collect();
            let digit = fields[column].pop().expect("a digit");
            fields[column].push(if digit == '1' { '2' } else { '1' });
            let report = run_core(&format!("{start}\n{}\n", fields.join(",")));
            assert_eq!(report.mismatches, 1, "column {column} of {row}");
            if text.contains("kind=factors") {
                continue; // a binade takes a second
            }
            // The difference can be shown again from its own text.
            let again = report.differences[0].file.as_deref().expect("a row");
            let again = run_core(again);
            let show = |report: &Report| report.differences[0].mismatch.to_string();
            assert_eq!(show(&again), show(&report), "column {column} of {row}, again");
        }
    }
}

/// A device's faults are detected in any order too, because none of them changes only the order.
#[test]
fn faults_of_devices_in_any_order() {
    let any = Strength { order: ListOrder::Any, ..Strength::default() };
    let within = Strength { conversion: Conversion::Within06Ulp, ..any };
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let factors = [2.5, 3.0, 7.5, 5.0].map(|factor| {
        PatchFactors::from_fn(Domain::Quad, |position| if position == 2 { 4.25 } else { factor })
    });
    for fault in Fault::of_patches() {
        let mut device = Faulty::new(CoreBackend, fault, 0);
        let outputs = device.tessellate(config, &factors).expect("the model");
        let answers = || {
            let cases = factors.iter().map(|&factors| Case { config, factors });
            cases.zip(outputs.iter().cloned()).collect::<Vec<_>>()
        };
        let expected = u64::from(fault != Fault::ShortAnswer); // one answer less, none wrong
        for strength in [any, within] {
            let report = check_device(answers(), strength);
            assert_eq!(report.mismatches, expected, "{fault:?} in {strength:?}");
        }
    }
}

/// The caller chooses which side is tested, not the source that a file names.
#[test]
fn either_side_of_listings_can_be_tested() {
    let text = excerpt("cases.txt", |_, _| true);
    let damaged = text.replacen("\n0 1 10\n", "\n0 1 11\n", 1);
    let shown = |tested: Tested| {
        let file = VectorFile::new("excerpt", damaged.as_bytes()).expect("a header");
        let report = check(file, &mut [Box::new(CoreBackend)], tested, &|_| ());
        report.expect("a verdict").differences[0].mismatch.to_string()
    };
    let index = "index 2 of primitive 0";
    let expected = format!("{index}: observed 0xa, expected 0xb (stage: stitch)");
    assert_eq!(shown(Tested::Backend), expected, "a recording");
    let expected = format!("{index}: observed 0xb, expected 0xa (stage: stitch)");
    assert_eq!(shown(Tested::Listings(Strength::default())), expected, "a device");
}

/// The first differences are shown and all are counted, whatever the number of threads.
#[test]
fn many_differences() {
    let good = excerpt("patches.csv", |i, _| i < 2000);
    let bad: Vec<_> = good
        .lines()
        .enumerate()
        .map(|(i, line)| {
            let digest = line.len() - 16;
            if i > 100 && i % 3 == 0 {
                line[..digest].to_owned() + "0123456789abcdef"
            } else {
                line.into()
            }
        })
        .collect();
    let bad = bad.join("\n");
    let shown = |backends: usize| {
        let mut backends: Vec<Box<dyn Backend>> =
            (0..backends).map(|_| Box::new(CoreBackend) as Box<dyn Backend>).collect();
        let report = run(&bad, &mut backends).expect("a verdict");
        assert_eq!((report.cases, report.mismatches), (2000, 634), "{} backends", backends.len());
        let shown: Vec<_> = report.differences.iter().map(ToString::to_string).collect();
        assert_eq!(shown.len(), MAX_DIFFERENCES, "differences that are shown");
        shown
    };
    assert_eq!(shown(1), shown(5), "1 and 5 threads");
}

#[test]
fn no_verdict_without_a_backend_or_a_whole_file() {
    let text = excerpt("patches.csv", |i, _| i < 1000);
    assert!(matches!(run(&text, &mut []), Err(CheckError::Backend(_))), "no backend");
    let cut = &text[..text.len() - 30];
    let result = run(cut, &mut [Box::new(CoreBackend)]);
    assert!(matches!(result, Err(CheckError::Malformed { .. })), "cut in its last row: {result:?}");
}
