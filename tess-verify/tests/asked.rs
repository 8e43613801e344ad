//! Tests of answers compared with the cases that were asked: each dropped, repeated or foreign
//! answer is one difference.

use std::time::Instant;
use tess_core::Tessellation;
use tess_verify::check::{Known, Report, Strength, Tested, check_asked};
use tess_verify::generate::{GenLevel, Selection, SplitMix64};
use tess_verify::vectors::{Listing, VectorFile};
use tess_verify::{Backend, Case, CoreBackend};

/// After this many cases in a row without a record, the comparison has lost its place.
const WINDOW: usize = 4096;

/// Small cases, all different.
fn cases(count: usize) -> Vec<Case> {
    let case = |k| {
        let line = format!("case isoline integer point ruler 3f800000 {:08x}", 0x3F80_0000 + k);
        line.parse().expect("a case")
    };
    (0..count).map(case).collect()
}

/// Checks correct answers to some cases against the cases that were asked.
fn check(asked: &[Case], answered: &[Case]) -> Report {
    let listing = |case: &Case| Listing::of_model(*case).to_string();
    let listings: String = answered.iter().map(listing).collect();
    let text = format!("# tess-vectors 1 kind=listings source=device\n{listings}# end\n");
    let file = VectorFile::new("device", text.as_bytes()).expect("a header");
    let mut backends: Vec<Box<dyn Backend>> = vec![Box::new(CoreBackend), Box::new(CoreBackend)];
    let mut asked = asked.iter().map(|case| Ok(*case));
    let tested = Tested::Listings(Strength::default());
    check_asked(file, Some(&mut asked), &Known::default(), &mut backends, tested, &|_| ())
        .expect("a verdict")
}

/// The first line of each difference.
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

/// One wrong answer does not make the correct ones after it wrong.
#[test]
fn one_coincidence_is_no_place_to_go_on_from() {
    let asked = cases(1000);
    let mut answered = asked.clone();
    answered[0] = asked[999];
    let report = check(&asked, &answered);
    assert_eq!((report.cases, report.mismatches), (1000, 1), "{:?}", shown(&report));
    assert!(shown(&report)[0].starts_with("record 1 (line "), "{:?}", shown(&report));
    answered[500] = asked[700];
    answered.remove(300);
    let report = check(&asked, &answered);
    assert_eq!((report.cases, report.mismatches), (1000, 3), "{:?}", shown(&report));
}

/// The number of entries of one list that must be inserted, removed or replaced to turn it into
/// another.
fn distance(answered: &[Case], asked: &[Case]) -> u64 {
    let mut row: Vec<u64> = (0..).take(asked.len() + 1).collect();
    for (number, answer) in (1..).zip(answered) {
        let mut next = vec![number];
        for (j, case) in asked.iter().enumerate() {
            let replaced = row[j] + u64::from(answer != case);
            next.push(replaced.min(row[j + 1] + 1).min(next[j] + 1));
        }
        row = next;
    }
    row[asked.len()]
}

/// Random edits: no explanation has fewer differences, and each edit counts as at most two.
#[test]
fn the_shortest_explanation_is_given() {
    let asked = cases(300);
    let mut random = SplitMix64::new(38);
    for round in 0..300 {
        let mut answered = asked.clone();
        let edits = round % 9 + 1;
        for _ in 0..edits {
            let length = u32::try_from(answered.len()).expect("few");
            let [at, other] = [0; 2].map(|_| random.below(length) as usize);
            match random.below(5) {
                0 => drop(answered.remove(at)),
                1 => answered.insert(at, asked[other.min(299)]),
                2 => answered[at] = asked[other.min(299)],
                3 => answered.swap(at, other),
                _ => {
                    let moved = answered.remove(at);
                    answered.insert(other.min(answered.len()), moved);
                }
            }
        }
        let report = check(&asked, &answered);
        assert_eq!(report.mismatches, distance(&answered, &asked), "round {round}: {report:?}");
        assert!(report.mismatches <= 2 * edits, "round {round}: {report}");
        let (right, answers) = (report.cases - report.mismatches, answered.len() as u64);
        assert!(right <= answers && report.cases >= answers.max(300), "round {round}: {report}");
    }
}

/// Answers lose their place several times. The distance from one such place to the next is larger
/// than the comparison looks ahead, or equal to it.
#[test]
fn long_files_come_into_step_again() {
    let asked = cases(5 * WINDOW);
    let mut answered = asked.clone();
    answered.drain(4 * WINDOW..4 * WINDOW + 10);
    answered[3 * WINDOW] = asked[0];
    answered.splice(2 * WINDOW..2 * WINDOW, asked[..1000].iter().copied());
    answered.drain(1000..WINDOW);
    let report = check(&asked, &answered);
    assert_eq!(report.mismatches, (WINDOW - 1000 + 1000 + 1 + 10) as u64, "{report}");

    let mut answered = asked.clone();
    answered.splice(100..100, asked[2 * WINDOW..][..3000].iter().copied());
    assert_eq!(check(&asked, &answered).mismatches, 3000, "most of a window is too many");

    // The answers after the gap are the last ones that the comparison looks at, and they are fewer
    // than the gap is wide.
    let mut answered = asked.clone();
    answered[0] = asked[5000];
    answered.drain(WINDOW - 6..WINDOW + 44);
    assert_eq!(check(&asked, &answered).mismatches, 51, "a gap at the end of a window");
}

/// Answers that share nothing with the cases asked take at most three times as long as correct
/// ones.
#[test]
fn foreign_answers_take_the_time_of_right_ones() {
    let all = cases(80_000);
    let (asked, foreign) = all.split_at(40_000);
    let time = |answered: &[Case], mismatches: u64| {
        let start = Instant::now();
        assert_eq!(check(asked, answered).mismatches, mismatches);
        start.elapsed()
    };
    // In turn, so that other work on the machine slows both.
    let times: Vec<_> = (0..5).map(|_| (time(asked, 0), time(foreign, 40_000))).collect();
    let right = times.iter().map(|(right, _)| *right).min().expect("five");
    let foreign = times.iter().map(|(_, foreign)| *foreign).min().expect("five");
    assert!(foreign < 3 * right, "{foreign:?} is more than three times {right:?}");
}

#[test]
fn more_missing_answers_than_are_looked_through() {
    let asked = cases(2 * WINDOW + 10);
    let report = check(&asked, &asked[2 * WINDOW + 1..]);
    assert_eq!(report.mismatches, 2 * WINDOW as u64 + 10, "nothing is in step: {report}");
    let report = check(&asked, &asked[WINDOW - 1..]);
    assert_eq!(report.mismatches, WINDOW as u64 - 1, "in step behind the window: {report}");
}

/// Missing answers do not end the comparison of a device: a wrong answer after one is found.
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
        check_asked(file, Some(&mut cases), &Known::default(), &mut backends, tested, &|_| ())
            .expect("a verdict");
    assert_eq!(report.mismatches, 2, "{report}");
    assert_eq!(report.differences[0].number, 1, "the missing one");
    assert_eq!(report.differences[1].case, Some(asked[21]), "{report}");
}
