//! Tests of the generated levels: the bins that they hit, and that they are reproducible.

use std::collections::HashSet;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, SplitOrder};
use tess_verify::Case;
use tess_verify::cover::Coverage;
use tess_verify::generate::{
    GenLevel, Selection, Shard, SplitMix64, configurations, configurations_among, random_patch,
    thresholds,
};
use tess_verify::vectors::Fnv1a;

fn level(level: GenLevel) -> Vec<Case> {
    Selection::level(level, 1).cases().collect()
}

/// A digest of cases: configurations by their places in `ALL`, factors by their bits.
fn digest(cases: impl IntoIterator<Item = Case>) -> String {
    fn place<T: PartialEq>(all: &[T], of: &T) -> u32 {
        (0..).zip(all).find(|(_, one)| *one == of).expect("one of them").0
    }
    let mut digest = Fnv1a::default();
    for Case { config, factors } in cases {
        digest.words([
            place(&Domain::ALL, &factors.domain()),
            place(&Partitioning::ALL, &config.partitioning),
            place(&OutputPrimitive::ALL, &config.output),
            place(&SplitOrder::ALL, &config.split),
        ]);
        digest.words(factors.iter().map(f32::to_bits));
    }
    format!("{:016x}", digest.finish())
}

/// A level, a seed and a number mean the same case on every machine, and in every release that does
/// not state otherwise.
#[test]
fn cases_are_the_recorded_ones() {
    let some = |level, seed| Selection { random: Some(2000), ..Selection::level(level, seed) };
    let domain = Some(Domain::Triangle);
    let (one, two) = (Selection::level(GenLevel::One, 1), Selection::level(GenLevel::Two, 1));
    let recorded = [
        ("level 1", one, "7dab21d1639f11fd"),
        ("level 2", two, "e5adfad2b7edb5ca"),
        ("level 3", some(GenLevel::Three, 7), "32301befa6bbcd9e"),
        ("rules", some(GenLevel::Rules, 7), "ea1f78e5bd61c0fc"),
        (
            "triangles of level 3",
            Selection { domain, ..some(GenLevel::Three, 7) },
            "b1b4b09582477d74",
        ),
    ];
    let digests = recorded.map(|(name, selection, _)| (name, digest(selection.cases())));
    assert_eq!(digests, recorded.map(|(name, _, expected)| (name, expected.to_owned())));
}

/// A case of another domain repeats its factors in turn; what is not selected is kept.
#[test]
fn cases_fit_a_selection() {
    let case: Case = "case isoline integer line ruler 40400000 40a00000".parse().expect("a case");
    let split = Some(SplitOrder::ALL[1]);
    let (domain, partitioning) = (Some(Domain::Triangle), Some(Partitioning::Pow2));
    let selection = Selection { domain, partitioning, split, ..Selection::level(GenLevel::One, 1) };
    let fitting = selection.fit(&case);
    assert_eq!(fitting.factors.iter().collect::<Vec<_>>(), [3.0, 5.0, 3.0, 5.0]);
    let kept =
        Config { partitioning: Partitioning::Pow2, split: SplitOrder::ALL[1], ..case.config };
    assert_eq!((fitting.domain(), fitting.config), (Domain::Triangle, kept));
    let unchanged = Selection::level(GenLevel::One, 1).fit(&case);
    assert_eq!((unchanged.factors, unchanged.config), (case.factors, case.config));
}

#[test]
fn configurations_can_be_some() {
    let (quad, point) = ([Domain::Quad], [OutputPrimitive::Point]);
    let some: Vec<_> = configurations_among(&quad, &[], &point, &[]).collect();
    assert_eq!(some.len(), 4 * 2, "of each partitioning and split order");
    assert!(some.iter().all(|(domain, config)| (*domain, config.output) == (quad[0], point[0])));
    assert!(configurations_among(&[], &[], &[], &[]).eq(configurations()), "no list is all");
}

#[test]
fn level_1_hits_every_bin() {
    let mut coverage = Coverage::default();
    coverage.record_stream(None, level(GenLevel::One));
    let missed: Vec<_> = coverage.missed().collect();
    assert!(missed.is_empty(), "{} bins missed: {missed:#?}", missed.len());
}

/// Each factor by itself makes a patch that is not a minimum patch, so a device that ignores it in
/// this decision is detected.
#[test]
fn level_1_has_patches_beside_minimum_ones() {
    let cases = level(GenLevel::One);
    for domain in Domain::ALL {
        for partitioning in Partitioning::ALL {
            for position in 0..domain.factors() {
                let is_there = cases.iter().any(|case| {
                    let mut others =
                        case.factors.iter().enumerate().filter(|&(p, _)| p != position);
                    case.domain() == domain
                        && case.config.partitioning == partitioning
                        && case.factors.iter().nth(position).is_some_and(|factor| factor > 2.0)
                        && others.all(|(_, factor)| factor.to_bits() == 1f32.to_bits())
                });
                let name = domain.factor_names()[position];
                assert!(
                    is_there,
                    "{domain:?} {partitioning:?}: no patch with {name} alone above 1"
                );
            }
        }
    }
}

/// Random patches reach every bin as well, except some of the transitions, and they stay small.
#[test]
fn random_patches_reach_what_there_is() {
    let (mut coverage, mut points, mut cases) = (Coverage::default(), 0, 0);
    let mut random = SplitMix64::new(1);
    for (domain, config) in configurations() {
        for _ in 0..4000 {
            let case = Case { config, factors: random_patch(domain, &mut random) };
            coverage.record_stream(None, [case]);
            points += u64::from(case.patch().counts().points);
            cases += 1;
        }
    }
    // Only the list of thresholds has cases exactly next to each threshold, and inside factors of
    // nearly the same size.
    let rare = ["boundary/", "rings/", "sequence/"];
    let missed = coverage.missed().filter(|bin| !rare.iter().any(|group| bin.starts_with(group)));
    let (transitions, others): (Vec<_>, Vec<_>) =
        missed.partition(|bin| bin.starts_with("transition/"));
    assert!(others.is_empty(), "{others:?}");
    assert!(transitions.len() < 4000, "{} transitions missed", transitions.len());
    let mean = points / cases;
    assert!((20..120).contains(&mean), "{mean} points in the mean");
}

/// State left by a patch may change the next one: each pair of neighbours in a stream hits its bin,
/// and no other.
#[test]
fn sequences_are_pairs_of_neighbours() {
    let [tri, culled, line] = [
        "tri fractional_odd triangle_cw ruler 3f800000 3f800000 3f800000 3f800000",
        "quad integer line ruler 00000000 3f800000 3f800000 3f800000 3f800000 3f800000",
        "isoline pow2 line center 40000000 40000000",
    ]
    .map(|line| format!("case {line}").parse::<Case>().expect("a case"));
    let mut coverage = Coverage::default();
    coverage.record_stream(None, [tri, culled]);
    coverage.record_stream(Some(culled), [line, line]);
    let of_sequences = coverage.bins().filter(|(bin, _)| bin.starts_with("sequence/"));
    let hit = of_sequences.filter(|(_, hits)| *hits > 0);
    let expected = [
        ("kind/isoline_regular/isoline_regular", 1),
        ("kind/quad_culled/isoline_regular", 1),
        ("kind/tri_minimum/quad_culled", 1),
        ("output/line/line", 2),
        ("output/triangle_cw/line", 1),
        ("partitioning/fractional_odd/integer", 1),
        ("partitioning/integer/pow2", 1),
        ("partitioning/pow2/pow2", 1),
        ("split/center/center", 1),
        ("split/ruler/center", 1),
        ("split/ruler/ruler", 1),
    ];
    let hit = hit.map(|(bin, hits)| (&bin["sequence/".len()..], hits));
    assert!(hit.eq(expected), "{coverage}");
}

/// Level 2 has each boundary in each position of each partitioning with both split orders.
#[test]
fn level_2_has_both_split_orders_everywhere() {
    use tess_verify::generate::boundary_factors;

    let mut seen = HashSet::new();
    for case in (Selection { random: Some(0), ..Selection::level(GenLevel::Two, 1) }).cases() {
        for (position, factor) in case.factors.iter().enumerate() {
            let (config, domain) = (case.config, case.domain());
            seen.insert((domain, config.partitioning, config.split, position, factor.to_bits()));
        }
    }
    for value in boundary_factors() {
        for domain in Domain::ALL {
            for position in 0..domain.factors() {
                for (partitioning, split) in Partitioning::ALL
                    .into_iter()
                    .flat_map(|p| SplitOrder::ALL.map(|split| (p, split)))
                {
                    let bin = (domain, partitioning, split, position, value.to_bits());
                    assert!(seen.contains(&bin), "{bin:?}");
                }
            }
        }
    }
}

#[test]
fn coverage_notices_what_is_missing() {
    let mut coverage = Coverage::default();
    assert!(coverage.groups().iter().all(|group| group.hit == 0), "nothing is hit at first");
    coverage.record_stream(None, level(GenLevel::One).into_iter().take(100));
    let missed = coverage.missed().filter(|bin| bin.starts_with("transition/")).count();
    assert!(missed > 7000, "100 cases cannot hit every transition, {missed} missed");
}

#[test]
fn same_arguments_give_the_same_cases() {
    assert_eq!(level(GenLevel::One), level(GenLevel::One), "level 1");
    let seeded = |seed| {
        let selection = Selection { random: Some(100), ..Selection::level(GenLevel::Three, seed) };
        selection.cases().collect::<Vec<_>>()
    };
    assert_eq!(seeded(7), seeded(7), "same seed");
    assert_ne!(seeded(7), seeded(8), "another seed");
}

#[test]
fn shards_are_disjoint_and_complete() {
    let parts = 7;
    let mut owners = vec![0; 1000];
    for part in 0..parts {
        for (i, owner) in owners.iter_mut().enumerate() {
            *owner += usize::from(Shard { part, of: parts }.has(i as u64));
        }
    }
    assert!(owners.iter().all(|&owner| owner == 1), "every item has one owner");
    assert_eq!(Shard { part: 9, of: 20 }.items(9), 0, "no item for this part");
}

/// The numbers of cases, points and indices of levels 1 and 2, which docs/verification.md states:
/// level 1 is small enough to simulate.
#[test]
fn levels_have_the_documented_sizes() {
    let size = |cases: Vec<Case>| {
        let counts = cases.iter().map(|case| case.patch().counts());
        let sum = counts.fold([0, 0], |[points, indices], counts| {
            [points + u64::from(counts.points), indices + u64::from(counts.indices)]
        });
        (cases.len(), sum)
    };
    let split = Some(SplitOrder::Ruler);
    let ruler = Selection { split, ..Selection::level(GenLevel::One, 1) }.cases().collect();
    let sizes = [level(GenLevel::One), level(GenLevel::Two), ruler].map(size);
    let expected = [
        (44_070, [12_409_464, 52_018_590]),
        (191_826, [57_348_122, 232_733_678]),
        (39_684, [11_894_596, 49_823_029]),
    ];
    assert_eq!((sizes, thresholds().len()), (expected, 1070));
    let one: HashSet<Case> = level(GenLevel::One).into_iter().collect();
    let beyond = level(GenLevel::Two).into_iter().filter(|case| !one.contains(case)).count();
    assert_eq!(beyond, 132_060, "the row level-2 of `tess verify`");
}

#[test]
#[should_panic(expected = "divide by zero")]
fn an_item_has_no_place_among_no_parts() {
    let _ = Shard { part: 0, of: 0 }.items(9);
}

#[test]
#[should_panic(expected = "divisor of zero")]
fn no_parts_have_no_item() {
    let _ = Shard { part: 0, of: 0 }.has(9);
}
