//! Input: the raw factors of many patches of one domain.

use crate::data::error::Error;
use alloc::vec::Vec;
use core::ops::Range;
use tess_core::{Domain, IsolineFactors, PatchFactors, QuadFactors, TriangleFactors};

/// The raw factors of patches of one domain, in one of three layouts: one structure per patch, as a
/// hull shader writes them; the core's [`PatchFactors`]; or one slice per factor (columns). `From`
/// converts each of them.
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
    /// Patches of any one domain, patch by patch. For small patches up to a fifth slower than the
    /// structures above; see [`OwnedBatch`](crate::OwnedBatch).
    Patches(&'a [PatchFactors]),
    /// Patches, factor by factor: a column for each factor.
    Columns(PatchFactors<&'a [f32]>),
}

/// Conversions from a slice of structures, and from references to an array or a vector of them.
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

/// A conversion from one column per factor.
macro_rules! from_columns {
    ($columns:ty) => {
        impl<'a> From<$columns> for Batch<'a> {
            fn from(columns: $columns) -> Self {
                Self::Columns(columns.into())
            }
        }
    };
}
from_columns!(IsolineFactors<&'a [f32]>);
from_columns!(TriangleFactors<&'a [f32]>);
from_columns!(QuadFactors<&'a [f32]>);
from_columns!(PatchFactors<&'a [f32]>);

impl Batch<'_> {
    /// The domain of the patches. For [`PatchFactors`] it is the first patch's domain, or quad if
    /// there are no patches.
    #[must_use]
    pub fn domain(&self) -> Domain {
        match self {
            Self::Isolines(_) => Domain::Isoline,
            Self::Triangles(_) => Domain::Triangle,
            Self::Quads(_) => Domain::Quad,
            Self::Patches(patches) => patches.first().map_or(Domain::Quad, PatchFactors::domain),
            Self::Columns(columns) => columns.domain(),
        }
    }

    /// The number of patches. For columns, the length of the shortest one.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Isolines(patches) => patches.len(),
            Self::Triangles(patches) => patches.len(),
            Self::Quads(patches) => patches.len(),
            Self::Patches(patches) => patches.len(),
            Self::Columns(columns) => shortest(columns),
        }
    }

    /// Whether the batch has no patches.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// The factors of a patch; `None` if the batch has no such patch.
    #[inline(always)]
    pub(crate) fn patch(&self, i: usize) -> Option<PatchFactors> {
        match self {
            Self::Isolines(patches) => patches.get(i).map(|&factors| factors.into()),
            Self::Triangles(patches) => patches.get(i).map(|&factors| factors.into()),
            Self::Quads(patches) => patches.get(i).map(|&factors| factors.into()),
            Self::Patches(patches) => patches.get(i).copied(),
            Self::Columns(columns) => (i < shortest(columns))
                .then(|| columns.map(|column| column.get(i).copied().unwrap_or_default())),
        }
    }

    /// Checks that the patches have one domain and the columns one length.
    ///
    /// # Errors
    /// [`Error::MixedDomains`], [`Error::UnevenColumns`].
    pub(crate) fn check(&self) -> Result<(), Error> {
        match self {
            Self::Isolines(_) | Self::Triangles(_) | Self::Quads(_) => Ok(()),
            Self::Patches(patches) => one_domain(self.domain(), patches),
            Self::Columns(columns) => one_length(columns),
        }
    }

    /// The patches of a range; `None` if it exceeds the batch.
    ///
    /// ```
    /// # use tess_simd::Batch;
    /// # use tess_simd::tess_core::QuadFactors;
    /// let patches = [QuadFactors::uniform(2.0); 10];
    /// let batch = Batch::from(&patches);
    /// assert_eq!(batch.get(4..10).map(|part| part.len()), Some(6));
    /// assert!(batch.get(4..11).is_none());
    /// ```
    #[must_use]
    pub fn get(&self, range: Range<usize>) -> Option<Self> {
        (range.start <= range.end && range.end <= self.len()).then(|| self.slice(&range))
    }

    /// Length of the run of patches with the same factors, bit for bit, that begins with patch
    /// `first`. 0 if there is no such patch.
    #[inline(always)]
    pub(crate) fn run(&self, first: usize) -> usize {
        let quads = |a: &QuadFactors, b: &QuadFactors| differ(*a, *b);
        match *self {
            Self::Isolines(patches) => run(patches, first, |a, b| differ(*a, *b)),
            Self::Triangles(patches) => run(patches, first, |a, b| differ(*a, *b)),
            Self::Quads(patches) => run(patches, first, quads),
            Self::Patches(patches) => run(patches, first, |a, b| match (*a, *b) {
                (PatchFactors::Isoline(a), PatchFactors::Isoline(b)) => differ(a, b),
                (PatchFactors::Triangle(a), PatchFactors::Triangle(b)) => differ(a, b),
                (PatchFactors::Quad(a), PatchFactors::Quad(b)) => differ(a, b),
                _ => 1,
            }),
            Self::Columns(columns) => run_of_columns(&columns, first),
        }
    }

    /// The patches of a range within the batch.
    pub(crate) fn slice(&self, range: &Range<usize>) -> Self {
        match *self {
            Self::Isolines(patches) => Self::Isolines(part(patches, range)),
            Self::Triangles(patches) => Self::Triangles(part(patches, range)),
            Self::Quads(patches) => Self::Quads(part(patches, range)),
            Self::Patches(patches) => Self::Patches(part(patches, range)),
            Self::Columns(columns) => Self::Columns(columns.map(|column| part(column, range))),
        }
    }
}

fn shortest(columns: &PatchFactors<&[f32]>) -> usize {
    columns.iter().map(<[f32]>::len).min().unwrap_or(0)
}

fn one_length(columns: &PatchFactors<&[f32]>) -> Result<(), Error> {
    let length = shortest(columns);
    match columns.iter().map(<[f32]>::len).find(|&other| other != length) {
        None => Ok(()),
        Some(longer) => Err(Error::UnevenColumns { lengths: [length, longer] }),
    }
}

fn one_domain(expected: Domain, patches: &[PatchFactors]) -> Result<(), Error> {
    match patches.iter().position(|patch| patch.domain() != expected) {
        None => Ok(()),
        Some(patch) => Err(Error::MixedDomains { patch, found: patches[patch].domain(), expected }),
    }
}

/// 0 if two patches have the same factors, bit for bit.
#[inline(always)]
fn differ<const N: usize>(a: impl Into<[f32; N]>, b: impl Into<[f32; N]>) -> u32 {
    let (a, b) = (a.into(), b.into());
    let mut different = 0;
    for factor in 0..N {
        different |= a[factor].to_bits() ^ b[factor].to_bits();
    }
    different
}

/// The number of patches, counted from `first`, that equal patch `first` in every column. The
/// search doubles its range for as long as all columns agree, because one column may stay the same
/// long after another has changed.
fn run_of_columns(columns: &PatchFactors<&[f32]>, first: usize) -> usize {
    let mut sight = 16;
    loop {
        let end = first.saturating_add(sight);
        let run = |column: &[f32]| {
            let seen = column.get(..end).unwrap_or(column);
            run(seen, first, |a, b| differ([*a], [*b]))
        };
        let least = columns.iter().map(run).min().unwrap_or(0);
        if least < sight {
            return least;
        }
        sight *= 2;
    }
}

/// The number of elements, counted from `first`, that equal element `first`. In blocks, each
/// element is compared with the next.
#[inline(always)]
fn run<T>(all: &[T], first: usize, differ: impl Fn(&T, &T) -> u32) -> usize {
    /// Elements compared at a time, as vectors.
    const COMPARED_AT_ONCE: usize = 8;
    let Some(all @ [one, others @ ..]) = all.get(first..) else { return 0 };
    if others.first().is_none_or(|next| differ(one, next) != 0) {
        return 1;
    }
    // `alike` patches are known to be equal. Nearly every call ends above: neighbours differ. A run
    // that has begun is usually long, so from here whole blocks are compared, each element with the
    // next, which needs no copy of the first.
    let mut alike = 1;
    let blocks =
        all.as_chunks::<COMPARED_AT_ONCE>().0.iter().zip(others.as_chunks::<COMPARED_AT_ONCE>().0);
    for (block, next) in blocks {
        let mut different = 0;
        for i in 0..COMPARED_AT_ONCE {
            different |= differ(&block[i], &next[i]);
        }
        if different != 0 {
            break;
        }
        alike += COMPARED_AT_ONCE;
    }
    alike + all[alike..].iter().take_while(|other| differ(one, other) == 0).count()
}

fn part<'a, T>(slice: &'a [T], range: &Range<usize>) -> &'a [T] {
    slice.get(range.clone()).unwrap_or_default()
}
