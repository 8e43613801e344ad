//! One patch with its configuration, as a line of text.

use crate::names::Named;
use crate::quote::quoted;
use std::fmt;
use std::hash::{Hash, Hasher};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, Patch, PatchFactors, SplitOrder};

/// A configuration and raw factors: all inputs of a tessellation.
///
/// Written as text, it is the first line of a listing, `case DOMAIN PARTITIONING OUTPUT SPLIT
/// FACTOR...`. Each factor is the 8 hex digits of its binary32 bits, so printing loses nothing.
///
/// ```
/// use tess_verify::Case;
///
/// let line = "case tri fractional_odd triangle_cw ruler 40200000 40400000 3f800000 7fc00000";
/// let case: Case = line.parse()?;
/// assert_eq!(case.to_string(), line);
/// assert_eq!(
///     case.command(),
///     "tess patch tri --outer 0x40200000,0x40400000,0x3f800000 --inner 0x7fc00000 \
///      --partitioning fractional_odd --output triangle_cw --split ruler"
/// );
/// # Ok::<(), tess_verify::CaseError>(())
/// ```
#[derive(Clone, Copy, Debug)]
pub struct Case {
    /// How the patch is tessellated.
    pub config: Config,
    /// The raw factors.
    pub factors: PatchFactors,
}

/// Compares bits: a NaN equals itself, and -0 differs from 0.
impl PartialEq for Case {
    fn eq(&self, other: &Self) -> bool {
        self.config == other.config
            && self.factors.map(f32::to_bits) == other.factors.map(f32::to_bits)
    }
}

impl Eq for Case {}

impl Hash for Case {
    fn hash<H: Hasher>(&self, state: &mut H) {
        (self.config, self.domain()).hash(state);
        self.factors.iter().for_each(|factor| factor.to_bits().hash(state));
    }
}

impl Case {
    /// The domain of the patch.
    #[must_use]
    pub const fn domain(&self) -> Domain {
        self.factors.domain()
    }

    /// Indices per primitive: 1, 2 or 3.
    #[must_use]
    pub const fn primitive_size(&self) -> usize {
        self.config.output.indices_per_primitive(self.domain()) as usize
    }

    /// The patch, processed by the model.
    #[must_use]
    pub fn patch(&self) -> Patch {
        Patch::new(self.config, self.factors)
    }

    /// The same case with another factor `number`, from 0.
    pub(crate) fn with_factor(&self, number: usize, factor: f32) -> Self {
        let mut at = 0..;
        let factors = self.factors.map(|own| if at.next() == Some(number) { factor } else { own });
        Self { factors, ..*self }
    }

    /// The same case with another output.
    pub(crate) const fn with_output(&self, output: OutputPrimitive) -> Self {
        Self { config: Config { output, ..self.config }, factors: self.factors }
    }

    /// The command line that tessellates the same patch.
    #[must_use]
    pub fn command(&self) -> String {
        let bits = |factor: f32| format!("0x{:08x}", factor.to_bits());
        let outer = self.factors.outer().map(bits).collect::<Vec<_>>().join(",");
        let inside = self.factors.inside().map(bits).collect::<Vec<_>>().join(",");
        let inner = if inside.is_empty() { String::new() } else { format!(" --inner {inside}") };
        let Config { partitioning, output, split } = self.config;
        format!(
            "tess patch {} --outer {outer}{inner} --partitioning {} --output {} --split {}",
            self.domain().name(),
            partitioning.name(),
            output.name(),
            split.name()
        )
    }
}

impl fmt::Display for Case {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Config { partitioning, output, split } = self.config;
        let domain = self.domain().name();
        write!(f, "case {domain} {} {} {}", partitioning.name(), output.name(), split.name())?;
        self.factors.iter().try_for_each(|factor| write!(f, " {:08x}", factor.to_bits()))
    }
}

impl std::str::FromStr for Case {
    type Err = CaseError;

    fn from_str(line: &str) -> Result<Self, CaseError> {
        let words: Vec<_> = line.split_whitespace().collect();
        let ["case", domain, partitioning, output, split, factors @ ..] = &words[..] else {
            let form = "a case is: case DOMAIN PARTITIONING OUTPUT SPLIT FACTOR...";
            return Err(CaseError {
                field: "case",
                message: format!("{form}, not {}", quoted(line)),
            });
        };
        let domain = named::<Domain>("domain", domain)?;
        let config = Config {
            partitioning: named::<Partitioning>("partitioning", partitioning)?,
            output: named::<OutputPrimitive>("output", output)?,
            split: named::<SplitOrder>("split", split)?,
        };
        Ok(Self { config, factors: parse_factors(domain, factors)? })
    }
}

fn named<T: Named>(field: &'static str, name: &str) -> Result<T, CaseError> {
    T::from_name(name).map_err(|error| CaseError { field, message: error.to_string() })
}

/// A text that is not a case, or a name or factor in it that is wrong.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{field}: {message}")]
#[non_exhaustive]
pub struct CaseError {
    /// The part that is wrong, such as `domain`.
    pub field: &'static str,
    /// What is wrong with it, and what is expected.
    pub message: String,
}

/// Parses a factor: a decimal number as Rust reads it (nan, inf, -0, 1e3), or `0x` and the bits of
/// a binary32.
///
/// # Errors
/// The text is neither.
pub fn factor(text: &str) -> Result<f32, String> {
    let text = text.trim();
    let hex = text.strip_prefix("0x").or_else(|| text.strip_prefix("0X"));
    let parsed = match hex {
        Some(digits) if digits.starts_with('+') => None,
        Some(digits) => u32::from_str_radix(digits, 16).ok().map(f32::from_bits),
        None => text.parse().ok(),
    };
    parsed.ok_or_else(|| {
        "a factor is a decimal number, nan, inf, or up to 8 hex digits after 0x".to_owned()
    })
}

/// Parses factors from their hex bit patterns.
///
/// # Errors
/// A pattern that is not 8 hex digits, or a number of factors other than the domain's.
pub(crate) fn parse_factors(domain: Domain, words: &[&str]) -> Result<PatchFactors, CaseError> {
    let values = parse_bits(words)?;
    PatchFactors::from_slice(domain, &values).ok_or_else(|| {
        let (name, count) = (domain.name(), domain.factors());
        let message = format!(
            "{name} patches have {count} factors ({}), not {}",
            domain.factor_names().join(", "),
            values.len()
        );
        CaseError { field: "factors", message }
    })
}

/// Parses binary32 numbers from their hex bit patterns.
///
/// # Errors
/// A pattern that is not 8 hex digits.
pub(crate) fn parse_bits(words: &[&str]) -> Result<Vec<f32>, CaseError> {
    let parse = |word: &&str| {
        let bits = parse_hex(word, 8).and_then(|bits| u32::try_from(bits).ok());
        bits.map(f32::from_bits).ok_or_else(|| CaseError {
            field: "factors",
            message: format!(
                "{} is not the 8 hex digits of a binary32 number's bits",
                quoted(word)
            ),
        })
    };
    words.iter().map(parse).collect()
}

/// Parses a number of exactly `digits` hex digits; `digits` is at most 16.
pub(crate) fn parse_hex(word: &str, digits: usize) -> Option<u64> {
    let digit = |byte: u8| char::from(byte).to_digit(16).map(u64::from);
    let number = || word.bytes().try_fold(0, |number, byte| Some(number << 4 | digit(byte)?));
    (word.len() == digits).then(number).flatten()
}

#[cfg(test)]
mod tests {
    use super::*;

    const QUAD: &str = "case quad pow2 line center 3f800000 80000000 7fc00001 ff800000 00000001 42";

    #[test]
    fn text_round_trips() {
        for domain in Domain::ALL {
            let factors = " ffc12345".repeat(domain.factors());
            let line = format!("case {} integer point ruler{factors}", domain.name());
            let case: Case = line.parse().unwrap_or_else(|error| panic!("{line}: {error}"));
            assert_eq!(case.to_string(), line, "the same line");
            assert_eq!(case, case.to_string().parse().expect("parses"), "NaN equals itself");
        }
    }

    #[test]
    fn errors_name_the_field_and_the_remedy() {
        let parse = |line: String| line.parse::<Case>().expect_err(&line).to_string();
        assert_eq!(
            parse(QUAD.into()),
            "factors: `42` is not the 8 hex digits of a binary32 number's bits"
        );
        assert_eq!(
            parse(QUAD.replace(" 42", "")),
            "factors: quad patches have 6 factors (u0, v0, u1, v1, inside_u, inside_v), not 5"
        );
        assert_eq!(
            parse(QUAD.replace("line", "lines")),
            "output: unknown output primitive `lines`, \
             expected one of: point, line, triangle_cw, triangle_ccw"
        );
        assert!(parse("case quad".into()).contains("DOMAIN PARTITIONING"), "the form is shown");
        assert!(parse(String::new()).contains("DOMAIN PARTITIONING"), "the form is shown");
    }

    #[test]
    fn minus_zero_is_not_zero() {
        let line = "case isoline integer line ruler 00000000 3f800000";
        let minus = line.replace("00000000", "80000000");
        assert_ne!(line.parse::<Case>(), minus.parse::<Case>(), "different bits");
    }

    #[test]
    fn isolines_have_no_inner_factors() {
        let case: Case =
            "case isoline integer line ruler 40000000 3f800000".parse().expect("valid");
        assert_eq!(
            case.command(),
            "tess patch isoline --outer 0x40000000,0x3f800000 \
             --partitioning integer --output line --split ruler"
        );
    }

    #[test]
    fn factors_in_every_notation() {
        let cases = [
            ("3", 0x4040_0000),
            ("-0", 0x8000_0000),
            ("0x80000000", 0x8000_0000),
            ("0X7fc00001", 0x7FC0_0001),
            ("inf", 0x7F80_0000),
            ("-inf", 0xFF80_0000),
            ("nan", 0x7FC0_0000),
            (" 1e1 ", 0x4120_0000),
            ("0x1", 1),
        ];
        for (text, bits) in cases {
            assert_eq!(factor(text).map(f32::to_bits), Ok(bits), "{text}");
        }
        for text in ["", "x", "0x", "0x123456789", "0x+1", "1,2", "3f", "0x-1"] {
            assert!(factor(text).is_err(), "{text:?} is no factor");
        }
    }
}
