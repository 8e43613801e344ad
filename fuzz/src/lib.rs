//! Cases from bytes, and one oracle for each fuzz target.
//!
//! An oracle takes libFuzzer's bytes and describes the first difference, ending with the case as a
//! line that `tess check -` reads back and as a `tess patch` command. The targets in `fuzz_targets`
//! only call oracles. `TESS_FUZZ_FAULT=1` plants a fault on the observed side, so that anyone can
//! watch each oracle fail.

pub mod capi;
pub mod device;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod input;
pub mod mesh;
pub mod prepare;
pub mod random_access;
pub mod seeds;
pub mod simd;
pub mod vectors;

use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use tess_core::Tessellation;
use tess_verify::Case;
use tess_verify::check::Mismatch;

/// Ends the run with the message of an oracle, which libFuzzer takes as a finding.
pub fn fail_if(result: Result<(), String>) {
    if let Err(difference) = result {
        panic!("{difference}");
    }
}

static PLANTED: AtomicBool = AtomicBool::new(false);

/// Plants the fault from now on, as `TESS_FUZZ_FAULT` does for a whole run.
pub fn plant_fault() {
    PLANTED.store(true, Ordering::Relaxed);
}

/// Whether the fault is planted.
pub fn fault_is_planted() -> bool {
    static ASKED_FOR: OnceLock<bool> = OnceLock::new();
    PLANTED.load(Ordering::Relaxed)
        || *ASKED_FOR.get_or_init(|| std::env::var_os("TESS_FUZZ_FAULT").is_some())
}

/// Describes the first difference between a case's output and the model's.
pub fn compare_with_model(
    name: &str,
    case: &Case,
    mut observed: Tessellation,
    model: &Tessellation,
) -> Result<(), String> {
    if let Some(last) = observed.indices.last_mut().filter(|_| fault_is_planted()) {
        *last ^= 1;
    }
    match Mismatch::between(case, &observed, model) {
        None => Ok(()),
        Some(mismatch) => Err(repeatable(case, &format!("{name} differs from core: {mismatch}"))),
    }
}

/// A message with the case in a form that can be run again: the line goes into a file that starts
/// with `# tess-vectors 1 kind=listings count=1 source=fuzz` or the like, the command into a shell.
pub fn repeatable(case: &Case, message: &str) -> String {
    format!("\n{case}\n{}\n{message}", case.command())
}
