//! Everything about one patch as JSON.

use super::OnePatch;
use crate::args::outer_and_inner;
use crate::names::Named;
use serde::Serialize;

#[derive(Serialize)]
struct Document<'a> {
    domain: &'a str,
    partitioning: &'a str,
    output: &'a str,
    split: &'a str,
    backend: &'a str,
    outer: Vec<Factor>,
    inner: Vec<Factor>,
    points: Vec<Point>,
    primitives: Vec<&'a [u32]>,
}

/// NaN and infinities are no JSON numbers: their `value` is null, `bits` has them.
#[derive(Serialize)]
struct Factor {
    bits: String,
    value: f32,
}

/// `u_bits` and `v_bits` are exact 16.16 numbers; `u` and `v` are the same values as binary32.
#[derive(Serialize)]
struct Point {
    u_bits: u32,
    v_bits: u32,
    u: f32,
    v: f32,
}

pub(super) fn render(patch: &OnePatch) -> String {
    let (outer, inner) = outer_and_inner(&patch.factors);
    let factors = |list: Vec<f32>| {
        let factor = |value: f32| Factor { bits: format!("0x{:08x}", value.to_bits()), value };
        list.into_iter().map(factor).collect()
    };
    let document = Document {
        domain: patch.factors.domain().name(),
        partitioning: patch.config.partitioning.name(),
        output: patch.config.output.name(),
        split: patch.config.split.name(),
        backend: patch.backend,
        outer: factors(outer),
        inner: factors(inner),
        points: points(patch),
        primitives: patch.primitives().collect(),
    };
    crate::output::json(&document)
}

fn points(patch: &OnePatch) -> Vec<Point> {
    let point = |point: &tess_core::DomainPoint| {
        let [u, v] = point.to_f32();
        Point { u_bits: point.u.to_bits(), v_bits: point.v.to_bits(), u, v }
    };
    patch.result.points.iter().map(point).collect()
}
