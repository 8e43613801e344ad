//! Where a point or a primitive comes from: line, ring and edge, and its number there.
//!
//! The terms of the specification's walks (sections 6 to 8) as values. `locate` makes them from
//! numbers; explanations and comparisons print them. In the picture of a quad's edges and rings, an
//! edge's points are numbered in the direction of the walk:
//!
//! ```text
//!        0 <-- 21 .. 17 <-- 16      edge 3, v = 1
//!        1   22 <- 37 <- 36   15
//!        :    :   ring 1  :    :     edge 0, u = 0, runs down from (0, 1); edge 2, u = 1, runs up
//!        3   28 -> 29 -> 30   11
//!        4 -->  5 ..  9 --> 10      edge 1, v = 0
//!
//!     Each edge has its first point and not its last, which begins the next edge.
//! ```
//!
//! In the quad (3, 4.5, 5, 6; 4, 7) of `docs/tour-cpu.md` point 30 is `Ring { ring: 1, edge: 2, p:
//! 0 }` and point 42 `Centre { p: 4 }`. Triangle 45 is `Ring { ring: 2, edge: 0, step: 7 }`: its
//! stitch joins ring 1 to ring 2, and is named after the inner one. `locate.rs` works these numbers
//! out, and its test `the_worked_patch` checks them.
//!
//! Invariant: an origin is a pure value. Its numbers mean something only for the patch that
//! `locate` made it for.

/// Where a domain point comes from in the walk of spec section 6.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PointOrigin {
    /// Corner `corner` of a minimum patch.
    Corner {
        /// Number of the corner.
        corner: u32,
    },
    /// Point `p` of an isoline.
    Line {
        /// Number of the line, from v = 0.
        line: u32,
        /// Number of the point on it, from u = 0.
        p: u32,
    },
    /// Point `p` of an outer edge.
    OuterEdge {
        /// Number of the edge: u = 0, v = 0, then w = 0 or u = 1, v = 1.
        edge: u32,
        /// Number of the point in the direction of the walk.
        p: u32,
    },
    /// Point `p` of an edge of an interior ring.
    Ring {
        /// Number of the ring, from 1.
        ring: u32,
        /// Number of the edge.
        edge: u32,
        /// Number of the point in the direction of the walk.
        p: u32,
    },
    /// Point `p` of the single point or row of points that ends an even interior.
    Centre {
        /// Number of the point.
        p: u32,
    },
}

/// Where a primitive comes from in the walk of spec sections 7 and 8.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum PrimitiveOrigin {
    /// Point output, or the line that joins the points in order: primitive `step`.
    Sequence {
        /// Number of the primitive.
        step: u32,
    },
    /// Segment `segment` of an isoline.
    Line {
        /// Number of the line, from v = 0.
        line: u32,
        /// Number of the segment, from u = 0.
        segment: u32,
    },
    /// Triangle `step` of a minimum patch.
    Minimum {
        /// Number of the triangle.
        step: u32,
    },
    /// Triangle `step` of the stitch between an outer edge and ring 1.
    Transition {
        /// Number of the edge: u = 0, v = 0, then w = 0 or u = 1, v = 1.
        edge: u32,
        /// Number of the triangle along the stitch.
        step: u32,
    },
    /// Triangle `step` of the stitch between one edge of rings `ring - 1` and `ring`.
    Ring {
        /// Number of the inner ring, from 2.
        ring: u32,
        /// Number of the edge.
        edge: u32,
        /// Number of the triangle along the stitch.
        step: u32,
    },
    /// Triangle `step` inside the innermost ring.
    Centre {
        /// Number of the triangle.
        step: u32,
    },
}
