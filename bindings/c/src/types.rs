//! The structures and numbers that cross the boundary, and their Rust counterparts.

use crate::boundary;
use crate::status::{
    TESS_OUT_OF_RANGE, TESS_UNKNOWN_VALUE, TESS_WRONG_FACTOR_COUNT, TessStatus, answer,
};
use tess_core::{
    Config, Counts, Domain, DomainPoint, FactorContext, OutputPrimitive, Parity, Partitioning,
    Patch, PatchFactors, SplitOrder,
};

/// Domain: parallel lines along u, stacked in v. Factors: density, detail.
pub const TESS_DOMAIN_ISOLINE: u32 = 0;
/// Domain: barycentric (u, v). Factors: outer U=0, V=0, W=0; inside.
pub const TESS_DOMAIN_TRIANGLE: u32 = 1;
/// Domain: the unit square. Factors: outer U=0, V=0, U=1, V=1; inside U, V.
pub const TESS_DOMAIN_QUAD: u32 = 2;

/// Partitioning: factors rounded up to integers, 1..64.
pub const TESS_PARTITIONING_INTEGER: u32 = 0;
/// Partitioning: tessellates as integer; only `tess_prepare` rounds to powers of two.
pub const TESS_PARTITIONING_POW2: u32 = 1;
/// Partitioning: an odd number of segments, 1..63.
pub const TESS_PARTITIONING_FRACTIONAL_ODD: u32 = 2;
/// Partitioning: an even number of segments, 2..64.
pub const TESS_PARTITIONING_FRACTIONAL_EVEN: u32 = 3;

/// Output: one index per point.
pub const TESS_OUTPUT_POINT: u32 = 0;
/// Output: line segments.
pub const TESS_OUTPUT_LINE: u32 = 1;
/// Output: triangles, clockwise as seen with v pointing down (lines on an isoline domain).
pub const TESS_OUTPUT_TRIANGLE_CW: u32 = 2;
/// Output: triangles, counter-clockwise as seen with v pointing down (lines on an isoline domain).
pub const TESS_OUTPUT_TRIANGLE_CCW: u32 = 3;

/// Split order: bit-reversed, the standard.
pub const TESS_SPLIT_RULER: u32 = 0;
/// Split order: from the centre outwards, as the Xbox 360 does.
pub const TESS_SPLIT_CENTER: u32 = 1;

/// Parity: an even number of segments.
pub const TESS_PARITY_EVEN: u32 = 0;
/// Parity: an odd number of segments.
pub const TESS_PARITY_ODD: u32 = 1;

/// The largest number of points of a patch.
pub const TESS_MAX_POINTS: u32 = 4225;
/// The largest number of indices of a patch.
pub const TESS_MAX_INDICES: u32 = 24576;
/// The largest number of factors of a patch.
pub const TESS_MAX_FACTORS: u32 = 6;

/// The configuration of a tessellator. Each field is one of the constants with the given prefix.
#[repr(C)]
#[derive(Clone, Copy, Debug)]
pub struct TessConfig {
    /// `TESS_DOMAIN_...`
    pub domain: u32,
    /// `TESS_PARTITIONING_...`
    pub partitioning: u32,
    /// `TESS_OUTPUT_...`
    pub output: u32,
    /// `TESS_SPLIT_...`
    pub split: u32,
}

/// Sizes of a patch's output.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TessCounts {
    /// Domain points, at most `TESS_MAX_POINTS`.
    pub points: u32,
    /// Points, line segments or triangles.
    pub primitives: u32,
    /// Indices, 1, 2 or 3 for each primitive, at most `TESS_MAX_INDICES`.
    pub indices: u32,
}

/// A domain point in unsigned 16.16 numbers, 0..0x10000. On triangles w = 0x10000 - u - v.
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TessPoint {
    /// First coordinate.
    pub u: u32,
    /// Second coordinate.
    pub v: u32,
}

/// The six numbers of a factor, and its parity (specification, section 4).
#[repr(C)]
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct TessContext {
    /// `TESS_PARITY_...`
    pub parity: u32,
    /// Reciprocal of the coarser subdivision, 16 fraction bits.
    pub inv_floor: u32,
    /// Reciprocal of the finer subdivision, 16 fraction bits.
    pub inv_ceil: u32,
    /// Weight of the finer subdivision, 16 fraction bits, below 0x10000.
    pub fraction: u32,
    /// Points on a half edge without the midpoint of an even edge, 1..32.
    pub half_points: u32,
    /// The position on the half edge that is splitting; `half_points + 1` if no position splits.
    pub split: u32,
    /// Points on the whole edge, both ends included, 2..65.
    pub points: u32,
}

impl From<Counts> for TessCounts {
    fn from(counts: Counts) -> Self {
        let Counts { points, primitives, indices } = counts;
        Self { points, primitives, indices }
    }
}

impl From<DomainPoint> for TessPoint {
    fn from(point: DomainPoint) -> Self {
        Self { u: point.u.to_bits(), v: point.v.to_bits() }
    }
}

impl From<FactorContext> for TessContext {
    fn from(context: FactorContext) -> Self {
        let FactorContext {
            parity,
            inv_floor,
            inv_ceil,
            fraction,
            half_points,
            split_position,
            points,
        } = context;
        let parity = parity.odd();
        Self { parity, inv_floor, inv_ceil, fraction, half_points, split: split_position, points }
    }
}

/// Both parities, in the order of their numbers.
const PARITIES: [Parity; 2] = [Parity::Even, Parity::Odd];

/// Element `number` of a list; `TESS_UNKNOWN_VALUE` beyond its end.
pub(crate) fn listed<T: Copy>(list: &[T], number: u32) -> Result<T, TessStatus> {
    let place = usize::try_from(number).map_err(|_| TESS_UNKNOWN_VALUE)?;
    list.get(place).copied().ok_or(TESS_UNKNOWN_VALUE)
}

pub(crate) fn parity(number: u32) -> Result<Parity, TessStatus> {
    listed(&PARITIES, number)
}

impl TessConfig {
    /// The numbers of a configuration and a domain.
    pub(crate) const fn encode(config: Config, domain: Domain) -> Self {
        let Config { partitioning, output, split } = config;
        Self {
            domain: domain as u32,
            partitioning: partitioning as u32,
            output: output as u32,
            split: split as u32,
        }
    }

    /// The configuration and the domain, every number checked.
    pub(crate) fn decode(&self) -> Result<(Config, Domain), TessStatus> {
        let config = Config {
            partitioning: listed(&Partitioning::ALL, self.partitioning)?,
            output: listed(&OutputPrimitive::ALL, self.output)?,
            split: listed(&SplitOrder::ALL, self.split)?,
        };
        Ok((config, listed(&Domain::ALL, self.domain)?))
    }
}

/// The factors of a patch in the specification's order, copied from a caller's array.
///
/// # Safety
/// - If not null and aligned, `factors` points to `factor_count` floats that can be read.
pub(crate) unsafe fn factors(
    domain: Domain,
    factors: *const f32,
    factor_count: usize,
) -> Result<PatchFactors, TessStatus> {
    if factor_count != domain.factors() {
        return Err(TESS_WRONG_FACTOR_COUNT);
    }
    // SAFETY: `factor_count` readable floats, as the caller promises.
    let factors = unsafe { boundary::list(factors, factor_count) }?;
    PatchFactors::from_slice(domain, factors).ok_or(TESS_WRONG_FACTOR_COUNT)
}

/// The patch that a caller describes.
///
/// # Safety
/// - If not null and aligned, `config` points to a configuration and `factor_values` to
///   `factor_count` floats that can be read.
pub(crate) unsafe fn patch(
    config: *const TessConfig,
    factor_values: *const f32,
    factor_count: usize,
) -> Result<Patch, TessStatus> {
    // SAFETY: a readable configuration, as the caller promises.
    let config = unsafe { boundary::read(config) }?;
    let (config, domain) = config.decode()?;
    // SAFETY: `factor_count` readable floats, as the caller promises.
    let factors = unsafe { factors(domain, factor_values, factor_count) }?;
    Ok(Patch::new(config, factors))
}

/// Writes `value` of the patch that a caller describes; `TESS_OUT_OF_RANGE` if it is `None`.
///
/// # Safety
/// - As for [`patch`]; `out`, if not null and aligned, must be valid for writing one structure.
pub(crate) unsafe fn of_patch<T: Copy, V: Into<T>>(
    (config, factors, factor_count): (*const TessConfig, *const f32, usize),
    out: *mut T,
    value: impl FnOnce(&Patch) -> Option<V>,
) -> TessStatus {
    answer(|| {
        // SAFETY: `config` and `factors` are readable, as the caller promises.
        let patch = unsafe { patch(config, factors, factor_count) }?;
        let value = value(&patch).ok_or(TESS_OUT_OF_RANGE)?;
        // SAFETY: `out` is writable, as the caller promises.
        unsafe { boundary::write(out, value.into()) }
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_mean_what_their_names_say() {
        let config = |domain, partitioning, output, split| {
            TessConfig { domain, partitioning, output, split }.decode()
        };
        let expected = |partitioning, output, split| Config { partitioning, output, split };
        assert_eq!(
            config(
                TESS_DOMAIN_QUAD,
                TESS_PARTITIONING_FRACTIONAL_EVEN,
                TESS_OUTPUT_TRIANGLE_CCW,
                TESS_SPLIT_CENTER
            ),
            Ok((
                expected(
                    Partitioning::FractionalEven,
                    OutputPrimitive::TriangleCcw,
                    SplitOrder::Centre
                ),
                Domain::Quad
            )),
            "the last of each"
        );
        assert_eq!(
            config(
                TESS_DOMAIN_TRIANGLE,
                TESS_PARTITIONING_FRACTIONAL_ODD,
                TESS_OUTPUT_TRIANGLE_CW,
                TESS_SPLIT_RULER
            ),
            Ok((
                expected(
                    Partitioning::FractionalOdd,
                    OutputPrimitive::TriangleCw,
                    SplitOrder::Ruler
                ),
                Domain::Triangle
            )),
            "one of the middle"
        );
        assert_eq!(
            config(TESS_DOMAIN_ISOLINE, TESS_PARTITIONING_POW2, TESS_OUTPUT_LINE, TESS_SPLIT_RULER),
            Ok((
                expected(Partitioning::Pow2, OutputPrimitive::Line, SplitOrder::Ruler),
                Domain::Isoline
            )),
            "another"
        );
        assert_eq!(
            (parity(TESS_PARITY_EVEN), parity(TESS_PARITY_ODD), parity(2)),
            (Ok(Parity::Even), Ok(Parity::Odd), Err(TESS_UNKNOWN_VALUE)),
            "parities"
        );
    }

    #[test]
    fn numbers_go_both_ways() {
        for (domain, config) in tess_verify::generate::configurations() {
            assert_eq!(TessConfig::encode(config, domain).decode(), Ok((config, domain)));
        }
    }

    #[test]
    fn limits_are_those_of_the_model() {
        assert_eq!(TESS_MAX_POINTS as usize, tess_core::MAX_POINTS, "points");
        assert_eq!(TESS_MAX_INDICES as usize, tess_core::MAX_INDICES, "indices");
    }
}
