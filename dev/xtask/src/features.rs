//! Every published package compiles with none of its features, with each, and with all.

use crate::command::{self, cargo};
use crate::{packages, setup};

/// Checks the published packages, or only those with these names. A user's first command may be
/// `--no-default-features`, which no other part of the suite compiles.
///
/// # Errors
/// cargo-hack cannot be installed, a combination does not compile, or a name is not that of a
/// published package.
pub(crate) fn check(names: &[&str]) -> Result<(), String> {
    let published = packages::published()?;
    let is_published = |name: &str| published.iter().any(|package| package.name == name);
    if let Some(name) = names.iter().find(|name| !is_published(name)) {
        return Err(format!("no published package is `{name}`"));
    }
    setup::subcommand("hack")?;
    // The packages are listed, because `--no-private` would change manifests while it runs.
    let mut hack = cargo("hack check --each-feature");
    for package in &published {
        if names.is_empty() || names.contains(&package.name.as_str()) {
            hack.args(["--package", &package.name]);
        }
    }
    command::run(&mut hack)
}
