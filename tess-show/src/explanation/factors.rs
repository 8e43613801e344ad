//! Each factor after each step of factor processing (spec sections 2 to 4).

use super::Fixed;
use std::fmt;
use tess_core::{FactorContext, Patch, PatchFactors, ProcessedFactor};
use tess_verify::Case;
use tess_verify::Named;

/// A binary32 number. NaN and infinities have no `value` in JSON.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) struct Float {
    pub(super) bits: u32,
    pub(super) value: f32,
}

impl Float {
    const fn new(bits: u32) -> Self {
        Self { bits, value: f32::from_bits(bits) }
    }
}

/// One factor through all steps. If the patch is culled, there are only raw factors.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(crate) struct FactorReport {
    pub(super) name: &'static str,
    pub(super) raw: Float,
    #[cfg_attr(feature = "serde", serde(flatten))]
    pub(super) processed: Option<Processed>,
}

impl FactorReport {
    /// Explains factor `k`; `None` if the patch has no such factor.
    pub(crate) fn new(case: &Case, k: u32) -> Option<Self> {
        let number = usize::try_from(k).ok()?;
        reports(&case.patch(), &case.factors).get(number).copied()
    }
}

impl fmt::Display for FactorReport {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { name, raw, processed } = self;
        writeln!(f, "factor {name}: {:08x} ({})", raw.bits, raw.value)?;
        let Some(Processed { clamped, rounded, fixed, parity, context: c }) = processed else {
            return writeln!(f, "  the patch is culled");
        };
        writeln!(
            f,
            "  clamped {:08x} ({}), rounded {:08x} ({}), fixed = {:05x} ({}), {parity}",
            clamped.bits, clamped.value, rounded.bits, rounded.value, fixed.bits, fixed.value
        )?;
        writeln!(
            f,
            "  points = {}, half_points = {}, split = {}, fraction = {:04x}, inv_floor = {:05x}, inv_ceil = {:05x}",
            c.points, c.half_points, c.split, c.fraction, c.inv_floor, c.inv_ceil
        )
    }
}

#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
pub(super) struct Processed {
    pub(super) clamped: Float,
    pub(super) rounded: Float,
    pub(super) fixed: Fixed,
    pub(super) parity: &'static str,
    pub(super) context: Context,
}

/// The six numbers of spec section 4, and the positions of the half edge that a transition stitch
/// visits.
#[derive(Clone, Copy, Debug)]
#[cfg_attr(feature = "serde", derive(serde::Serialize))]
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
            split: context.split_position,
            fraction: context.fraction,
            inv_floor: context.inv_floor,
            inv_ceil: context.inv_ceil,
            points: context.points,
            half_steps: context.visited_positions(),
        }
    }
}

impl From<&ProcessedFactor> for Processed {
    fn from(factor: &ProcessedFactor) -> Self {
        Self {
            clamped: Float::new(factor.clamped),
            rounded: Float::new(factor.rounded),
            fixed: Fixed::new(factor.fixed.to_bits()),
            parity: factor.context.parity.name(),
            context: Context::from(&factor.context),
        }
    }
}

/// The specification's name of a factor, from the name of the model's field.
pub(super) fn name(field: &'static str) -> &'static str {
    match field {
        "u0" => "U=0",
        "v0" => "V=0",
        "w0" => "W=0",
        "u1" => "U=1",
        "v1" => "V=1",
        "inside_u" => "inside U",
        "inside_v" => "inside V",
        other => other,
    }
}

/// Every factor of a patch with its name: first the outer ones, then the inside ones.
pub(super) fn named<T: Copy>(factors: &PatchFactors<T>) -> Vec<(&'static str, T)> {
    let names = factors.domain().factor_names().iter().copied().map(name);
    names.zip(factors.iter()).collect()
}

pub(super) fn reports(patch: &Patch, raw: &PatchFactors) -> Vec<FactorReport> {
    let processed = patch.processed().factors().map(named).unwrap_or_default();
    let report = |(k, (name, raw)): (usize, (&'static str, f32))| FactorReport {
        name,
        raw: Float::new(raw.to_bits()),
        processed: processed.get(k).map(|(_, factor)| Processed::from(factor)),
    };
    named(raw).into_iter().enumerate().map(report).collect()
}
