//! The named workloads that benches and reports time, as data.
//!
//! Built from integers and correctly rounded operations alone, so that every machine times the
//! same patches; a bench compares [`Workload::digest`] before it times anything.
#![expect(
    clippy::float_arithmetic,
    clippy::cast_possible_truncation,
    reason = "scenes are built from additions, multiplications, divisions and square roots in \
              binary64, each correctly rounded, and rounded to binary32 at the end"
)]

use crate::digest::Fnv1a;
use crate::random::SplitMix64;
use std::ops::Range;
use tess_core::{
    Config, Counts, IsolineFactors, OutputPrimitive, Partitioning, Patch, PatchFactors,
    QuadFactors, TriangleFactors,
};

/// The factors K of the workloads `uniform-K`.
pub const UNIFORM_FACTORS: [u8; 7] = [1, 2, 4, 8, 16, 32, 64];

/// The seed of the workloads that are drawn at random.
pub const SEED: u64 = 11;

/// Patches of one domain and configuration, with the name that `tess bench --workload` takes.
#[derive(Clone, Debug)]
pub struct Workload {
    /// Name, such as `uniform-16` or `seed-table/isolines`.
    pub name: String,
    /// How the patches are tessellated.
    pub config: Config,
    /// The patches, all of one domain.
    pub patches: Vec<PatchFactors>,
    /// How a consumer hands them over.
    pub calls: Calls,
}

/// How many patches a call to the tessellator has.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Calls {
    /// Many at once.
    Batch,
    /// One patch at a time, as interfaces without batches do.
    SinglePatch,
}

/// Width of the indices in a consumer's buffer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum IndexType {
    /// 16 bits: enough for any one patch.
    U16,
    /// 32 bits.
    U32,
}

/// What a workload or a part of it amounts to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Totals {
    /// Patches.
    pub patches: u64,
    /// Domain points.
    pub points: u64,
    /// Primitives: triangles, or segments on isolines.
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
    pub const fn bytes(&self, index_type: IndexType) -> u64 {
        let index = match index_type {
            IndexType::U16 => 2,
            IndexType::U32 => 4,
        };
        8 * self.points + index * self.indices
    }
}

/// Bytes of output that a batch of the working set `cache` has at least.
pub const CACHE_BATCH_BYTES: u64 = 1 << 20;
/// Patches that a batch of the working set `cache` has at least.
pub const CACHE_BATCH_PATCHES: usize = 8;
/// Bytes of output of the working set `stream`.
pub const STREAM_BYTES: u64 = 1 << 30;

impl Workload {
    fn batch(name: impl Into<String>, config: Config, patches: Vec<PatchFactors>) -> Self {
        Self { name: name.into(), config, patches, calls: Calls::Batch }
    }

    fn single(name: impl Into<String>, config: Config, patches: Vec<PatchFactors>) -> Self {
        Self { name: name.into(), config, patches, calls: Calls::SinglePatch }
    }

    /// Output sizes of each patch, from the model.
    pub fn counts(&self) -> impl Iterator<Item = Counts> {
        self.patches.iter().map(|&factors| Patch::new(self.config, factors).counts())
    }

    /// What one pass over the workload amounts to.
    #[must_use]
    pub fn totals(&self) -> Totals {
        let mut totals = Totals::default();
        self.counts().for_each(|counts| totals.add(counts));
        totals
    }

    /// The digest that a correct implementation's output has, chained over all patches as
    /// [`Fnv1a::patch`] does.
    #[must_use]
    pub fn digest(&self) -> u64 {
        let mut digest = Fnv1a::new();
        for &factors in &self.patches {
            digest.patch(&Patch::new(self.config, factors).tessellate());
        }
        digest.finish()
    }

    /// The working set `cache`: consecutive batches that cover all patches, each of about 1 MiB of
    /// output and of at least 8 patches; one patch each if that is how the workload is called.
    ///
    /// A remainder that would make a batch of its own too small joins the batch before it.
    #[must_use]
    pub fn cache_batches(&self, index_type: IndexType) -> Vec<Range<usize>> {
        let is_full = |range: &Range<usize>, totals: &Totals| match self.calls {
            Calls::SinglePatch => true,
            Calls::Batch => {
                range.len() >= CACHE_BATCH_PATCHES && totals.bytes(index_type) >= CACHE_BATCH_BYTES
            }
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
    pub fn stream_repeats(&self, index_type: IndexType) -> u64 {
        STREAM_BYTES.div_ceil(self.totals().bytes(index_type).max(1))
    }
}

/// Every workload, in the order of reports.
#[must_use]
pub fn all() -> Vec<Workload> {
    let mut workloads: Vec<_> = UNIFORM_FACTORS.into_iter().map(uniform).collect();
    workloads.extend(seed_table());
    workloads.extend([terrain(), character(), worst()]);
    workloads
}

/// The workloads that a name stands for: one, or all of a family such as `uniform` or
/// `seed-table`; none for an unknown name.
#[must_use]
pub fn named(name: &str) -> Vec<Workload> {
    let family = |workload: &Workload| {
        let rest = workload.name.strip_prefix(name);
        rest.is_some_and(|rest| rest.is_empty() || rest.starts_with(['-', '/']))
    };
    all().into_iter().filter(family).collect()
}

/// `uniform-K`: 4096 quads, all factors `factor`, integer.
#[must_use]
pub fn uniform(factor: u8) -> Workload {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let patch = quad([factor.into(); 6]);
    Workload::batch(format!("uniform-{factor}"), config, vec![patch; 4096])
}

/// `seed-table`: single quads of several sizes, and every integer isoline, one patch at a time.
#[must_use]
pub fn seed_table() -> Vec<Workload> {
    let quads = [
        ("16", [16; 6]),
        ("32", [32; 6]),
        ("48", [48; 6]),
        ("64", [64; 6]),
        ("32-16-8-6-4-2", [32, 16, 8, 6, 4, 2]),
        ("64-15-23-14-13-46", [64, 15, 23, 14, 13, 46]),
    ];
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let mut workloads = Vec::new();
    for (name, factors) in quads {
        let patch = quad(factors.map(|factor: u8| f32::from(factor)));
        workloads.push(Workload::single(format!("seed-table/quad-{name}"), config, vec![patch]));
    }
    workloads.push(isolines());
    workloads
}

/// `seed-table/isolines`: every integer isoline, density by density.
fn isolines() -> Workload {
    let factors = (1..=64u8).flat_map(|density| (1..=64u8).map(move |detail| (density, detail)));
    let patches = factors
        .map(|(density, detail)| {
            PatchFactors::Isoline(IsolineFactors { density: density.into(), detail: detail.into() })
        })
        .collect();
    let config = Config::new(Partitioning::Integer, OutputPrimitive::Line);
    Workload::single("seed-table/isolines", config, patches)
}

/// `terrain`: a flat ground of 64 x 64 quads seen by a camera, `fractional_even`.
///
/// Patch (x, z) covers the unit square from (x, z), u along x and v along z. The camera stands at
/// (32, 0), 3 units above the ground: the middle of the border z = 0. An edge's factor is 192
/// divided by the distance from the camera to the edge's midpoint, so from 63 under the camera to
/// 2.7 in the far corners; patches on both sides of an edge see the same midpoint and so agree.
/// Both inside factors are the mean of the four edges.
#[must_use]
pub fn terrain() -> Workload {
    /// Coordinates in half units, so that midpoints are whole numbers.
    fn edge_factor(x_halves: i32, z_halves: i32) -> f64 {
        let (x, z) = (f64::from(x_halves) / 2.0 - 32.0, f64::from(z_halves) / 2.0);
        192.0 / (x * x + z * z + 9.0).sqrt()
    }
    let mut patches = Vec::new();
    for z in (0..128).step_by(2) {
        for x in (0..128).step_by(2) {
            let midpoints = [(x, z + 1), (x + 1, z), (x + 2, z + 1), (x + 1, z + 2)];
            let [u0, v0, u1, v1] = midpoints.map(|(x, z)| edge_factor(x, z));
            let mean = (u0 + v0 + u1 + v1) / 4.0;
            patches.push(quad([u0, v0, u1, v1, mean, mean].map(|factor| factor as f32)));
        }
    }
    let config = Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw);
    Workload::batch("terrain", config, patches)
}

/// `character`: 20000 triangles with edge factors log-uniform in 1..8, `fractional_odd`.
///
/// The inside factor is the mean of the three edges.
#[must_use]
pub fn character() -> Workload {
    let mut random = SplitMix64::new(SEED);
    let patches = (0..20_000)
        .map(|_| {
            let [u0, v0, w0] = std::array::from_fn(|_| power_of_two(3.0 * random.unit()));
            let mean = (u0 + v0 + w0) / 3.0;
            let [u0, v0, w0, inside] = [u0, v0, w0, mean].map(|factor| factor as f32);
            PatchFactors::Triangle(TriangleFactors { u0, v0, w0, inside })
        })
        .collect();
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    Workload::batch("character", config, patches)
}

/// `worst`: 1024 quads, every factor uniform in 1..64 on its own, `fractional_odd`.
#[must_use]
pub fn worst() -> Workload {
    let mut random = SplitMix64::new(SEED);
    let patches = (0..1024)
        .map(|_| quad(std::array::from_fn(|_| (1.0 + 63.0 * random.unit()) as f32)))
        .collect();
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    Workload::batch("worst", config, patches)
}

fn quad([u0, v0, u1, v1, inside_u, inside_v]: [f32; 6]) -> PatchFactors {
    PatchFactors::Quad(QuadFactors { u0, v0, u1, v1, inside_u, inside_v })
}

/// 2^x for x >= 0, out of square roots, as library powers differ between machines.
///
/// Uses the first 24 bits of x's fraction: bit -k contributes the 2^k-th root of two.
fn power_of_two(mut x: f64) -> f64 {
    let mut power = 1.0;
    while x >= 1.0 {
        power *= 2.0;
        x -= 1.0;
    }
    let mut root: f64 = 2.0;
    for _ in 0..24 {
        root = root.sqrt();
        x *= 2.0;
        if x >= 1.0 {
            power *= root;
            x -= 1.0;
        }
    }
    power
}

#[cfg(test)]
mod tests;
