//! Times every named workload by the model, by `tess-simd` at each level, and filling as many
//! bytes, beside each other. `tess bench` times the same workloads for users.
//!
//! A workload is its first mebibyte of output, in the calls of the working set `cache`: batches, or
//! one patch per call (`single/...`, `seed-table/...`). Elements are patches. Each implementation's
//! digest is compared with the model's before anything is timed.

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use std::time::Duration;
use tess_benches::{Backend, Written, first_mebibyte};
use tess_workloads::Workload;

fn workloads(criterion: &mut Criterion) {
    for workload in Workload::all() {
        let (part, calls) = first_mebibyte(&workload);
        let mut group = criterion.benchmark_group(&workload.name);
        group.throughput(Throughput::Elements(part.patches.len() as u64)).sample_size(10);
        group.warm_up_time(Duration::from_millis(50));
        group.measurement_time(Duration::from_millis(200));
        for backend in Backend::all() {
            let mut written = Written::new(&part, calls.iter().cloned(), backend)
                .unwrap_or_else(|error| panic!("{}, {backend}: {error}", workload.name));
            written.check().unwrap_or_else(|error| panic!("{backend}: {error}"));
            group.bench_function(BenchmarkId::from_parameter(backend), |bencher| {
                bencher.iter(|| written.run().expect("as before, when it was checked"));
            });
            if backend == Backend::Core {
                group.bench_function("fill", |bencher| bencher.iter(|| written.fill()));
            }
        }
        group.finish();
    }
}

criterion_group!(benches, workloads);
criterion_main!(benches);
