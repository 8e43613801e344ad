//! Times every kernel of the CPU backend at every level, and the model's stage: the table of
//! `dev/testkit/src/kernels.rs`.
//!
//! Each entry runs its inputs of four rounds: integer and fractional-even factors, random and
//! extreme. A table follows Criterion's own report: the nanoseconds per element (a point, an index,
//! or a patch or number where the stage makes neither), and how many times as long the model takes,
//! which also notes the meaning of each word. The smallest time of all samples counts, so that
//! other work on the machine has little effect.
#![expect(clippy::float_arithmetic, reason = "times are divided")]

use criterion::measurement::WallTime;
use criterion::{
    BenchmarkGroup, BenchmarkId, Criterion, Throughput, criterion_group, criterion_main,
};
use std::hint::black_box;
use std::io::Write as _;
use std::time::{Duration, Instant};
use tess_simd::Level;
use tess_testkit::kernels::TABLE;

/// The rounds that are timed.
const ROUNDS: [u32; 4] = [16, 17, 22, 23];

fn kernels(criterion: &mut Criterion) {
    let levels: Vec<_> = Level::ALL.into_iter().filter(|level| level.is_available()).collect();
    let names: String = levels.iter().map(|level| format!("{:>18}", level.name())).collect();
    let mut report = format!("\n{:<40}{:>9}{names}\n", "nanoseconds an element", "model");
    for entry in TABLE {
        let mut cases = ROUNDS.map(|round| entry.case(round));
        let words = cases.each_mut().map(|case| entry.expected(case));
        let elements: usize = words.iter().map(|words| words.elements()).sum();
        let mut group = criterion.benchmark_group(entry.name);
        group.throughput(Throughput::Elements(elements as u64)).sample_size(20);
        group.warm_up_time(Duration::from_millis(100));
        group.measurement_time(Duration::from_millis(400));
        let model = least(&mut group, "model", || {
            cases.iter_mut().for_each(|case| drop(black_box(entry.expected(case))));
        });
        let mut row = format!("{:<40}{:>9}", entry.name, nanoseconds(model, elements));
        for &level in &levels {
            for (case, words) in cases.iter().zip(&words) {
                let compared = entry.compare(case, words, level);
                compared.unwrap_or_else(|error| {
                    panic!("{} at {level}, not timed: {error}", entry.name_at(level))
                });
            }
            let mut taps = cases.each_ref().map(|case| entry.tap(case, level));
            let time = least(&mut group, level.name(), || {
                black_box(&mut taps).iter_mut().for_each(|tap| tap.run())
            });
            let times = model.zip(time).map_or(String::new(), |(model, time)| {
                format!(" ({:.1}x)", model.as_secs_f64() / time.as_secs_f64())
            });
            row += &format!("{:>18}", nanoseconds(time, elements) + &times);
        }
        group.finish();
        if model.is_some() {
            report += &(row + "\n");
        }
    }
    let _ = std::io::stdout().write_all(report.as_bytes());
}

/// Times a routine; returns the smallest time of one call in any sample, if the filter selects it.
fn least(
    group: &mut BenchmarkGroup<'_, WallTime>,
    name: &str,
    mut routine: impl FnMut(),
) -> Option<Duration> {
    let mut least: Option<Duration> = None;
    group.bench_function(BenchmarkId::from_parameter(name), |bencher| {
        bencher.iter_custom(|times| {
            let start = Instant::now();
            (0..times).for_each(|_| routine());
            let all = start.elapsed();
            let one = all.div_f64(times as f64);
            least = Some(least.map_or(one, |least| least.min(one)));
            all
        });
    });
    least
}

fn nanoseconds(time: Option<Duration>, elements: usize) -> String {
    time.map_or("-".to_owned(), |time| format!("{:.2}", time.as_secs_f64() * 1e9 / elements as f64))
}

criterion_group!(benches, kernels);
criterion_main!(benches);
