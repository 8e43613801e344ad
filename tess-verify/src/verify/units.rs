//! What there is to compare, cut into units.

use crate::case::{Case, factor_bits, factors_from_list};
use crate::generate::{Level, Selection, configurations, random_patch};
use crate::names::Named;
use crate::random::SplitMix64;
use std::collections::HashSet;
use tess_core::{Config, Domain, OutputPrimitive, Parity, Partitioning, SplitOrder};

/// Something that can be compared.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Subject {
    /// The generated level 1.
    Level1,
    /// What the generated level 2 has beyond level 1.
    Level2,
    /// All 2^32 binary32 factors, as outer and as inside factor, in every partitioning.
    Factors,
    /// All fixed-point factors: contexts and locations, in both parities and split orders.
    Locations,
    /// All pairs of an outer and an inside factor, in both split orders.
    Transitions,
    /// All pairs of inside factors, and all isolines.
    Interiors,
    /// Random patches.
    Random(Random),
}

impl Subject {
    /// Every subject that is finite, the fastest first.
    pub const ALL: [Self; 6] = [
        Self::Level1,
        Self::Transitions,
        Self::Interiors,
        Self::Level2,
        Self::Locations,
        Self::Factors,
    ];
}

impl Named for Subject {
    const WHAT: &'static str = "subject";
    const NAMES: &'static [(&'static str, Self)] = &[
        ("level-1", Self::Level1),
        ("level-2", Self::Level2),
        ("factors", Self::Factors),
        ("locations", Self::Locations),
        ("transitions", Self::Transitions),
        ("interiors", Self::Interiors),
    ];

    fn name(self) -> &'static str {
        let finite = Self::NAMES.iter().find(|(_, subject)| *subject == self);
        finite.map_or("random", |(name, _)| name)
    }
}

/// Random patches of every configuration: every domain, partitioning, output and split order.
///
/// Each unit is drawn from a seed of its own, so that more patches begin with the same ones.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Random {
    /// How many patches of each configuration.
    pub patches: u64,
    /// Seed of all of them.
    pub seed: u64,
}

/// Random patches of one configuration, from a seed of their own.
#[derive(Clone, Copy, Debug)]
pub struct RandomUnit {
    domain: Domain,
    config: Config,
    seed: u64,
    patches: u64,
}

impl RandomUnit {
    /// The patches, always the same.
    #[must_use]
    pub fn cases(&self) -> Vec<Case> {
        let &Self { domain, config, seed, patches } = self;
        let mut random = SplitMix64::new(seed);
        let case = |_| Case { config, factors: random_patch(domain, &mut random) };
        (0..patches).map(case).collect()
    }
}

/// A part of a subject.
#[derive(Clone, Debug)]
pub enum Unit {
    /// Whole patches.
    Patches(Vec<Case>),
    /// Random patches of one configuration.
    Random(RandomUnit),
    /// Factor processing of the binary32 numbers with 2^20 consecutive bit patterns.
    Values {
        /// The partitioning.
        partitioning: Partitioning,
        /// The first bits.
        first: u32,
    },
    /// Contexts and locations of all fixed-point factors with one integer part.
    Bucket {
        /// Split order.
        split: SplitOrder,
        /// Parity.
        parity: Parity,
        /// Integer part.
        bucket: u32,
    },
}

/// How many binary32 numbers a unit has.
pub(super) const VALUES: u32 = 1 << 20;
/// How many patches a unit has at most.
const PATCHES: usize = 1024;
/// How many random patches a unit has at most: large batches, as each is one configuration's.
const RANDOM_PATCHES: u64 = 4096;

/// The units of a subject, always the same in the same order.
#[must_use]
pub fn units(subject: Subject) -> Vec<Unit> {
    match subject {
        Subject::Level1 => patches(Selection::level(Level::One, 1).cases()),
        Subject::Level2 => patches(beyond_level_one()),
        Subject::Factors => values().collect(),
        Subject::Locations => buckets().collect(),
        Subject::Transitions => patches(transitions()),
        Subject::Interiors => patches(interiors()),
        Subject::Random(random) => random_units(random).collect(),
    }
}

fn patches(cases: impl Iterator<Item = Case>) -> Vec<Unit> {
    let cases: Vec<Case> = cases.collect();
    cases.chunks(PATCHES).map(|cases| Unit::Patches(cases.to_vec())).collect()
}

/// The cases of level 2, most of which level 1 does not have, without those that it has.
fn beyond_level_one() -> impl Iterator<Item = Case> {
    let key = |case: &Case| (case.config, case.domain(), factor_bits(&case.factors));
    let known: HashSet<_> =
        Selection::level(Level::One, 1).cases().map(|case| key(&case)).collect();
    Selection::level(Level::Two, 1).cases().filter(move |case| !known.contains(&key(case)))
}

/// Configuration by configuration.
fn random_units(random: Random) -> impl Iterator<Item = Unit> {
    let mut seeds = SplitMix64::new(random.seed);
    configurations().flat_map(move |(domain, config)| {
        let mut seeds = SplitMix64::new(seeds.next_u64());
        (0..random.patches.div_ceil(RANDOM_PATCHES)).map(move |number| {
            let patches = RANDOM_PATCHES.min(random.patches - number * RANDOM_PATCHES);
            Unit::Random(RandomUnit { domain, config, seed: seeds.next_u64(), patches })
        })
    })
}

fn values() -> impl Iterator<Item = Unit> {
    Partitioning::ALL.into_iter().flat_map(|partitioning| {
        let starts = (0..=u32::MAX).step_by(VALUES as usize);
        starts.map(move |first| Unit::Values { partitioning, first })
    })
}

fn buckets() -> impl Iterator<Item = Unit> {
    let parities = |split| [Parity::Even, Parity::Odd].map(|parity| (split, parity));
    SplitOrder::ALL.into_iter().flat_map(parities).flat_map(|(split, parity)| {
        let integers = match parity {
            Parity::Even => 2..=64,
            Parity::Odd => 1..=63,
        };
        integers.map(move |bucket| Unit::Bucket { split, parity, bucket })
    })
}

/// Integer factors reach every topology (spec section 12.8): a transition depends on the two point
/// counts alone. Four outer factors at a time, along either axis of a quad; three on a triangle.
fn transitions() -> impl Iterator<Item = Case> {
    let pairs = (1..=64u8).flat_map(|inside| (1..=64u8).map(move |outer| (outer, inside)));
    SplitOrder::ALL.into_iter().flat_map(move |split| {
        pairs.clone().flat_map(move |(outer, inside)| {
            let next = outer % 64 + 1;
            [
                integer(Domain::Quad, split, &[outer, 2, next, 1, 3, inside]),
                integer(Domain::Quad, split, &[1, outer, 3, next, inside, 4]),
                integer(Domain::Triangle, split, &[outer, next, 65 - outer, inside]),
            ]
            .into_iter()
            .flatten()
        })
    })
}

/// Triangles, quads of every two inside factors and isolines of every two factors.
fn interiors() -> impl Iterator<Item = Case> {
    let pairs = (1..=64u8).flat_map(|a| (1..=64u8).map(move |b| (a, b)));
    pairs.flat_map(|(a, b)| {
        let triangle = integer(Domain::Triangle, SplitOrder::Ruler, &[1, 2, 3, a]);
        [
            integer(Domain::Quad, SplitOrder::Ruler, &[1, 2, 3, 4, a, b]),
            integer(Domain::Isoline, SplitOrder::Ruler, &[a, b]),
            triangle.filter(|_| b == 1),
        ]
        .into_iter()
        .flatten()
    })
}

/// A patch with these integer factors; `None` for a wrong number of them.
fn integer(domain: Domain, split: SplitOrder, factors: &[u8]) -> Option<Case> {
    let factors: Vec<f32> = factors.iter().copied().map(f32::from).collect();
    let output = OutputPrimitive::TriangleCw;
    let config = Config { partitioning: Partitioning::Integer, output, split };
    factors_from_list(domain, &factors).map(|factors| Case { config, factors })
}
