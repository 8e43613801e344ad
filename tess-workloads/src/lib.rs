#![doc = include_str!("../README.md")]

mod scenes;

use scenes::{
    UNIFORM_FACTORS, character, meshes, mosaic, mosaic_even, seed_table, single, terrain, uniform,
    worst,
};

use std::ops::Range;
use tess_core::Order;
use tess_core::{Config, Counts, Patch, PatchFactors};
use tess_verify::vectors::Fnv1a;

/// Patches of one domain and configuration, under the name that `tess bench --workload` takes.
#[derive(Clone, Debug)]
pub struct Workload {
    /// Name, such as `uniform-16` or `seed-table/isolines`.
    pub name: String,
    /// How the patches are tessellated.
    pub config: Config,
    /// The patches, all of one domain.
    pub patches: Vec<PatchFactors>,
    /// The index of the first patch of each group, ascending from 0; empty if the patches are not
    /// grouped.
    pub groups: Vec<u32>,
    /// How a consumer passes the patches to the tessellator.
    pub calls: Calls,
}

/// The patches in one call to the tessellator.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Calls {
    /// As many as the measurement calls for.
    Batch,
    /// One patch per call, as in an interface without batches.
    SinglePatch,
    /// One group per call, as in a renderer that draws mesh by mesh.
    Group,
    /// All groups in one call, whose result gives the position of each group's output.
    AllGroups,
}

/// The width of indices in a consumer's buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IndexWidth {
    /// 16 bits, enough for any single patch.
    U16,
    /// 32 bits.
    U32,
}

/// The size of a workload or of a part of one.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Totals {
    /// Patches.
    pub patches: u64,
    /// Domain points.
    pub points: u64,
    /// Primitives: triangles, or segments of isolines.
    pub primitives: u64,
    /// Indices.
    pub indices: u64,
}

impl Totals {
    fn add(&mut self, counts: Counts) {
        self.patches += 1;
        self.points += u64::from(counts.points);
        self.primitives += u64::from(counts.primitives);
        self.indices += u64::from(counts.indices);
    }

    /// Bytes of output: 8 for each point (u and v as 16.16), 2 or 4 for each index.
    #[must_use]
    pub const fn bytes(&self, index_type: IndexWidth) -> u64 {
        let index = match index_type {
            IndexWidth::U16 => 2,
            IndexWidth::U32 => 4,
        };
        8 * self.points + index * self.indices
    }
}

/// The smallest output, in bytes, of a batch of the working set `cache`.
const CACHE_BATCH_BYTES: u64 = 1 << 20;
/// The smallest number of patches in a batch of the working set `cache`.
const CACHE_BATCH_PATCHES: usize = 8;
/// The output, in bytes, of the working set `stream`.
const STREAM_BYTES: u64 = 1 << 30;

impl Workload {
    /// Every workload, in the order of reports.
    #[must_use]
    pub fn all() -> Vec<Self> {
        let mut workloads: Vec<_> = UNIFORM_FACTORS.into_iter().map(uniform).collect();
        workloads.extend(seed_table());
        workloads.extend([terrain(), character(), mosaic(), mosaic_even()]);
        workloads.extend(meshes());
        workloads.extend(single());
        workloads.push(worst());
        workloads
    }

    /// The workload of this name, or all workloads of a family such as `uniform`, `seed-table` or
    /// `single`; empty for an unknown name.
    #[must_use]
    pub fn named(name: &str) -> Vec<Self> {
        let all = Self::all();
        if let Some(workload) = all.iter().find(|workload| workload.name == name) {
            return vec![workload.clone()];
        }
        let family = |workload: &Self| {
            let rest = workload.name.strip_prefix(name);
            rest.is_some_and(|rest| rest.starts_with(['-', '/']))
        };
        all.into_iter().filter(family).collect()
    }

    fn batch(name: impl Into<String>, config: Config, patches: Vec<PatchFactors>) -> Self {
        Self { name: name.into(), config, patches, groups: Vec::new(), calls: Calls::Batch }
    }

    fn single(name: impl Into<String>, config: Config, patches: Vec<PatchFactors>) -> Self {
        Self { calls: Calls::SinglePatch, ..Self::batch(name, config, patches) }
    }

    /// The patches of each group, in order; none if the patches are not grouped.
    fn group_ranges(&self) -> impl Iterator<Item = Range<usize>> {
        let starts = self.groups.iter().map(|&start| start as usize);
        let ends = starts.clone().skip(1).chain([self.patches.len()]);
        starts.zip(ends).map(|(start, end)| start..end)
    }

    /// The output sizes of each patch, from the model.
    pub fn counts(&self) -> impl Iterator<Item = Counts> {
        self.patches.iter().map(|&factors| Patch::new(self.config, factors).counts())
    }

    /// The size of one pass over the workload.
    #[must_use]
    pub fn totals(&self) -> Totals {
        let mut totals = Totals::default();
        self.counts().for_each(|counts| totals.add(counts));
        totals
    }

    /// The digest of a correct implementation's output with triangles in this order, chained over
    /// all patches as [`Fnv1a::patch`] does.
    #[must_use]
    pub fn digest(&self, order: Order) -> u64 {
        let mut digest = Fnv1a::default();
        for &factors in &self.patches {
            digest.patch(&Patch::new(self.config, factors).tessellate_in(order));
        }
        digest.finish()
    }

    /// The working set `cache`: consecutive batches that cover all patches. Each is one call, if
    /// [`Workload::calls`] fixes its patches; otherwise each has about 1 MiB of output and at least
    /// 8 patches.
    ///
    /// A remainder too small for a batch of its own joins the batch before it.
    #[must_use]
    pub fn cache_batches(&self, index_type: IndexWidth) -> Vec<Range<usize>> {
        match self.calls {
            Calls::Batch => self.mebibytes(index_type),
            Calls::SinglePatch => (0..self.patches.len()).map(|patch| patch..patch + 1).collect(),
            Calls::Group => self.group_ranges().collect(),
            Calls::AllGroups => std::iter::once(0..self.patches.len()).collect(),
        }
    }

    /// Consecutive batches of about 1 MiB of output.
    fn mebibytes(&self, index_type: IndexWidth) -> Vec<Range<usize>> {
        let is_full = |range: &Range<usize>, totals: &Totals| {
            range.len() >= CACHE_BATCH_PATCHES && totals.bytes(index_type) >= CACHE_BATCH_BYTES
        };
        let mut batches: Vec<Range<usize>> = Vec::new();
        let mut batch = 0..0;
        let mut totals = Totals::default();
        for (i, counts) in self.counts().enumerate() {
            batch.end = i + 1;
            totals.add(counts);
            if is_full(&batch, &totals) {
                batches.push(batch.clone());
                batch = batch.end..batch.end;
                totals = Totals::default();
            }
        }
        match batches.last_mut() {
            Some(last) => last.end = batch.end,
            None => batches.push(batch),
        }
        batches
    }

    /// How often the workload is repeated to write the working set `stream`, 1 GiB of output.
    #[must_use]
    pub fn stream_repeats(&self, index_type: IndexWidth) -> u64 {
        STREAM_BYTES.div_ceil(self.totals().bytes(index_type).max(1))
    }
}

#[cfg(test)]
mod tests;
