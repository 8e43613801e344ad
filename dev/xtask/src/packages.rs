//! The workspace's packages, as `cargo metadata` lists them.

use crate::command::{self, cargo, workspace};
use serde::Deserialize;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A package of the workspace.
#[derive(Debug, Deserialize)]
pub(crate) struct Package {
    pub(crate) name: String,
    version: String,
    manifest_path: PathBuf,
    /// The registries that it may be published to; `None` stands for any.
    publish: Option<Vec<String>>,
    pub(crate) targets: Vec<Target>,
    #[serde(default)]
    metadata: Option<PackageTables>,
}

/// The tables `[package.metadata]` of a manifest, for tools.
#[derive(Debug, Default, Deserialize)]
struct PackageTables {
    #[serde(default)]
    tests: TestTable,
}

/// The table `[package.metadata.tests]` of a manifest: test programs by name, or [`WHOLE`].
#[derive(Debug, Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(crate) struct TestTable {
    /// Programs that only `test all` builds and runs, each with the reason.
    #[serde(default)]
    pub(crate) slow: BTreeMap<String, String>,
    /// Programs that cannot run without something of the machine, each with the need's name in
    /// `setup`.
    #[serde(default)]
    pub(crate) needs: BTreeMap<String, String>,
}

/// The name that stands for every test program of a package.
pub(crate) const WHOLE: &str = "*";

/// A library, program, test, example or bench of a package.
#[derive(Debug, Deserialize)]
pub(crate) struct Target {
    kind: Vec<String>,
    pub(crate) name: String,
    pub(crate) src_path: PathBuf,
    /// Whether `cargo test` runs it.
    #[serde(default)]
    pub(crate) test: bool,
}

impl Target {
    /// The arguments of cargo that select targets of this kind and name.
    pub(crate) fn selection(&self) -> Vec<String> {
        match self.kind.first().map(String::as_str) {
            Some(kind @ ("bin" | "test" | "example" | "bench")) => {
                vec![format!("--{kind}"), self.name.clone()]
            }
            _ => vec!["--lib".to_owned()],
        }
    }

    /// Whether it is the library of its package, in any form.
    pub(crate) fn is_library(&self) -> bool {
        self.selection() == ["--lib"]
    }
}

impl Package {
    /// The folder of its manifest.
    pub(crate) fn folder(&self) -> &Path {
        self.manifest_path.parent().unwrap_or(&self.manifest_path)
    }

    /// What its manifest says of its tests.
    pub(crate) fn tests(&self) -> &TestTable {
        static NOTHING: TestTable = TestTable { slow: BTreeMap::new(), needs: BTreeMap::new() };
        self.metadata.as_ref().map_or(&NOTHING, |metadata| &metadata.tests)
    }

    /// Its name and version, in the form that registries use for folders.
    pub(crate) fn full_name(&self) -> String {
        format!("{}-{}", self.name, self.version)
    }

    /// Whether it has a library that Rust code can use.
    pub(crate) fn is_library(&self) -> bool {
        let kinds = || self.targets.iter().flat_map(|target| &target.kind);
        kinds().any(|kind| kind == "lib" || kind == "rlib")
    }
}

#[derive(Deserialize)]
struct Metadata {
    packages: Vec<Package>,
}

/// The packages of the workspace.
///
/// # Errors
/// `cargo metadata` fails.
pub(crate) fn all() -> Result<Vec<Package>, String> {
    of(&mut cargo("metadata --no-deps --format-version 1"))
}

/// The package in this folder, which is a separate workspace.
///
/// # Errors
/// As for [`all`], or the folder has no package.
pub(crate) fn at(folder: &str) -> Result<Package, String> {
    let manifest = workspace().join(folder).join("Cargo.toml");
    let mut metadata = cargo("metadata --no-deps --format-version 1 --manifest-path");
    of(metadata.arg(manifest))?.pop().ok_or_else(|| format!("{folder} has no package"))
}

fn of(metadata: &mut Command) -> Result<Vec<Package>, String> {
    let text = command::output(metadata)?;
    let metadata: Metadata = serde_json::from_str(&text).map_err(|error| error.to_string())?;
    Ok(metadata.packages)
}

/// The published packages.
///
/// # Errors
/// `cargo metadata` fails, or no package is published.
pub(crate) fn published() -> Result<Vec<Package>, String> {
    let is_published = |package: &Package| package.publish.as_ref().is_none_or(|to| !to.is_empty());
    let packages: Vec<_> = all()?.into_iter().filter(is_published).collect();
    if packages.is_empty() { Err("no package is published".into()) } else { Ok(packages) }
}
