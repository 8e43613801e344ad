//! Tests of the table of mistakes: each is seen as different by a comparison, and named only where
//! it explains every difference and no right record refutes it.

#[path = "common/numbers.rs"]
mod numbers;

use numbers::every_number;
use std::sync::LazyLock;
use tess_core::{Domain, OutputPrimitive, Partitioning, SplitOrder, Tessellation};
use tess_verify::check::{Explanation, ListOrder, Report, Strength, Tested, check, check_device};
use tess_verify::generate::{GenLevel, Selection, SplitMix64, configurations, random_patch};
use tess_verify::mistakes::{Mistake, Request, all, named, requests};
use tess_verify::rules::Specification;
use tess_verify::vectors::{Listing, VectorFile};
use tess_verify::{Backend, Case, CoreBackend};

fn model(case: &Case) -> Tessellation {
    case.patch().tessellate()
}

fn mistake(words: &str) -> &'static Mistake {
    named(words).unwrap_or_else(|| panic!("{words}: in the table"))
}

/// A device's answers to cases in order, where `answer` returns the wrong ones.
fn judged(
    cases: &[Case],
    strength: Strength,
    answer: impl Fn(&Request, &Tessellation) -> Option<Tessellation>,
) -> Report {
    let answers = requests(cases.iter().copied()).map(|request| {
        let right = model(&request.case);
        (request.case, answer(&request, &right).unwrap_or(right))
    });
    check_device(answers, strength)
}

fn in_order(order: ListOrder) -> Strength {
    Strength { order, ..Strength::default() }
}

/// The cases of `tess gen --rules` and of every number of segments, and the model's answers.
static POPULATION: LazyLock<Vec<(Case, Tessellation)>> = LazyLock::new(|| {
    let split = Some(SplitOrder::Ruler);
    let cases = Selection { split, ..Selection::level(GenLevel::Rules, 1) }.cases();
    cases.chain(every_number()).map(|case| (case, model(&case))).collect()
});

/// A device with a mistake, compared over consecutive cases in which the mistake shows. A mistake
/// that takes something from the first patch may need one of its own domain.
fn judged_where_it_shows(mistake: &Mistake) -> Option<Report> {
    const BEFORE: usize = 8;
    const AFTER: usize = 12;
    [None, Some(Domain::Quad), Some(Domain::Triangle)].into_iter().find_map(|domain| {
        let is_meant = |case: &Case| domain.is_none_or(|domain| case.domain() == domain);
        let population = || POPULATION.iter().filter(|(case, _)| is_meant(case));
        let cases = || population().map(|(case, _)| *case);
        let first = requests(cases()).zip(population()).position(|(request, (_, right))| {
            right.indices.len() < 3000 && mistake.wrong_answer(&request, right).is_some()
        })?;
        let near: Vec<Case> =
            cases().take(first + AFTER).skip(first.saturating_sub(BEFORE)).collect();
        // If it depends on the number of a patch, the beginning shows it.
        let from_first: Vec<Case> = cases().take(300).collect();
        [near, from_first].into_iter().find_map(|cases| {
            let wrong =
                |request: &Request, right: &Tessellation| mistake.wrong_answer(request, right);
            let report = judged(&cases, Strength::default(), wrong);
            (report.mismatches > 0).then_some(report)
        })
    })
}

/// What is wrong with the report on a device with this mistake.
fn fault(own: &'static Mistake) -> Option<String> {
    let Some(report) = judged_where_it_shows(own) else { return Some("not seen".to_owned()) };
    if let Some(freedoms) = report.freedoms() {
        // Whether an order is the same in equal patches is a question for the rules.
        let is_allowed = own.allowed().iter().any(|by| by.standard == Specification::D3d11);
        return (!is_allowed && !freedoms.order).then(|| format!("allowed: {}", freedoms.name()));
    }
    let is_own = |one: &&Explanation| matches!(one, Explanation::Mistake(m, _) if *m == own);
    let Some(found) = report.explanations.iter().find(is_own) else {
        return Some(format!("not named, but {:?}", report.explanations));
    };
    if found.words() != own.words() {
        return Some(format!("a right record refutes it: {}", found.words()));
    }
    let shortest = report.mistake().map(Explanation::words).unwrap_or_default();
    (shortest.len() > own.words().len()).then(|| format!("named {shortest}"))
}

/// A device with each mistake differs, and the explainer names that mistake, or one that is as
/// short and explains as much.
#[test]
fn each_mistake_is_seen_and_named() {
    let faults: Vec<String> =
        all().iter().filter_map(|own| Some(format!("{}: {}", own.words(), fault(own)?))).collect();
    assert!(faults.is_empty(), "{} of {}: {faults:#?}", faults.len(), all().len());
}

/// Small random patches of every configuration with factors in range.
fn cases() -> Vec<Case> {
    let mut random = SplitMix64::new(1);
    let patch = |(domain, config)| {
        [0; 4].map(|_| Case { config, factors: random_patch(domain, &mut random) })
    };
    let in_range = |case: &Case| case.factors.iter().all(|factor| (1.0..=64.0).contains(&factor));
    configurations().flat_map(patch).filter(in_range).collect()
}

/// Mistakes that show in many patches are named alone, in any order of comparison.
#[test]
fn a_mistake_of_every_patch_is_named_alone() {
    for words in [
        "every triangle turns the other way",
        "u and v are exchanged: order of vertices reversed",
        "u and v are exchanged: order of vertices kept",
        "u is mirrored: order of vertices reversed",
        "v is mirrored: order of vertices kept",
        "v and w are exchanged: order of vertices reversed",
        "the domain is turned by a quarter: order of vertices kept",
        "the two levels of isolines are exchanged",
        "the inner levels are exchanged",
        "levels are rounded to binary16, as Metal stores them: all levels, to the nearest",
        "levels are rounded to binary16, as Metal stores them: outer levels, toward zero",
        "levels are rounded to bfloat16: inner levels, to the nearest",
        "levels are rounded to steps: all levels, 1/256 toward zero",
        "levels are those of the first patch: first, all",
    ] {
        let own = mistake(words);
        for order in [ListOrder::Exact, ListOrder::Sequence, ListOrder::Any] {
            let report = judged(&cases(), in_order(order), |request, right| {
                own.wrong_answer(request, right)
            });
            assert!(report.mismatches > 10, "{words}, {order:?}: {report}");
            let named = report.mistake().map(Explanation::words);
            assert_eq!(named.as_deref(), Some(words), "{order:?}: {:?}", report.explanations);
        }
    }
}

/// A device that also loses the last primitive of one patch.
#[test]
fn a_mistake_that_does_not_explain_everything_is_not_named() {
    let odd = cases().into_iter().find(|case| model(case).indices.len() > 30).expect("one");
    for words in ["every triangle turns the other way", "the inner levels are exchanged"] {
        let own = mistake(words);
        let report = judged(&cases(), Strength::default(), |request, right| {
            let mut output = own.wrong_answer(request, right).unwrap_or_else(|| right.clone());
            if request.case == odd {
                output.indices.truncate(output.indices.len() - odd.primitive_size());
            }
            Some(output)
        });
        assert!(report.mismatches > 10, "{words}: {report}");
        assert_eq!(report.explanations, [], "{words}: {report}");
    }
}

/// Triangles turn the other way in six patches, which have nothing in common; two thousand others
/// are right.
#[test]
fn right_records_refute_a_mistake() {
    let own = mistake("every triangle turns the other way");
    let cases: Vec<Case> =
        cases().into_iter().filter(|case| case.primitive_size() == 3).cycle().take(2006).collect();
    let wrong = [3, 200, 411, 957, 1310, 1801];
    let report = judged(&cases, in_order(ListOrder::Any), |request, right| {
        own.wrong_answer(request, right).filter(|_| wrong.contains(&request.number))
    });
    assert_eq!(report.mismatches, 6, "{report}");
    assert_eq!(report.explanations, [], "the others are right");
}

/// A mistake on some patches is named with the condition that they have in common.
#[test]
fn the_scope_of_a_mistake_is_named() {
    type Condition = fn(&Request) -> bool;
    let largest = |case: &Case| case.factors.iter().fold(0.0, f32::max);
    let above = cases().iter().map(largest).filter(|level| *level >= 5.0).fold(64.0, f32::min);
    let above = format!(", where the largest level is at least {above}");
    let conditions: [(&str, Condition); 5] = [
        (", on quad patches", |request| request.case.domain() == Domain::Quad),
        (", under fractional_odd", |request| {
            request.case.config.partitioning == Partitioning::FractionalOdd
        }),
        (", with output triangle_cw", |request| {
            request.case.config.output == OutputPrimitive::TriangleCw
        }),
        (&above, |request| request.case.factors.iter().any(|level| level >= 5.0)),
        (", in every 7 patches, such as number 7", |request| request.number % 7 == 6),
    ];
    let own = mistake("every triangle turns the other way");
    let cases: Vec<Case> = cases().into_iter().filter(|case| case.primitive_size() == 3).collect();
    for (words, has) in conditions {
        let report = judged(&cases, in_order(ListOrder::Any), |request, right| {
            own.wrong_answer(request, right).filter(|_| has(request))
        });
        let (mismatches, all) = (report.mismatches, report.cases);
        assert!(mismatches > 5 && mismatches < all, "{words}: {report}");
        let named = report.mistake().map(Explanation::words).unwrap_or_default();
        assert_eq!(named, format!("{}{words}", own.words()), "{:?}", report.explanations);
    }
}

/// The explanations of a file of listings that several threads check.
fn of_a_file(answers: &[(Case, Tessellation)], threads: usize) -> Vec<Explanation> {
    let listing = |(case, output): &(Case, Tessellation)| {
        Listing { line: 0, case: *case, output: output.clone() }.to_string()
    };
    let records: String = answers.iter().map(listing).collect();
    let text = format!("# tess-vectors 1 kind=listings source=device\n{records}# end\n");
    let file = VectorFile::new("device", text.as_bytes()).expect("a header");
    let mut backends: Vec<Box<dyn Backend>> = Vec::new();
    backends.resize_with(threads, || Box::new(CoreBackend));
    let tested = Tested::Listings(in_order(ListOrder::Any));
    check(file, &mut backends, tested, &|_| ()).expect("a verdict").explanations
}

/// Threads take 256 records at a time. A record of one thread counts for all of them, be it right
/// or wrong, and a mistake may take something from a record of another thread.
#[test]
fn threads_do_not_matter() {
    let quads = |case: &Case| case.domain() == Domain::Quad && case.primitive_size() == 3;
    let cases: Vec<Case> = cases().into_iter().filter(quads).cycle().take(1000).collect();
    let answers = |own: &'static Mistake, is_wrong: fn(u64) -> bool| {
        let answer = |request: Request| {
            let right = model(&request.case);
            let wrong = own.wrong_answer(&request, &right).filter(|_| is_wrong(request.number));
            (request.case, wrong.unwrap_or(right))
        };
        requests(cases.iter().copied()).map(answer).collect::<Vec<_>>()
    };
    for words in ["the inner levels are exchanged", "the output is that of the patch before"] {
        let own = mistake(words);
        for threads in [1, 4] {
            let found = of_a_file(&answers(own, |_| true), threads);
            assert_eq!(found.first().map(Explanation::words).as_deref(), Some(words), "{found:?}");
            // The last records are right, or one is wrong in another way.
            let found = of_a_file(&answers(own, |number| number < 900), threads);
            assert_eq!(found, [], "{words}, {threads} threads");
            let mut odd = answers(own, |_| true);
            odd[990].1 = Tessellation::default();
            assert_eq!(of_a_file(&odd, threads), [], "{words}, {threads} threads");
        }
    }
}

/// Ties to even, toward zero, and numbers too small or too large for binary16.
#[test]
fn binary16_has_its_own_ends() {
    let taken = |direction: &str, detail: &str| {
        let words = "levels are rounded to binary16, as Metal stores them: all levels,";
        let own = mistake(&format!("{words} {direction}"));
        let line = format!("case isoline fractional_odd line ruler 40400000 {detail}");
        let request = requests([line.parse().expect("a case")]).next().expect("one");
        let level = own.case(&request).factors.iter().nth(1).expect("a detail");
        format!("{:08x}", level.to_bits())
    };
    for (detail, nearest, toward_zero) in [
        ("40401000", "40400000", "40400000"), // 3 + 2^-10, halfway: to the even one
        ("40403000", "40404000", "40402000"), // 3 + 3 * 2^-10
        ("40401001", "40402000", "40400000"),
        ("33000000", "00000000", "00000000"), // 2^-25, which becomes 0 and culls
        ("33000001", "33800000", "00000000"),
        ("477fefff", "477fe000", "477fe000"),
        ("477ff000", "7f800000", "477fe000"), // 65520, which becomes infinity
        ("7f800000", "7f800000", "7f800000"),
    ] {
        assert_eq!(taken("to the nearest", detail), nearest, "{detail}");
        assert_eq!(taken("toward zero", detail), toward_zero, "{detail}");
    }
}
