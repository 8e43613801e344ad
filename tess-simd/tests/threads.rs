//! Batches on several threads: the same output as on one, whatever their number.

#![cfg(feature = "rayon")]

#[path = "common/patches.rs"]
mod patches;

use patches::{Patches, compare, configs};
use tess_core::{Config, Domain, DomainPoint, OutputPrimitive, Partitioning, PatchFactors};
use tess_simd::{Numbering, Tessellator};

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

#[test]
fn any_number_of_threads() {
    for (threads, config) in [0, 1, 2, 3, 5, 8].into_iter().zip(configs().step_by(5)) {
        let mut tessellator = Tessellator::new(config).threads(threads);
        for (count, domain) in [(0, Domain::Quad), (7, Domain::Triangle), (150, Domain::Quad)] {
            assert_same(&mut tessellator, domain, &Patches::random(31, domain, count));
        }
    }
}

/// So many patches that several threads count them.
#[test]
fn counted_on_several_threads() {
    let isolines = Patches::random(5, Domain::Isoline, 3001);
    let cheap = |patch: &PatchFactors| match patch {
        PatchFactors::Isoline(factors) => factors.density <= 4.0,
        _ => true,
    };
    let patches = Patches::new(isolines.all.into_iter().filter(cheap).collect());
    assert!(patches.all.len() > 1100, "{} patches", patches.all.len());
    for threads in [2, 3] {
        let mut tessellator = Tessellator::new(CONFIG).threads(threads);
        assert_same(&mut tessellator, Domain::Isoline, &patches);
    }
}

/// Threads of a pool that is larger than there are workspaces.
#[test]
fn within_a_larger_pool() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(5).build().expect("five threads");
    let patches = Patches::random(9, Domain::Triangle, 60);
    pool.broadcast(|_| {
        for threads in [1, 3] {
            let mut tessellator = Tessellator::new(CONFIG).threads(threads);
            assert_same(&mut tessellator, Domain::Triangle, &patches);
        }
    });
}

/// However many threads are asked for, there are at most 256.
#[test]
fn too_many_threads() {
    let of = |threads| Tessellator::new(CONFIG).threads(threads);
    assert_eq!(Tessellator::MAX_THREADS, 256, "as documented");
    let most = of(256).memory();
    assert_eq!(of(257).memory(), most, "one too many");
    assert_eq!(of(usize::MAX).memory(), most, "far too many");
    assert!(of(255).memory() < most, "one fewer");
    let patches = Patches::random(3, Domain::Quad, 40);
    assert_same(&mut of(100_000), Domain::Quad, &patches);
}

/// A size of rayon's global pool that cannot be started: the tests start themselves with it.
#[test]
fn too_large_a_pool() {
    let program = std::env::current_exe().expect("the path of this test");
    let output = std::process::Command::new(program)
        .args(["--exact", "in_a_pool_of_any_size", "--nocapture"])
        .env("RAYON_NUM_THREADS", "100000")
        .output()
        .expect("this test runs again");
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
    assert!(text.contains("global pool: 256 threads"), "{text}");
}

#[test]
fn in_a_pool_of_any_size() {
    use std::io::Write as _;
    let patches = Patches::random(3, Domain::Quad, 40);
    assert_same(&mut Tessellator::new(CONFIG).threads(2), Domain::Quad, &patches);
    let threads = rayon::current_num_threads();
    let _ = writeln!(std::io::stderr(), "global pool: {threads} threads");
}

/// Each thread has a workspace of its own, in a copy too.
#[test]
fn workspaces_are_counted() {
    let of = |threads| Tessellator::new(CONFIG).threads(threads).memory();
    let workspace = of(2) - of(1);
    assert!(workspace > 100_000, "{workspace} bytes");
    assert_eq!(of(4), of(1) + 3 * workspace, "four threads");
    assert_eq!(of(0), of(1), "at least one");
    let copy = |threads| Tessellator::new(CONFIG).threads(threads).clone().memory();
    assert_eq!(copy(3), copy(1) + 2 * workspace, "a copy");
}
