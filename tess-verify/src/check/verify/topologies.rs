//! Every topology, by integer factors (spec section 12.8).

use crate::case::Case;
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors, SplitOrder};

/// Every pair of an outer and an inside factor, because a transition depends only on the two point
/// counts. On quads along both axes, and on triangles.
pub(super) fn transitions() -> impl Iterator<Item = Case> {
    let pairs = (1..=64u8).flat_map(|inside| (1..=64u8).map(move |outer| (outer, inside)));
    SplitOrder::ALL.into_iter().flat_map(move |split| {
        pairs.clone().flat_map(move |(outer, inside)| {
            let next = outer % 64 + 1;
            [
                integer(Domain::Quad, split, &[outer, 2, next, 1, 3, inside]),
                integer(Domain::Quad, split, &[1, outer, 3, next, inside, 4]),
                integer(Domain::Triangle, split, &[outer, next, 65 - outer, inside]),
            ]
            .into_iter()
            .flatten()
        })
    })
}

/// Triangles by inside factor, quads by every pair of inside factors, and isolines by every pair of
/// factors.
pub(super) fn interiors() -> impl Iterator<Item = Case> {
    let pairs = (1..=64u8).flat_map(|a| (1..=64u8).map(move |b| (a, b)));
    pairs.flat_map(|(a, b)| {
        let triangle = integer(Domain::Triangle, SplitOrder::Ruler, &[1, 2, 3, a]);
        [
            integer(Domain::Quad, SplitOrder::Ruler, &[1, 2, 3, 4, a, b]),
            integer(Domain::Isoline, SplitOrder::Ruler, &[a, b]),
            triangle.filter(|_| b == 1),
        ]
        .into_iter()
        .flatten()
    })
}

/// A patch with these integer factors; `None` if their number is not the domain's.
fn integer(domain: Domain, split: SplitOrder, factors: &[u8]) -> Option<Case> {
    let output = OutputPrimitive::TriangleCw;
    let config = Config { partitioning: Partitioning::Integer, output, split };
    let factors = PatchFactors::from_slice(domain, factors)?.map(f32::from);
    Some(Case { config, factors })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The patches of outer factors 7 and 64 with inside factor 5; the factor after 64 is 1.
    #[test]
    fn pairs_come_in_both_axes_and_on_triangles() {
        let all: Vec<Case> = transitions().collect();
        assert_eq!(all.len(), 2 * 64 * 64 * 3, "split orders, pairs, patches");
        for (outer, expected) in [
            (7, [&[7, 2, 8, 1, 3, 5][..], &[1, 7, 3, 8, 5, 4], &[7, 8, 58, 5]]),
            (64, [&[64, 2, 1, 1, 3, 5], &[1, 64, 3, 1, 5, 4], &[64, 1, 1, 5]]),
        ] {
            let first = 3 * (64 * (5 - 1) + outer - 1);
            let domains = [Domain::Quad, Domain::Quad, Domain::Triangle];
            let expected = domains.into_iter().zip(expected).map(|(domain, factors)| {
                integer(domain, SplitOrder::Ruler, factors).expect("as many factors")
            });
            assert_eq!(all[first..first + 3], expected.collect::<Vec<_>>(), "outer {outer}");
        }
    }
}
