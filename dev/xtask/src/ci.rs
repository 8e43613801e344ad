//! The steps of continuous integration: texts and lints, which fail fast; the comparisons; then
//! everything else. A run that is killed has told what matters.

use crate::command::{self, cargo};
use crate::ports::{self, Extent};
use crate::{examples, features, fuzz, levels, publish, rtl, satellites, script, test};

/// Runs formatting, checks of texts and records, lints, documentation, every test, the satellites
/// that are stale or all of them, features, the fuzz targets, other compilers and processors, and
/// packages; with `all` also the circuit's proofs and placements. The last line printed is the
/// tests' tally.
pub(crate) fn run(all: bool) -> Result<(), String> {
    if cfg!(target_arch = "x86_64") && !levels::required().contains(&"avx2") {
        return Err("continuous integration on x86-64 needs a processor with AVX2".into());
    }
    command::run(&mut cargo("fmt --all --check"))?;
    script::run(script::CHECKS, &["traceability"])?;
    script::run(script::CHECKS, &["public"])?;
    script::run(script::CHECKS, &["width"])?;
    script::run(script::FRESH, &[])?;
    command::run(
        cargo("clippy --workspace --all-targets --all-features").args(["--", "-D", "warnings"]),
    )?;
    command::run(
        cargo("doc --workspace --no-deps --all-features").env("RUSTDOCFLAGS", "-D warnings"),
    )?;
    examples::lint()?;
    let tally = test::run_all()?;
    satellites::check(all)?;
    if all {
        // What docs/rtl.md promises beyond the comparisons.
        rtl::run(&["--prove"])?;
        rtl::run(&["--place"])?;
    }
    features::check_brief()?;
    fuzz::run(&["3"])?;
    ports::run(&["msrv", "s390x", "wasm", "miri"], Extent::Brief)?;
    publish::dry_run()?;
    publish::deny_if_installed()?;
    println!("\n{tally}");
    Ok(())
}
