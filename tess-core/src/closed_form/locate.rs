//! The random-access formulation: any point or primitive from only its number, in constant time.
//!
//! Parallel hardware and shaders make element `i` without the elements before it.
//! `Patch::locate_point`, `point`, `locate_primitive` and `primitive` call this module, and
//! `tess-gpu`'s shaders have the same stages. It uses closed forms instead of the sequential walks
//! of `model::points` and `model::connect`; a test compares the two on every topology.
//!
//! # The data
//!
//! A patch's points and triangles are lists of slots whose sizes follow from point counts. With `n`
//! the points of an outer edge and `u`, `v` those of the inside factors, a quad has:
//!
//! ```text
//! points      | outer edge 0..4    | ring 1: edges 0..4  | ring 2 ... | centre row
//! slot sizes  | n - 1 each         | v-3, u-3, v-3, u-3  | 2 fewer    | what is left
//!
//! triangles   | transitions 0..4   | ring 2: edges 0..4          | ring 3 ... | centre strip
//! slot sizes  | n + along - 4 each | 2 (v-4), 2 (u-4), twice     | 4 fewer    | what is left
//! ```
//!
//! The sizes of successive rings are an arithmetic progression, so the number of elements before a
//! ring is a product (`quad_points_before`, `triangles_before`). A number is located in three
//! steps: whether it is in the outer part; its ring, by a binary search over these products; its
//! slot in the ring, by at most three subtractions.
//!
//! # One patch
//!
//! The quad (3, 4.5, 5, 6; 4, 7), fractional even, has 5, 7, 7, 7 points on its edges, and u = 5, v
//! = 9. Its outer ring has 4 + 6 + 6 + 6 = 22 points, ring 1 has 6 + 2 + 6 + 2 = 16, and the centre
//! row has 5. Point 30 is number 8 of the interior. That is ring 1, past the 6 + 2 points of edges
//! 0 and 1: the first point of edge 2. The transitions have 10, 8, 12 and 8 triangles, ring 2 has
//! 10, 2, 10 and 2. Triangle 45 is number 7 after the 38 of the transitions: ring 2, edge 0, step
//! 7. The test `the_worked_patch` checks these numbers.
//!
//! # What holds
//!
//! - The callers have checked that the number is below the patch's count. A larger number would
//!   fall into the last slot and give the origin of an element that does not exist.
//! - The products grow with the ring, and the first is at most the number. The search relies on
//!   both.
//! - Nothing overflows: counts are below 2^15, and products of a ring and a count below 2^13.
//! - Origins are pure values. `point` and `primitive` return `None` for an origin of another kind
//!   of patch or output. They rely on `locate` for its ring, edge and step.
//!
//! # Why not simpler
//!
//! Walking to element `i` takes as many steps as there are elements before it, up to 4224 for a
//! point. Solving the quadratic for the ring would take a square root, which neither this crate nor
//! WGSL without floats has. The search has five steps, because a patch has at most 32 rings.

mod centre_strip;
pub(crate) mod origin;
pub(crate) mod point;
pub(crate) mod primitive;
mod rings;
mod stitch;

/// The largest `ring` in `1..end` with `first(ring) <= target`, found bit by bit: five steps,
/// because a patch has at most 32 rings. `first` grows with the ring and `first(1) <= target`.
fn last_ring_at_or_before(target: u32, end: u32, first: impl Fn(u32) -> u32) -> u32 {
    let mut ring = 1;
    for step in [16, 8, 4, 2, 1] {
        if ring + step < end && first(ring + step) <= target {
            ring += step;
        }
    }
    ring
}

/// Splits `target` into the slot that it falls into and its place within that slot, for slots of
/// these sizes. Anything past the other slots falls into the last one.
fn slot_of<const N: usize>(target: u32, sizes: [u32; N]) -> (u32, u32) {
    let mut slot = 0;
    let mut place = target;
    for &size in &sizes[..N - 1] {
        if place < size {
            break;
        }
        place -= size;
        slot += 1;
    }
    (slot, place)
}

#[cfg(test)]
mod tests {
    use crate::{Config, DomainPoint, OutputPrimitive, Partitioning, Patch, Primitive};
    use crate::{PointOrigin, PrimitiveOrigin, QuadFactors, TriangleFactors};

    /// The numbers of the head of this file.
    #[test]
    fn the_worked_patch() {
        let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
        let patch = Patch::new(config, QuadFactors::from([3.0, 4.5, 5.0, 6.0, 4.0, 7.0]));
        assert_eq!((patch.counts().points, patch.counts().primitives), (22 + 16 + 5, 38 + 24));
        let point = |i| patch.locate_point(i);
        assert_eq!(point(7), Some(PointOrigin::OuterEdge { edge: 1, p: 3 }), "4 are before edge 1");
        assert_eq!(point(30), Some(PointOrigin::Ring { ring: 1, edge: 2, p: 0 }), "22 + 8");
        assert_eq!(point(40), Some(PointOrigin::Centre { p: 2 }), "38 + 2");
        let triangle = |t| patch.locate_primitive(t);
        assert_eq!(triangle(12), Some(PrimitiveOrigin::Transition { edge: 1, step: 2 }), "10 + 2");
        assert_eq!(
            triangle(45),
            Some(PrimitiveOrigin::Ring { ring: 2, edge: 0, step: 7 }),
            "38 + 7"
        );
    }

    /// The numbers of the heads of `rings` and `point`.
    #[test]
    fn the_worked_rings() {
        let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
        let patch = Patch::new(config, TriangleFactors::from([3.0, 3.0, 3.0, 8.0]));
        let rings = [18, 12, 6];
        let points = 9 + rings.iter().sum::<u32>() + 1;
        assert_eq!((patch.counts().points, patch.counts().primitives), (points, 27 + 30 + 18 + 6));
        let (ring, edge) = (3, 0);
        assert_eq!(patch.locate_primitive(60), Some(PrimitiveOrigin::Ring { ring, edge, step: 3 }));
        assert_eq!(
            patch.primitive(60),
            Some(Primitive::Triangle([40, 29, 30])),
            "27 to 31, 39 to 41"
        );
        let origin = PointOrigin::Ring { ring: 2, edge: 1, p: 2 };
        assert_eq!(patch.locate_point(33), Some(origin), "9 + 18 + 4 + 2");
        assert_eq!(
            patch.point(33),
            Some(DomainPoint::from_bits(0x6aaa, 0x2aab)),
            "5 / 12 and 1 / 6"
        );
    }

    /// The pictures of `centre_strip`.
    #[test]
    fn the_worked_strips() {
        let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
        let strip = |inside_u, inside_v| {
            let factors = QuadFactors::from([3.0, 3.0, 3.0, 3.0, inside_u, inside_v]);
            let patch = Patch::new(config, factors);
            [20, 21, 22, 23, 24, 25].map(|t| patch.primitive(t).expect("the last six"))
        };
        let along_u =
            [[12, 13, 14], [12, 14, 19], [19, 14, 15], [19, 15, 18], [18, 15, 16], [18, 16, 17]];
        assert_eq!(strip(5.0, 3.0), along_u.map(Primitive::Triangle), "all alike");
        let along_v =
            [[12, 13, 19], [19, 13, 18], [13, 17, 18], [13, 14, 17], [14, 15, 17], [17, 15, 16]];
        assert_eq!(strip(3.0, 5.0), along_v.map(Primitive::Triangle), "the middle is turned");
    }
}
