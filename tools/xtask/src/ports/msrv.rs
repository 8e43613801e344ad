//! The oldest compiler that `Cargo.toml` promises.

use crate::command;
use crate::packages;
use crate::setup;
use std::process::Command;

/// The workspace's `rust-version`, without its last number.
const RUST_VERSION: &str = env!("CARGO_PKG_RUST_VERSION");

/// Checks every published package, all features on, with the first release of that version.
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
    fn the_readme_has_the_version_of_the_manifest() {
        let readme = fs::read_to_string(command::workspace().join("README.md")).expect("a README");
        let sentence = format!("Rust {RUST_VERSION} or later");
        assert!(readme.contains(&sentence), "README.md should say: {sentence}");
        assert_eq!(readme.matches(" or later").count(), 1, "and name no other version");
    }
}
