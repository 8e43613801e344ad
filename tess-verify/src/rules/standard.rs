//! The rules, and where each standard states them.

use crate::names::Named;

/// A standard whose tessellator this is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Specification {
    /// Vulkan.
    Vulkan,
    /// OpenGL.
    OpenGl,
    /// Direct3D 11.
    D3d11,
}

/// What a standard demands of output.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum Rule {
    /// Equal levels and state give equal primitives in equal order.
    Same,
    /// The vertices of an outer edge depend on the edge's own level and the spacing.
    EdgeLevel,
    /// The vertices of an outer edge are mirrored about its middle.
    Symmetric,
    /// Equal levels give equal vertices on every outer edge.
    EveryEdge,
    /// The winding does not change the set of triangles.
    Winding,
    /// Triangles without a vertex on the outline depend on the inner levels and the spacing.
    Interior,
    /// Triangles at an outer edge depend on its level, the inner levels and the spacing.
    Transition,
    /// Vertices exist and lie in the domain.
    Range,
    /// A patch has no primitive if and only if an outer level is not above 0, or NaN.
    Discard,
    /// An edge has as many segments as its level asks for.
    Segments,
    /// Segments are equally long but for two, which lie symmetrically.
    Spacing,
    /// The two shorter segments do not shrink as the level grows.
    Monotone,
    /// Triangles cover the domain once: every edge within is shared, and the outline is walked once.
    Cover,
    /// No triangle turns the other way.
    Orientation,
    /// Isolines are equally spaced, none lies at v = 1, and each covers its line once.
    Isolines,
    /// Points are drawn once each.
    PointsOnce,
    /// Points are the vertices that lines or triangles of the same levels have.
    PointsSame,
    /// There are as many primitives as the levels ask for, degenerate ones included.
    Counts,
}

impl Named for Specification {
    const WHAT: &'static str = "specification";
    const NAMES: &'static [(&'static str, Self)] =
        &[("vulkan", Self::Vulkan), ("opengl", Self::OpenGl), ("d3d11", Self::D3d11)];
}

impl Named for Rule {
    const WHAT: &'static str = "rule";
    const NAMES: &'static [(&'static str, Self)] = &[
        ("same", Self::Same),
        ("edge-level", Self::EdgeLevel),
        ("symmetric", Self::Symmetric),
        ("every-edge", Self::EveryEdge),
        ("winding", Self::Winding),
        ("interior", Self::Interior),
        ("transition", Self::Transition),
        ("range", Self::Range),
        ("discard", Self::Discard),
        ("segments", Self::Segments),
        ("spacing", Self::Spacing),
        ("monotone", Self::Monotone),
        ("cover", Self::Cover),
        ("orientation", Self::Orientation),
        ("isolines", Self::Isolines),
        ("points-once", Self::PointsOnce),
        ("points-same", Self::PointsSame),
        ("counts", Self::Counts),
    ];
}

/// Where Vulkan, OpenGL and Direct3D 11 state each rule, in the order of [`Rule`]; empty where a standard has no such
/// rule. OpenGL's list of invariance has the title and the numbers of Vulkan's. In Direct3D rounded locations may go
/// backwards, so a triangle may turn the other way, and may coincide, so an edge may show fewer segments than it has;
/// `Counts` stands for these.
const SOURCES: [[&str; 3]; Rule::NAMES.len()] = {
    const GL: &str = "11.2.2 Tessellation Primitive Generation";
    const SPACING: &str = "22.3 Tessellator Spacing";
    const POINTS: &str = "22.9 Tessellation Point Mode";
    const RULES: [&str; 8] = [
        "Tessellation Invariance, rule 1",
        "Tessellation Invariance, rule 2",
        "Tessellation Invariance, rule 3",
        "Tessellation Invariance, rule 4",
        "Tessellation Invariance, rule 5",
        "Tessellation Invariance, rule 6",
        "Tessellation Invariance, rule 7",
        "Tessellation Invariance, rule 8",
    ];
    [
        [RULES[0], RULES[0], "13 What the public specification leaves open: order"],
        [RULES[1], RULES[1], "12.5 Crack-free"],
        [RULES[2], RULES[2], "12.2 Symmetry"],
        [RULES[3], RULES[3], "12.5 Crack-free"],
        [RULES[4], RULES[4], "12.7 Winding"],
        [RULES[5], RULES[5], ""],
        [RULES[6], RULES[6], ""],
        [RULES[7], RULES[7], "12.1 Range"],
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
    pub fn rules(self) -> impl Iterator<Item = Rule> {
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
