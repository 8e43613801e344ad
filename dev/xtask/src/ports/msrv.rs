//! The oldest compiler that `Cargo.toml` promises.

use crate::command;
use crate::packages;
use crate::setup;
use std::process::Command;

/// The workspace's `rust-version`, without its last number.
const RUST_VERSION: &str = env!("CARGO_PKG_RUST_VERSION");

/// Checks every published package, with all features, on the first release of that version.
pub(super) fn check() -> Result<(), String> {
    let compiler = format!("{RUST_VERSION}.0");
    setup::toolchain(&compiler, &[])?;
    let mut check = Command::new("cargo");
    check.arg(format!("+{compiler}")).args(["check", "--locked", "--all-features"]);
    for package in packages::published()? {
        check.args(["--package", &package.name]);
    }
    command::run(check.current_dir(command::workspace()))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs;

    #[test]
    fn the_version_stands_in_one_manifest() {
        let root = command::workspace();
        let read = |path: &str| fs::read_to_string(root.join(path)).expect(path);
        assert!(!read("README.md").contains("Rust 1."), "README.md refers to Cargo.toml");
        let own = ["fuzz/Cargo.toml", "dev/nostd-proof/Cargo.toml"].map(read);
        let members = packages::published().expect("packages");
        let members = members
            .iter()
            .map(|package| fs::read_to_string(package.folder().join("Cargo.toml")).expect("one"));
        for manifest in own.into_iter().chain(members) {
            assert!(!manifest.contains("rust-version = "), "another version:\n{manifest}");
        }
    }
}
