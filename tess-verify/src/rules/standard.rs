//! The rules, and where each standard states them.

use crate::names::{Named, named};

named! {
    /// A standard by which a tessellator is judged.
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
    /// A demand of a standard on a tessellator's output.
    #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
    #[non_exhaustive]
    pub enum Rule: "rule" {
        /// Equal levels and state give the same primitives in the same order.
        Same = "same",
        /// The vertices of an outer edge depend only on the edge's own level and the spacing.
        EdgeLevel = "edge-level",
        /// The vertices of an outer edge are symmetric about its middle.
        Symmetric = "symmetric",
        /// Equal levels give equal vertices on every outer edge.
        EveryEdge = "every-edge",
        /// The winding does not change the set of triangles.
        Winding = "winding",
        /// Triangles without a vertex on the outline depend only on the inner levels and the
        /// spacing.
        Interior = "interior",
        /// Triangles at an outer edge depend only on its level, the inner levels and the spacing.
        Transition = "transition",
        /// Every index names a vertex, and the vertices are in the domain.
        Range = "range",
        /// A patch has no primitives if and only if an outer level is NaN or not above 0.
        Discard = "discard",
        /// An edge has as many segments as its level asks for.
        Segments = "segments",
        /// All segments have equal lengths, except two, which are symmetric and vanish just above
        /// the integer below.
        Spacing = "spacing",
        /// The inner levels give the numbers of columns and rows of a quad, and of rings of a
        /// triangle.
        InnerLevels = "inner-levels",
        /// The columns, rows and rings inside are spaced like edges of the same levels.
        InnerSpacing = "inner-spacing",
        /// Lines of equal levels are divided equally: outer edges, isolines, columns, rows and
        /// rings.
        EqualLevels = "equal-levels",
        /// The two shorter segments grow with the level.
        Monotone = "monotone",
        /// Triangles cover the domain once: every edge inside is shared, and the outline is walked
        /// once.
        Cover = "cover",
        /// Each triangle joins two neighbouring vertices of one line with a vertex of the next
        /// line.
        Neighbours = "neighbours",
        /// No triangle turns the wrong way.
        Orientation = "orientation",
        /// Isolines are equally spaced, none is at v = 1, and each covers its line once.
        Isolines = "isolines",
        /// Each point is drawn once.
        PointsOnce = "points-once",
        /// Points are the vertices that lines or triangles of the same levels have.
        PointsSame = "points-same",
        /// There are as many primitives as the levels ask for, degenerate ones included.
        Counts = "counts",
        /// Vertices are where the specification places them.
        Places = "places",
        /// Primitives are those of the specification, in any order.
        Primitives = "primitives",
    }
}

/// Sections about tessellation in Vulkan 1.3.
mod vulkan {
    pub(super) const DISCARD: &str = "22.2 Tessellator Patch Discard";
    pub(super) const SPACING: &str = "22.3 Tessellator Spacing";
    pub(super) const WINDING: &str = "22.5 Tessellator Vertex Winding Order";
    pub(super) const MESH: &str = "22.6 Triangle Tessellation, 22.7 Quad Tessellation";
    pub(super) const ISOLINES: &str = "22.8 Isoline Tessellation";
    pub(super) const POINTS: &str = "22.9 Tessellation Point Mode";
}

/// The section of OpenGL 4.6 about tessellation, without its list of invariance rules.
const OPENGL: &str = "11.2.2 Tessellation Primitive Generation";

/// A rule of the list of invariance rules, which has the same title and numbers in Vulkan and
/// OpenGL.
macro_rules! invariance {
    ($number:literal) => {
        Some(concat!("Tessellation Invariance, rule ", $number))
    };
}

impl Specification {
    /// Its rules, in the order of [`Rule`].
    pub(super) fn rules(self) -> impl Iterator<Item = Rule> {
        let all = Rule::NAMES.iter().map(|(_, rule)| *rule);
        all.filter(move |rule| self.source(*rule).is_some())
    }

    /// The section of the standard that states a rule, by number and title; `None` if the standard
    /// has no such rule.
    ///
    /// Direct3D's rules are sections of `docs/specification.md`, which refines chapter 11 of the
    /// D3D11.3 functional specification.
    #[must_use]
    pub const fn source(self, rule: Rule) -> Option<&'static str> {
        match self {
            Self::Vulkan => vulkan_source(rule),
            Self::OpenGl => opengl_source(rule),
            Self::D3d11 => d3d11_source(rule),
        }
    }
}

const fn vulkan_source(rule: Rule) -> Option<&'static str> {
    match rule {
        Rule::Same => invariance!(1),
        Rule::EdgeLevel => invariance!(2),
        Rule::Symmetric => invariance!(3),
        Rule::EveryEdge => invariance!(4),
        Rule::Winding => invariance!(5),
        Rule::Interior => invariance!(6),
        Rule::Transition => invariance!(7),
        Rule::Range => invariance!(8),
        Rule::Discard => Some(vulkan::DISCARD),
        Rule::Segments | Rule::Spacing | Rule::EqualLevels | Rule::Monotone => {
            Some(vulkan::SPACING)
        }
        Rule::InnerLevels | Rule::InnerSpacing | Rule::Cover | Rule::Neighbours => {
            Some(vulkan::MESH)
        }
        Rule::Orientation => Some(vulkan::WINDING),
        Rule::Isolines => Some(vulkan::ISOLINES),
        Rule::PointsOnce | Rule::PointsSame => Some(vulkan::POINTS),
        Rule::Counts | Rule::Places | Rule::Primitives => None,
    }
}

/// Vulkan's text is derived from OpenGL's, so OpenGL states the same rules.
const fn opengl_source(rule: Rule) -> Option<&'static str> {
    match rule {
        Rule::Same
        | Rule::EdgeLevel
        | Rule::Symmetric
        | Rule::EveryEdge
        | Rule::Winding
        | Rule::Interior
        | Rule::Transition
        | Rule::Range => vulkan_source(rule),
        _ if vulkan_source(rule).is_some() => Some(OPENGL),
        _ => None,
    }
}

/// Direct3D's locations are exact, so `Places` and `Primitives` cover what other standards say of
/// spacing, winding and the inside.
const fn d3d11_source(rule: Rule) -> Option<&'static str> {
    match rule {
        Rule::Same => Some("13 What the public specification leaves open: order"),
        Rule::EdgeLevel | Rule::EveryEdge => Some("12.5 Crack-free"),
        Rule::Symmetric => Some("12.2 Symmetry"),
        Rule::Winding => Some("12.7 Winding"),
        Rule::Range => Some("12.1 Range"),
        Rule::Discard => Some("3 Factor processing: cull"),
        Rule::Segments => Some("4 The factor context: points"),
        Rule::InnerLevels => Some("6 Points, in order: interior"),
        Rule::Cover => Some("12.3 Area, 12.4 Manifold"),
        Rule::Isolines => Some("6 Points, in order: isoline"),
        Rule::PointsSame => Some("8 Output primitives"),
        Rule::Counts => Some("12.6 Counts"),
        Rule::Places => Some("6 Points, in order"),
        Rule::Primitives => Some("7 Connectivity"),
        Rule::Spacing
        | Rule::InnerSpacing
        | Rule::EqualLevels
        | Rule::Monotone
        | Rule::Interior
        | Rule::Transition
        | Rule::Neighbours
        | Rule::Orientation
        | Rule::PointsOnce => None,
    }
}
