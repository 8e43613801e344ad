//! The rules for the number of segments of an edge.

/// The rule for the factor of an edge, 1 to 64, which can depend on the camera. Both patches of an
/// edge get the same factor.
///
/// For the formulas, see [`tess_surface::factors`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LevelOfDetail {
    /// The same factor everywhere.
    Uniform(f32),
    /// Segments of about this many pixels of the camera's picture.
    Pixels(f32),
    /// A factor of this number divided by the distance from the camera to the edge's midpoint.
    Distance(f32),
}

impl Default for LevelOfDetail {
    fn default() -> Self {
        Self::Pixels(8.0)
    }
}

impl LevelOfDetail {
    /// The kind and the amount, as `tess_edge` of surface.wgsl reads them.
    pub(crate) const fn words(self) -> [f32; 4] {
        let (kind, amount) = match self {
            Self::Uniform(factor) => (1.0, factor),
            Self::Pixels(pixels) => (2.0, pixels),
            Self::Distance(scale) => (3.0, scale),
        };
        [kind, amount, 0.0, 0.0]
    }

    /// The words of an entity that the camera does not see.
    pub(crate) const HIDDEN: [f32; 4] = [0.0; 4];
}
