//! The cases of a campaign: how they are made, how many there are, and their digest.
//!
//! ```text
//! set      level=3 level-version=3 seed=1 random=50           from which `tess merge` makes them again
//! asked    17 cases with the digest 7a..                      shard 1 of 3
//!          17 cases with the digest 03..                      shard 2
//!        + 16 cases with the digest c9..                      shard 3
//!        = 50 cases with the digest of the whole set
//! ```
//!
//! A case counts by its line. Its hash is the first half of the line's SHA-256, as a number with
//! the first byte on top; a digest is the sum of hashes modulo 2^128. So it depends on how often
//! each case occurs, not on the order, and digests of parts add up.

use rayon::iter::{ParallelBridge, ParallelIterator};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::fmt::{self, Display};
use tess_verify::check::{Subject, units};
use tess_verify::generate::{GenLevel, LEVEL_VERSION, Selection};
use tess_verify::{Case, Named};

/// How many cases, and their digest.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct CaseSum {
    pub(crate) cases: u64,
    #[serde(with = "hex")]
    digest: u128,
}

impl CaseSum {
    /// Adds a case by its line.
    pub(crate) fn add(&mut self, case: &impl Display) {
        self.join(Self { cases: 1, digest: hash(case.to_string().as_bytes()) });
    }

    /// Adds the cases of another sum. The number saturates, because another program's report may
    /// hold any.
    pub(crate) fn join(&mut self, other: Self) {
        self.cases = self.cases.saturating_add(other.cases);
        self.digest = self.digest.wrapping_add(other.digest);
    }

    /// The sum of some cases.
    pub(crate) fn of<T: Display>(cases: impl IntoIterator<Item = T>) -> Self {
        let mut sum = Self::default();
        cases.into_iter().for_each(|case| sum.add(&case));
        sum
    }
}

impl Display for CaseSum {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} cases with the digest {:032x}", self.cases, self.digest)
    }
}

/// The digest as 32 hex digits.
mod hex {
    use serde::{Deserialize, Deserializer, Serializer, de::Error};

    pub(super) fn serialize<S: Serializer>(digest: &u128, to: S) -> Result<S::Ok, S::Error> {
        to.serialize_str(&format!("{digest:032x}"))
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(from: D) -> Result<u128, D::Error> {
        let text = String::deserialize(from)?;
        let is_hex = text.len() == 32 && text.bytes().all(|digit| digit.is_ascii_hexdigit());
        let digest = u128::from_str_radix(&text, 16).ok().filter(|_| is_hex);
        digest.ok_or_else(|| D::Error::custom(format!("a digest has 32 hex digits, not `{text}`")))
    }
}

/// The first half of the SHA-256 of some bytes.
pub(super) fn hash(bytes: &[u8]) -> u128 {
    let whole = Sha256::digest(bytes);
    whole.iter().take(16).fold(0, |hash, byte| hash << 8 | u128::from(*byte))
}

/// How the cases of all shards together are made: words `KEY=VALUE`, as in the first line of a
/// vector file.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(transparent)]
pub(crate) struct CaseSet(String);

impl Display for CaseSet {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.0)
    }
}

const LEVEL: &str = "level";
const VERSION: &str = "level-version";
/// The keys that describe a selection.
const SELECTION: [&str; 8] =
    [LEVEL, VERSION, "seed", "random", "domain", "partitioning", "output", "split"];
/// The cases are asked of a device that lacks some configurations.
const DEVICE: &str = "device=vulkan";

const LEVELS: [(&str, GenLevel); 4] = [
    ("1", GenLevel::One),
    ("2", GenLevel::Two),
    ("3", GenLevel::Three),
    ("rules", GenLevel::Rules),
];

impl CaseSet {
    /// The cases of a selection.
    pub(crate) fn of(selection: &Selection) -> Self {
        let level = LEVELS.iter().find(|(_, level)| *level == selection.level);
        let mut words = vec![
            format!("{LEVEL}={}", level.map_or("", |(name, _)| name)),
            format!("{VERSION}={LEVEL_VERSION}"),
            format!("seed={}", selection.seed),
            format!("random={}", selection.random_count()),
        ];
        let Selection { domain, partitioning, output, split, .. } = selection;
        words.extend(domain.map(|domain| format!("domain={}", domain.name())));
        words.extend(partitioning.map(|spacing| format!("partitioning={}", spacing.name())));
        words.extend(output.map(|output| format!("output={}", output.name())));
        words.extend(split.map(|split| format!("split={}", split.name())));
        Self(words.join(" "))
    }

    /// The cases of a selection as a Vulkan device is asked them.
    #[cfg(feature = "probe")]
    pub(crate) fn of_device(selection: &Selection) -> Self {
        Self(format!("{} {DEVICE}", Self::of(selection)))
    }

    /// The cases of these subjects of a comparison.
    pub(crate) fn of_subjects(subjects: &[Subject]) -> Self {
        let names: Vec<&str> = subjects.iter().map(|subject| subject.name()).collect();
        let mut set = format!("subjects={} {VERSION}={LEVEL_VERSION}", names.join(","));
        for subject in subjects {
            if let Subject::Random { patches, seed } = subject {
                set += &format!(" patches={patches} seed={seed}");
            }
        }
        Self(set)
    }

    /// The cases that the notes of a vector file describe; `None` if they name no level.
    pub(crate) fn of_notes(notes: &[(String, String)]) -> Option<Self> {
        let own = notes.iter().filter(|(key, _)| Self::describes(key));
        let words: Vec<String> = own.map(|(key, value)| format!("{key}={value}")).collect();
        notes.iter().any(|(key, _)| key == LEVEL).then(|| Self(words.join(" ")))
    }

    /// Whether a note with this key describes the cases of a file.
    pub(crate) fn describes(key: &str) -> bool {
        SELECTION.contains(&key)
    }

    /// The notes of a vector file of these cases.
    pub(crate) fn notes(&self) -> Vec<(String, String)> {
        self.pairs().map(|(key, value)| (key.to_owned(), value.to_owned())).collect()
    }

    fn pairs(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0.split(' ').map(|word| word.split_once('=').unwrap_or((word, "")))
    }

    /// The cases, in order, if they are those of a selection.
    ///
    /// # Errors
    /// Why this program cannot make them.
    pub(crate) fn cases(&self) -> Result<Box<dyn Iterator<Item = Case> + Send>, String> {
        let set = self.0.strip_suffix(DEVICE);
        let selection = Self(set.unwrap_or(&self.0).trim_end().to_owned()).selection()?;
        match (set, selection.level) {
            (None, _) => Ok(Box::new(selection.cases())),
            #[cfg(feature = "probe")]
            (Some(_), GenLevel::Rules) => {
                Ok(Box::new(tess_probe::rule_cases(selection).into_iter()))
            }
            #[cfg(feature = "probe")]
            (Some(_), _) => {
                let whole = tess_verify::generate::Shard::WHOLE;
                Ok(Box::new(tess_probe::cases(selection, whole).into_iter()))
            }
            #[cfg(not(feature = "probe"))]
            (Some(_), _) => Err("this build of tess leaves `probe` out".to_owned()),
        }
    }

    /// The selection that the words describe.
    fn selection(&self) -> Result<Selection, String> {
        let mut selection = Selection::level(GenLevel::One, 1);
        let mut version = "1"; // files of the first version do not name it
        for (key, value) in self.pairs() {
            let wrong = || format!("`{key}={value}` is unknown to this program");
            let number = || value.parse().map_err(|_| wrong());
            match key {
                LEVEL => {
                    let level = LEVELS.iter().find(|(name, _)| *name == value);
                    selection.level = level.map(|(_, level)| *level).ok_or_else(wrong)?;
                }
                VERSION => version = value,
                "seed" => selection.seed = number()?,
                "random" => selection.random = Some(number()?),
                "domain" => selection.domain = Some(named(value).ok_or_else(wrong)?),
                "partitioning" => selection.partitioning = Some(named(value).ok_or_else(wrong)?),
                "output" => selection.output = Some(named(value).ok_or_else(wrong)?),
                "split" => selection.split = Some(named(value).ok_or_else(wrong)?),
                _ => return Err(wrong()),
            }
        }
        if selection.level != GenLevel::Three {
            require(version)?; // the cases of level 3 are the same in every version
        }
        Ok(selection)
    }

    /// The subjects that the words describe; `None` if they describe a selection.
    fn subjects(&self) -> Option<Result<Vec<Subject>, String>> {
        let value = |key| self.pairs().find(|(known, _)| *known == key).map(|(_, value)| value);
        let names = value("subjects")?;
        let wrong = || format!("`{self}` is unknown to this program");
        let number = |key| value(key).and_then(|text| text.parse().ok()).ok_or_else(wrong);
        let subject = |name: &str| match name {
            "random" => Ok(Subject::Random { patches: number("patches")?, seed: number("seed")? }),
            _ => named(name).ok_or_else(wrong),
        };
        let version = require(value(VERSION).unwrap_or_default());
        Some(version.and_then(|()| names.split(',').map(subject).collect()))
    }

    /// The sums of the cases of each of so many shards.
    ///
    /// # Errors
    /// Why this program cannot make the cases.
    pub(crate) fn sums(&self, shards: u64) -> Result<Vec<CaseSum>, String> {
        let Some(subjects) = self.subjects() else {
            return Ok(summed(self.cases()?, shards, |case| CaseSum::of([case])));
        };
        let units = subjects?.into_iter().map(units);
        let sums = units.map(|units| summed(units, shards, |unit| CaseSum::of(unit.cases())));
        Ok(sums.fold(none(shards), joined))
    }
}

/// Refuses levels of another version. Errors: says so.
fn require(version: &str) -> Result<(), String> {
    if version == LEVEL_VERSION.to_string() {
        return Ok(());
    }
    Err(format!("the levels have version {version}; this program makes version {LEVEL_VERSION}"))
}

fn named<T: Named>(name: &str) -> Option<T> {
    T::from_name(name).ok()
}

/// The sums of each shard; item i is one of shard i modulo `shards`.
fn summed<T: Send>(
    items: impl Iterator<Item = T> + Send,
    shards: u64,
    sum: impl Fn(T) -> CaseSum + Sync,
) -> Vec<CaseSum> {
    let add = |mut sums: Vec<CaseSum>, (shard, item): (usize, T)| {
        sums[shard].join(sum(item));
        sums
    };
    let numbered = (0..usize::try_from(shards).unwrap_or(usize::MAX)).cycle().zip(items);
    numbered.par_bridge().fold(|| none(shards), add).reduce(|| none(shards), joined)
}

fn none(shards: u64) -> Vec<CaseSum> {
    (0..shards).map(|_| CaseSum::default()).collect()
}

fn joined(mut sums: Vec<CaseSum>, others: Vec<CaseSum>) -> Vec<CaseSum> {
    sums.iter_mut().zip(others).for_each(|(sum, other)| sum.join(other));
    sums
}
