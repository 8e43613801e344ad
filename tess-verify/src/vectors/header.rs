//! The first line of a vector file.

use super::error::VectorError;
use super::lines::Line;
use super::row::decimal;
use crate::names::{Named, named};
use crate::quote::quoted;
use std::fmt;

named! {
    /// The kind of a vector file's records.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    #[non_exhaustive]
    pub enum Kind: "kind" {
        /// Whole outputs.
        Listings = "listings",
        /// Single patches: counts and digests.
        Patches = "patches",
        /// Rows of 64 patches of a systematic sweep, with one chained digest.
        Sweep = "sweep",
        /// Rows of up to 100 patches with all factors equal, with one chained digest.
        Uniform = "uniform",
        /// All factors with one integer part: digests of contexts and locations.
        Locations = "locations",
        /// All binary32 numbers of a binade: digests of processed factors.
        Factors = "factors",
        /// Factor preparation.
        Preparation = "preparation",
    }
}

impl Kind {
    /// Whether each record is one patch.
    #[must_use]
    pub const fn has_cases(self) -> bool {
        matches!(self, Self::Listings | Self::Patches | Self::Preparation)
    }

    /// The line of column names of a CSV kind; `None` for listings.
    pub(crate) const fn columns(self) -> Option<&'static str> {
        Some(match self {
            Self::Listings => return None,
            Self::Patches => {
                "domain,partitioning,output,split,factors_f32_hex,points,indices,points_fnv1a64,indices_fnv1a64"
            }
            Self::Sweep | Self::Uniform => "domain,partitioning,output,row,cases,chain_fnv1a64",
            Self::Locations => {
                "split,parity,factor_bucket,contexts_fnv1a64,locations_fnv1a64,locations"
            }
            Self::Factors => "partitioning,exponent,outer_fnv1a64,inside_fnv1a64",
            Self::Preparation => {
                "domain,partitioning,reduction,axis,output,input_f32_hex,unrounded_f32_hex,rounded_f32_hex,\
                 points,indices,points_fnv1a64,indices_fnv1a64"
            }
        })
    }
}

/// The first line of a file: `# tess-vectors 1 kind=KIND count=COUNT source=SOURCE KEY=VALUE...`.
///
/// It displays as that line. If the count is left out, the last line of the file is `# end`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Header {
    /// The kind of the records.
    pub kind: Kind,
    /// The number of records that follow; `None` if the file marks its end instead.
    pub count: Option<u64>,
    /// The origin of the results, for people; nothing depends on it.
    pub source: String,
    /// The producer's notes as keys and values, such as a level and a seed.
    pub notes: Vec<(String, String)>,
}

impl fmt::Display for Header {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, count, source, notes } = self;
        write!(f, "{MAGIC} {VERSION} kind={}", kind.name())?;
        count.map_or(Ok(()), |count| write!(f, " count={count}"))?;
        write!(f, " source={source}")?;
        notes.iter().try_for_each(|(key, value)| write!(f, " {key}={value}"))
    }
}

pub(super) const MAGIC: &str = "# tess-vectors";
/// The last line of a file that has no count.
pub(super) const END: &str = "# end";
const VERSION: &str = "1";

impl Header {
    /// The text before the records: this line, and the column names if the kind is CSV.
    #[must_use]
    pub fn head(&self) -> String {
        let columns = self.kind.columns().map(|columns| format!("{columns}\n"));
        format!("{self}\n{}", columns.unwrap_or_default())
    }

    /// The message for a file that begins with `instead`.
    pub(super) fn missing(instead: &str) -> String {
        format!(
            "a vector file starts with `{MAGIC} {VERSION} kind=... count=... source=...`, not with \
             {instead}"
        )
    }

    /// Parses the first line of a file.
    pub(super) fn parse(line: Line<'_>) -> Result<Self, VectorError> {
        let rest = line.text.strip_prefix(MAGIC).and_then(|rest| rest.strip_prefix(' '));
        let Some(rest) = rest else {
            return Err(line.error("header", Self::missing(&quoted(line.text))));
        };
        let mut words = rest.split(' ').filter(|word| !word.is_empty());
        let version = words.next().unwrap_or("");
        if version != VERSION {
            let version = quoted(version);
            let message = format!("format version {version} is unknown, expected {VERSION}");
            return Err(line.error("header", message));
        }
        let mut pairs = pairs(line, words)?;
        let mut take = |key: &'static str| {
            let at = pairs.iter().position(|(known, _)| known == key)?;
            Some(pairs.remove(at).1)
        };
        let (kind, count, source) = (take("kind"), take("count"), take("source"));
        let missing = |key| move || line.error(key, "missing in the header");
        let (kind, source) =
            (kind.ok_or_else(missing("kind"))?, source.ok_or_else(missing("source"))?);
        let kind = Kind::from_name(&kind).map_err(|error| line.error("kind", error.to_string()))?;
        let count = count.map(|count| parse_count(&count, line)).transpose()?;
        Ok(Self { kind, count, source, notes: pairs })
    }
}

/// The words `KEY=VALUE`; each key may occur once.
fn pairs<'a>(
    line: Line<'_>,
    words: impl Iterator<Item = &'a str>,
) -> Result<Vec<(String, String)>, VectorError> {
    let mut pairs: Vec<(String, String)> = Vec::new();
    for word in words {
        let Some((key, value)) = word.split_once('=') else {
            return Err(line.error("header", format!("{} is not KEY=VALUE", quoted(word))));
        };
        if pairs.iter().any(|(known, _)| known == key) {
            return Err(line.error("header", format!("{} is given twice", quoted(key))));
        }
        pairs.push((key.to_owned(), value.to_owned()));
    }
    Ok(pairs)
}

fn parse_count(text: &str, line: Line<'_>) -> Result<u64, VectorError> {
    match decimal(text) {
        Some(count) => Ok(count),
        None => Err(line.error("count", format!("{} is not a number", quoted(text)))),
    }
}
