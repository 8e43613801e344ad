//! The comparison of one captured patch with the model.

use crate::capture::{Captured, Method};
use tess_core::fixed_point::ONE;
use tess_core::{Domain, DomainPoint, Tessellation};
use tess_verify::Case;
use tess_verify::check::{ListOrder, Strength, vertices};
use tess_verify::vectors::fixed;

/// How close a captured patch is to the model; the first verdict is the closest.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum PatchVerdict {
    /// The model's primitives in the model's order, vertex for vertex.
    Sequence,
    /// The same, except for the leading vertices of triangles.
    Leading,
    /// The model's primitives in another order. This is also the best verdict if only points are
    /// captured.
    Order,
    /// The model's points, but other primitives.
    Connectivity,
    /// Points that the model does not have, or too few points; with the largest distance from the
    /// model's nearest point, in units of 2^-16.
    Coordinates(u32),
    /// A patch that the model culls, or one that only the device culls.
    Culling,
}

/// The strength that leaves only the order free.
pub(crate) fn any_order(method: Method) -> Strength {
    Strength { order: ListOrder::Any, elements: method.elements(), ..Strength::default() }
}

/// Compares a patch with the model's output for it. `observed` is `None` if it has coordinates that
/// are not 16.16 numbers.
pub(crate) fn verdict(
    case: &Case,
    captured: &Captured,
    observed: Option<&Tessellation>,
    expected: &Tessellation,
    method: Method,
) -> PatchVerdict {
    if captured.vertices.is_empty() != expected.points.is_empty() {
        return PatchVerdict::Culling;
    }
    let Some(observed) = observed else {
        return PatchVerdict::Coordinates(units(captured, expected));
    };
    let equal = |method| any_order(method).equal(case, observed, expected);
    match method {
        Method::Points if equal(method) => PatchVerdict::Order,
        Method::Primitives if equal(method) => order(case, observed, expected),
        Method::Primitives if equal(Method::Points) => PatchVerdict::Connectivity,
        _ => PatchVerdict::Coordinates(units(captured, expected)),
    }
}

/// How much of the order of the model's primitives is kept.
fn order(case: &Case, observed: &Tessellation, expected: &Tessellation) -> PatchVerdict {
    let sequence = Strength { order: ListOrder::Sequence, ..Strength::default() };
    if sequence.equal(case, observed, expected) {
        return PatchVerdict::Sequence;
    }
    let size = case.primitive_size();
    let [observed, expected] =
        [observed, expected].map(|output| vertices(output).collect::<Vec<_>>());
    let is_rotated = |(a, b): (&[_], &[_])| {
        (0..size).any(|by| (0..size).all(|i| a.get((i + by) % size) == b.get(i)))
    };
    let same_length = observed.len() == expected.len();
    if same_length && observed.chunks(size).zip(expected.chunks(size)).all(is_rotated) {
        PatchVerdict::Leading
    } else {
        PatchVerdict::Order
    }
}

/// The largest distance of a captured coordinate from the nearest point of the model, in units of
/// 2^-16 rounded up; 0 if the device only lacks points.
fn units(captured: &Captured, expected: &Tessellation) -> u32 {
    let distance = |vertex: &[u32; 3]| {
        let to = |point: &DomainPoint| {
            let [u, v] = [point.u.to_bits(), point.v.to_bits()];
            scaled_distance(vertex[0], u).max(scaled_distance(vertex[1], v))
        };
        expected.points.iter().map(to).min().unwrap_or(0)
    };
    captured.vertices.iter().map(distance).max().unwrap_or(0)
}

/// The distance between the binary32 with these bits and a 16.16 number, in units of 2^-16 rounded
/// up; at most 2^17.
#[expect(
    clippy::float_arithmetic,
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a figure for people; a NaN becomes 2^17"
)]
fn scaled_distance(bits: u32, number: u32) -> u32 {
    let distance = (f64::from(f32::from_bits(bits)) * 65536.0 - f64::from(number)).abs();
    distance.ceil().min(f64::from(2 * ONE)) as u32
}

/// Whether the third coordinates are right: 1 - u - v on triangles, 0 elsewhere.
pub(crate) fn third_is_right(case: &Case, captured: &Captured) -> bool {
    let right = |&[u, v, w]: &[u32; 3]| match (case.domain(), fixed(u), fixed(v)) {
        (Domain::Triangle, Some(u), Some(v)) => fixed(w) == ONE.checked_sub(u + v),
        // The faulty coordinate is reported already.
        (Domain::Triangle, _, _) => true,
        (Domain::Isoline | Domain::Quad, _, _) => w == 0,
    };
    captured.vertices.iter().all(right)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_rounded_up() {
        let distance = |units: f32| scaled_distance((units * ONE_UNIT).to_bits(), 1000);
        const ONE_UNIT: f32 = 1.0 / 65536.0;
        for (units, expected) in
            [(1000.0, 0), (1000.25, 1), (999.75, 1), (1001.0, 1), (1001.5, 2), (997.0, 3)]
        {
            assert_eq!(distance(units), expected, "{units}");
        }
        for odd in [f32::NAN, f32::INFINITY, -3.0, 4e9] {
            assert_eq!(scaled_distance(odd.to_bits(), 1000), 2 * ONE, "{odd}");
        }
    }

    /// Where there is no third coordinate, it must be 0 to the bit.
    #[test]
    fn third_coordinates() {
        let case = |line: &str| line.parse::<Case>().expect("a case");
        let one = 1f32.to_bits();
        let quad =
            "case quad integer point ruler 3f800000 3f800000 3f800000 3f800000 3f800000 3f800000";
        let lines = "case isoline integer point ruler 3f800000 3f800000";
        let tri = "case tri integer point ruler 3f800000 3f800000 3f800000 3f800000";
        for (line, w, is_right) in [
            (quad, 0, true),
            (quad, 1, false),
            (quad, one, false),
            (quad, (-0f32).to_bits(), false),
            (lines, 0, true),
            (lines, one, false),
            (lines, (-0f32).to_bits(), false),
            (tri, one, true),
            (tri, 0, false),
        ] {
            let captured = Captured { vertices: vec![[0, 0, w]] };
            assert_eq!(third_is_right(&case(line), &captured), is_right, "{line}, {w:08x}");
        }
    }
}
