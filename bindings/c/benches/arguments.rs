//! Times calls for one patch by the kind of their argument: `PatchFactors`, the domain's structure,
//! and the array of the C function `tess_batch_patch`.
//!
//! A caller may make a patch's factors just before the call, as a driver does, or long before it.
//! Both do the same work here: factors are made one by one in a ring of 64 patches, either for the
//! patch of the call or for one 63 calls later. A call takes equally long in all six rows of a
//! level; where "just before" takes longer, a load waits for the caller's stores (the head of
//! `tess-simd/src/stages/packet/one.rs`).

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, BenchmarkId, Criterion, Throughput};
use criterion::{criterion_group, criterion_main};
use std::hint::black_box;
use std::ptr;
use std::time::Duration;
use tess_capi::batch::{
    TESS_INDEX_U32, TESS_LEVEL_BASELINE, TESS_MEMORY_INITIALISED, TESS_NUMBERING_PER_PATCH,
    TESS_POINT_F32, TessBatch, TessBatchOutput, tess_batch_create, tess_batch_free,
    tess_batch_patch,
};
use tess_capi::status::TESS_OK;
use tess_capi::types::{TessConfig, TessCounts};
use tess_core::{
    Config, Domain, MAX_INDICES, MAX_POINTS, PatchFactors, QuadFactors, TriangleFactors,
};
use tess_simd::{CountedPatch, Level, Tessellator};
use tess_workloads::Workload;

/// Patches whose factors are in memory.
const RING: usize = 64;
/// Patches of one pass.
const PATCHES: usize = 4096;
/// The most factors of a patch.
const FACTORS: usize = Domain::Quad.factors();

/// The patches of a workload, and buffers for one.
struct Work {
    name: String,
    config: Config,
    domain: Domain,
    level: Level,
    raw: Vec<[f32; FACTORS]>,
    points: Vec<[f32; 2]>,
    indices: Vec<u32>,
}

impl Work {
    fn new(workload: &Workload, level: Level) -> Self {
        let raw = workload.patches.iter().take(PATCHES).map(|patch| {
            let mut raw = [0.0; FACTORS];
            raw.iter_mut().zip(patch.iter()).for_each(|(to, factor)| *to = factor);
            raw
        });
        Self {
            name: format!("{}, {level}", workload.name),
            config: workload.config,
            domain: workload.patches[0].domain(),
            level,
            raw: raw.collect(),
            points: vec![[0.0; 2]; MAX_POINTS + CountedPatch::OVERRUN],
            indices: vec![0; MAX_INDICES + CountedPatch::OVERRUN],
        }
    }

    fn tessellator(&self) -> Tessellator {
        Tessellator::with_level(self.config, self.level).expect("a level that is available")
    }
}

/// Makes each patch `ahead` calls before it is passed; returns the number of points of all.
fn pass<F: Clone>(
    raw: &[[f32; FACTORS]],
    ahead: usize,
    ring: &mut [F],
    make: impl Fn(&[f32; FACTORS], &mut F),
    mut call: impl FnMut(&F) -> u32,
) -> u64 {
    for (raw, to) in raw.iter().zip(&mut ring[..ahead]) {
        make(raw, to);
    }
    let mut points = 0;
    for i in 0..raw.len() {
        let made = i + ahead;
        make(&raw[made % raw.len()], &mut ring[made % RING]);
        points += u64::from(call(&ring[i % RING]));
    }
    points
}

#[inline(never)]
fn make_quad(raw: &[f32; FACTORS], to: &mut QuadFactors) {
    let [u0, v0, u1, v1, inside_u, inside_v] = raw;
    // Separate stores: the compiler would join them if it knew the numbers.
    (to.u0, to.v0, to.u1) = (black_box(*u0), black_box(*v0), black_box(*u1));
    to.v1 = black_box(*v1);
    (to.inside_u, to.inside_v) = (black_box(*inside_u), black_box(*inside_v));
}

#[inline(never)]
fn make_triangle(raw: &[f32; FACTORS], to: &mut TriangleFactors) {
    let [u0, v0, w0, inside, ..] = raw;
    (to.u0, to.v0) = (black_box(*u0), black_box(*v0));
    (to.w0, to.inside) = (black_box(*w0), black_box(*inside));
}

#[inline(never)]
fn make_any(raw: &[f32; FACTORS], to: &mut PatchFactors) {
    match to {
        PatchFactors::Triangle(factors) => make_triangle(raw, factors),
        PatchFactors::Quad(factors) => make_quad(raw, factors),
        PatchFactors::Isoline(_) => {}
    }
}

#[inline(never)]
fn make_array(raw: &[f32; FACTORS], to: &mut [f32; FACTORS]) {
    to.iter_mut().zip(raw).for_each(|(to, factor)| *to = black_box(*factor));
}

/// One row: a kind of argument, made just before the call and long before it.
fn rows<F: Copy>(
    group: &mut BenchmarkGroup<'_, WallTime>,
    kind: &str,
    raw: &[[f32; FACTORS]],
    (start, make): (F, impl Fn(&[f32; FACTORS], &mut F)),
    mut call: impl FnMut(&F) -> u32,
) -> [u64; 2] {
    [(0, "just before"), (RING - 1, "long before")].map(|(ahead, when)| {
        let mut ring = vec![start; RING];
        group.bench_function(BenchmarkId::new(kind, when), |bencher| {
            bencher.iter(|| pass(raw, ahead, &mut ring, &make, &mut call));
        });
        pass(raw, ahead, &mut ring, &make, &mut call)
    })
}

fn rust(group: &mut BenchmarkGroup<'_, WallTime>, work: &mut Work) -> [u64; 4] {
    let (mut one, mut other) = (work.tessellator(), work.tessellator());
    let Work { raw, points, indices, domain, .. } = work;
    let start = PatchFactors::uniform(*domain, 0.0);
    let any = rows(group, "PatchFactors", raw, (start, make_any), |factors| {
        one.patch(*factors, points, indices).expect("room").points
    });
    let structure = match *domain {
        Domain::Quad => {
            let start = (QuadFactors::uniform(0.0), make_quad);
            rows(group, "QuadFactors", raw, start, |factors| {
                other.patch(*factors, points, indices).expect("room").points
            })
        }
        _ => {
            let start = (TriangleFactors::uniform(0.0), make_triangle);
            rows(group, "TriangleFactors", raw, start, |factors| {
                other.patch(*factors, points, indices).expect("room").points
            })
        }
    };
    [any[0], any[1], structure[0], structure[1]]
}

fn c(group: &mut BenchmarkGroup<'_, WallTime>, work: &mut Work) -> [u64; 2] {
    let Work { raw, points, indices, config, level, domain, .. } = work;
    let Config { partitioning, output, split } = config;
    let config = TessConfig {
        domain: *domain as u32,
        partitioning: *partitioning as u32,
        output: *output as u32,
        split: *split as u32,
    };
    let level = TESS_LEVEL_BASELINE + *level as u32;
    let mut batch: *mut TessBatch = ptr::null_mut();
    // SAFETY: both pointers are to variables of this function.
    assert_eq!(unsafe { tess_batch_create(&config, level, &mut batch) }, TESS_OK, "a batch");
    let output = TessBatchOutput {
        points: points.as_mut_ptr().cast(),
        point_capacity: points.len(),
        indices: indices.as_mut_ptr().cast(),
        index_capacity: indices.len(),
        point_format: TESS_POINT_F32,
        index_type: TESS_INDEX_U32,
        memory: TESS_MEMORY_INITIALISED,
        ranges: ptr::null_mut(),
        range_capacity: 0,
        numbering: TESS_NUMBERING_PER_PATCH,
        base_vertex: 0,
    };
    let found = rows(group, "C", raw, ([0.0; FACTORS], make_array), |factors| {
        let mut counts = TessCounts::default();
        // SAFETY: the batch was made above; `output` has the buffers of `work`.
        let status = unsafe { tess_batch_patch(batch, factors.as_ptr(), &output, &mut counts) };
        assert_eq!(status, TESS_OK, "a patch");
        counts.points
    });
    // SAFETY: made above, and used by nothing else.
    unsafe { tess_batch_free(batch) };
    found
}

fn arguments(criterion: &mut Criterion) {
    for name in ["mosaic", "character", "mosaic-even"] {
        let workload = Workload::named(name).remove(0);
        for level in Level::ALL.into_iter().filter(|level| level.is_available()) {
            let mut work = Work::new(&workload, level);
            let mut group = criterion.benchmark_group(&work.name);
            group.throughput(Throughput::Elements(PATCHES as u64)).sample_size(40);
            group.warm_up_time(Duration::from_millis(200));
            group.measurement_time(Duration::from_secs(1));
            let points = [&rust(&mut group, &mut work)[..], &c(&mut group, &mut work)].concat();
            assert!(points.iter().all(|&all| all == points[0]), "{}: {points:?}", work.name);
            group.finish();
        }
    }
}

criterion_group!(benches, arguments);
criterion_main!(benches);
