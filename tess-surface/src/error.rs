//! The reasons to refuse a mesh, a patch or a height image.

use tess_core::Domain;
use thiserror::Error;

/// The largest magnitude that a coordinate may have: 1e16.
///
/// Lengths, bounds of derivatives and normals are square roots of sums of squares of differences of
/// coordinates. The largest such differences are the tangents of curved quads, up to 32 times as
/// large as the corners' coordinates. Within this limit the sums stay below 1e36; binary32 ends at
/// 3.4e38, and larger sums would make results infinite or NaN.
pub const MAX_COORDINATE: f32 = 1e16;

/// A fault of one face or patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum FaceError {
    /// An index is past the end of its list.
    #[error("a {what} index is out of range: there are {count}")]
    OutOfRange {
        /// The name of the list's elements.
        what: &'static str,
        /// The number of elements in the list.
        count: usize,
    },
    /// The number of normals or texture coordinates is not the number of corners.
    #[error("a face of {corners} corners has {found} {what} indices")]
    WrongCount {
        /// The name of the elements.
        what: &'static str,
        /// The number that the face has.
        found: usize,
        /// The number of its corners.
        corners: usize,
    },
    /// A position, texture coordinate or control point is NaN or infinite, or a normal has no
    /// direction. The string says which of them.
    #[error("a {0} is {zero}NaN or infinite", zero = if *.0 == "normal" { "zero, " } else { "" })]
    NotFinite(&'static str),
    /// A position, texture coordinate or control point has a coordinate beyond [`MAX_COORDINATE`].
    /// The string says which of them.
    #[error(
        "a {0} is too large to be evaluated: coordinates must lie within {MAX_COORDINATE:e} of 0"
    )]
    TooLarge(&'static str),
    /// Two neighbouring corners have the same position.
    #[error("two neighbouring corners are in the same place")]
    RepeatedCorner,
    /// All corners or control points are on one line.
    #[error("it has zero area")]
    NoArea,
    /// A weight is not greater than zero.
    #[error("a weight is not greater than zero")]
    Weight,
}

/// The reason why a mesh or a list of patches cannot be made into a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[non_exhaustive]
pub enum MeshError {
    /// The mesh has no face.
    #[error("there is no face")]
    Empty,
    /// The mesh has 2^30 faces or more.
    #[error("there are {faces} faces; 2^30 are too many")]
    TooMany {
        /// The number of faces.
        faces: usize,
    },
    /// A face has a fault; this is the first such face.
    #[error("face {face}: {fault}")]
    Face {
        /// Its number, from 0.
        face: usize,
        /// Its fault.
        fault: FaceError,
    },
}

/// Values for the corners of another domain than the surface's were given.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Error)]
#[error("the values belong to a {found:?} patch, but the surface is a {expected:?}")]
pub struct WrongDomainError {
    /// The domain of the values.
    pub found: Domain,
    /// The domain of the surface.
    pub expected: Domain,
}

/// The reason why a height image, or a displacement by it, is refused.
#[derive(Clone, Copy, Debug, PartialEq, Error)]
#[non_exhaustive]
pub enum HeightError {
    /// The number of texels is not width times height, or it is 0.
    #[error(
        "there are {texels} texels for an image of {width} x {height}; give one for each place, and at least one"
    )]
    WrongLength {
        /// The number of texels.
        texels: usize,
        /// The width of the image.
        width: usize,
        /// The height of the image.
        height: usize,
    },
    /// A texel is NaN or infinite.
    #[error("texel {index} is NaN or infinite; replace it by a number")]
    NotFinite {
        /// Its number, from 0.
        index: usize,
    },
    /// A texel is beyond [`MAX_COORDINATE`].
    #[error(
        "texel {index} is too large to be evaluated: heights must lie within {MAX_COORDINATE:e} of 0"
    )]
    TooLarge {
        /// Its number, from 0.
        index: usize,
    },
    /// The image's largest height times the scale is NaN or beyond [`MAX_COORDINATE`].
    #[error(
        "heights up to {height:e} times the scale {scale:e} are too large to be evaluated: products must lie within \
         {MAX_COORDINATE:e} of 0"
    )]
    TooHigh {
        /// The largest magnitude in the image.
        height: f32,
        /// The scale.
        scale: f32,
    },
}
