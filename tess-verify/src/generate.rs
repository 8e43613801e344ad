//! Test vectors in levels: equal arguments give equal cases, in equal order.
//!
//! - Level 1 has every boundary once. It hits every coverage bin and is small enough to simulate.
//! - Level 2 has every boundary in every position, and every pair of counts.
//! - Level 3 is random.
//! - `Rules` has families of related patches, for the rules of the standards to compare.
//!
//! Each of them ends with random cases, if any are asked for.

#[cfg(feature = "arbitrary")]
mod arbitrary;
mod boundaries;
mod choices;
mod classes;
mod levels;
mod numbers;
mod patches;
mod random;
mod registers;
mod related;
mod thresholds;

pub use boundaries::boundary_factors;
use boundaries::{exceptional_factors, ordinary_factors, special_factors};
use patches::random_factor;
pub use patches::random_patch;
#[cfg(feature = "arbitrary")]
pub(crate) use patches::{factor_up_to, patch_of};
pub use random::SplitMix64;
pub use thresholds::thresholds;
pub(crate) use thresholds::{FIRST_NAN, FRAME, SIGN};

use crate::case::Case;
use choices::Choices;
use random::Draw;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors, SplitOrder};

/// How much to generate: `--level` of `tess gen`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GenLevel {
    /// Every boundary once.
    One,
    /// Every boundary in every position, and every pair of counts.
    Two,
    /// Only random cases.
    Three,
    /// Families of related patches: `tess gen --rules`.
    Rules,
}

/// The version of the levels. It is incremented when a level or `Rules` gets other cases; a file
/// records it. The cases of level 3 have never changed.
pub const LEVEL_VERSION: u8 = 5;

/// One of `of` disjoint parts that together make up the whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Number of this part, less than `of`.
    pub part: u64,
    /// The number of parts, at least 1.
    pub of: u64,
}

impl Shard {
    /// Everything, as a single part.
    pub const WHOLE: Self = Self { part: 0, of: 1 };

    /// Whether item `i` belongs to this part.
    ///
    /// # Panics
    /// If `of` is 0.
    #[must_use]
    pub const fn has(&self, i: u64) -> bool {
        i % self.of == self.part
    }

    /// How many of `count` items belong to this part.
    ///
    /// # Panics
    /// If `of` is 0.
    #[must_use]
    pub const fn items(&self, count: u64) -> u64 {
        count.saturating_sub(self.part).div_ceil(self.of)
    }

    /// The number, among all items, of this part's item `n`; `None` if it is 2^64 or more.
    pub(crate) fn item(&self, n: u64) -> Option<u64> {
        n.checked_mul(self.of)?.checked_add(self.part)
    }
}

/// The cases to generate.
#[derive(Clone, Copy, Debug)]
pub struct Selection {
    /// The level.
    pub level: GenLevel,
    /// The seed of all random cases.
    pub seed: u64,
    /// Number of random cases; `None` for the level's own number.
    pub random: Option<u64>,
    /// Only this domain; `None` for all.
    pub domain: Option<Domain>,
    /// Only this partitioning; `None` for all.
    pub partitioning: Option<Partitioning>,
    /// Only this output primitive; `None` for all.
    pub output: Option<OutputPrimitive>,
    /// Only this split order; `None` for all.
    pub split: Option<SplitOrder>,
}

impl Selection {
    /// A level with its own number of random cases, in every domain and configuration.
    #[must_use]
    pub const fn level(level: GenLevel, seed: u64) -> Self {
        Self {
            level,
            seed,
            random: None,
            domain: None,
            partitioning: None,
            output: None,
            split: None,
        }
    }

    /// Moves a case into a selected configuration. If its domain changes, the new domain's factors
    /// take the values of the old ones in turn.
    ///
    /// A fuzz target for a device that supports only some configurations uses this.
    #[must_use]
    pub fn fit(&self, case: &Case) -> Case {
        let Config { partitioning, output, split } = case.config;
        let config = Config {
            partitioning: self.partitioning.unwrap_or(partitioning),
            output: self.output.unwrap_or(output),
            split: self.split.unwrap_or(split),
        };
        let domain = self.domain.filter(|domain| *domain != case.domain());
        let factors: Vec<f32> = case.factors.iter().collect();
        let in_turn = |i: usize| factors[i % factors.len()];
        let factors = domain.map_or(case.factors, |domain| PatchFactors::from_fn(domain, in_turn));
        Case { config, factors }
    }

    /// The selected cases, in order.
    pub fn cases(self) -> impl Iterator<Item = Case> {
        let systematic = match self.level {
            GenLevel::One => levels::one(&self.choices()),
            GenLevel::Two => levels::two(&self.choices()),
            GenLevel::Three => Vec::new(),
            GenLevel::Rules => related::systematic(&self.choices()),
        };
        // Levels 1 and 2 are built from the selection, so nothing of theirs is filtered out; of the
        // rules' patches, outputs are.
        let systematic = systematic.into_iter().filter(move |case| self.selects(case));
        let random: Box<dyn Iterator<Item = Case> + Send> = match self.level {
            GenLevel::Rules => Box::new(self.random_families()),
            _ => Box::new(self.random_cases()),
        };
        systematic.chain(random)
    }

    fn choices(self) -> Choices {
        Choices {
            domains: one_or(self.domain, &Domain::ALL),
            partitionings: one_or(self.partitioning, &Partitioning::ALL),
            outputs: one_or(self.output, &OutputPrimitive::ALL),
            splits: one_or(self.split, &SplitOrder::ALL),
        }
    }

    /// The number of random cases: as asked for, or the level's own number.
    #[must_use]
    pub const fn random_count(self) -> u64 {
        match (self.random, self.level) {
            (Some(count), _) => count,
            (None, GenLevel::One) => 500,
            (None, GenLevel::Two) => 20_000,
            (None, GenLevel::Three) => 1_000_000,
            (None, GenLevel::Rules) => 0,
        }
    }

    /// Cases of random families that are selected, as many as are asked for.
    fn random_families(self) -> impl Iterator<Item = Case> {
        let random = SplitMix64::new(self.seed);
        let count = usize::try_from(self.random_count()).unwrap_or(usize::MAX);
        let Choices { domains, partitionings, splits, .. } = self.choices();
        let families = related::random(random, domains, partitionings, splits);
        // Every family has each output, so the filter never runs dry.
        families.filter(move |case| self.selects(case)).take(count)
    }

    fn random_cases(self) -> impl Iterator<Item = Case> {
        let count = self.random_count();
        let mut random = SplitMix64::new(self.seed);
        let Choices { domains, partitionings, outputs, splits } = self.choices();
        (0..count).map(move |_| {
            let config = Config {
                partitioning: pick(&mut random, &partitionings),
                output: pick(&mut random, &outputs),
                split: pick(&mut random, &splits),
            };
            let domain = pick(&mut random, &domains);
            let factors = PatchFactors::from_fn(domain, |_| random_factor(&mut random));
            Case { config, factors }
        })
    }

    fn selects(&self, case: &Case) -> bool {
        let config = case.config;
        self.domain.is_none_or(|own| own == case.domain())
            && self.partitioning.is_none_or(|own| own == config.partitioning)
            && self.output.is_none_or(|own| own == config.output)
            && self.split.is_none_or(|own| own == config.split)
    }
}

fn one_or<T: Copy>(one: Option<T>, all: &[T]) -> Vec<T> {
    one.map_or(all.to_vec(), |one| vec![one])
}

/// Every domain with every configuration, in the order of spec section 1.
pub fn configurations() -> impl Iterator<Item = (Domain, Config)> {
    let outputs = |partitioning| OutputPrimitive::ALL.map(|output| (partitioning, output));
    let configs = Partitioning::ALL.into_iter().flat_map(outputs).flat_map(|(p, output)| {
        SplitOrder::ALL.map(|split| Config { partitioning: p, output, split })
    });
    Domain::ALL.into_iter().flat_map(move |domain| configs.clone().map(move |c| (domain, c)))
}

/// The configurations whose parts are all in these lists, in the same order; an empty list allows
/// all values.
pub fn configurations_among<'a>(
    domains: &'a [Domain],
    partitionings: &'a [Partitioning],
    outputs: &'a [OutputPrimitive],
    splits: &'a [SplitOrder],
) -> impl Iterator<Item = (Domain, Config)> + 'a {
    fn has<T: PartialEq>(some: &[T], one: &T) -> bool {
        some.is_empty() || some.contains(one)
    }
    configurations().filter(move |(domain, config)| {
        has(domains, domain)
            && has(partitionings, &config.partitioning)
            && has(outputs, &config.output)
            && has(splits, &config.split)
    })
}

pub(crate) fn pick<T: Copy>(random: &mut impl Draw, from: &[T]) -> T {
    from[random.below(u32::try_from(from.len()).unwrap_or(u32::MAX)) as usize]
}

/// The binary32 of a 15.16 number. It is exact below 2^24; larger numbers are rounded to nearest,
/// ties to even.
#[expect(
    clippy::cast_precision_loss,
    clippy::float_arithmetic,
    reason = "exact: 24 significant bits, scaled by a power of two"
)]
pub(crate) fn from_fixed(bits: u32) -> f32 {
    bits as f32 / 65536.0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_have_their_items_by_number() {
        for part in 0..7 {
            let shard = Shard { part, of: 7 };
            let mine: Vec<u64> = (0..1000).filter(|&i| shard.has(i)).collect();
            let numbered: Option<Vec<u64>> =
                (0..shard.items(1000)).map(|n| shard.item(n)).collect();
            assert_eq!(numbered, Some(mine), "part {part}, item by item");
        }
    }

    #[test]
    fn fixed_factors_beyond_24_bits_are_rounded() {
        for (bits, expected) in
            [(0x00FF_FFFF, 255.999_98), (0x0100_0001, 256.0), (u32::MAX, 65536.0)]
        {
            assert_eq!(from_fixed(bits).to_bits(), f32::to_bits(expected), "{bits:#x}");
        }
    }
}
