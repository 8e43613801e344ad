//! The standards.

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
