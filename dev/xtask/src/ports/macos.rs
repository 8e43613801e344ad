//! macOS: everything except linking can be checked anywhere.

use crate::command::{self, cargo};
use crate::setup;

const TARGET: &str = "aarch64-apple-darwin";

/// The packages without C code, which would need Apple's compiler.
const PACKAGES: &[&str] = &[
    "tess-core",
    "tess-level",
    "tess-simd",
    "tess-gpu",
    "tess-surface",
    "tess-mesh",
    "tess-verify",
    "tess-show",
    "tess-workloads",
    "tess-wgpu",
    "tess-capi",
];

/// Checks the libraries for Apple's processors. Nothing is run, because that takes a Mac.
pub(super) fn check() -> Result<(), String> {
    setup::target(TARGET)?;
    let packages = PACKAGES.iter().flat_map(|package| ["--package", package]);
    command::run(cargo("check --lib --all-features --target").arg(TARGET).args(packages))?;
    command::run(cargo("check --package tess-program --no-default-features --target").arg(TARGET))
}
