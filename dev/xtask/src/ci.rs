//! The steps of continuous integration, ordered by how fast they fail.

use crate::command::{self, cargo};
use crate::ports::{self, Extent};
use crate::{examples, features, fuzz, levels, publish, script, test};

/// Runs formatting, checks of texts and records, lints, documentation, features, the fuzz targets,
/// other compilers and processors, packages, and finally every test.
pub(crate) fn run() -> Result<(), String> {
    if cfg!(target_arch = "x86_64") && !levels::required().contains(&"avx2") {
        return Err("continuous integration on x86-64 needs a processor with AVX2".into());
    }
    command::run(&mut cargo("fmt --all --check"))?;
    script::run(script::CHECKS, &["traceability"])?;
    script::run(script::CHECKS, &["public"])?;
    script::run(script::CHECKS, &["width"])?;
    script::run(script::RECORDS, &["fresh"])?;
    command::run(
        cargo("clippy --workspace --all-targets --all-features").args(["--", "-D", "warnings"]),
    )?;
    command::run(
        cargo("doc --workspace --no-deps --all-features").env("RUSTDOCFLAGS", "-D warnings"),
    )?;
    examples::lint()?;
    features::check_brief()?;
    command::lock_versions(&command::workspace(), "fuzz")?;
    command::run(&mut cargo("test --manifest-path fuzz/Cargo.toml"))?;
    fuzz::run(&["3"])?;
    ports::run(&["msrv", "s390x", "wasm", "miri"], Extent::Brief)?;
    publish::dry_run()?;
    publish::deny_if_installed()?;
    test::run_all(test::Browser::Demanded)
}
