//! A workload's patches, written by one implementation on the CPU.

use crate::Result;
use std::fmt;
use std::hint::black_box;
use std::ops::Range;
use tess_core::fixed::types::U16F16;
use tess_core::{DomainPoint, Order, Patch, PatchFactors};
use tess_simd::{Buffers, Level, Numbering, OwnedBatch, PatchRange, Tessellator};
use tess_verify::vectors::Fnv1a;
use tess_workloads::{IndexWidth, Workload};

/// An implementation on the CPU.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Backend {
    /// The golden model, patch by patch.
    Core,
    /// `tess-simd` at a level, one thread.
    Simd(Level),
}

impl Backend {
    /// The model, and `tess-simd` at each level of this machine.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let levels = Level::ALL.into_iter().filter(|level| level.is_available());
        std::iter::once(Self::Core).chain(levels.map(Self::Simd)).collect()
    }
}

impl fmt::Display for Backend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Core => f.write_str("core"),
            Self::Simd(level) => level.fmt(f),
        }
    }
}

/// The calls that write a workload, and the buffers that every call writes to.
///
/// The model writes 16.16 points, `tess-simd` pairs of binary32; indices have 32 bits.
#[derive(Debug)]
pub struct Written<'a> {
    workload: &'a Workload,
    calls: Vec<Call>,
    writer: Writer,
    indices: Vec<u32>,
    ranges: Vec<PatchRange>,
}

/// The patches of one call, and the size of its output.
#[derive(Debug)]
struct Call {
    patches: Range<usize>,
    points: usize,
    indices: usize,
}

#[derive(Debug)]
enum Writer {
    Core { points: Vec<DomainPoint> },
    Simd { tessellator: Box<Tessellator>, patches: OwnedBatch, points: Vec<[f32; 2]> },
}

impl<'a> Written<'a> {
    /// Makes the buffers for calls with these patches of a workload. Calls with one patch go
    /// through [`Tessellator::patch`].
    ///
    /// # Errors
    /// The machine lacks the level, or the output is larger than memory.
    pub fn new(
        workload: &'a Workload,
        calls: impl IntoIterator<Item = Range<usize>>,
        backend: Backend,
    ) -> Result<Self> {
        let calls = calls.into_iter().map(|patches| Call::new(workload, patches));
        let calls = calls.collect::<Result<Vec<_>>>()?;
        let most = |size: fn(&Call) -> usize| calls.iter().map(size).max().unwrap_or(0);
        let points = most(|call| call.points);
        // Not zeros, because the system would then map the memory only while it is timed.
        let writer = match backend {
            Backend::Core => Writer::Core { points: vec![DomainPoint::from_bits(1, 1); points] },
            Backend::Simd(level) => Writer::Simd {
                tessellator: Box::new(Tessellator::with_level(workload.config, level)?),
                patches: OwnedBatch::try_from(&workload.patches[..])?,
                points: vec![[1.0; 2]; points],
            },
        };
        let indices = vec![1; most(|call| call.indices)];
        let ranges = vec![PatchRange::default(); most(|call| call.patches.len())];
        Ok(Self { workload, calls, writer, indices, ranges })
    }

    /// Makes every call.
    ///
    /// # Errors
    /// The implementation refuses a call.
    pub fn run(&mut self) -> Result<()> {
        for number in 0..self.calls.len() {
            self.call(number)?;
            black_box((&mut self.writer, &mut self.indices[..]));
        }
        Ok(())
    }

    /// Makes every call, and returns the digest of its output, as [`Workload::digest`] computes it.
    ///
    /// # Errors
    /// Those of [`Self::run`].
    pub fn digest(&mut self) -> Result<u64> {
        let mut digest = Fnv1a::default();
        for number in 0..self.calls.len() {
            self.call(number)?;
            for range in &self.ranges[..self.calls[number].patches.len()] {
                let first = range.first_point as usize;
                let points = first..first + range.points as usize;
                let first = range.first_index as usize;
                let indices = first..first + range.indices as usize;
                digest.patch(&tess_core::Tessellation {
                    points: self.writer.exact(points),
                    indices: self.indices[indices].to_vec(),
                });
            }
        }
        Ok(digest.finish())
    }

    /// Checks that the calls write what the model does.
    ///
    /// # Errors
    /// The digests differ; those of [`Self::run`].
    pub fn check(&mut self) -> Result<()> {
        let (observed, expected) = (self.digest()?, self.workload.digest(Order::Specification));
        if observed == expected {
            return Ok(());
        }
        let name = &self.workload.name;
        Err(format!("{name}: digest {observed:016x}, the model's {expected:016x}; not timed")
            .into())
    }

    /// Fills as many bytes as the calls write, call by call.
    pub fn fill(&mut self) {
        for call in &self.calls {
            match &mut self.writer {
                Writer::Core { points } => points[..call.points].fill(DomainPoint::default()),
                Writer::Simd { points, .. } => points[..call.points].fill([0.0; 2]),
            }
            self.indices[..call.indices].fill(0);
            black_box((&mut self.writer, &mut self.indices[..]));
        }
    }

    fn call(&mut self, number: usize) -> Result<()> {
        let patches = self.calls[number].patches.clone();
        let (indices, ranges) = (&mut self.indices[..], &mut self.ranges[..]);
        match &mut self.writer {
            Writer::Core { points } => {
                let all = &self.workload.patches[patches];
                write_by_model(self.workload, all, points, indices, ranges)
            }
            Writer::Simd { tessellator, points, .. } if patches.len() == 1 => {
                let factors = self.workload.patches[patches.start];
                let counts = tessellator.patch(factors, points, indices)?;
                let (points, indices) = (counts.points, counts.indices);
                ranges[0] = PatchRange { first_point: 0, points, first_index: 0, indices };
                Ok(())
            }
            Writer::Simd { tessellator, patches: all, points } => {
                let batch = all.get(patches).ok_or("a call with patches past the last")?;
                let buffers = Buffers::new(points, indices).with_ranges(ranges);
                tessellator.write(batch, Numbering::PerPatch, buffers)?;
                Ok(())
            }
        }
    }
}

impl Call {
    fn new(workload: &Workload, patches: Range<usize>) -> Result<Self> {
        let part = workload.patches[patches.clone()].to_vec();
        let totals = Workload { patches: part, ..workload.clone() }.totals();
        Ok(Self {
            patches,
            points: usize::try_from(totals.points)?,
            indices: usize::try_from(totals.indices)?,
        })
    }
}

impl Writer {
    /// Some of the written points in 16.16.
    fn exact(&self, range: Range<usize>) -> Vec<DomainPoint> {
        let exact =
            |&[u, v]: &[f32; 2]| DomainPoint { u: U16F16::from_num(u), v: U16F16::from_num(v) };
        match self {
            Self::Core { points } => points[range].to_vec(),
            Self::Simd { points, .. } => points[range].iter().map(exact).collect(),
        }
    }
}

/// Writes patches one after another, with the range of each.
fn write_by_model(
    workload: &Workload,
    patches: &[PatchFactors],
    points: &mut [DomainPoint],
    indices: &mut [u32],
    ranges: &mut [PatchRange],
) -> Result<()> {
    let (mut first_point, mut first_index) = (0, 0);
    for (&factors, range) in patches.iter().zip(ranges) {
        let own = (&mut points[first_point as usize..], &mut indices[first_index as usize..]);
        let counts = Patch::new(workload.config, factors).write(own.0, own.1)?;
        let (points, indices) = (counts.points, counts.indices);
        *range = PatchRange { first_point, points, first_index, indices };
        first_point += points;
        first_index += indices;
    }
    Ok(())
}

/// The first calls of a workload, up to a mebibyte of output, as the working set `cache` of `tess
/// bench` makes them; and the workload of only their patches.
#[must_use]
pub fn first_mebibyte(workload: &Workload) -> (Workload, Vec<Range<usize>>) {
    let part = |patches: Range<usize>| Workload {
        patches: workload.patches[patches].to_vec(),
        ..workload.clone()
    };
    let mut bytes = 0;
    let mut calls = workload.cache_batches(IndexWidth::U32);
    calls.retain(|call| {
        let is_first = bytes < 1 << 20;
        if is_first {
            bytes += part(call.clone()).totals().bytes(IndexWidth::U32);
        }
        is_first
    });
    let end = calls.last().map_or(0, |call| call.end);
    (part(0..end), calls)
}
