//! Cuts the subjects of a comparison into units.

use super::subject::Subject;
use super::topologies::{interiors, transitions};
use crate::case::Case;
use crate::generate::SplitMix64;
use crate::generate::{GenLevel, Selection, configurations, random_patch};
use crate::names::Named;
use std::collections::HashSet;
use tess_core::{Config, Domain, Parity, Partitioning, SplitOrder};

/// Random patches of one configuration, drawn from a seed of their own.
#[derive(Clone, Copy, Debug)]
pub(super) struct RandomUnit {
    domain: Domain,
    config: Config,
    seed: u64,
    patches: u64,
}

impl RandomUnit {
    /// The patches, the same each time.
    pub(super) fn cases(&self) -> Vec<Case> {
        let &Self { domain, config, seed, patches } = self;
        let mut random = SplitMix64::new(seed);
        let case = |_| Case { config, factors: random_patch(domain, &mut random) };
        (0..patches).map(case).collect()
    }
}

/// A part of a subject that is compared by itself.
#[derive(Clone, Debug)]
pub struct Unit(pub(super) Work);

/// The work of a unit.
#[derive(Clone, Debug)]
pub(super) enum Work {
    /// Whole patches.
    Patches(Vec<Case>),
    /// Random patches of one configuration.
    Random(RandomUnit),
    /// Factor processing of 2^20 binary32 numbers with consecutive bit patterns.
    Values {
        /// The partitioning.
        partitioning: Partitioning,
        /// The first bit pattern.
        first: u32,
    },
    /// Contexts and locations of all fixed-point factors with one integer part.
    Bucket {
        /// The split order.
        split: SplitOrder,
        /// The parity.
        parity: Parity,
        /// The integer part.
        bucket: u32,
    },
}

impl Unit {
    /// A line for each of its cases: the line of a patch, or a name of a range of values. No other
    /// unit of any subject has an equal line for other work.
    #[must_use]
    pub fn cases(&self) -> Vec<String> {
        let lines = |cases: &[Case]| cases.iter().map(Case::to_string).collect();
        match &self.0 {
            Work::Patches(cases) => lines(cases),
            Work::Random(unit) => lines(&unit.cases()),
            Work::Values { partitioning, first } => {
                let last = first + (VALUES - 1);
                vec![format!("factors {} {first:08x} to {last:08x}", partitioning.name())]
            }
            Work::Bucket { split, parity, bucket } => {
                vec![format!("locations {} {} {bucket}", split.name(), parity.name())]
            }
        }
    }
}

/// The units of a subject, in the order in which shards count them. Each is made when it is its
/// turn.
pub fn units(subject: Subject) -> impl Iterator<Item = Unit> + Send {
    let units = Units::of(subject);
    (0..units.count()).filter_map(move |number| units.get(number))
}

/// The number of binary32 numbers per unit.
pub(super) const VALUES: u32 = 1 << 20;
/// The number of units that cover the binary32 numbers, per partitioning.
const VALUE_UNITS: u64 = (1 << 32) / VALUES as u64;
/// The largest number of patches in a unit.
const PATCHES: usize = 1024;
/// The largest number of random patches in a unit. It is larger, because such a unit is one batch
/// of one configuration.
const RANDOM_PATCHES: u64 = 4096;

/// The units of a subject, the same and in the same order each time.
///
/// A unit is made on request, because not all of them may fit into memory.
#[derive(Clone, Debug)]
pub(super) struct Units(UnitSource);

#[derive(Clone, Debug)]
enum UnitSource {
    Patches(Vec<Case>),
    Random { patches: u64, seed: u64, configurations: Vec<(Domain, Config)> },
    Values,
    Buckets(Vec<(SplitOrder, Parity, u32)>),
}

impl Units {
    /// The units of `subject`.
    pub(super) fn of(subject: Subject) -> Self {
        Self(match subject {
            Subject::Level1 => {
                UnitSource::Patches(Selection::level(GenLevel::One, 1).cases().collect())
            }
            Subject::Level2 => UnitSource::Patches(beyond_level_one().collect()),
            Subject::Factors => UnitSource::Values,
            Subject::Locations => UnitSource::Buckets(buckets().collect()),
            Subject::Transitions => UnitSource::Patches(transitions().collect()),
            Subject::Interiors => UnitSource::Patches(interiors().collect()),
            Subject::Random { patches, seed } => {
                UnitSource::Random { patches, seed, configurations: configurations().collect() }
            }
        })
    }

    /// The number of units.
    pub(super) fn count(&self) -> u64 {
        match &self.0 {
            UnitSource::Patches(cases) => cases.len().div_ceil(PATCHES) as u64,
            UnitSource::Random { patches, configurations, .. } => {
                patches.div_ceil(RANDOM_PATCHES) * configurations.len() as u64
            }
            UnitSource::Values => Partitioning::ALL.len() as u64 * VALUE_UNITS,
            UnitSource::Buckets(buckets) => buckets.len() as u64,
        }
    }

    /// Unit `number`; `None` if it is not below [`Units::count`].
    pub(super) fn get(&self, number: u64) -> Option<Unit> {
        self.work(number).map(Unit)
    }

    fn work(&self, number: u64) -> Option<Work> {
        let index = usize::try_from(number).ok()?;
        match &self.0 {
            UnitSource::Patches(cases) => {
                cases.chunks(PATCHES).nth(index).map(|cases| Work::Patches(cases.to_vec()))
            }
            UnitSource::Random { patches, seed, configurations } => {
                let of_each = patches.div_ceil(RANDOM_PATCHES);
                let configuration = usize::try_from(number.checked_div(of_each)?).ok()?;
                let &(domain, config) = configurations.get(configuration)?;
                let number = number % of_each;
                let seed = seed_of_unit(*seed, configuration, number);
                let patches = RANDOM_PATCHES.min(patches - number * RANDOM_PATCHES);
                Some(Work::Random(RandomUnit { domain, config, seed, patches }))
            }
            UnitSource::Values => {
                let &partitioning =
                    Partitioning::ALL.get(usize::try_from(number / VALUE_UNITS).ok()?)?;
                let first = u32::try_from(number % VALUE_UNITS).ok()? * VALUES;
                Some(Work::Values { partitioning, first })
            }
            UnitSource::Buckets(buckets) => {
                let &(split, parity, bucket) = buckets.get(index)?;
                Some(Work::Bucket { split, parity, bucket })
            }
        }
    }
}

/// The seed of a unit: the configuration's seed is drawn from the subject's, and the unit's from
/// the configuration's.
fn seed_of_unit(seed: u64, configuration: usize, number: u64) -> u64 {
    let of_configuration = SplitMix64::after(seed, configuration as u64).next_u64();
    SplitMix64::after(of_configuration, number).next_u64()
}

/// The cases of level 2 that level 1 does not have.
fn beyond_level_one() -> impl Iterator<Item = Case> {
    let known: HashSet<Case> = Selection::level(GenLevel::One, 1).cases().collect();
    Selection::level(GenLevel::Two, 1).cases().filter(move |case| !known.contains(case))
}

fn buckets() -> impl Iterator<Item = (SplitOrder, Parity, u32)> {
    let parities = |split| [Parity::Even, Parity::Odd].map(|parity| (split, parity));
    SplitOrder::ALL.into_iter().flat_map(parities).flat_map(|(split, parity)| {
        let integers = match parity {
            Parity::Even => 2..=64,
            Parity::Odd => 1..=63,
        };
        integers.map(move |bucket| (split, parity, bucket))
    })
}
