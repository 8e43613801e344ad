//! The generated levels: what they hit, and that they are reproducible.

use tess_verify::case::Case;
use tess_verify::coverage::Coverage;
use tess_verify::generate::{Level, Selection, Shard, configurations, random_patch};
use tess_verify::random::SplitMix64;

fn level(level: Level) -> Vec<Case> {
    Selection::level(level, 1).cases().collect()
}

#[test]
fn level_1_hits_every_bin() {
    let mut coverage = Coverage::new();
    level(Level::One).iter().for_each(|case| coverage.record(case));
    let missed: Vec<_> = coverage.missed().collect();
    assert!(missed.is_empty(), "{} bins missed: {missed:#?}", missed.len());
}

/// Random patches reach every bin too, but for some of the transitions; and they stay small.
#[test]
fn random_patches_reach_what_there_is() {
    let (mut coverage, mut points, mut cases) = (Coverage::new(), 0, 0);
    let mut random = SplitMix64::new(1);
    for (domain, config) in configurations() {
        for _ in 0..4000 {
            let case = Case { config, factors: random_patch(domain, &mut random) };
            coverage.record(&case);
            points += u64::from(case.patch().counts().points);
            cases += 1;
        }
    }
    let (transitions, others): (Vec<_>, Vec<_>) =
        coverage.missed().partition(|bin| bin.starts_with("transition/"));
    assert!(others.is_empty(), "{others:?}");
    assert!(transitions.len() < 1000, "{} transitions missed", transitions.len());
    let mean = points / cases;
    assert!((20..120).contains(&mean), "{mean} points in the mean");
}

#[test]
fn coverage_notices_what_is_missing() {
    let mut coverage = Coverage::new();
    assert!(coverage.groups().iter().all(|group| group.hit == 0), "nothing is hit at first");
    level(Level::One).iter().take(100).for_each(|case| coverage.record(case));
    let missed = coverage.missed().filter(|bin| bin.starts_with("transition/")).count();
    assert!(missed > 3000, "100 cases cannot hit every transition, {missed} missed");
}

#[test]
fn same_arguments_give_the_same_cases() {
    assert_eq!(level(Level::One), level(Level::One), "level 1");
    let seeded = |seed| {
        let selection = Selection { random: Some(100), ..Selection::level(Level::Three, seed) };
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
    for part in 0..parts {
        let shard = Shard { part, of: parts };
        let mine: Vec<u64> = (0..1000).filter(|&i| shard.has(i)).collect();
        let numbered: Option<Vec<u64>> = (0..shard.items(1000)).map(|n| shard.item(n)).collect();
        assert_eq!(numbered, Some(mine), "part {part}, item by item");
    }
    assert_eq!(Shard { part: 9, of: 20 }.items(9), 0, "no item for this part");
}

#[test]
fn level_1_stays_small_enough_to_simulate() {
    let cases = level(Level::One);
    let elements: u64 = cases
        .iter()
        .map(|case| case.patch().counts())
        .map(|counts| u64::from(counts.points + counts.indices))
        .sum();
    assert!((5_000..60_000).contains(&cases.len()), "{} cases", cases.len());
    assert!(elements < 40_000_000, "{elements} points and indices");
}
