//! A fault in an adapter's output is detected.

#[cfg(feature = "gpu")]
use super::gpu::GpuBackend;
use super::simd::Simd;
use tess_simd::Level;
use tess_testkit::faults::{Fault, Faulty};
use tess_verify::Backend;
use tess_verify::check::{self, Tested};
use tess_verify::vectors::VectorFile;
#[cfg(feature = "gpu")]
use tess_workloads::IndexWidth;

/// One index is one too high, in a backend with 16-bit indices.
#[test]
fn narrow_indices_that_differ() {
    let golden = concat!(env!("CARGO_MANIFEST_DIR"), "/../../golden/cases.txt");
    let recorded = std::fs::read_to_string(golden).expect("recorded");
    for backend in &mut faulty() {
        let file = VectorFile::new("cases.txt", recorded.as_bytes()).expect("a vector file");
        let one = std::slice::from_mut(backend);
        let report = check::check(file, one, Tested::Backend, &|_| {}).expect("a verdict");
        assert_eq!((report.cases, report.mismatches), (51, 1), "{}", backend.device());
    }
}

/// Backends with 16-bit indices, each with one wrong index.
fn faulty() -> Vec<Box<dyn Backend>> {
    let simd = Simd::<u16>::with_level(Level::Baseline).expect("every machine has it");
    Vec::from([
        Box::new(Faulty::new(simd, Fault::last_index(), 0)) as Box<dyn Backend>,
        #[cfg(feature = "gpu")]
        Box::new(Faulty::new(
            GpuBackend::open(IndexWidth::U16).expect("an adapter"),
            Fault::last_index(),
            0,
        )),
    ])
}
