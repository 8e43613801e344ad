//! Outputs that are kept from call to call, one for each pair of formats.

use crate::buffers::{Element, Outcome, equal, numbering, of_batch};
use crate::calls::{Format, From, Width};
use crate::expected::{Column, Expected, Of};
use tess_core::DomainPoint;
use tess_simd::{
    BadGroupError, Batch, Error, IndexFormat, Output, OutputPoint, PatchRange, Tessellator,
    group_ranges,
};

/// An output, and its expected contents.
#[derive(Debug, Default)]
struct Kept<P: OutputPoint, I: IndexFormat> {
    output: Output<P, I>,
    last: Expected,
    base: Option<u32>,
}

/// All kept outputs.
#[derive(Debug, Default)]
pub(crate) struct Outputs {
    float_16: Kept<[f32; 2], u16>,
    float_32: Kept<[f32; 2], u32>,
    fixed_16: Kept<DomainPoint, u16>,
    fixed_32: Kept<DomainPoint, u32>,
}

/// A batch, the core's answer, and the error if it is refused.
pub(crate) type Asked<'a> = (Batch<'a>, Expected, Option<Error>);

impl Outputs {
    /// Tessellates a batch into the output of these formats.
    pub(crate) fn tessellate(
        &mut self,
        tessellator: &mut Tessellator,
        asked: Asked<'_>,
        (format, width, from): (Format, Width, From),
        groups: &[u32],
    ) -> Outcome {
        match (format, width) {
            (Format::Fixed, Width::Bits16) => {
                self.fixed_16.tessellate(tessellator, asked, (format, from))?;
                check_groups(self.fixed_16.output.ranges(), groups)
            }
            (Format::Fixed, Width::Bits32) => {
                self.fixed_32.tessellate(tessellator, asked, (format, from))?;
                check_groups(self.fixed_32.output.ranges(), groups)
            }
            (_, Width::Bits16) => {
                self.float_16.tessellate(tessellator, asked, (format, from))?;
                check_groups(self.float_16.output.ranges(), groups)
            }
            (_, Width::Bits32) => {
                self.float_32.tessellate(tessellator, asked, (format, from))?;
                check_groups(self.float_32.output.ranges(), groups)
            }
        }
    }
}

impl<P: OutputPoint + Element, I: IndexFormat + Element> Kept<P, I> {
    /// Tessellates a batch; a refused one leaves the previous output.
    fn tessellate(
        &mut self,
        tessellator: &mut Tessellator,
        (batch, expected, refused): Asked<'_>,
        (format, from): (Format, From),
    ) -> Outcome {
        let (numbering, base, too_large) = numbering::<I>(from, &expected);
        let refused = refused.or(too_large);
        let result = tessellator.tessellate(batch, numbering, &mut self.output).map(of_batch);
        equal("result", result, refused.map_or_else(|| Ok(expected.sizes()), Err))?;
        if refused.is_none() {
            (self.last, self.base) = (expected, base);
        }
        let Self { output, last, base } = self;
        for k in [0, 1] {
            let column = Column::new(Of::Point(format, k), k, output.points(), P::POISON);
            last.check(&column, 0)?;
        }
        last.check(&Column::new(Of::Index(*base), 0, output.indices(), I::POISON), 0)?;
        equal("ranges", output.ranges(), last.ranges())?;
        let sizes = |range: &PatchRange| Some((range.points as usize, range.indices as usize));
        let found = |i| output.patch(i).map(|(points, indices)| (points.len(), indices.len()));
        let mut all = last.ranges().iter().map(sizes).chain([None]).enumerate();
        all.try_for_each(|(i, sizes)| equal(&format!("sizes of patch {i}"), found(i), sizes))
    }
}

/// Nothing if each group has the sum of its patches.
fn check_groups(ranges: &[PatchRange], starts: &[u32]) -> Outcome {
    let found = group_ranges(ranges, starts).map(|groups| groups.collect::<Vec<_>>());
    let lowest = |group: usize| group.checked_sub(1).map_or(0, |before| starts[before]);
    let bad =
        |&(group, &start): &(usize, &u32)| start < lowest(group) || start as usize > ranges.len();
    if let Some((group, &start)) = starts.iter().enumerate().find(bad) {
        let bad = BadGroupError { group, start, lowest: lowest(group), patches: ranges.len() };
        return equal("groups", found, Err(bad));
    }
    let before = |patch: usize| {
        let sum = |size: fn(&PatchRange) -> u32| ranges[..patch].iter().map(size).sum::<u32>();
        [sum(|range| range.points), sum(|range| range.indices)]
    };
    let ends = starts.iter().skip(1).map(|&start| start as usize).chain([ranges.len()]);
    let groups = starts.iter().zip(ends).map(|(&start, end)| {
        let [first, behind] = [before(start as usize), before(end)];
        PatchRange {
            first_point: first[0],
            points: behind[0] - first[0],
            first_index: first[1],
            indices: behind[1] - first[1],
        }
    });
    equal("groups", found, Ok(groups.collect()))
}
