//! Every published package compiles with none of its features, with each, and with all.

use crate::command::{self, cargo};
use crate::packages::{self, Package};
use crate::setup;

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
    let is_chosen = |package: &&Package| names.is_empty() || names.contains(&package.name.as_str());
    check_each(published.iter().filter(is_chosen))
}

/// As [`check`], but of the program only that it compiles with none: each of its features brings
/// another build of the GPU's libraries. Lints compile it with all.
///
/// # Errors
/// As for [`check`].
pub(crate) fn check_brief() -> Result<(), String> {
    let published = packages::published()?;
    check_each(published.iter().filter(|package| package.name != PROGRAM))?;
    command::run(&mut cargo(&format!("check --no-default-features --package {PROGRAM}")))
}

const PROGRAM: &str = "tess-program";

fn check_each<'a>(chosen: impl Iterator<Item = &'a Package>) -> Result<(), String> {
    setup::subcommand("hack")?;
    // The packages are listed, because `--no-private` would change manifests while it runs.
    let mut hack = cargo("hack check --each-feature");
    hack.args(chosen.flat_map(|package| ["--package", &package.name]));
    command::run(&mut hack)
}
