//! Times the beginning of a tessellator: making it, making it and its first patch, and a patch like
//! those before. The difference between the last two rows is what a program pays that makes a
//! tessellator for each patch.

use criterion::{BenchmarkId, Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use std::time::Duration;
use tess_core::{Config, OutputPrimitive, Partitioning, QuadFactors};
use tess_simd::{CountedPatch, Level, Tessellator};

fn first(criterion: &mut Criterion) {
    let config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);
    let mut points = vec![[0.0; 2]; tess_core::MAX_POINTS + CountedPatch::OVERRUN];
    let mut indices = vec![0_u32; tess_core::MAX_INDICES + CountedPatch::OVERRUN];
    let mut patch = |tessellator: &mut Tessellator| {
        let factors = black_box(QuadFactors::uniform(3.5));
        tessellator.patch(factors, &mut points, &mut indices).expect("room for any patch")
    };
    let mut group = criterion.benchmark_group("first");
    group.warm_up_time(Duration::from_millis(200)).measurement_time(Duration::from_secs(1));
    for level in Level::ALL.into_iter().filter(|level| level.is_available()) {
        let make = || Tessellator::with_level(black_box(config), level).expect("it is available");
        group.bench_function(BenchmarkId::new("a tessellator", level), |bencher| {
            bencher.iter(make);
        });
        group.bench_function(BenchmarkId::new("with its first patch", level), |bencher| {
            bencher.iter(|| patch(&mut make()));
        });
        let mut kept = make();
        group.bench_function(BenchmarkId::new("a further patch", level), |bencher| {
            bencher.iter(|| patch(&mut kept));
        });
    }
    group.finish();
}

criterion_group!(benches, first);
criterion_main!(benches);
