//! The SIMD backend over the named workloads, beside filling the same bytes.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use tess_benches::cases;

/// Bytes per second of each workload, working set `cache`, one thread, 16.16 points, `u32` indices.
fn simd(criterion: &mut Criterion) {
    for mut case in cases() {
        case.run_simd().expect("the buffers fit");
        let name = case.workload.name.clone();
        assert_eq!(case.digest(), case.expected_digest(), "{name}: not timed");
        let mut group = criterion.benchmark_group(&name);
        group.throughput(Throughput::Bytes(case.bytes()));
        let level = case.level();
        group.bench_function(BenchmarkId::new("simd", level), |bencher| {
            bencher.iter(|| black_box(&mut case).run_simd());
        });
        group.bench_function("fill", |bencher| bencher.iter(|| black_box(&mut case).fill()));
    }
}

criterion_group!(benches, simd);
criterion_main!(benches);
