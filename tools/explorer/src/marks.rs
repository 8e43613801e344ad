//! Marks of the page: areas of triangles, middles and splits of edges.

use tess_core::place::placement;
use tess_core::{FactorContext, OutputPrimitive, Patch, PatchFactors, PointOrigin};
use tess_verify::vectors::Listing;

/// Twice the signed area of each triangle, in units of 2^-32; nothing for points and lines.
#[expect(clippy::cast_precision_loss, reason = "below 2^53 for points of the domain")]
pub(crate) fn areas(listing: &Listing) -> Vec<f64> {
    let output = listing.case.config.output;
    let orientation = if output == OutputPrimitive::TriangleCcw { -1 } else { 1 };
    let corner = |index: u32| {
        let point = listing.output.points.get(index as usize);
        point.map_or((0, 0), |p| (i64::from(p.u.to_bits()), i64::from(p.v.to_bits())))
    };
    let corners = |primitive: &[u32]| primitive.iter().map(|&i| corner(i)).collect::<Vec<_>>();
    let area = |primitive: &[u32]| match corners(primitive)[..] {
        [(u0, v0), (u1, v1), (u2, v2)] => {
            let doubled = (u1 - u0) * (v2 - v0) - (u2 - u0) * (v1 - v0);
            Some((orientation * doubled) as f64)
        }
        _ => None,
    };
    listing.primitives().filter_map(area).collect()
}

/// A mark for each point: 1 for the exact middle of an even edge, 2 for the split.
pub(crate) fn points(patch: &Patch) -> Vec<u8> {
    (0..patch.counts().points).map(|i| mark(patch, i).unwrap_or(0)).collect()
}

fn mark(patch: &Patch, i: u32) -> Option<u8> {
    let (context, p) = edge(patch, i)?;
    let placement = placement(&context, p);
    Some(match placement.blend {
        None => 1,
        Some(_) if placement.position == context.split_position => 2,
        Some(_) => 0,
    })
}

/// The context of the outer edge or line of a point, and its number there.
fn edge(patch: &Patch, i: u32) -> Option<(FactorContext, u32)> {
    let factors = patch.processed().factors()?;
    match patch.locate_point(i)? {
        PointOrigin::OuterEdge { edge, p } => {
            factors.iter().nth(edge as usize).map(|factor| (factor.context, p))
        }
        PointOrigin::Line { p, .. } => match factors {
            PatchFactors::Isoline(factors) => Some((factors.detail.context, p)),
            _ => None,
        },
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::fixed_point::ONE;

    fn listing(factor: &str, output: &str) -> Listing {
        let line =
            format!("case quad fractional_even {output} ruler{}", format!(" {factor}").repeat(6));
        Listing::of_model(line.parse().expect("a case"))
    }

    #[test]
    fn areas_fill_the_domain_whatever_the_winding() {
        let square = 2.0 * f64::from(ONE) * f64::from(ONE);
        for output in ["triangle_cw", "triangle_ccw"] {
            let areas = areas(&listing("40600000", output));
            assert!(areas.iter().all(|area| *area > 0.0), "{output}: none is flipped");
            assert_eq!(areas.iter().sum::<f64>().to_bits(), square.to_bits(), "{output}");
        }
        assert!(
            areas(&listing("40c00020", "triangle_cw")).iter().any(|area| *area < 0.0),
            "flipped"
        );
        assert_eq!(areas(&listing("40600000", "line")), [0.0; 0], "lines have none");
    }

    #[test]
    fn middles_and_splits_of_each_edge_are_marked() {
        let case = listing("40600000", "triangle_cw").case;
        let marks = points(&case.patch());
        let count = |kind| marks.iter().filter(|mark| **mark == kind).count();
        assert_eq!((count(1), count(2)), (4, 8), "one middle and two splits on each of four edges");
    }
}
