//! Both forms of each stage, compiled for each CPU level as `tess-simd` does it.

use crate::by_wide;
use crate::data::lanes::{Column, LANES, MAX_FACTORS};
use crate::stages::factors::{self, Processed};
use crate::stages::place::{Locations, Spacing, Spacings};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, SplitOrder};
use tess_simd::at_each_level;

/// Factors of a block of quads.
pub(crate) const ALL: usize = LANES * MAX_FACTORS;

/// Fixed-point factors of a block and their parities.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Factors {
    pub(crate) fixed: Column,
    pub(crate) odd: Column,
}

at_each_level! {
    /// Factor processing of quads.
    fn factors_by_arrays(
        partitioning: Partitioning,
        raw: &[Column<f32>],
        out: &mut [Processed],
    ) = arrays_factors;
}

at_each_level! {
    /// Factor processing of quads.
    fn factors_by_wide(
        partitioning: Partitioning,
        raw: &[Column<f32>],
        out: &mut [Processed],
    ) = wide_factors;
}

at_each_level! {
    /// Point counts and spacings, by way of contexts.
    fn contexts_by_arrays(
        order: SplitOrder,
        factors: &[Factors],
        out: &mut [(Spacings, Column)],
    ) = arrays_contexts;
}

at_each_level! {
    /// Point counts and spacings, by way of contexts.
    fn contexts_by_wide(
        order: SplitOrder,
        factors: &[Factors],
        out: &mut [by_wide::Spacings],
    ) = wide_contexts;
}

at_each_level! {
    /// Locations of edges.
    fn locations_by_arrays(edges: &[Spacing], out: &mut [Locations]) = arrays_locations;
}

at_each_level! {
    /// Locations of edges.
    fn locations_by_wide(edges: &[Spacing], out: &mut [by_wide::Locations]) = wide_locations;
}

#[inline(always)]
fn arrays_factors(partitioning: Partitioning, raw: &[Column<f32>], out: &mut [Processed]) {
    let config = Config::new(partitioning, OutputPrimitive::Point);
    for (raw, out) in raw.iter().zip(out) {
        *out = factors::process(config, Domain::Quad, raw);
    }
}

#[inline(always)]
fn wide_factors(partitioning: Partitioning, raw: &[Column<f32>], out: &mut [Processed]) {
    for (raw, out) in raw.iter().zip(out) {
        by_wide::process(partitioning, raw, out);
    }
}

#[inline(always)]
fn arrays_contexts(order: SplitOrder, factors: &[Factors], out: &mut [(Spacings, Column)]) {
    for (Factors { fixed, odd }, (spacings, points)) in factors.iter().zip(out) {
        spacings.fill::<ALL>(points, (fixed, odd), order);
    }
}

#[inline(always)]
fn wide_contexts(order: SplitOrder, factors: &[Factors], out: &mut [by_wide::Spacings]) {
    for (Factors { fixed, odd }, out) in factors.iter().zip(out) {
        out.fill(fixed, odd, order);
    }
}

#[inline(always)]
fn arrays_locations(edges: &[Spacing], out: &mut [Locations]) {
    for (spacing, out) in edges.iter().zip(out) {
        out.fill(spacing);
    }
}

#[inline(always)]
fn wide_locations(edges: &[Spacing], out: &mut [by_wide::Locations]) {
    for (spacing, out) in edges.iter().zip(out) {
        out.fill(spacing);
    }
}
