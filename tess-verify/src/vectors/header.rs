//! The first line of a vector file.

use super::error::{Place, VectorError};
use crate::names::Named;
use std::fmt;

/// What the records of a vector file are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Kind {
    /// Whole outputs.
    Listings,
    /// Single patches: counts and digests.
    Patches,
    /// Rows of 64 patches of a systematic sweep, one chained digest.
    Sweep,
    /// Rows of up to 100 patches with equal factors, one chained digest.
    Uniform,
    /// All fractions of a factor's integer part: digests of contexts and locations.
    Locations,
    /// All binary32 of a binade: digests of processed factors.
    Factors,
    /// Factor preparation.
    Preparation,
}

impl Named for Kind {
    const WHAT: &'static str = "kind";
    const NAMES: &'static [(&'static str, Self)] = &[
        ("listings", Self::Listings),
        ("patches", Self::Patches),
        ("sweep", Self::Sweep),
        ("uniform", Self::Uniform),
        ("locations", Self::Locations),
        ("factors", Self::Factors),
        ("preparation", Self::Preparation),
    ];
}

impl Kind {
    /// The column names of a CSV kind; `None` for listings.
    #[must_use]
    pub const fn columns(self) -> Option<&'static [&'static str]> {
        const CHAIN: &[&str] =
            &["domain", "partitioning", "output", "row", "cases", "chain_fnv1a64"];
        Some(match self {
            Self::Listings => return None,
            Self::Patches => &[
                "domain",
                "partitioning",
                "output",
                "split",
                "factors_f32_hex",
                "points",
                "indices",
                "points_fnv1a64",
                "indices_fnv1a64",
            ],
            Self::Sweep | Self::Uniform => CHAIN,
            Self::Locations => &[
                "split",
                "parity",
                "factor_bucket",
                "contexts_fnv1a64",
                "locations_fnv1a64",
                "locations",
            ],
            Self::Factors => &["partitioning", "exponent", "outer_fnv1a64", "inside_fnv1a64"],
            Self::Preparation => &[
                "domain",
                "partitioning",
                "reduction",
                "axis",
                "output",
                "input_f32_hex",
                "unrounded_f32_hex",
                "rounded_f32_hex",
                "points",
                "indices",
                "points_fnv1a64",
                "indices_fnv1a64",
            ],
        })
    }
}

/// The first line: `# tess-vectors 1 kind=KIND count=COUNT source=SOURCE KEY=VALUE...`.
///
/// Its text is that line.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Header {
    /// What the records are.
    pub kind: Kind,
    /// How many records follow, at least 1.
    pub count: u64,
    /// Where the results come from.
    pub source: String,
    /// Everything else that the producer says, such as a level and a seed.
    pub notes: Vec<(String, String)>,
}

impl fmt::Display for Header {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { kind, count, source, notes } = self;
        write!(f, "{MAGIC} {VERSION} kind={} count={count} source={source}", kind.name())?;
        notes.iter().try_for_each(|(key, value)| write!(f, " {key}={value}"))
    }
}

const MAGIC: &str = "# tess-vectors";
const VERSION: &str = "1";

impl Header {
    /// Whether the results are observations of a device under test: their source is neither the
    /// reference (`d3d11-reference...`) nor this project (`tess...`).
    #[must_use]
    pub fn is_from_device(&self) -> bool {
        !["d3d11-reference", "tess"].iter().any(|known| self.source.starts_with(known))
    }

    /// Parses the first line of a file.
    pub(super) fn parse(line: &str, place: &Place) -> Result<Self, VectorError> {
        let Some(rest) = line.strip_prefix(MAGIC) else {
            let what = if line.is_empty() { "an empty one" } else { "this one" };
            let message = format!(
                "a vector file starts with `{MAGIC} {VERSION} kind=... count=... source=...`, \
                 not with {what}"
            );
            return Err(place.error("header", message));
        };
        let mut words = rest.split_whitespace();
        let version = words.next().unwrap_or("");
        if version != VERSION {
            let message = format!("format version `{version}` is unknown, expected {VERSION}");
            return Err(place.error("header", message));
        }
        let mut pairs = Vec::new();
        for word in words {
            let Some((key, value)) = word.split_once('=') else {
                return Err(place.error("header", format!("`{word}` is not KEY=VALUE")));
            };
            if pairs.iter().any(|(known, _)| known == key) {
                return Err(place.error("header", format!("{key} is given twice")));
            }
            pairs.push((key.to_owned(), value.to_owned()));
        }
        let mut take = |key: &'static str| {
            let at = pairs.iter().position(|(known, _)| known == key);
            let pair = at.map(|at| pairs.remove(at));
            pair.map(|(_, value)| value).ok_or_else(|| place.error(key, "missing in the header"))
        };
        let (kind, count, source) = (take("kind")?, take("count")?, take("source")?);
        let kind =
            Kind::from_name(&kind).map_err(|error| place.error("kind", error.to_string()))?;
        Ok(Self { kind, count: parse_count(&count, place)?, source, notes: pairs })
    }
}

fn parse_count(text: &str, place: &Place) -> Result<u64, VectorError> {
    match text.parse() {
        Ok(0) => Err(place.error("count", "is 0; a file without records shows nothing")),
        Ok(count) => Ok(count),
        Err(_) => Err(place.error("count", format!("`{text}` is not a number"))),
    }
}
