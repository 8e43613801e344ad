//! Buffers that a call writes into, and the contents that they must have afterwards.

use crate::calls::{Format, From, Room, To, Width};
use crate::expected::{Column, Expected, Of};
use crate::patches::Bits;
use std::fmt::Debug;
use tess_core::{DomainPoint, PatchFactors};
use tess_simd::{
    ApartBuffers, Batch, BatchBuffer, BatchCounts, Buffers, Counted, CountedPatch, Error,
    IndexFormat, Numbering, OutputPoint, PatchRange, Tessellator,
};

/// Nothing, or the fault.
pub(crate) type Outcome = Result<(), String>;

/// Fills buffers before a call. No coordinate has these bits in any format.
const POISON: u32 = 0xDEAD_BEEF;

/// An element of a buffer.
pub(crate) trait Element: Bits {
    const POISON: Self;
}
impl Element for f32 {
    const POISON: Self = Self::from_bits(POISON);
}
impl Bits for f32 {
    fn bits(self) -> [u32; 2] {
        [self.to_bits(), 0]
    }
}
impl Element for [f32; 2] {
    const POISON: Self = [f32::POISON; 2];
}
impl Element for DomainPoint {
    const POISON: Self = Self::from_bits(POISON, POISON);
}
impl Element for u16 {
    const POISON: Self = 0xBEEF;
}
impl Element for u32 {
    const POISON: Self = POISON;
}

/// The calls that write.
#[derive(Debug)]
pub(crate) enum Writer<'a, 'b> {
    Batch(&'a mut Tessellator, Batch<'a>),
    Counted(&'a mut Counted<'b>),
    Patch(&'a mut Tessellator, PatchFactors),
    CountedPatch(&'a mut CountedPatch<'b>),
}

impl Writer<'_, '_> {
    /// Elements after the output that may be overwritten.
    const fn overrun(&self) -> usize {
        match self {
            Self::Batch(..) | Self::Counted(_) => 0,
            Self::Patch(..) | Self::CountedPatch(_) => CountedPatch::OVERRUN,
        }
    }
}

/// Indices and ranges.
type Rest<'a, I> = (Numbering, &'a mut [I], Option<&'a mut [PatchRange]>);

/// Sizes of points, indices and ranges, or the error in their place.
type Sizes = Result<[usize; 3], Error>;

/// Points in one of the two forms.
trait PointBuffers {
    /// Arrays of these lengths.
    fn new(lengths: [usize; 2]) -> Self;
    fn write<I: IndexFormat>(&mut self, writer: Writer<'_, '_>, rest: Rest<'_, I>) -> Sizes;
    fn columns(&self, format: Format) -> [Column; 2];
}

impl<P: OutputPoint + Element> PointBuffers for Vec<P> {
    fn new([length, _]: [usize; 2]) -> Self {
        vec![P::POISON; length]
    }

    fn write<I: IndexFormat>(&mut self, writer: Writer<'_, '_>, rest: Rest<'_, I>) -> Sizes {
        let (numbering, indices, ranges) = rest;
        let buffers = |points, indices| {
            let mut buffers = Buffers::new(points, indices);
            buffers.ranges = ranges;
            buffers
        };
        match writer {
            Writer::Batch(t, batch) => {
                t.write(batch, numbering, buffers(self, indices)).map(of_batch)
            }
            Writer::Counted(counted) => {
                counted.write(numbering, buffers(self, indices)).map(of_batch)
            }
            Writer::Patch(t, patch) => t.patch(patch, self, indices).map(of_patch),
            Writer::CountedPatch(counted) => counted.write(self, indices).map(of_patch),
        }
    }

    fn columns(&self, format: Format) -> [Column; 2] {
        [0, 1].map(|k| Column::new(Of::Point(format, k), k, self, P::POISON))
    }
}

impl PointBuffers for [Vec<f32>; 2] {
    fn new(lengths: [usize; 2]) -> Self {
        lengths.map(|length| vec![f32::POISON; length])
    }

    fn write<I: IndexFormat>(&mut self, writer: Writer<'_, '_>, rest: Rest<'_, I>) -> Sizes {
        let ((numbering, indices, ranges), [u, v]) = (rest, self);
        let buffers = |u, v, indices| {
            let mut buffers = ApartBuffers::new(u, v, indices);
            buffers.ranges = ranges;
            buffers
        };
        match writer {
            Writer::Batch(t, batch) => {
                t.write_apart(batch, numbering, buffers(u, v, indices)).map(of_batch)
            }
            Writer::Counted(counted) => {
                counted.write_apart(numbering, buffers(u, v, indices)).map(of_batch)
            }
            Writer::Patch(t, patch) => t.patch_apart(patch, u, v, indices).map(of_patch),
            Writer::CountedPatch(counted) => counted.write_apart(u, v, indices).map(of_patch),
        }
    }

    fn columns(&self, format: Format) -> [Column; 2] {
        [0, 1].map(|k| Column::new(Of::Point(format, k), 0, &self[k], f32::POISON))
    }
}

pub(crate) const fn of_batch(counts: BatchCounts) -> [usize; 3] {
    [counts.points, counts.indices, counts.patches]
}

pub(crate) const fn of_patch(counts: tess_core::Counts) -> [usize; 3] {
    [counts.points as usize, counts.indices as usize, 1]
}

/// Makes a call that writes. A batch that cannot be counted is refused for the reason given.
pub(crate) fn write(
    writer: Writer<'_, '_>,
    to: &To,
    expected: &Expected,
    refused: Option<Error>,
) -> Outcome {
    let all = (writer, to, expected, refused);
    match (to.room.format, to.room.width) {
        (Format::Float, Width::Bits16) => write_as::<Vec<[f32; 2]>, u16>(all),
        (Format::Float, Width::Bits32) => write_as::<Vec<[f32; 2]>, u32>(all),
        (Format::Fixed, Width::Bits16) => write_as::<Vec<DomainPoint>, u16>(all),
        (Format::Fixed, Width::Bits32) => write_as::<Vec<DomainPoint>, u32>(all),
        (Format::Apart, Width::Bits16) => write_as::<[Vec<f32>; 2], u16>(all),
        (Format::Apart, Width::Bits32) => write_as::<[Vec<f32>; 2], u32>(all),
    }
}

fn write_as<B: PointBuffers, I: IndexFormat + Element>(
    (writer, to, expected, refused): (Writer<'_, '_>, &To, &Expected, Option<Error>),
) -> Outcome {
    let [points, indices, patches] = expected.sizes();
    let (numbering, base, too_large) = numbering::<I>(to.from, expected);
    let To { room, ranges, .. } = to;
    let refused = refused.or(too_large).or_else(|| too_small(to, expected));
    let mut all_points = B::new([room.points, room.second].map(|spare| length(points, spare)));
    let mut all_indices = vec![I::POISON; length(indices, room.indices)];
    let mut all_ranges = ranges.map(|spare| vec![NO_RANGE; length(patches, spare)]);
    let overrun = writer.overrun();
    let rest = (numbering, &mut all_indices[..], all_ranges.as_deref_mut());
    let result = all_points.write(writer, rest);
    equal("result", result, refused.map_or_else(|| Ok(expected.sizes()), Err))?;
    let [u, v] = all_points.columns(room.format);
    let columns = [u, v, Column::new(Of::Index(base), 0, &all_indices, I::POISON)];
    for column in &columns {
        match refused {
            Some(_) => column.is_untouched(0)?,
            None => expected.check(column, overrun)?,
        }
    }
    let written = if refused.is_none() { expected.ranges() } else { &[] };
    all_ranges.map_or(Ok(()), |ranges| check_ranges(&ranges, written))
}

const NO_RANGE: PatchRange =
    PatchRange { first_point: POISON, points: POISON, first_index: POISON, indices: POISON };

/// Nothing if these ranges are the expected ones, and those after them untouched.
fn check_ranges(found: &[PatchRange], expected: &[PatchRange]) -> Outcome {
    let all = expected.iter().chain(std::iter::repeat(&NO_RANGE));
    let mut ranges = found.iter().zip(all).enumerate();
    ranges.try_for_each(|(i, (a, b))| equal(&format!("range {i}"), a, b))
}

/// The length with this many elements more than needed.
fn length(needed: usize, spare: isize) -> usize {
    needed.saturating_add_signed(spare)
}

/// The numbering of a call, the batch's base vertex, and why its indices do not fit.
pub(crate) fn numbering<I: IndexFormat>(
    from: From,
    expected: &Expected,
) -> (Numbering, Option<u32>, Option<Error>) {
    let points = expected.sizes()[0] as u64;
    let base_vertex = match from {
        From::EachPatch => return (Numbering::PerPatch, None, None),
        From::Base(base) => base,
        From::Limit(above) => {
            let first = (I::LARGEST + 1).saturating_sub(points).saturating_add_signed(above);
            u32::try_from(first).unwrap_or(u32::MAX)
        }
    };
    let largest = (u64::from(base_vertex) + points).saturating_sub(1);
    let too_large = (points > 0 && largest > I::LARGEST)
        .then_some(Error::IndexTooLarge { largest, limit: I::LARGEST });
    (Numbering::PerBatch { base_vertex }, Some(base_vertex), too_large)
}

/// The first buffer that is short.
fn too_small(to: &To, expected: &Expected) -> Option<Error> {
    let [points, indices, patches] = expected.sizes();
    let Room { format, points: spare, second, indices: spare_indices, .. } = to.room;
    let second = if format == Format::Apart { second } else { 0 };
    let all = [
        (BatchBuffer::Ranges, patches, to.ranges.unwrap_or(0)),
        (BatchBuffer::Points, points, spare),
        (BatchBuffer::Points, points, second),
        (BatchBuffer::Indices, indices, spare_indices),
    ];
    let short = |&(_, needed, spare): &_| length(needed, spare) < needed;
    all.into_iter().find(short).map(|(buffer, needed, spare)| Error::BufferTooSmall {
        buffer,
        needed,
        got: length(needed, spare),
    })
}

/// Nothing if both are equal.
pub(crate) fn equal<T: PartialEq + Debug>(what: &str, found: T, expected: T) -> Outcome {
    match found == expected {
        true => Ok(()),
        false => Err(format!("{what}: {found:?} instead of {expected:?}")),
    }
}
