//! Test vectors in three levels: same arguments, same cases, in the same order.
//!
//! - Level 1 has every boundary once. It hits every coverage bin and is small enough to simulate.
//! - Level 2 has every boundary in every position, and every pair of counts.
//! - Level 3 is random.
//! - `Rules` has families of patches that the rules of the standards compare.
//!
//! Each level ends with random cases.

#[cfg(feature = "arbitrary")]
mod arbitrary;
mod boundaries;
mod choices;
mod levels;
mod patches;
mod random;
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

/// How much is generated: `--level` of `tess gen`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum GenLevel {
    /// Every boundary once.
    One,
    /// Every boundary in every position, every pair of counts.
    Two,
    /// Random.
    Three,
    /// Families of related patches: `tess gen --rules`.
    Rules,
}

/// The version of the levels. It grows when a level or `Rules` gets other cases, so that a file
/// says which it has; level 3 never changed.
pub const LEVEL_VERSION: u8 = 3;

/// One of `of` disjoint parts that together are everything.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shard {
    /// Number of this part, less than `of`.
    pub part: u64,
    /// Number of parts, at least 1.
    pub of: u64,
}

impl Shard {
    /// Everything in one part.
    pub const WHOLE: Self = Self { part: 0, of: 1 };

    /// Whether item `i` belongs to this part.
    ///
    /// # Panics
    /// If there are no parts.
    #[must_use]
    pub const fn has(&self, i: u64) -> bool {
        i % self.of == self.part
    }

    /// How many of `count` items belong to this part.
    ///
    /// # Panics
    /// If there are no parts.
    #[must_use]
    pub const fn items(&self, count: u64) -> u64 {
        count.saturating_sub(self.part).div_ceil(self.of)
    }

    /// The number of this part's item `n` among all items; `None` beyond 2^64.
    pub(crate) fn item(&self, n: u64) -> Option<u64> {
        n.checked_mul(self.of)?.checked_add(self.part)
    }
}

/// The cases to generate.
#[derive(Clone, Copy, Debug)]
pub struct Selection {
    /// How much.
    pub level: GenLevel,
    /// Seed of everything random.
    pub seed: u64,
    /// Number of random cases; `None` for the level's own number.
    pub random: Option<u64>,
    /// One domain only.
    pub domain: Option<Domain>,
    /// One partitioning only.
    pub partitioning: Option<Partitioning>,
    /// One output primitive only.
    pub output: Option<OutputPrimitive>,
    /// One split order only.
    pub split: Option<SplitOrder>,
}

impl Selection {
    /// A level with its own number of random cases, of every domain and partitioning.
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

    /// A case in a configuration that is selected: one of another domain keeps its factors in turn.
    ///
    /// A fuzz target for a device that has some configurations gives it such cases.
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

    /// The cases, in order.
    pub fn cases(self) -> impl Iterator<Item = Case> {
        let systematic = match self.level {
            GenLevel::One => levels::one(&self.choices()),
            GenLevel::Two => levels::two(&self.choices()),
            GenLevel::Three => Vec::new(),
            GenLevel::Rules => related::systematic(),
        };
        // Of levels 1 and 2 that is every case: they are made of what is selected.
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

    /// How many random cases there are: as many as asked for, or the level's own number.
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

    /// Random families, of the selected cases as many as are asked for.
    fn random_families(self) -> impl Iterator<Item = Case> {
        let random = SplitMix64::new(self.seed);
        let count = usize::try_from(self.random_count()).unwrap_or(usize::MAX);
        let Choices { domains, partitionings, splits, .. } = self.choices();
        let families = related::random(random, domains, partitionings, splits);
        // Every family has each output, so the filter leaves some of each.
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

/// The configurations of which each part is one of these, in the same order; an empty list stands
/// for all.
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

/// The binary32 with this 15.16 value, exact for values below 2^24; larger ones are rounded to
/// nearest even.
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
