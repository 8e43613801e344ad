//! Batches on several threads have the same output as on one, for any number of threads.

use crate::patches::{Patches, compare, configs};
use std::sync::Mutex;
use std::sync::atomic::{AtomicBool, Ordering};
use tess_core::{Config, Domain, DomainPoint, OutputPrimitive, Partitioning, PatchFactors};
use tess_simd::{Numbering, Order, Tessellator};

const CONFIG: Config = Config::new(Partitioning::FractionalOdd, OutputPrimitive::TriangleCw);

fn assert_same(tessellator: &mut Tessellator, domain: Domain, patches: &Patches) {
    let expected = patches.expected(tessellator.config());
    let numbering = Numbering::PerBatch { base_vertex: 77 };
    let structures = (patches, patches.structures(domain));
    compare::<DomainPoint, u32>(tessellator, structures, &expected, numbering, |point| point);
    let columns = (patches, patches.columns(domain));
    let to_f32 = DomainPoint::to_f32;
    compare::<[f32; 2], u16>(tessellator, columns, &expected, Numbering::PerPatch, to_f32);
}

/// A batch with enough patches that several threads count it.
#[test]
fn counted_on_several_threads() {
    let isolines = Patches::random(5, Domain::Isoline, 3001);
    let cheap = |patch: &PatchFactors| match patch {
        PatchFactors::Isoline(factors) => factors.density <= 4.0,
        _ => true,
    };
    let patches = Patches::new(isolines.all.into_iter().filter(cheap).collect());
    assert!(patches.all.len() > 1100, "{} patches", patches.all.len());
    for (threads, config) in [2, 3, 4].into_iter().zip(configs().step_by(5)) {
        let mut tessellator = Tessellator::new(config).with_threads(threads);
        assert_same(&mut tessellator, Domain::Isoline, &patches);
    }
}

/// A pool with more threads than there are workspaces.
#[test]
fn within_a_larger_pool() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(5).build().expect("five threads");
    let patches = Patches::random(9, Domain::Triangle, 60);
    pool.broadcast(|_| {
        for threads in [1, 3] {
            let mut tessellator = Tessellator::new(CONFIG).with_threads(threads);
            assert_same(&mut tessellator, Domain::Triangle, &patches);
        }
    });
}

/// Workspaces of threads that have written a batch hold templates in the order of that batch. When
/// the order changes, all of them are dropped, whichever thread they belong to.
#[test]
fn every_workspace_takes_the_new_order() {
    const THREADS: usize = 3;
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let pool = rayon::ThreadPoolBuilder::new().num_threads(THREADS).build().expect("a pool");
    let patches = Patches::new(vec![PatchFactors::uniform(Domain::Quad, 9.0)]);
    let mut tessellator = Tessellator::new(config).with_threads(THREADS);
    for order in [Order::Specification, Order::VertexCache] {
        let expected = patches.expected_in(order, config);
        tessellator.set_order(order);
        let shared = Mutex::new(&mut tessellator);
        // One patch is one slice, which the calling thread writes with the workspace of its number.
        pool.broadcast(|_| {
            let mut tessellator = shared.lock().expect("no test has failed");
            let batch = (&patches, patches.structures(Domain::Quad));
            let (numbering, same) = (Numbering::PerPatch, |point| point);
            compare::<DomainPoint, u32>(&mut tessellator, batch, &expected, numbering, same);
        });
    }
}

/// A single thread writes all slices, also those before its own.
#[test]
fn each_thread_alone_writes_every_slice() {
    const THREADS: usize = 3;
    let pool = rayon::ThreadPoolBuilder::new().num_threads(THREADS).build().expect("a pool");
    let patches = Patches::random(11, Domain::Quad, 200);
    for alone in 0..THREADS {
        let done = AtomicBool::new(false);
        pool.broadcast(|context| {
            if context.index() == alone {
                let _end = SetAtEnd(&done);
                let mut tessellator = Tessellator::new(CONFIG).with_threads(THREADS);
                assert_same(&mut tessellator, Domain::Quad, &patches);
            } else {
                // Busy, so that it takes no work from the single thread.
                while !done.load(Ordering::Acquire) {
                    std::thread::yield_now();
                }
            }
        });
    }
}

/// Sets a flag when it is dropped, even in a panic.
struct SetAtEnd<'a>(&'a AtomicBool);

impl Drop for SetAtEnd<'_> {
    fn drop(&mut self) {
        self.0.store(true, Ordering::Release);
    }
}

/// There are at most 256 threads, however many are requested.
#[test]
fn too_many_threads() {
    let of = |threads| Tessellator::new(CONFIG).with_threads(threads);
    assert_eq!(Tessellator::MAX_THREADS, 256, "as documented");
    let most = of(256).memory();
    assert_eq!(of(257).memory(), most, "one too many");
    assert_eq!(of(usize::MAX).memory(), most, "far too many");
    assert!(of(255).memory() < most, "one fewer");
    let patches = Patches::random(3, Domain::Quad, 40);
    assert_same(&mut of(100_000), Domain::Quad, &patches);
}

/// Runs one test in a process of its own, with an environment variable.
fn alone(test: &str, variable: &str, value: &str) {
    let program = std::env::current_exe().expect("the path of this test");
    let output = std::process::Command::new(program)
        .args(["--exact", &format!("threads::{test}"), "--nocapture", "--ignored"])
        .env(variable, value)
        .output()
        .expect("this test runs again");
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
    let stdout = String::from_utf8_lossy(&output.stdout);
    assert!(stdout.contains("1 passed"), "{stdout}");
}

/// rayon would start every requested thread.
#[test]
fn too_large_a_pool() {
    alone("in_a_pool_of_256_on_request", "RAYON_NUM_THREADS", "100000");
}

#[test]
#[ignore = "too_large_a_pool runs it"]
fn in_a_pool_of_256_on_request() {
    assert_eq!(Tessellator::start_threads(), Ok(()), "256 threads can be started");
    if let Ok(threads) = std::fs::read_dir("/proc/self/task") {
        // The test itself has one or two.
        let threads = threads.count();
        assert!((257..260).contains(&threads), "{threads} threads");
    }
    let patches = Patches::random(3, Domain::Quad, 40);
    assert_same(&mut Tessellator::new(CONFIG).with_threads(2), Domain::Quad, &patches);
}

/// No thread can have such a stack.
#[test]
fn no_threads() {
    alone(
        "where_no_thread_can_be_started_on_request",
        "RUST_MIN_STACK",
        &(1_u64 << 46).to_string(),
    );
}

#[test]
#[ignore = "no_threads runs it"]
fn where_no_thread_can_be_started_on_request() {
    let error = Tessellator::start_threads().expect_err("no thread can be started").to_string();
    assert!(error.contains(" threads cannot be started: "), "{error}");
    let patches = Patches::random(11, Domain::Quad, 200);
    assert_same(&mut Tessellator::new(CONFIG).with_threads(3), Domain::Quad, &patches);
    let patches = Patches::random(5, Domain::Isoline, 1500);
    assert_same(&mut Tessellator::new(CONFIG).with_threads(3), Domain::Isoline, &patches);
}

/// Each thread has one workspace, also in a copy.
#[test]
fn workspaces_are_counted() {
    let of = |threads| Tessellator::new(CONFIG).with_threads(threads).memory();
    let workspace = of(2) - of(1);
    assert!(workspace < 1024, "{workspace} bytes before it is used");
    assert_eq!(of(4), of(1) + 3 * workspace, "four threads");
    assert_eq!(of(0), of(1), "at least one");
    let copy = |threads| Tessellator::new(CONFIG).with_threads(threads).clone().memory();
    assert_eq!(copy(3), copy(1) + 2 * workspace, "a copy");
}
