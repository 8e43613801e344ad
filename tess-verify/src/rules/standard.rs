//! The standards, and where each of them states a rule.

use super::rule::{ROWS, Row, Rule};
use crate::names::named;

named! {
    /// A standard by which a tessellator is judged.
    #[derive(Clone, Copy, Debug, PartialEq, Eq)]
    #[non_exhaustive]
    pub enum Specification: "specification" {
        /// Vulkan.
        Vulkan = "vulkan",
        /// OpenGL, whose text Vulkan's is derived from. It states the same rules.
        OpenGl = "opengl",
        /// Direct3D 11. Its locations are exact, so `Places` and `Primitives` cover what other
        /// standards say of spacing, winding and the inside.
        D3d11 = "d3d11",
    }
}

impl Specification {
    /// Its rules, in the order of [`Rule`].
    pub(super) fn rules(self) -> impl Iterator<Item = &'static Row> {
        ROWS.iter().filter(move |row| row.source(self).is_some())
    }

    /// The section of the standard that states a rule, by number and title; `None` if the standard
    /// has no such rule.
    ///
    /// Direct3D's rules are sections of `docs/specification.md`, which refines chapter 11 of the
    /// D3D11.3 functional specification.
    #[must_use]
    pub const fn source(self, rule: Rule) -> Option<&'static str> {
        Row::of(rule).source(self)
    }
}
