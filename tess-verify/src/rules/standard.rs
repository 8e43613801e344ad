//! The rules, and where each standard states them.

use crate::names::{Named, named};

named! {
    /// A standard whose tessellator this is.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum Specification: "specification" {
        /// Vulkan.
        Vulkan = "vulkan",
        /// OpenGL.
        OpenGl = "opengl",
        /// Direct3D 11.
        D3d11 = "d3d11",
    }
}

named! {
    /// A demand of a standard on output.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    #[non_exhaustive]
    pub enum Rule: "rule" {
        /// Equal levels and state give equal primitives in equal order.
        Same = "same",
        /// The vertices of an outer edge depend on the edge's own level and the spacing.
        EdgeLevel = "edge-level",
        /// The vertices of an outer edge are mirrored about its middle.
        Symmetric = "symmetric",
        /// Equal levels give equal vertices on every outer edge.
        EveryEdge = "every-edge",
        /// The winding does not change the set of triangles.
        Winding = "winding",
        /// Triangles without a vertex on the outline depend on the inner levels and the spacing.
        Interior = "interior",
        /// Triangles at an outer edge depend on its level, the inner levels and the spacing.
        Transition = "transition",
        /// Vertices exist and lie in the domain.
        Range = "range",
        /// A patch has no primitive if and only if an outer level is not above 0, or NaN.
        Discard = "discard",
        /// An edge has as many segments as its level asks for.
        Segments = "segments",
        /// Segments are equally long but for two, which lie symmetrically.
        Spacing = "spacing",
        /// The two shorter segments do not shrink as the level grows.
        Monotone = "monotone",
        /// Triangles cover the domain once: every edge within is shared, and the outline is walked once.
        Cover = "cover",
        /// No triangle turns the other way.
        Orientation = "orientation",
        /// Isolines are equally spaced, none lies at v = 1, and each covers its line once.
        Isolines = "isolines",
        /// Points are drawn once each.
        PointsOnce = "points-once",
        /// Points are the vertices that lines or triangles of the same levels have.
        PointsSame = "points-same",
        /// There are as many primitives as the levels ask for, degenerate ones included.
        Counts = "counts",
    }
}

/// Where Vulkan, OpenGL and Direct3D 11 state each rule, in the order of [`Rule`]; empty where a standard has no such
/// rule. OpenGL's list of invariance has the title and the numbers of Vulkan's. In Direct3D rounded locations may go
/// backwards, so a triangle may turn the other way, and may coincide, so an edge may show fewer segments than it has;
/// `Counts` stands for these.
const SOURCES: [[&str; 3]; Rule::NAMES.len()] = {
    const GL: &str = "11.2.2 Tessellation Primitive Generation";
    const SPACING: &str = "22.3 Tessellator Spacing";
    const POINTS: &str = "22.9 Tessellation Point Mode";
    macro_rules! rule {
        ($number:literal) => {
            concat!("Tessellation Invariance, rule ", $number)
        };
    }
    [
        [rule!(1), rule!(1), "13 What the public specification leaves open: order"],
        [rule!(2), rule!(2), "12.5 Crack-free"],
        [rule!(3), rule!(3), "12.2 Symmetry"],
        [rule!(4), rule!(4), "12.5 Crack-free"],
        [rule!(5), rule!(5), "12.7 Winding"],
        [rule!(6), rule!(6), ""],
        [rule!(7), rule!(7), ""],
        [rule!(8), rule!(8), "12.1 Range"],
        ["22.2 Tessellator Patch Discard", GL, "3 Factor processing: cull"],
        [SPACING, GL, ""],
        [SPACING, GL, ""],
        [SPACING, GL, ""],
        ["22.6 Triangle Tessellation, 22.7 Quad Tessellation", GL, "12.3 Area, 12.4 Manifold"],
        ["22.5 Tessellator Vertex Winding Order", GL, ""],
        ["22.8 Isoline Tessellation", GL, "6 Points, in order: isoline"],
        [POINTS, GL, ""],
        [POINTS, GL, "8 Output primitives"],
        ["", "", "12.6 Counts"],
    ]
};

impl Specification {
    /// Its rules, in the order of [`Rule`].
    pub(super) fn rules(self) -> impl Iterator<Item = Rule> {
        let all = Rule::NAMES.iter().map(|(_, rule)| *rule);
        all.filter(move |rule| !self.source(*rule).is_empty())
    }

    /// Where it states a rule: section and title; empty if it has no such rule. Direct3D's rules are sections of
    /// `docs/specification.md`, which refines chapter 11 of the D3D11.3 functional specification.
    #[must_use]
    pub const fn source(self, rule: Rule) -> &'static str {
        SOURCES[rule as usize][self as usize]
    }
}
