//! What goes in: the raw factors of many patches of one domain.

use crate::lanes::{Column, LANES, MAX_FACTORS};
use core::ops::Range;
use tess_core::{Domain, IsolineFactors, QuadFactors, TriangleFactors};

/// The raw factors of patches of one domain, in either of two layouts: one structure for each
/// patch, as a hull shader writes them, or one slice for each factor.
///
/// Every bit pattern of every factor is valid. The slices of a batch of columns should have the
/// same length: as many patches as the shortest has are seen; [`Batch::is_even`] tells.
#[derive(Clone, Copy, Debug)]
pub enum Batch<'a> {
    /// Isolines, patch by patch.
    Isolines(&'a [IsolineFactors]),
    /// Triangles, patch by patch.
    Triangles(&'a [TriangleFactors]),
    /// Quads, patch by patch.
    Quads(&'a [QuadFactors]),
    /// Isolines, factor by factor.
    IsolineColumns(IsolineFactors<&'a [f32]>),
    /// Triangles, factor by factor.
    TriangleColumns(TriangleFactors<&'a [f32]>),
    /// Quads, factor by factor.
    QuadColumns(QuadFactors<&'a [f32]>),
}

impl<'a> From<&'a [IsolineFactors]> for Batch<'a> {
    fn from(patches: &'a [IsolineFactors]) -> Self {
        Self::Isolines(patches)
    }
}

impl<'a> From<&'a [TriangleFactors]> for Batch<'a> {
    fn from(patches: &'a [TriangleFactors]) -> Self {
        Self::Triangles(patches)
    }
}

impl<'a> From<&'a [QuadFactors]> for Batch<'a> {
    fn from(patches: &'a [QuadFactors]) -> Self {
        Self::Quads(patches)
    }
}

const fn isoline<T: Copy>(f: &IsolineFactors<T>) -> [T; 2] {
    [f.density, f.detail]
}

const fn triangle<T: Copy>(f: &TriangleFactors<T>) -> [T; 4] {
    [f.u0, f.v0, f.w0, f.inside]
}

const fn quad<T: Copy>(f: &QuadFactors<T>) -> [T; 6] {
    [f.u0, f.v0, f.u1, f.v1, f.inside_u, f.inside_v]
}

impl Batch<'_> {
    /// The domain of its patches.
    #[must_use]
    pub const fn domain(&self) -> Domain {
        match self {
            Self::Isolines(_) | Self::IsolineColumns(_) => Domain::Isoline,
            Self::Triangles(_) | Self::TriangleColumns(_) => Domain::Triangle,
            Self::Quads(_) | Self::QuadColumns(_) => Domain::Quad,
        }
    }

    /// How many patches it has.
    #[must_use]
    pub fn len(&self) -> usize {
        match self {
            Self::Isolines(patches) => patches.len(),
            Self::Triangles(patches) => patches.len(),
            Self::Quads(patches) => patches.len(),
            _ => self.column_lengths().min().unwrap_or(0),
        }
    }

    /// Whether it has no patches.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Whether all columns, if it is made of columns, have the same length.
    #[must_use]
    pub fn is_even(&self) -> bool {
        self.column_lengths().all(|length| length == self.len())
    }

    /// The lengths of its columns; none if it is not made of columns.
    fn column_lengths(&self) -> impl Iterator<Item = usize> {
        let columns: ([&[f32]; MAX_FACTORS], usize) = match self {
            Self::IsolineColumns(columns) => padded(isoline(columns)),
            Self::TriangleColumns(columns) => padded(triangle(columns)),
            Self::QuadColumns(columns) => padded(quad(columns)),
            _ => ([&[]; MAX_FACTORS], 0),
        };
        columns.0.into_iter().take(columns.1).map(<[f32]>::len)
    }

    /// The patches of a range that lies within it.
    pub(crate) fn slice(&self, range: &Range<usize>) -> Self {
        match *self {
            Self::Isolines(patches) => Self::Isolines(part(patches, range)),
            Self::Triangles(patches) => Self::Triangles(part(patches, range)),
            Self::Quads(patches) => Self::Quads(part(patches, range)),
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

/// The factors of up to [`Chunk::PATCHES`] patches, factor by factor.
///
/// Blocks are read from here and not from the batch: what is written in single numbers is read
/// as vectors, for which the writes must have been long ago.
#[derive(Clone, Debug)]
pub(crate) struct Chunk([[f32; Self::PATCHES]; MAX_FACTORS]);

impl Chunk {
    pub(crate) const PATCHES: usize = 4 * LANES;
    pub(crate) const EMPTY: Self = Self([[0.0; Self::PATCHES]; MAX_FACTORS]);

    /// Loads patches from `first` on, as many as there is room for; zero where the last block has
    /// no patch.
    #[inline(always)]
    pub(crate) fn load(&mut self, batch: &Batch<'_>, first: usize) {
        match batch {
            Batch::Isolines(patches) => self.load_structures(patches, first, isoline),
            Batch::Triangles(patches) => self.load_structures(patches, first, triangle),
            Batch::Quads(patches) => self.load_structures(patches, first, quad),
            Batch::IsolineColumns(columns) => self.load_columns(isoline(columns), first),
            Batch::TriangleColumns(columns) => self.load_columns(triangle(columns), first),
            Batch::QuadColumns(columns) => self.load_columns(quad(columns), first),
        }
    }

    #[inline(always)]
    fn load_structures<F, const N: usize>(
        &mut self,
        patches: &[F],
        first: usize,
        factors: impl Fn(&F) -> [f32; N],
    ) {
        let patches = patches.get(first..).unwrap_or_default();
        let patches = patches.get(..Self::PATCHES).unwrap_or(patches);
        for (i, patch) in patches.iter().enumerate().take(Self::PATCHES) {
            for (values, factor) in self.0.iter_mut().zip(factors(patch)) {
                values[i] = factor;
            }
        }
        self.clear(patches.len());
    }

    #[inline(always)]
    fn load_columns<const N: usize>(&mut self, columns: [&[f32]; N], first: usize) {
        let count = columns.iter().map(|c| c.len()).min().unwrap_or(0);
        let mut loaded = 0;
        for (values, source) in self.0.iter_mut().zip(columns) {
            let source = source.get(first..count.min(first + Self::PATCHES)).unwrap_or_default();
            values[..source.len()].copy_from_slice(source);
            loaded = source.len();
        }
        self.clear(loaded);
    }

    /// Zeros from a patch to the end of its block.
    #[inline(always)]
    fn clear(&mut self, first: usize) {
        for i in first..first.next_multiple_of(LANES).min(Self::PATCHES) {
            for values in &mut self.0 {
                values[i] = 0.0;
            }
        }
    }

    /// The factors of the patches of a block, `number` blocks into the chunk.
    #[inline(always)]
    pub(crate) fn block(&self, number: usize) -> Column<f32> {
        let mut column = [0.0; LANES * MAX_FACTORS];
        for (lanes, values) in column.as_chunks_mut::<LANES>().0.iter_mut().zip(&self.0) {
            *lanes = values.as_chunks().0[number % (Self::PATCHES / LANES)];
        }
        column
    }
}

fn padded<const N: usize>(columns: [&[f32]; N]) -> ([&[f32]; MAX_FACTORS], usize) {
    (core::array::from_fn(|i| columns.get(i).copied().unwrap_or_default()), N)
}

fn part<'a, T>(slice: &'a [T], range: &Range<usize>) -> &'a [T] {
    slice.get(range.clone()).unwrap_or_default()
}
