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

/// The rules of Vulkan and of OpenGL.
const KHRONOS: &[Rule] = &[
    Rule::Same,
    Rule::EdgeLevel,
    Rule::Symmetric,
    Rule::EveryEdge,
    Rule::Winding,
    Rule::Interior,
    Rule::Transition,
    Rule::Range,
    Rule::Discard,
    Rule::Segments,
    Rule::Spacing,
    Rule::Monotone,
    Rule::Cover,
    Rule::Orientation,
    Rule::Isolines,
    Rule::PointsOnce,
    Rule::PointsSame,
];

/// The rules of Direct3D 11. Rounded locations may go backwards, so a triangle may turn the other way, and
/// may coincide, so an edge may show fewer segments than it has; `Counts` stands for these.
const D3D11: &[Rule] = &[
    Rule::Same,
    Rule::EdgeLevel,
    Rule::Symmetric,
    Rule::EveryEdge,
    Rule::Winding,
    Rule::Range,
    Rule::Discard,
    Rule::Cover,
    Rule::Isolines,
    Rule::PointsSame,
    Rule::Counts,
];

impl Specification {
    /// Its rules, in the order of [`Rule`].
    #[must_use]
    pub const fn rules(self) -> &'static [Rule] {
        match self {
            Self::Vulkan | Self::OpenGl => KHRONOS,
            Self::D3d11 => D3D11,
        }
    }

    /// Where it states a rule: section and title. Direct3D's rules are sections of `docs/specification.md`, which
    /// refines chapter 11 of the D3D11.3 functional specification.
    #[must_use]
    pub const fn source(self, rule: Rule) -> &'static str {
        match self {
            Self::Vulkan => vulkan(rule),
            Self::OpenGl => opengl(rule),
            Self::D3d11 => d3d11(rule),
        }
    }
}

const fn vulkan(rule: Rule) -> &'static str {
    match rule {
        Rule::Same => "Tessellation Invariance, rule 1",
        Rule::EdgeLevel => "Tessellation Invariance, rule 2",
        Rule::Symmetric => "Tessellation Invariance, rule 3",
        Rule::EveryEdge => "Tessellation Invariance, rule 4",
        Rule::Winding => "Tessellation Invariance, rule 5",
        Rule::Interior => "Tessellation Invariance, rule 6",
        Rule::Transition => "Tessellation Invariance, rule 7",
        Rule::Range => "Tessellation Invariance, rule 8",
        Rule::Discard => "22.2 Tessellator Patch Discard",
        Rule::Segments | Rule::Spacing | Rule::Monotone => "22.3 Tessellator Spacing",
        Rule::Orientation => "22.5 Tessellator Vertex Winding Order",
        Rule::Cover => "22.6 Triangle Tessellation, 22.7 Quad Tessellation",
        Rule::Isolines => "22.8 Isoline Tessellation",
        Rule::PointsOnce | Rule::PointsSame => "22.9 Tessellation Point Mode",
        Rule::Counts => "",
    }
}

/// Its list of invariance has the title and the numbers of Vulkan's.
const fn opengl(rule: Rule) -> &'static str {
    match rule {
        Rule::Discard
        | Rule::Segments
        | Rule::Spacing
        | Rule::Monotone
        | Rule::Orientation
        | Rule::Cover
        | Rule::Isolines
        | Rule::PointsOnce
        | Rule::PointsSame => "11.2.2 Tessellation Primitive Generation",
        Rule::Same
        | Rule::EdgeLevel
        | Rule::Symmetric
        | Rule::EveryEdge
        | Rule::Winding
        | Rule::Interior
        | Rule::Transition
        | Rule::Range
        | Rule::Counts => vulkan(rule),
    }
}

const fn d3d11(rule: Rule) -> &'static str {
    match rule {
        Rule::Same => "13 What the public specification leaves open: order",
        Rule::EdgeLevel | Rule::EveryEdge => "12.5 Crack-free",
        Rule::Symmetric => "12.2 Symmetry",
        Rule::Winding => "12.7 Winding",
        Rule::Range => "12.1 Range",
        Rule::Discard => "3 Factor processing: cull",
        Rule::Cover => "12.3 Area, 12.4 Manifold",
        Rule::Isolines => "6 Points, in order: isoline",
        Rule::PointsSame => "8 Output primitives",
        Rule::Counts => "12.6 Counts",
        Rule::Interior
        | Rule::Transition
        | Rule::Segments
        | Rule::Spacing
        | Rule::Monotone
        | Rule::Orientation
        | Rule::PointsOnce => "",
    }
}
