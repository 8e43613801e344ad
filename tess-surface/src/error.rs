//! Why a mesh or a patch is refused.

use core::fmt;
use tess_core::Domain;

/// The largest magnitude that a coordinate may have: 1e16.
///
/// Lengths, bounds of derivatives and normals are square roots of sums of squares of differences of
/// coordinates. The largest such differences are the tangents of curved quads, up to 32 times as large
/// as the corners' coordinates, so that the sums stay below 1e36; binary32 ends at 3.4e38. Beyond
/// that, positions would be infinite or NaN.
pub const MAX_COORDINATE: f32 = 1e16;

/// Fault of one face or patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshFault {
    /// An index points beyond its list.
    OutOfRange {
        /// The name of the list's elements.
        what: &'static str,
        /// The number of elements in the list.
        count: usize,
    },
    /// The normals or texture coordinates are not one for each corner.
    WrongCount {
        /// The name of the elements.
        what: &'static str,
        /// How many the face has.
        found: usize,
        /// The number of its corners.
        corners: usize,
    },
    /// A position or texture coordinate is NaN or infinite, or a normal has no direction. The
    /// string names which.
    NotFinite(&'static str),
    /// A position, texture coordinate or control point has a coordinate beyond [`MAX_COORDINATE`].
    /// The string names which.
    TooLarge(&'static str),
    /// Two neighbouring corners have the same position.
    RepeatedCorner,
    /// All corners or control points lie on one line.
    NoArea,
    /// A weight is not greater than zero.
    Weight,
    /// An edge of this face already belongs to two other faces, and not as many of all its faces run
    /// one way along it as the other.
    NonManifold {
        /// The numbers of the other faces.
        others: [usize; 2],
    },
}

/// Why a mesh cannot be tessellated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum MeshError {
    /// The mesh has no face.
    Empty,
    /// The mesh has 2^30 faces or more.
    TooMany {
        /// The number of faces.
        faces: usize,
    },
    /// One face, the first such, is at fault.
    Face {
        /// Its number, from 0.
        face: usize,
        /// Its fault.
        fault: MeshFault,
    },
}

/// A value for each corner was given for another domain than the surface's.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct WrongDomain {
    /// The domain of the values.
    pub found: Domain,
    /// The domain of the surface.
    pub expected: Domain,
}

/// Why there is no such height image, or no such displacement by it.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum HeightError {
    /// The number of texels is not width times height, or it is 0.
    WrongLength {
        /// How many texels there are.
        texels: usize,
        /// The width of the image.
        width: usize,
        /// The height of the image.
        height: usize,
    },
    /// A texel is NaN or infinite.
    NotFinite {
        /// Its number, from 0.
        index: usize,
    },
    /// A texel is beyond [`MAX_COORDINATE`].
    TooLarge {
        /// Its number, from 0.
        index: usize,
    },
    /// The image's largest height times the scale is NaN or beyond [`MAX_COORDINATE`].
    TooHigh {
        /// The largest magnitude in the image.
        height: f32,
        /// The scale.
        scale: f32,
    },
}

impl MeshError {
    pub(crate) const fn face(face: usize, fault: MeshFault) -> Self {
        Self::Face { face, fault }
    }
}

impl fmt::Display for MeshFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange { what, count } => {
                write!(f, "a {what} index is out of range: there are {count}")
            }
            Self::WrongCount { what, found, corners } => {
                write!(f, "a face of {corners} corners has {found} {what} indices")
            }
            Self::NotFinite("normal") => f.write_str("a normal is zero, NaN or infinite"),
            Self::NotFinite(what) => write!(f, "a {what} is NaN or infinite"),
            Self::TooLarge(what) => write!(
                f,
                "a {what} is too large to be evaluated: coordinates must lie within \
                 {MAX_COORDINATE:e} of 0"
            ),
            Self::RepeatedCorner => f.write_str("two neighbouring corners are in the same place"),
            Self::NoArea => f.write_str("it has zero area"),
            Self::Weight => f.write_str("a weight is not greater than zero"),
            Self::NonManifold { .. } => {
                f.write_str("one of its edges belongs to two other faces already (not manifold)")
            }
        }
    }
}

impl fmt::Display for MeshError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Empty => f.write_str("there is no face"),
            Self::TooMany { faces } => write!(f, "there are {faces} faces; 2^30 are too many"),
            Self::Face { face, fault } => write!(f, "face {face}: {fault}"),
        }
    }
}

impl fmt::Display for WrongDomain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { found, expected } = self;
        write!(f, "the values belong to a {found:?} patch, but the surface is a {expected:?}")
    }
}

impl fmt::Display for HeightError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::WrongLength { texels, width, height } => write!(
                f,
                "there are {texels} texels for an image of {width} x {height}; give one for each \
                 place, and at least one"
            ),
            Self::NotFinite { index } => {
                write!(f, "texel {index} is NaN or infinite; replace it by a number")
            }
            Self::TooLarge { index } => write!(
                f,
                "texel {index} is too large to be evaluated: heights must lie within \
                 {MAX_COORDINATE:e} of 0"
            ),
            Self::TooHigh { height, scale } => write!(
                f,
                "heights up to {height:e} times the scale {scale:e} are too large to be evaluated: \
                 products must lie within {MAX_COORDINATE:e} of 0"
            ),
        }
    }
}

impl core::error::Error for HeightError {}
impl core::error::Error for WrongDomain {}
impl core::error::Error for MeshFault {}
impl core::error::Error for MeshError {}
