//! The answer of `tess-core` to a batch, compared with buffers that were written.

use crate::calls::{Factors, Format};
use crate::patches::Bits;
use tess_core::fixed::types::U16F16;
use tess_core::{Config, DomainPoint, Patch, PatchFactors};
use tess_simd::{Order, PatchRange};

/// The core's output of a batch.
#[derive(Debug, Default)]
pub(crate) struct Expected {
    patches: Vec<PatchFactors>,
    points: Vec<DomainPoint>,
    /// Counted from each patch's first point.
    indices: Vec<u32>,
    ranges: Vec<PatchRange>,
}

/// One number of each element of a buffer, as bits.
#[derive(Debug)]
pub(crate) struct Column {
    pub(crate) of: Of,
    bits: Vec<u32>,
    /// The word that the buffer was filled with before.
    poison: u32,
}

/// The selected number.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Of {
    /// A coordinate: u is 0, v is 1.
    Point(Format, usize),
    /// An index. The base vertex is that of the batch, or `None` if each patch is numbered
    /// separately.
    Index(Option<u32>),
}

impl Column {
    /// Number `k` of each element of a buffer that was filled with `poison`.
    pub(crate) fn new<T: Bits>(of: Of, k: usize, elements: &[T], poison: T) -> Self {
        let bits = elements.iter().map(|element| element.bits()[k]).collect();
        Self { of, bits, poison: poison.bits()[k] }
    }

    /// Nothing if no element from this one on was written.
    pub(crate) fn is_untouched(&self, from: usize) -> Result<(), String> {
        let behind = self.bits.get(from..).unwrap_or_default();
        match behind.iter().position(|&bits| bits != self.poison) {
            None => Ok(()),
            Some(at) => Err(format!("{:?}: element {} is overwritten", self.of, from + at)),
        }
    }

    fn shown(&self, bits: u32) -> String {
        match self.of {
            Of::Point(Format::Fixed, _) => format!("{} ({bits:#x})", U16F16::from_bits(bits)),
            Of::Point(..) => format!("{} ({bits:#x})", f32::from_bits(bits)),
            Of::Index(_) => format!("{bits} ({bits:#x})"),
        }
    }
}

impl Expected {
    pub(crate) fn new(config: Config, order: Order, patches: Vec<PatchFactors>) -> Self {
        let mut all = Self::default();
        let bits = |patch: &PatchFactors| patch.map(f32::to_bits);
        for run in patches.chunk_by(|a, b| bits(a) == bits(b)) {
            let one = Patch::new(config, run[0]).tessellate_in(order);
            for _ in run {
                let [first_point, first_index] = [all.points.len(), all.indices.len()].map(small);
                let [points, indices] = [one.points.len(), one.indices.len()].map(small);
                all.ranges.push(PatchRange { first_point, points, first_index, indices });
                all.points.extend(&one.points);
                all.indices.extend(&one.indices);
            }
        }
        Self { patches, ..all }
    }

    /// Sizes of points, indices and ranges.
    pub(crate) const fn sizes(&self) -> [usize; 3] {
        [self.points.len(), self.indices.len(), self.ranges.len()]
    }

    pub(crate) fn ranges(&self) -> &[PatchRange] {
        &self.ranges
    }

    /// Nothing if the elements of the output are right, and those more than `overrun` after it are
    /// untouched.
    pub(crate) fn check(&self, column: &Column, overrun: usize) -> Result<(), String> {
        let expected = self.bits(column.of);
        let found = column.bits.get(..expected.len()).ok_or("the buffer is too short")?;
        if let Some(at) = (0..expected.len()).find(|&at| found[at] != expected[at]) {
            let (patch, element) = self.place(column.of, at);
            return Err(format!(
                "patch {patch} of {}, {:?}: {:?}, element {element} (of the batch {at}) is {} instead of {}",
                self.patches.len(),
                Factors(self.patches[patch]),
                column.of,
                column.shown(found[at]),
                column.shown(expected[at]),
            ));
        }
        column.is_untouched(expected.len() + overrun)
    }

    /// The words that a column must hold.
    fn bits(&self, of: Of) -> Vec<u32> {
        match of {
            Of::Point(Format::Fixed, k) => {
                self.points.iter().map(|point| point.bits()[k]).collect()
            }
            Of::Point(_, k) => {
                self.points.iter().map(|point| point.to_f32()[k].to_bits()).collect()
            }
            Of::Index(None) => self.indices.clone(),
            Of::Index(Some(base)) => {
                let moved = |range: &PatchRange| {
                    let end = range.first_index + range.indices;
                    let own = &self.indices[range.first_index as usize..end as usize];
                    let first = base.wrapping_add(range.first_point);
                    own.iter().map(move |&index| first.wrapping_add(index))
                };
                self.ranges.iter().flat_map(moved).collect()
            }
        }
    }

    /// The patch that an element belongs to, and the element's number in it.
    fn place(&self, of: Of, at: usize) -> (usize, usize) {
        let first = |range: &PatchRange| match of {
            Of::Point(..) => range.first_point as usize,
            Of::Index(_) => range.first_index as usize,
        };
        let patch = self.ranges.partition_point(|range| first(range) <= at) - 1;
        (patch, at - first(&self.ranges[patch]))
    }
}

fn small(length: usize) -> u32 {
    u32::try_from(length).expect("batches of these tests are small")
}
