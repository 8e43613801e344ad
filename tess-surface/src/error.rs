//! What can be wrong with a mesh.

use core::fmt;

/// A fault of one face or patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Fault {
    /// An index beyond the list that it points into.
    OutOfRange {
        /// What it should be the number of.
        what: &'static str,
        /// How many there are.
        count: usize,
    },
    /// A position or texture coordinate that is NaN or infinite, or a normal of no direction.
    NotFinite(&'static str),
    /// Two neighbouring corners in the same place.
    RepeatedCorner,
    /// Corners on one line, or a patch whose points are all on one line.
    NoArea,
    /// A weight that is not greater than zero.
    Weight,
    /// An edge of this face belongs to two other faces already.
    NonManifold {
        /// The other faces.
        others: [usize; 2],
    },
}

/// A mesh that cannot be tessellated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MeshError {
    /// There is no face.
    Empty,
    /// There are more faces than can be numbered.
    TooMany {
        /// How many there are.
        faces: usize,
    },
    /// A face is at fault.
    Face {
        /// Its number, from 0.
        face: usize,
        /// What is wrong with it.
        fault: Fault,
    },
}

impl MeshError {
    pub(crate) const fn face(face: usize, fault: Fault) -> Self {
        Self::Face { face, fault }
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::OutOfRange { what, count } => {
                write!(f, "a {what} index is out of range: there are {count}")
            }
            Self::NotFinite("normal") => f.write_str("a normal is zero, NaN or infinite"),
            Self::NotFinite(what) => write!(f, "a {what} is NaN or infinite"),
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
            Self::TooMany { faces } => write!(f, "{faces} faces are more than 2^30"),
            Self::Face { face, fault } => write!(f, "face {face}: {fault}"),
        }
    }
}

impl core::error::Error for Fault {}
impl core::error::Error for MeshError {}
