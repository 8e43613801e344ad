//! Answers beside what was asked: each dropped, repeated or foreign answer is one difference.

use tess_core::Tessellation;
use tess_verify::backend::Backend;
use tess_verify::case::Case;
use tess_verify::checker::{Report, Tested, WINDOW, check_asked};
use tess_verify::core_backend::CoreBackend;
use tess_verify::generate::{GenLevel, Selection};
use tess_verify::strength::Strength;
use tess_verify::vectors::{Listing, VectorFile};

/// Distinct small cases.
fn cases(count: usize) -> Vec<Case> {
    let case = |k| {
        let line = format!("case isoline integer point ruler 3f800000 {:08x}", 0x3F80_0000 + k);
        line.parse().expect("a case")
    };
    (0..count).map(case).collect()
}

/// Checks right answers for some cases against what was asked.
fn check(asked: &[Case], answered: &[Case]) -> Report {
    let listing = |case: &Case| Listing::of_model(*case).to_string();
    let listings: String = answered.iter().map(listing).collect();
    let text = format!("# tess-vectors 1 kind=listings source=device\n{listings}# end\n");
    let file = VectorFile::new("device", text.as_bytes()).expect("a header");
    let mut backends: Vec<Box<dyn Backend>> = vec![Box::new(CoreBackend), Box::new(CoreBackend)];
    let mut asked = asked.iter().map(|case| Ok(*case));
    let tested = Tested::Listings(Strength::default());
    check_asked(file, Some(&mut asked), &mut backends, tested, &|_| ()).expect("a verdict")
}

/// The first lines of the differences.
fn shown(report: &Report) -> Vec<String> {
    let lines = report.differences.iter().map(ToString::to_string);
    lines.map(|text| text.lines().next().unwrap_or_default().to_owned()).collect()
}

#[test]
fn one_dropped_answer_is_one_difference() {
    let asked = cases(600);
    for dropped in [0, 8, 255, 256, 599] {
        let mut answered = asked.clone();
        let case = answered.remove(dropped);
        let report = check(&asked, &answered);
        assert_eq!((report.cases, report.mismatches), (600, 1), "{report}, without {dropped}");
        let missing = format!("record {} is missing: {case}", dropped + 1);
        assert_eq!(shown(&report), [missing], "{report}");
    }
    let report = check(&asked, &[&asked[..100], &asked[350..]].concat());
    assert_eq!((report.cases, report.mismatches), (600, 250), "250 in a row");
    assert!(shown(&report)[0].starts_with("record 101 is missing: "), "{report:?}");
}

#[test]
fn one_more_answer_is_one_difference() {
    let asked = cases(20);
    for place in [1, 8, 20] {
        let mut answered = asked.clone();
        answered.insert(place, asked[place - 1]);
        let report = check(&asked, &answered);
        assert_eq!((report.cases, report.mismatches), (21, 1), "{place}: {:?}", shown(&report));
        let first = &shown(&report)[0];
        assert!(first.starts_with(&format!("record {} (line ", place + 1)), "{first}");
    }
}

#[test]
fn a_foreign_answer_stands_in_the_place_of_one() {
    let asked = cases(20);
    let foreign: Case =
        "case tri integer point ruler 3f800000 3f800000 3f800000 3f800000".parse().expect("a case");
    for places in [&[3][..], &[0], &[19], &[5, 6], &[18, 19]] {
        let mut answered = asked.clone();
        places.iter().for_each(|place| answered[*place] = foreign);
        let report = check(&asked, &answered);
        assert_eq!(report.mismatches, places.len() as u64, "{places:?}: {:?}", shown(&report));
        let wrong = report.differences[0].mismatch.to_string();
        let expected = format!("observed {foreign}, expected {}", asked[places[0]]);
        assert!(wrong.contains(&expected), "{wrong}");
    }
}

#[test]
fn two_exchanged_answers_are_two_differences() {
    let asked = cases(20);
    let mut answered = asked.clone();
    answered.swap(4, 5);
    let report = check(&asked, &answered);
    assert_eq!(report.mismatches, 2, "{:?}", shown(&report));
}

#[test]
fn more_missing_answers_than_are_looked_through() {
    let asked = cases(WINDOW + 10);
    let report = check(&asked, &asked[WINDOW + 1..]);
    assert_eq!(report.mismatches, WINDOW as u64 + 10, "nothing is in step: {report}");
    let report = check(&asked, &asked[WINDOW - 1..]);
    assert_eq!(report.mismatches, WINDOW as u64 - 1, "in step behind the window: {report}");
}

/// A device is compared in spite of what is missing: a wrong answer behind it is found.
#[test]
fn a_wrong_answer_behind_a_missing_one() {
    let selection = Selection { random: Some(50), ..Selection::level(GenLevel::Three, 5) };
    let asked: Vec<Case> =
        selection.cases().filter(|case| case.patch().counts().points > 3).collect();
    let mut answers: Vec<(Case, Tessellation)> =
        asked[1..].iter().map(|case| (*case, case.patch().tessellate())).collect();
    answers[20].1.points.swap(0, 1);
    let listing =
        |(case, output): (Case, Tessellation)| Listing { line: 0, case, output }.to_string();
    let listings: String = answers.into_iter().map(listing).collect();
    let text = format!("# tess-vectors 1 kind=listings source=device\n{listings}# end\n");
    let file = VectorFile::new("device", text.as_bytes()).expect("a header");
    let mut backends: Vec<Box<dyn Backend>> = vec![Box::new(CoreBackend)];
    let mut cases = asked.iter().map(|case| Ok(*case));
    let tested = Tested::Listings(Strength::default());
    let report =
        check_asked(file, Some(&mut cases), &mut backends, tested, &|_| ()).expect("a verdict");
    assert_eq!(report.mismatches, 2, "{report}");
    assert_eq!(report.differences[0].number, 1, "the missing one");
    assert_eq!(report.differences[1].case, Some(asked[21]), "{report}");
}
