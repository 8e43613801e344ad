//! What goes in: the raw factors of many patches of one domain.

use crate::error::Error;
use alloc::vec::Vec;
use core::ops::Range;
use tess_core::{Domain, IsolineFactors, PatchFactors, QuadFactors, TriangleFactors};

/// The raw factors of patches of one domain, in one of three layouts: a structure for each patch,
/// as a hull shader writes them; the core's [`PatchFactors`]; or a slice for each factor
/// (columns). `From` makes it from any of them.
///
/// Every bit pattern of every factor is valid. The patches must have one domain, and the columns
/// one length: [`Tessellator::count`](crate::Tessellator::count) returns an error otherwise.
///
/// ```
/// use tess_simd::Batch;
/// use tess_simd::tess_core::{Domain, IsolineFactors};
///
/// let (density, detail) = ([2.0, 3.0, 4.0], [1.0; 3]);
/// let batch = Batch::from(IsolineFactors { density: &density[..], detail: &detail[..] });
/// assert_eq!((batch.len(), batch.domain()), (3, Domain::Isoline));
/// ```
#[derive(Clone, Copy, Debug)]
#[non_exhaustive]
pub enum Batch<'a> {
    /// Isolines, patch by patch.
    Isolines(&'a [IsolineFactors]),
    /// Triangles, patch by patch.
    Triangles(&'a [TriangleFactors]),
    /// Quads, patch by patch.
    Quads(&'a [QuadFactors]),
    /// Patches of any one domain, patch by patch.
    Patches(&'a [PatchFactors]),
    /// Isolines, factor by factor.
    IsolineColumns(IsolineFactors<&'a [f32]>),
    /// Triangles, factor by factor.
    TriangleColumns(TriangleFactors<&'a [f32]>),
    /// Quads, factor by factor.
    QuadColumns(QuadFactors<&'a [f32]>),
}

/// Conversions from a slice of structures, and from what is borrowed as one.
macro_rules! from_structures {
    ($factors:ty, $layout:ident) => {
        impl<'a> From<&'a [$factors]> for Batch<'a> {
            fn from(patches: &'a [$factors]) -> Self {
                Self::$layout(patches)
            }
        }

        impl<'a, const N: usize> From<&'a [$factors; N]> for Batch<'a> {
            fn from(patches: &'a [$factors; N]) -> Self {
                Self::$layout(patches)
            }
        }

        impl<'a> From<&'a Vec<$factors>> for Batch<'a> {
            fn from(patches: &'a Vec<$factors>) -> Self {
                Self::$layout(patches)
            }
        }
    };
}
from_structures!(IsolineFactors, Isolines);
from_structures!(TriangleFactors, Triangles);
from_structures!(QuadFactors, Quads);
from_structures!(PatchFactors, Patches);

/// A conversion from a slice for each factor.
macro_rules! from_columns {
    ($factors:ident, $layout:ident) => {
        impl<'a> From<$factors<&'a [f32]>> for Batch<'a> {
            fn from(columns: $factors<&'a [f32]>) -> Self {
                Self::$layout(columns)
            }
        }
    };
}
from_columns!(IsolineFactors, IsolineColumns);
from_columns!(TriangleFactors, TriangleColumns);
from_columns!(QuadFactors, QuadColumns);

impl Batch<'_> {
    /// The domain of its patches: that of the first if it is made of [`PatchFactors`], a quad if
    /// there is none.
    #[must_use]
    pub fn domain(&self) -> Domain {
        match self {
            Self::Isolines(_) | Self::IsolineColumns(_) => Domain::Isoline,
            Self::Triangles(_) | Self::TriangleColumns(_) => Domain::Triangle,
            Self::Quads(_) | Self::QuadColumns(_) => Domain::Quad,
            Self::Patches(patches) => patches.first().map_or(Domain::Quad, PatchFactors::domain),
        }
    }

    /// The number of patches: the length of the shortest column if it is made of columns.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Isolines(patches) => patches.len(),
            Self::Triangles(patches) => patches.len(),
            Self::Quads(patches) => patches.len(),
            Self::Patches(patches) => patches.len(),
            Self::IsolineColumns(columns) => shortest(&isoline(columns)),
            Self::TriangleColumns(columns) => shortest(&triangle(columns)),
            Self::QuadColumns(columns) => shortest(&quad(columns)),
        }
    }

    /// Whether it has no patches.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether its columns have one length and its patches one domain.
    ///
    /// # Errors
    /// [`Error::UnevenColumns`], [`Error::MixedDomains`].
    pub(crate) fn check(&self) -> Result<(), Error> {
        match self {
            Self::Isolines(_) | Self::Triangles(_) | Self::Quads(_) => Ok(()),
            Self::Patches(patches) => one_domain(self.domain(), patches),
            Self::IsolineColumns(columns) => one_length(&isoline(columns)),
            Self::TriangleColumns(columns) => one_length(&triangle(columns)),
            Self::QuadColumns(columns) => one_length(&quad(columns)),
        }
    }

    /// The patches of a range that lies within it.
    pub(crate) fn slice(&self, range: &Range<usize>) -> Self {
        match *self {
            Self::Isolines(patches) => Self::Isolines(part(patches, range)),
            Self::Triangles(patches) => Self::Triangles(part(patches, range)),
            Self::Quads(patches) => Self::Quads(part(patches, range)),
            Self::Patches(patches) => Self::Patches(part(patches, range)),
            Self::IsolineColumns(columns) => {
                let [density, detail] = isoline(&columns).map(|c| part(c, range));
                Self::IsolineColumns(IsolineFactors { density, detail })
            }
            Self::TriangleColumns(columns) => {
                let [u0, v0, w0, inside] = triangle(&columns).map(|c| part(c, range));
                Self::TriangleColumns(TriangleFactors { u0, v0, w0, inside })
            }
            Self::QuadColumns(columns) => {
                let [u0, v0, u1, v1, inside_u, inside_v] = quad(&columns).map(|c| part(c, range));
                Self::QuadColumns(QuadFactors { u0, v0, u1, v1, inside_u, inside_v })
            }
        }
    }
}

pub(crate) const fn isoline<T: Copy>(f: &IsolineFactors<T>) -> [T; 2] {
    [f.density, f.detail]
}

pub(crate) const fn triangle<T: Copy>(f: &TriangleFactors<T>) -> [T; 4] {
    [f.u0, f.v0, f.w0, f.inside]
}

pub(crate) const fn quad<T: Copy>(f: &QuadFactors<T>) -> [T; 6] {
    [f.u0, f.v0, f.u1, f.v1, f.inside_u, f.inside_v]
}

fn shortest(columns: &[&[f32]]) -> usize {
    columns.iter().map(|column| column.len()).min().unwrap_or(0)
}

fn one_length(columns: &[&[f32]]) -> Result<(), Error> {
    let length = shortest(columns);
    match columns.iter().map(|column| column.len()).find(|&other| other != length) {
        None => Ok(()),
        Some(longer) => Err(Error::UnevenColumns { lengths: [length, longer] }),
    }
}

fn one_domain(expected: Domain, patches: &[PatchFactors]) -> Result<(), Error> {
    match patches.iter().position(|patch| patch.domain() != expected) {
        None => Ok(()),
        Some(patch) => {
            Err(Error::MixedDomains { patch, found: patches[patch].domain(), expected })
        }
    }
}

fn part<'a, T>(slice: &'a [T], range: &Range<usize>) -> &'a [T] {
    slice.get(range.clone()).unwrap_or_default()
}
