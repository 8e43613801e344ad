//! Each factor after each step of factor processing (spec sections 2 to 4).

use super::{Fixed, processed};
use serde::Serialize;
use tess_core::{Domain, FactorContext, Parity, Patch, PatchFactors, ProcessedFactor};

/// A binary32 number; NaN and infinities have no `value` in JSON.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Float {
    pub(super) bits: u32,
    pub(super) value: f32,
}

impl Float {
    const fn new(bits: u32) -> Self {
        Self { bits, value: f32::from_bits(bits) }
    }
}

/// One factor on its way. A culled patch has raw factors alone.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct FactorReport {
    pub(super) name: &'static str,
    pub(super) raw: Float,
    #[serde(flatten)]
    pub(super) processed: Option<Processed>,
}

#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Processed {
    pub(super) clamped: Float,
    pub(super) rounded: Float,
    pub(super) fixed: Fixed,
    pub(super) parity: &'static str,
    pub(super) context: Context,
}

/// The six numbers of spec section 4, and the half edge that a transition stitch walks.
#[derive(Clone, Copy, Debug, Serialize)]
pub(super) struct Context {
    pub(super) half_points: u32,
    pub(super) split: u32,
    pub(super) fraction: u32,
    pub(super) inv_floor: u32,
    pub(super) inv_ceil: u32,
    pub(super) points: u32,
    pub(super) half_steps: u32,
}

impl From<&FactorContext> for Context {
    fn from(context: &FactorContext) -> Self {
        Self {
            half_points: context.half_points,
            split: context.split,
            fraction: context.fraction,
            inv_floor: context.inv_floor,
            inv_ceil: context.inv_ceil,
            points: context.points,
            half_steps: context.half_steps(),
        }
    }
}

impl From<&ProcessedFactor> for Processed {
    fn from(factor: &ProcessedFactor) -> Self {
        Self {
            clamped: Float::new(factor.clamped),
            rounded: Float::new(factor.rounded),
            fixed: Fixed::new(factor.fixed.to_bits()),
            parity: match factor.context.parity {
                Parity::Even => "even",
                Parity::Odd => "odd",
            },
            context: Context::from(&factor.context),
        }
    }
}

/// The specification's names of a domain's factors: outer ones, then inside ones.
pub(super) const fn names(domain: Domain) -> &'static [&'static str] {
    match domain {
        Domain::Isoline => &["density", "detail"],
        Domain::Triangle => &["U=0", "V=0", "W=0", "inside"],
        Domain::Quad => &["U=0", "V=0", "U=1", "V=1", "inside U", "inside V"],
    }
}

/// Every factor of a patch with its name: outer, then inside.
pub(super) fn named<T: Copy>(factors: &PatchFactors<T>) -> Vec<(&'static str, T)> {
    names(factors.domain()).iter().copied().zip(factors.iter()).collect()
}

pub(super) fn reports(patch: &Patch, raw: &PatchFactors) -> Vec<FactorReport> {
    let processed = processed(patch).map(named).unwrap_or_default();
    let report = |(k, (name, raw)): (usize, (&'static str, f32))| FactorReport {
        name,
        raw: Float::new(raw.to_bits()),
        processed: processed.get(k).map(|(_, factor)| Processed::from(factor)),
    };
    named(raw).into_iter().enumerate().map(report).collect()
}
