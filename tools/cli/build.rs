//! Passes the program the commit from which it is built, for its reports.
//!
//! The commit counts as clean only if every file that the program is made of is as it is there.
//! Which files these are is cargo's knowledge: the packages of this workspace that this one depends
//! on, whatever their files are, and the manifests and versions that cargo reads.
//! `tests/program/commit.rs` compares them with the files that the compiler read.

use serde_json::Value;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

fn main() {
    println!("cargo::rerun-if-env-changed=TESS_COMMIT");
    println!("cargo::rerun-if-changed=build.rs");
    let folder = PathBuf::from(std::env::var_os("CARGO_MANIFEST_DIR").unwrap_or_default());
    let given = std::env::var("TESS_COMMIT").ok();
    let built = given.map(Built::of).or_else(|| packaged(&folder)).or_else(|| checked_out(&folder));
    let Built { commit, sources, watched } = built.unwrap_or_else(|| Built::of("unknown".into()));
    for path in &watched {
        println!("cargo::rerun-if-changed={}", path.display());
    }
    println!("cargo::rustc-env=TESS_COMMIT={commit}");
    let sources: String = sources.iter().map(|path| format!("{}\n", path.display())).collect();
    let list = PathBuf::from(std::env::var_os("OUT_DIR").unwrap_or_default()).join("sources.txt");
    if let Err(error) = std::fs::write(&list, sources) {
        println!("cargo::error={}: {error}", list.display());
    }
}

/// What the program is built from.
#[derive(Debug)]
pub(crate) struct Built {
    /// The commit, with `+changes` if a file differs from it.
    pub(crate) commit: String,
    /// The files, if they are those of a clone.
    sources: Vec<PathBuf>,
    /// The files on which the commit and its cleanliness depend.
    watched: Vec<PathBuf>,
}

impl Built {
    const fn of(commit: String) -> Self {
        Self { commit, sources: Vec::new(), watched: Vec::new() }
    }
}

fn marked(commit: String, is_clean: bool) -> String {
    if is_clean { commit } else { commit + "+changes" }
}

/// The commit recorded in a published package.
pub(crate) fn packaged(folder: &Path) -> Option<Built> {
    let file = folder.join(".cargo_vcs_info.json");
    let info: Value = serde_json::from_str(&std::fs::read_to_string(&file).ok()?).ok()?;
    let commit = info["git"]["sha1"].as_str()?.to_owned();
    let is_dirty = info["git"]["dirty"] == true;
    Some(Built { watched: vec![file], ..Built::of(marked(commit, !is_dirty)) })
}

/// The commit of the clone in which this package is; `None` if it is in no clone, or in another
/// project's.
pub(crate) fn checked_out(folder: &Path) -> Option<Built> {
    let root = PathBuf::from(git(folder, &["rev-parse", "--show-toplevel"])?);
    let sources = sources(folder, &root)?;
    let names: Vec<&str> = sources.iter().map(String::as_str).collect();
    let commit = git(&root, &["rev-parse", "HEAD"])?;
    let status = ["--no-optional-locks", "--literal-pathspecs", "status", "--porcelain", "--"];
    let changes = git(&root, &[&status[..], &names].concat())?;
    let commit = marked(commit, changes.is_empty());
    let sources: Vec<PathBuf> = names.iter().map(|name| root.join(name)).collect();
    let state = ["HEAD", "logs/HEAD"];
    let state = state.map(|name| git(folder, &["rev-parse", "--git-path", name]));
    let state = state.into_iter().flatten().map(|path| folder.join(path));
    // Cargo would run this again and again for a file that is not there.
    let watched = state.chain(sources.iter().cloned()).filter(|path| path.exists()).collect();
    Some(Built { commit, sources, watched })
}

/// The files of the clone from which the program is built, from its root: all of the packages that
/// the one in `folder` depends on, except those of their tests, benches and examples, and what
/// cargo itself reads. `None` if the clone is not that of this workspace.
fn sources(folder: &Path, root: &Path) -> Option<Vec<String>> {
    let words = ["metadata", "--no-deps", "--offline", "--format-version", "1"];
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let answer = Command::new(cargo).args(words).current_dir(folder).output().ok()?;
    let metadata: Value = serde_json::from_slice(&answer.stdout).ok()?;
    let workspace = PathBuf::from(metadata["workspace_root"].as_str()?);
    if workspace.canonicalize().ok()? != root.canonicalize().ok()? {
        return None;
    }
    let packages = packages(&metadata, folder);
    let list = ["ls-files", "-z", "--cached", "--others", "--exclude-standard"];
    let all = git(&workspace, &list)?;
    let of_cargo = ["Cargo.toml", "Cargo.lock", "rust-toolchain", "rust-toolchain.toml"];
    let is_source = |name: &&str| {
        let path = workspace.join(name);
        let of_program = packages.iter().any(|package| package.has(&path));
        of_program || of_cargo.contains(name) || name.starts_with(".cargo/")
    };
    Some(all.split('\0').filter(is_source).map(str::to_owned).collect())
}

/// A package of the workspace.
struct Package {
    folder: PathBuf,
    /// Its folders that are not part of a program which depends on it.
    others: Vec<PathBuf>,
}

impl Package {
    fn new(folder: &Path, metadata: &Value) -> Self {
        let [mut own, mut others] = [BTreeSet::new(), BTreeSet::new()];
        for target in metadata["targets"].as_array().into_iter().flatten() {
            let path = Path::new(target["src_path"].as_str().unwrap_or_default());
            let mut parts = path.strip_prefix(folder).unwrap_or(path).components();
            let first = parts.next().map(|part| folder.join(part));
            let kinds = target["kind"].as_array().into_iter().flatten().filter_map(Value::as_str);
            let is_other =
                kinds.into_iter().any(|kind| ["test", "bench", "example"].contains(&kind));
            let folders = if is_other { &mut others } else { &mut own };
            folders.extend(first.filter(|_| parts.next().is_some()));
        }
        // A test may be in the folder of the library.
        Self { folder: folder.to_owned(), others: others.difference(&own).cloned().collect() }
    }

    /// Whether a file is one of the package, and not of a workspace inside its folder.
    fn has(&self, path: &Path) -> bool {
        let is_inside = path.starts_with(&self.folder);
        let inner = path.ancestors().skip(1).take_while(|folder| *folder != self.folder);
        is_inside
            && !self.others.iter().any(|other| path.starts_with(other))
            && !inner.into_iter().any(|folder| folder.join("Cargo.toml").is_file())
    }
}

/// The package in `folder`, and all that it depends on, whatever the features.
fn packages(metadata: &Value, folder: &Path) -> Vec<Package> {
    let mut found = BTreeSet::new();
    let mut next = vec![folder.to_owned()];
    let mut packages = Vec::new();
    let all = || metadata["packages"].as_array().into_iter().flatten();
    while let Some(folder) = next.pop() {
        if !found.insert(folder.clone()) {
            continue;
        }
        let manifest = folder.join("Cargo.toml");
        let of = all()
            .find(|one| one["manifest_path"].as_str().is_some_and(|at| manifest == Path::new(at)));
        let of = of.unwrap_or(&Value::Null);
        packages.push(Package::new(&folder, of));
        let dependencies = of["dependencies"].as_array().into_iter().flatten();
        let used = dependencies.filter(|dependency| dependency["kind"] != "dev");
        next.extend(used.filter_map(|one| one["path"].as_str()).map(PathBuf::from));
    }
    packages
}

/// The output of git, without the newline at the end; `None` if there is no git or no clone.
fn git(folder: &Path, words: &[&str]) -> Option<String> {
    let answer = Command::new("git").args(words).current_dir(folder).output().ok()?;
    let text = String::from_utf8(answer.stdout).ok()?;
    answer.status.success().then(|| text.trim_end().to_owned())
}
