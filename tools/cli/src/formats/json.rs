//! Everything about one patch as JSON.

use super::OnePatch;
use serde::Serialize;
use tess_core::DomainPoint;
use tess_verify::Named;

#[derive(Serialize)]
struct Document<'a> {
    domain: &'a str,
    partitioning: &'a str,
    output: &'a str,
    split: &'a str,
    backend: &'a str,
    factors: Vec<Factor>,
    points: Vec<Point>,
    primitives: Vec<&'a [u32]>,
}

/// NaN and infinities are not JSON numbers: their `value` is null, and `bits` has them.
#[derive(Serialize)]
struct Factor {
    name: &'static str,
    bits: String,
    value: f32,
}

/// `u_bits` and `v_bits` are 16.16 numbers; `u` and `v` are exactly the same values.
#[derive(Serialize)]
struct Point {
    u_bits: u32,
    v_bits: u32,
    u: f64,
    v: f64,
}

pub(super) fn render(patch: &OnePatch) -> String {
    let case = patch.case();
    let named = case.domain().factor_names().iter().zip(case.factors.iter());
    let factor = |(name, value): (&&'static str, f32)| {
        let bits = format!("0x{:08x}", value.to_bits());
        Factor { name, bits, value }
    };
    let point = |point: &DomainPoint| {
        let [u, v] = point.to_f32().map(f64::from);
        Point { u_bits: point.u.to_bits(), v_bits: point.v.to_bits(), u, v }
    };
    let document = Document {
        domain: case.domain().name(),
        partitioning: case.config.partitioning.name(),
        output: case.config.output.name(),
        split: case.config.split.name(),
        backend: patch.backend,
        factors: named.map(factor).collect(),
        points: patch.output().points.iter().map(point).collect(),
        primitives: patch.listing.primitives().collect(),
    };
    crate::output::json(&document)
}
