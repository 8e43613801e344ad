//! Every seed passes its oracle, and each oracle fails when a fault is planted.
//!
//! One test, as the planted fault is seen by the whole process.

use std::path::Path;
use tess_fuzz::{capi, plant_fault, prepare, random_access, seeds, simd, vectors};

type Oracle = fn(&[u8]) -> Result<(), String>;

const ORACLES: &[(&str, Oracle)] = &[
    ("random_access", random_access::check),
    ("simd", simd::check),
    ("prepare", prepare::check),
    ("vectors", vectors::check),
    ("capi", capi::check),
    #[cfg(feature = "gpu")]
    ("gpu", tess_fuzz::gpu::check),
];

#[test]
fn seeds_pass_until_a_fault_is_planted() {
    let golden = Path::new(env!("CARGO_MANIFEST_DIR")).join("../golden");
    for &(target, oracle) in ORACLES {
        let seeds = seeds::of(target, &golden).expect("seeds");
        assert!(seeds.len() >= 8, "{target} has only {} seeds", seeds.len());
        for (name, bytes) in seeds {
            assert_eq!(oracle(&bytes), Ok(()), "seed {name} of {target}");
        }
    }
    plant_fault();
    for &(target, oracle) in ORACLES {
        let seeds = seeds::of(target, &golden).expect("seeds");
        let failures: Vec<_> = seeds.iter().filter_map(|(_, bytes)| oracle(bytes).err()).collect();
        assert!(failures.len() >= seeds.len() / 3, "{target}: {} failures", failures.len());
        println!(
            "{target}: {} of {} seeds fail, such as: {}",
            failures.len(),
            seeds.len(),
            failures[0]
        );
    }
}
