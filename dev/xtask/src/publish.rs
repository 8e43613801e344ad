//! The conditions of publishing: packages that build by themselves, licences, compatible changes.

use crate::command::{self, cargo, in_file, workspace};
use crate::packages::{self, Package};
use crate::setup;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Publishes every published package.
///
/// # Errors
/// The sources are not committed, or cargo fails.
pub(crate) fn send() -> Result<(), String> {
    let mut status = Command::new("git");
    let changed = command::output(status.args(["status", "--porcelain"]).current_dir(workspace()))?;
    if !changed.is_empty() {
        return Err(format!("a published version is a commit; commit these first:\n{changed}"));
    }
    // The copies of the licences belong to no commit.
    with_licences(&mut cargo("publish --workspace --allow-dirty"))?;
    APART.iter().try_for_each(|folder| command::run(in_folder(&mut cargo("publish"), folder)))
}

/// Published packages that are separate workspaces. They depend on published versions of the
/// others, so they are published after them; before that, only `cargo xtask integrations` builds
/// them.
const APART: &[&str] = &["integrations/bevy"];

/// The command for the manifest in this folder of the workspace.
fn in_folder<'a>(cargo: &'a mut Command, folder: &str) -> &'a mut Command {
    cargo.arg("--manifest-path").arg(workspace().join(folder).join("Cargo.toml"))
}

/// Runs a command while each published package has a copy of the licences, because each becomes an
/// archive of its own.
fn with_licences(command: &mut Command) -> Result<(), String> {
    let copies = |act: &dyn Fn(&Path, &Path) -> std::io::Result<()>| {
        packages::published()?.iter().try_for_each(|package| {
            LICENCES.iter().try_for_each(|licence| {
                let copy = package.folder().join(licence);
                act(&workspace().join(licence), &copy).map_err(|error| in_file(&copy, &error))
            })
        })
    };
    let ran = copies(&|from, to| fs::copy(from, to).map(drop)).and_then(|()| command::run(command));
    copies(&|_, to| fs::remove_file(to)).and(ran)
}

/// Packs every published package, and returns the archives.
///
/// # Errors
/// As for [`dry_run`].
pub(crate) fn pack() -> Result<Vec<PathBuf>, String> {
    forget_packages()?;
    let published = packages::published()?;
    let mut pack = cargo("package --no-verify --allow-dirty");
    pack.args(published.iter().flat_map(|package| ["--package", &package.name]));
    with_licences(&mut pack)?;
    let mut names: Vec<_> = published.iter().map(Package::full_name).collect();
    names.extend(pack_apart()?);
    let file = |name: &String| command::target().join(format!("package/{name}.crate"));
    Ok(names.iter().map(file).collect())
}

/// Packs the packages of [`APART`], and returns their names and versions. Their lock files are left
/// out, because no registry has the versions of this workspace that they would name.
fn pack_apart() -> Result<Vec<String>, String> {
    let pack = |folder: &&str| {
        let mut pack = cargo("package --no-verify --allow-dirty --exclude-lockfile --target-dir");
        command::run(in_folder(pack.arg(command::target()), folder))?;
        Ok(packages::at(folder)?.full_name())
    };
    APART.iter().map(pack).collect()
}

/// Packs and builds every published package as the registry would receive it, without sending it.
pub(crate) fn dry_run() -> Result<(), String> {
    let lacking = lacking()?;
    if !lacking.is_empty() {
        return Err(lacking.join("\n"));
    }
    forget_packages()?;
    let mut publish = cargo("publish --dry-run --workspace --all-features");
    // This only tests the build, with every dependency; nobody runs or debugs the result.
    publish.env("CARGO_PROFILE_DEV_DEBUG", "0");
    // A developer's changes are packed too; actual publishing needs a clean checkout.
    with_licences(publish.arg("--allow-dirty"))?;
    println!("\nONLY PACKED: {}; `cargo xtask integrations` builds it", pack_apart()?.join(", "));
    Ok(())
}

/// Removes the packages left by an earlier dry run. Cargo takes them from a folder that serves as a
/// registry, and assumes that a version in a registry never changes. It would build old sources, or
/// nothing.
fn forget_packages() -> Result<(), String> {
    let (home, target) = (command::cargo_home()?, command::target());
    for package in packages::published()? {
        let (with_version, name) = (package.full_name(), format!("{}-", package.name));
        // The name of a registry that is a folder has no host.
        for registry in entries(&home.join("registry/src"), "-") {
            remove_all(&entries(&registry, &with_version))?;
        }
        remove_all(&entries(&target.join("debug/.fingerprint"), &name))?;
    }
    Ok(())
}

/// The entries of a folder whose names have this prefix; empty if the folder does not exist.
fn entries(folder: &Path, prefix: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    let named = entries.filter(|e| e.file_name().to_string_lossy().starts_with(prefix));
    named.map(|entry| entry.path()).collect()
}

fn remove_all(folders: &[PathBuf]) -> Result<(), String> {
    folders
        .iter()
        .try_for_each(|folder| fs::remove_dir_all(folder).map_err(|error| in_file(folder, &error)))
}

/// Checks dependencies against `deny.toml`: licences, banned and duplicate crates, and sources.
///
/// With `advisories`, also checks the database of known vulnerabilities, which is fetched from the
/// network.
pub(crate) fn deny(advisories: bool) -> Result<(), String> {
    setup::subcommand("deny")?;
    let mut deny = cargo("deny --workspace --all-features check licenses bans sources");
    if advisories {
        deny.arg("advisories");
    } else {
        println!("deny: advisories are not checked; `cargo xtask deny advisories` checks them");
    }
    command::run(&mut deny)
}

/// The part of [`deny`] in continuous integration. If cargo-deny, which takes minutes to compile,
/// is not installed, it checks nothing and says so.
pub(crate) fn deny_if_installed() -> Result<(), String> {
    if setup::has_subcommand("deny") {
        return deny(false);
    }
    println!(
        "\nNOT CHECKED: licences and sources of dependencies, as cargo-deny is not installed;"
    );
    println!("`cargo xtask deny` installs it and checks them");
    Ok(())
}

/// Compares the interfaces of the published libraries with those of a commit, and with the version
/// numbers in the manifests.
pub(crate) fn semver(baseline: &str) -> Result<(), String> {
    setup::subcommand("semver-checks")?;
    let mut checks = cargo("semver-checks --all-features --baseline-rev");
    checks.arg(baseline);
    for package in packages::published()?.iter().filter(|package| package.is_library()) {
        checks.args(["--package", &package.name]);
    }
    command::run(&mut checks)
}

/// The keys of a manifest that a registry shows.
const SHOWN: &[&str] = &[
    "description",
    "repository",
    "readme",
    "keywords",
    "categories",
    "[package.metadata.docs.rs]",
];

/// The texts of the licences, in the workspace's folder.
pub(crate) const LICENCES: &[&str] = &["LICENSE-APACHE", "LICENSE-MIT"];

/// The files and manifest keys that published packages lack, one line per item.
fn lacking() -> Result<Vec<String>, String> {
    let mut lacking = Vec::new();
    let apart: Result<Vec<_>, _> = APART.iter().map(|folder| packages::at(folder)).collect();
    for package in packages::published()?.into_iter().chain(apart?) {
        let read = |name| command::read(&package.folder().join(name));
        let manifest = read("Cargo.toml")?;
        let has = |key: &&str| manifest.lines().any(|line| line.starts_with(key));
        let mut add = |what: String| lacking.push(format!("{}: {what}", package.name));
        SHOWN.iter().filter(|key| !has(key)).for_each(|key| add(format!("no {key} in Cargo.toml")));
        if read("README.md").is_err() {
            add("no README.md".into());
        }
    }
    Ok(lacking)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn published_packages_are_complete() {
        assert_eq!(lacking(), Ok(vec![]), "cargo xtask publish says so too");
    }
}
