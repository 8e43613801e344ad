//! The golden model over the named workloads.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::hint::black_box;
use tess_benches::cases;

/// Patches per second of each workload, working set `cache`, `u32` indices.
fn core(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("core");
    for mut case in cases() {
        case.run_core().expect("the buffers fit");
        let name = case.workload.name.clone();
        assert_eq!(case.digest(), case.expected_digest(), "{name}: not timed");
        group.throughput(Throughput::Elements(case.totals.patches));
        group.bench_function(BenchmarkId::from_parameter(name), |bencher| {
            bencher.iter(|| black_box(&mut case).run_core());
        });
    }
}

criterion_group!(benches, core);
criterion_main!(benches);
