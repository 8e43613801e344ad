//! A patch on the command line: domain, factors and configuration.

use crate::failure::Failure;
use crate::names::{self, Named};
use clap::builder::ValueParser;
use tess_core::{
    Config, Domain, IsolineFactors, OutputPrimitive, Partitioning, PatchFactors, QuadFactors,
    SplitOrder, TriangleFactors,
};

/// The arguments that describe one patch.
#[derive(Clone, Debug, clap::Args)]
pub struct PatchArgs {
    /// Domain of the patch
    #[arg(value_parser = names::parser::<Domain>())]
    pub domain: Domain,
    /// Outer factors: density,detail (isoline); U=0,V=0,W=0 (tri); U=0,V=0,U=1,V=1 (quad)
    ///
    /// Each decimal (nan, inf and -0 too), or the bits of a binary32 such as 0x40490fdb.
    #[arg(long, value_name = "F,F,..", value_delimiter = ',', allow_hyphen_values = true)]
    #[arg(required = true, value_parser = ValueParser::new(factor))]
    pub outer: Vec<f32>,
    /// Inside factors: one (tri); along U, along V (quad); none (isoline)
    #[arg(long, value_name = "F,F,..", value_delimiter = ',', allow_hyphen_values = true)]
    #[arg(value_parser = ValueParser::new(factor))]
    pub inner: Vec<f32>,
    /// Spacing of the cuts
    #[arg(long, value_name = "NAME", default_value = "integer")]
    #[arg(value_parser = names::parser::<Partitioning>())]
    pub partitioning: Partitioning,
    /// What the indices describe
    #[arg(long, value_name = "NAME", default_value = "triangle_cw")]
    #[arg(value_parser = names::parser::<OutputPrimitive>())]
    pub output: OutputPrimitive,
    /// Order in which points join an edge
    #[arg(long, value_name = "NAME", default_value = "ruler")]
    #[arg(value_parser = names::parser::<SplitOrder>())]
    pub split: SplitOrder,
}

impl PatchArgs {
    /// The configuration.
    #[must_use]
    pub const fn config(&self) -> Config {
        Config { partitioning: self.partitioning, output: self.output, split: self.split }
    }

    /// The raw factors.
    ///
    /// # Errors
    /// The numbers of outer and inside factors are not those of the domain.
    pub fn factors(&self) -> Result<PatchFactors, Failure> {
        match (self.domain, &self.outer[..], &self.inner[..]) {
            (Domain::Isoline, &[density, detail], []) => {
                Ok(PatchFactors::Isoline(IsolineFactors { density, detail }))
            }
            (Domain::Triangle, &[u0, v0, w0], &[inside]) => {
                Ok(PatchFactors::Triangle(TriangleFactors { u0, v0, w0, inside }))
            }
            (Domain::Quad, &[u0, v0, u1, v1], &[inside_u, inside_v]) => {
                Ok(PatchFactors::Quad(QuadFactors { u0, v0, u1, v1, inside_u, inside_v }))
            }
            _ => Err(self.wrong_count()),
        }
    }

    fn wrong_count(&self) -> Failure {
        let needs = match self.domain {
            Domain::Isoline => "--outer density,detail and no --inner",
            Domain::Triangle => "--outer U0,V0,W0 (3 factors) and --inner INSIDE (1 factor)",
            Domain::Quad => "--outer U0,V0,U1,V1 (4 factors) and --inner U,V (2 factors)",
        };
        Failure::bad_input(format!(
            "domain {} takes {needs}; got {} outer and {} inside factors",
            self.domain.name(),
            self.outer.len(),
            self.inner.len()
        ))
    }
}

/// A factor: decimal as Rust reads it (nan, inf, -0, 1e3), or `0x` and the bits of a binary32.
fn factor(text: &str) -> Result<f32, String> {
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

/// The command that tessellates this patch again, to the bit.
#[must_use]
pub fn command_line(config: Config, factors: &PatchFactors) -> String {
    let list = |factors: &[f32]| {
        let bits: Vec<_> = factors.iter().map(|f| format!("0x{:08x}", f.to_bits())).collect();
        bits.join(",")
    };
    let (outer, inner) = outer_and_inner(factors);
    let mut line = format!("tess patch {} --outer {}", factors.domain().name(), list(&outer));
    if !inner.is_empty() {
        line.push_str(&format!(" --inner {}", list(&inner)));
    }
    let (partitioning, output) = (config.partitioning.name(), config.output.name());
    line.push_str(&format!(" --partitioning {partitioning} --output {output}"));
    line.push_str(&format!(" --split {}", config.split.name()));
    line
}

/// Outer and inside factors, in the order of the specification.
#[must_use]
pub fn outer_and_inner<T: Copy>(factors: &PatchFactors<T>) -> (Vec<T>, Vec<T>) {
    match factors {
        PatchFactors::Isoline(factors) => (vec![factors.density, factors.detail], vec![]),
        PatchFactors::Triangle(factors) => (factors.outer().to_vec(), vec![factors.inside]),
        PatchFactors::Quad(factors) => (factors.outer().to_vec(), factors.inside().to_vec()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
