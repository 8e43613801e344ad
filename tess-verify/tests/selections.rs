//! Tests of level 1 for any selection: it hits every bin that the selection's patches can hit, so
//! that a device is tested as far as its configurations allow, and it detects devices whose
//! mistakes only some of its cases show.

use std::collections::BTreeSet;
use tess_core::{
    Config, Domain, OutputPrimitive, Partitioning, PatchFactors, Side, SplitOrder, Step,
    StitchKind, Tessellation,
};
use tess_verify::check::{Strength, check_device};
use tess_verify::cover::{Coverage, Exclusions};
use tess_verify::generate::{GenLevel, Selection, configurations_among};
use tess_verify::{Case, Named};

/// Each value of a part of a configuration, and `None`, which means all.
fn or_all<T: Copy>(all: &[T]) -> Vec<Option<T>> {
    all.iter().copied().map(Some).chain([None]).collect()
}

/// Selections of level 1, without the random cases at its end: every selection without an output,
/// as outputs differ in their own bins only; each output by itself; and each single configuration,
/// with the outputs taken in turn.
fn selections() -> Vec<Selection> {
    let level = Selection { random: Some(0), ..Selection::level(GenLevel::One, 1) };
    let each_output =
        OutputPrimitive::ALL.map(|output| Selection { output: Some(output), ..level });
    let mut all = each_output.to_vec();
    let mut outputs = OutputPrimitive::ALL.into_iter().cycle();
    for domain in or_all(&Domain::ALL) {
        for partitioning in or_all(&Partitioning::ALL) {
            for split in or_all(&SplitOrder::ALL) {
                let some = Selection { domain, partitioning, split, ..level };
                all.push(some);
                if domain.is_some() && partitioning.is_some() && split.is_some() {
                    all.push(Selection { output: outputs.next(), ..some });
                }
            }
        }
    }
    all
}

/// The options of `tess gen` for a selection.
fn options(selection: &Selection) -> String {
    let Selection { domain, partitioning, output, split, .. } = selection;
    let names = [
        ("domain", domain.map(Named::name)),
        ("partitioning", partitioning.map(Named::name)),
        ("output", output.map(Named::name)),
        ("split", split.map(Named::name)),
    ];
    let given = names.iter().filter_map(|(name, value)| Some(format!(" --{name} {}", (*value)?)));
    format!("tess gen --level 1{}", given.collect::<String>())
}

/// The bins that a selection's patches can hit but its level 1 does not, and how many bins they can
/// hit.
fn holes(selection: &Selection) -> (Vec<String>, usize) {
    let Selection { domain, partitioning, output, split, .. } = *selection;
    let mut coverage = Coverage::default();
    coverage.record_stream(None, selection.cases());
    let outside = Exclusions::outside(configurations_among(
        &Vec::from_iter(domain),
        &Vec::from_iter(partitioning),
        &Vec::from_iter(output),
        &Vec::from_iter(split),
    ));
    let holes: Vec<String> = coverage.holes(&outside).map(str::to_owned).collect();
    (holes, coverage.bins().count() - outside.bins().count())
}

#[test]
#[ignore = "slow: level 1 of many selections"]
fn level_1_of_any_selection_has_no_holes() {
    let mut with_holes = Vec::new();
    for selection in selections() {
        let (holes, bins) = holes(&selection);
        assert!(bins > 50, "{}: {bins} bins", options(&selection));
        if !holes.is_empty() {
            let some = holes.iter().take(12).cloned().collect::<Vec<_>>().join(" ");
            with_holes.push(format!("{}: {} holes: {some}", options(&selection), holes.len()));
        }
    }
    assert!(with_holes.is_empty(), "{}:\n{}", with_holes.len(), with_holes.join("\n"));
}

/// A patch's transitions: its outer and inside numbers of points, and the split order.
fn transitions(case: &Case) -> BTreeSet<(u32, u32, &'static str)> {
    let patch = case.patch();
    let points = |factors: &PatchFactors<tess_core::ProcessedFactor>| match factors {
        PatchFactors::Isoline(_) => Vec::new(),
        PatchFactors::Triangle(f) => {
            let inside = f.inside.context.points;
            f.outer().map(|outer| (outer.context.points, inside)).to_vec()
        }
        PatchFactors::Quad(f) => {
            let [u, v] = f.inside().map(|inside| inside.context.points);
            f.outer().iter().map(|outer| outer.context.points).zip([v, u, v, u]).collect()
        }
    };
    match patch.processed() {
        tess_core::ProcessedPatch::Regular(factors) => {
            let split = case.config.split.name();
            points(factors).into_iter().map(|(outer, inside)| (outer, inside, split)).collect()
        }
        _ => BTreeSet::new(),
    }
}

/// The number of differences of a device that turns one triangle wherever a patch has a transition.
fn differences(selection: &Selection, wrong: (u32, u32, &str)) -> u64 {
    let shows = |case: &Case| transitions(case).contains(&wrong);
    let answers = selection.cases().filter(shows).map(|case| {
        let mut output = case.patch().tessellate();
        output.indices.reverse();
        (case, output)
    });
    check_device(answers, Strength::default()).mismatches
}

/// A device had wrong masks where outer edges of 38, 46, 54 or 62 points (half of which is 19, 23,
/// 27 or 31) met an inside of 64 segments, and where 11 segments met 10: no case of one split order
/// showed them.
#[test]
fn level_1_sees_a_wrong_transition_of_one_split_order() {
    for outer in [12, 38, 46, 54, 62] {
        let inside = if outer == 12 { 11 } else { 65 };
        for split in SplitOrder::ALL {
            for domain in [None, Some(Domain::Triangle), Some(Domain::Quad)] {
                for output in [None, Some(OutputPrimitive::TriangleCw)] {
                    let level = Selection::level(GenLevel::One, 1);
                    let of_order = Selection { split: Some(split), domain, output, ..level };
                    for selection in [of_order, Selection { split: None, ..of_order }] {
                        let wrong = (outer, inside, split.name());
                        assert!(
                            differences(&selection, wrong) > 0,
                            "{wrong:?}: {}",
                            options(&selection)
                        );
                    }
                }
            }
        }
    }
}

/// The model's answer with two triangles wrong on each transition of these outer and inside points:
/// the first two that advance along different rows come in the other order, as if the outer row's
/// half had its point at another position. `None` if nothing of the case is wrong.
fn stitched_wrongly(case: &Case, (outer, inside): (u32, u32)) -> Option<Tessellation> {
    let Config { output, split, .. } = case.config;
    let is_clockwise = output == OutputPrimitive::TriangleCw;
    if !is_clockwise && output != OutputPrimitive::TriangleCcw {
        return None;
    }
    let mut answer = case.patch().tessellate();
    let mut is_wrong = false;
    case.patch().stitches(|stitch| {
        let points = (stitch.outer_points, stitch.inner_points + 2);
        if !matches!(stitch.kind, StitchKind::Transition { .. }) || points != (outer, inside) {
            return;
        }
        let mut steps = Vec::new();
        stitch.steps(split, |step| steps.push(step));
        let differ = |pair: &&[Step]| pair[0].advances != pair[1].advances;
        let Some(&[first, second]) = steps.windows(2).find(differ) else { return };
        let early = Step { advances: second.advances, begins: second.begins, ..first };
        let late = match second.advances {
            Side::Outer => Step { outer: first.outer + 1, ..first },
            Side::Inner => Step { inner: first.inner + 1, ..first },
        };
        for (right, wrong) in [(first, early), (second, late)] {
            let [right, mut wrong] =
                [right, wrong].map(|step| step.triangle(&stitch.outer, &stitch.inner));
            if !is_clockwise {
                wrong.swap(1, 2);
            }
            let is_it =
                |triangle: &&mut [u32; 3]| right.iter().all(|index| triangle.contains(index));
            let place = answer.indices.as_chunks_mut::<3>().0.iter_mut().find(is_it);
            *place.expect("a triangle of the stitch") = wrong;
        }
        is_wrong = true;
    });
    is_wrong.then_some(answer)
}

/// The same halves, stitched wrongly in ruler order by two triangles: 2 * half points if the number
/// of segments is odd, one more if it is even.
#[test]
#[ignore = "slow: level 1 of many selections"]
fn level_1_sees_halves_that_are_stitched_wrongly() {
    for outer in [19, 23, 27, 31].into_iter().flat_map(|half| [2 * half, 2 * half + 1]) {
        for domain in [None, Some(Domain::Triangle), Some(Domain::Quad)] {
            for output in [None, Some(OutputPrimitive::TriangleCw)] {
                let level = Selection::level(GenLevel::One, 1);
                let selection =
                    Selection { split: Some(SplitOrder::Ruler), domain, output, ..level };
                let answers = selection
                    .cases()
                    .filter_map(|case| stitched_wrongly(&case, (outer, 65)).map(|it| (case, it)));
                let found = check_device(answers, Strength::default());
                assert!(found.mismatches > 0, "{outer} points: {}", options(&selection));
                assert_eq!(found.mismatches, found.cases, "{outer} points: each is wrong");
            }
        }
    }
}

/// A part of a configuration that a device keeps from the previous patch.
type Kept = (&'static str, fn(&Case, Config) -> Case);

const KEPT: [Kept; 3] = [
    ("split", |case, before| with(case, Config { split: before.split, ..case.config })),
    ("output", |case, before| with(case, Config { output: before.output, ..case.config })),
    ("partitioning", |case, before| {
        with(case, Config { partitioning: before.partitioning, ..case.config })
    }),
];

const fn with(case: &Case, config: Config) -> Case {
    Case { config, factors: case.factors }
}

/// Of the systematic cases, how many a device answers wrongly that keeps something from the case
/// before.
fn wrong_in_sequence(selection: Selection, keep: fn(&Case, Config) -> Case) -> usize {
    let cases: Vec<Case> = Selection { random: Some(0), ..selection }.cases().collect();
    let answer = |case: &Case| -> Tessellation { case.patch().tessellate() };
    let is_wrong = |pair: &&[Case]| {
        let kept = keep(&pair[1], pair[0].config);
        kept.config != pair[1].config && answer(&kept) != answer(&pair[1])
    };
    cases.windows(2).filter(is_wrong).count()
}

#[test]
fn level_1_sees_what_a_device_keeps_from_the_patch_before() {
    for domain in or_all(&Domain::ALL) {
        let selection = Selection { domain, ..Selection::level(GenLevel::One, 1) };
        for (name, keep) in KEPT {
            let wrong = wrong_in_sequence(selection, keep);
            assert!(wrong >= 2, "{name} is kept: {wrong} wrong of {}", options(&selection));
        }
    }
    let odd = Some(Partitioning::FractionalOdd);
    let selection = Selection { partitioning: odd, ..Selection::level(GenLevel::One, 1) };
    assert!(wrong_in_sequence(selection, KEPT[0].1) >= 6, "the split order, of each domain");
}
