//! Exact comparison: the first element in which two results differ, and the stage that it points
//! to.

mod mismatch;

pub use mismatch::{Element, Mismatch, SpecStage};

use crate::case::Case;
use crate::strength::vertices;
use std::collections::BTreeSet;
use tess_core::{DomainPoint, FactorContext, FixedFactor, Tessellation};

impl Mismatch {
    /// The first difference between two outputs of a case: counts, then points, then indices.
    #[must_use]
    pub fn between(case: &Case, observed: &Tessellation, expected: &Tessellation) -> Option<Self> {
        let size = case.primitive_size();
        count("points", &observed.points, &expected.points)
            .or_else(|| count("indices", &observed.indices, &expected.indices))
            .or_else(|| points(&observed.points, &expected.points))
            .or_else(|| indices(size, &observed.indices, &expected.indices))
    }
}

/// The first difference between the points of two outputs; indices are ignored.
pub(crate) fn points_alone(observed: &Tessellation, expected: &Tessellation) -> Option<Mismatch> {
    count("points", &observed.points, &expected.points)
        .or_else(|| points(&observed.points, &expected.points))
}

/// The first difference between the vertices of two outputs' primitives, compared by coordinates.
pub(crate) fn sequences(
    case: &Case,
    observed: &Tessellation,
    expected: &Tessellation,
) -> Option<Mismatch> {
    let size = case.primitive_size();
    let places = |output: &Tessellation| -> Vec<Option<[u32; 2]>> {
        let bits = |point: DomainPoint| [point.u.to_bits(), point.v.to_bits()];
        vertices(output).map(|point| point.map(bits)).collect()
    };
    let (observed, expected) = (places(observed), places(expected));
    count("vertices", &observed, &expected).or_else(|| {
        let at = observed.iter().zip(&expected).position(|(o, e)| o != e)?;
        let known: BTreeSet<_> = expected.iter().collect();
        let is_moved = observed.iter().any(|place| !known.contains(place));
        let stage = if is_moved { SpecStage::Location } else { SpecStage::Stitch };
        let element = Element::Index { primitive: at / size, position: at % size };
        let show = |place: Option<[u32; 2]>| match place {
            Some([u, v]) => format!("({u:05x}, {v:05x})"),
            None => "no point".to_owned(),
        };
        let (observed, expected) = (show(observed[at]), show(expected[at]));
        Some(Mismatch { element, observed, expected, stage })
    })
}

fn count<T>(what: &'static str, observed: &[T], expected: &[T]) -> Option<Mismatch> {
    Mismatch::count(what, observed.len() as u64, expected.len() as u64)
}

fn points(observed: &[DomainPoint], expected: &[DomainPoint]) -> Option<Mismatch> {
    let index =
        observed.iter().zip(expected).position(|(observed, expected)| observed != expected)?;
    let same_set = sorted(observed) == sorted(expected);
    let stage = if same_set { SpecStage::PointOrder } else { SpecStage::Location };
    let (observed, expected) = (observed[index], expected[index]);
    let (coordinate, observed, expected) = if observed.u == expected.u {
        ("v", observed.v, expected.v)
    } else {
        ("u", observed.u, expected.u)
    };
    let element = Element::Point { index, coordinate };
    Some(Mismatch::hex(element, 5, observed.to_bits(), expected.to_bits(), stage))
}

fn sorted(points: &[DomainPoint]) -> Vec<(u32, u32)> {
    let mut bits: Vec<_> = points.iter().map(|p| (p.u.to_bits(), p.v.to_bits())).collect();
    bits.sort_unstable();
    bits
}

fn indices(size: usize, observed: &[u32], expected: &[u32]) -> Option<Mismatch> {
    let at = observed.iter().zip(expected).position(|(observed, expected)| observed != expected)?;
    let element = Element::Index { primitive: at / size, position: at % size };
    Some(Mismatch::hex(element, 1, observed[at], expected[at], SpecStage::Stitch))
}

/// The first difference between the contexts of `factors`; the three lists have equal lengths.
pub(crate) fn contexts(
    factors: &[FixedFactor],
    observed: &[FactorContext],
    expected: &[FactorContext],
) -> Option<Mismatch> {
    let of_one = |((&factor, observed), expected): ((&FixedFactor, _), _)| {
        let fields = context_fields(observed).into_iter().zip(context_fields(expected));
        let mut different = fields.filter(|(observed, expected)| observed != expected);
        different.next().map(|((field, observed), (_, expected))| {
            let element = Element::Context { factor, field };
            Mismatch::hex(element, 1, observed, expected, SpecStage::Context)
        })
    };
    factors.iter().zip(observed).zip(expected).find_map(of_one)
}

/// The fields of a context with their names; parity is 1 for odd.
fn context_fields(context: &FactorContext) -> [(&'static str, u32); 7] {
    [
        ("parity", context.parity.odd()),
        ("inv_floor", context.inv_floor),
        ("inv_ceil", context.inv_ceil),
        ("fraction", context.fraction),
        ("half_points", context.half_points),
        ("split", context.split_position),
        ("points", context.points),
    ]
}

/// The first difference between the locations of contexts; `contexts` are those of `factors`.
pub(crate) fn locations(
    factors: &[FixedFactor],
    contexts: &[FactorContext],
    observed: &[u32],
    expected: &[u32],
) -> Option<Mismatch> {
    let count = Mismatch::count("locations", observed.len() as u64, expected.len() as u64);
    count.or_else(|| {
        let at = observed.iter().zip(expected).position(|(o, e)| o != e)?;
        let of_factor = |(&factor, context): (&FixedFactor, &FactorContext)| {
            (0..context.points as usize).map(move |p| Element::Location { factor, p })
        };
        let element = factors.iter().zip(contexts).flat_map(of_factor).nth(at)?;
        Some(Mismatch::hex(element, 5, observed[at], expected[at], SpecStage::Location))
    })
}

/// The first difference between the processed factors of the raw factors `values`.
pub(crate) fn fixed_factors(
    values: &[f32],
    observed: &[[FixedFactor; 2]],
    expected: &[[FixedFactor; 2]],
) -> Option<Mismatch> {
    let at = observed.iter().zip(expected).position(|(o, e)| o != e)?;
    let (role, which) =
        if observed[at][0] == expected[at][0] { ("inside", 1) } else { ("outer", 0) };
    let element = Element::Factor { x: values[at].to_bits(), role };
    let [observed, expected] = [observed, expected].map(|factors| factors[at][which].to_bits());
    Some(Mismatch::hex(element, 6, observed, expected, SpecStage::Factors))
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::{Parity, SplitOrder};

    #[test]
    fn a_wrong_index_names_its_primitive_and_its_position() {
        for (line, size) in [
            ("case tri integer triangle_cw ruler 40400000 40400000 40400000 40400000", 3),
            ("case isoline integer line ruler 40000000 40800000", 2),
        ] {
            let case: Case = line.parse().expect("a case");
            let expected = case.patch().tessellate();
            for at in 0..expected.indices.len() {
                let mut observed = expected.clone();
                observed.indices[at] += 1;
                let found =
                    Mismatch::between(&case, &observed, &expected).map(|found| found.element);
                let element =
                    Element::Index { primitive: at / size, position: at - at / size * size };
                assert_eq!(found, Some(element), "index {at} of {line}");
            }
        }
    }

    /// Each location belongs to its own context, also at the first and the last location of one.
    #[test]
    fn a_wrong_location_names_its_factor() {
        let factors = [0x2_0000, 0x3_8000, 0x4_0000].map(FixedFactor::from_bits);
        let contexts =
            factors.map(|fixed| FactorContext::new(fixed, Parity::Even, SplitOrder::Ruler));
        let all = contexts.iter().map(|context| context.points).sum();
        let expected: Vec<u32> = (0..all).collect();
        let mut at = 0;
        for (factor, context) in factors.into_iter().zip(&contexts) {
            for p in 0..context.points as usize {
                let mut observed = expected.clone();
                observed[at] ^= 1;
                let found = locations(&factors, &contexts, &observed, &expected);
                let element = Element::Location { factor, p };
                assert_eq!(found.map(|found| found.element), Some(element), "location {at}");
                at += 1;
            }
        }
        assert_eq!(at, expected.len(), "all locations");
    }
}
