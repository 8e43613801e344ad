//! Faults planted by hand: `cargo xtask mutants planted`.
//!
//! A fault changes a copy of the tree, in which one test program is rebuilt and run; the sources
//! themselves are not touched. Switches in the code, with one build for all faults, would be
//! faster. But then the published crates would contain them, and the tests would run on a build
//! other than the published one.

use super::fault::{self, Planted};
use crate::command::{self, in_file, workspace};
use crate::suite::{self, Tree};
use crate::tally::Job;
use std::collections::BTreeSet;
use std::fmt;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use tess_testkit::listed::ListedFault;

/// The folder of the lists.
const LISTS: &str = "dev/faults";

/// The time limit in seconds; tests that run longer have detected the fault.
const PATIENCE: &str = "600";

/// The outcome of a fault.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Fate {
    Seen,
    Survived,
    /// The compiler detected it, so no test was run.
    Refused,
}

impl fmt::Display for Fate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Seen => "seen",
            Self::Survived => "SURVIVED",
            Self::Refused => "DOES NOT COMPILE",
        })
    }
}

/// Plants the faults whose folder, tests or name contain one of `words`, or all of them.
///
/// - A fault survives and is not listed as equivalent, or is listed and does not survive.
/// - A fault cannot be applied or does not compile.
/// - Tests fail without a fault.
pub(super) fn run(words: &[&str]) -> Result<(), String> {
    let files = files()?;
    let faults = chosen(words)?;
    let places: Vec<String> =
        faults.iter().filter_map(|fault| fault::plant(fault, &workspace(), &files).err()).collect();
    if !places.is_empty() {
        return Err(places.join("\n"));
    }
    let tree = copy(&files)?;
    let mut sound = BTreeSet::new();
    let mut wrong = Vec::new();
    for (number, fault) in (1..).zip(&faults) {
        if sound.insert((&fault.tests, &fault.filters)) && fate_in(&tree, fault)? != Fate::Survived
        {
            return Err(format!("{}: fails or does not compile without a fault", fault.tests));
        }
        let planted = fault::plant(fault, &workspace(), &files)?;
        let fate = fate(&tree, fault, &planted)?;
        let line = format!("{}: {}: {fate}", planted.file.display(), fault.name);
        println!("[{number} of {}] {line}", faults.len());
        let expected = if fault.equivalent.is_some() { Fate::Survived } else { Fate::Seen };
        if fate != expected {
            wrong.push(line);
        }
    }
    let equivalent = faults.iter().filter(|fault| fault.equivalent.is_some()).count();
    println!("\n{} faults, {equivalent} of them equivalent", faults.len());
    match wrong.is_empty() {
        true => Ok(()),
        false => Err(format!("not as listed:\n{}", wrong.join("\n"))),
    }
}

/// The outcome of a fault that is planted in the copy of the tree; the copy is restored afterwards.
fn fate(tree: &Tree, fault: &ListedFault, planted: &Planted) -> Result<Fate, String> {
    let file = tree.root.join(&planted.file);
    let original = fs::read(&file).map_err(|error| in_file(&file, &error))?;
    fs::write(&file, &planted.text).map_err(|error| in_file(&file, &error))?;
    let fate = fate_in(tree, fault);
    fs::write(&file, original).map_err(|error| in_file(&file, &error))?;
    fate
}

/// The faults that one of these words selects, without those that tests plant themselves.
fn chosen(words: &[&str]) -> Result<Vec<ListedFault>, String> {
    let mut faults = fault::read(&workspace().join(LISTS))?;
    faults.retain(|fault| !fault.is_planted_by_tests);
    faults.retain(|fault| {
        let ListedFault { folder, tests, filters, name, .. } = fault;
        let shown = format!("{folder} {tests} {} {name}", filters.join(" "));
        words.is_empty() || words.iter().any(|word| shown.contains(word))
    });
    if faults.is_empty() { Err(format!("no fault has one of {words:?}")) } else { Ok(faults) }
}

/// Whether a fault's tests detect what is in the tree.
fn fate_in(tree: &Tree, fault: &ListedFault) -> Result<Fate, String> {
    let Ok(jobs) = suite::programs(tree, &fault.tests) else { return Ok(Fate::Refused) };
    let mut fate = Fate::Survived;
    for Job { command, .. } in &jobs {
        // A fault may cause an endless loop.
        let mut limited = Command::new("timeout");
        limited
            .arg(PATIENCE)
            .arg(command.get_program())
            .args(command.get_args())
            .args(&fault.filters);
        if let Some(folder) = command.get_current_dir() {
            limited.current_dir(folder);
        }
        limited.envs(command.get_envs().filter_map(|(key, value)| Some((key, value?))));
        let output = limited.output().map_err(|error| format!("cannot run `timeout`: {error}"))?;
        let text = String::from_utf8_lossy(&output.stdout);
        if output.status.success() && text.contains("running 0 tests") {
            return Err(format!("{}: no test has the name {:?}", fault.tests, &fault.filters));
        }
        if !output.status.success() {
            fate = Fate::Seen;
        }
    }
    Ok(fate)
}

/// All files that git tracks or could add.
fn files() -> Result<Vec<PathBuf>, String> {
    let mut git = Command::new("git");
    git.args(["ls-files", "--cached", "--others", "--exclude-standard"]).current_dir(workspace());
    let list = command::output(&mut git)?;
    let files = list.lines().map(PathBuf::from);
    Ok(files.filter(|file| workspace().join(file).is_file()).collect())
}

/// Brings the copy of the tree up to date. Unchanged files are left alone, so that they are not
/// compiled again.
fn copy(files: &[PathBuf]) -> Result<Tree, String> {
    let folder = command::target().join("planted");
    let tree = Tree { root: folder.join("tree"), target: folder.join("target") };
    if !tree.target.exists() {
        take_builds(&tree.target)?;
    }
    let known = list(&tree.root);
    for file in known.iter().filter(|file| !files.contains(file)) {
        fs::remove_file(tree.root.join(file)).map_err(|error| in_file(file, &error))?;
    }
    for file in files {
        let (from, to) = (workspace().join(file), tree.root.join(file));
        let new = fs::read(&from).map_err(|error| in_file(&from, &error))?;
        if fs::read(&to).is_ok_and(|old| old == new) {
            continue;
        }
        let parent = to.parent().unwrap_or(&to);
        fs::create_dir_all(parent).map_err(|error| in_file(parent, &error))?;
        fs::write(&to, new).map_err(|error| in_file(&to, &error))?;
    }
    Ok(tree)
}

/// Copies the workspace's builds to `target`. Third-party crates then need not be compiled again.
/// Our own must be, because their sources are in another place and newer.
fn take_builds(target: &Path) -> Result<(), String> {
    let builds = command::target().join("debug");
    fs::create_dir_all(target).map_err(|error| in_file(target, &error))?;
    if !builds.is_dir() {
        return Ok(());
    }
    // `cp -a` preserves the files' times, which cargo compares.
    command::run(Command::new("cp").arg("-a").args([&builds, target]))
}

/// The paths of the files below a folder, relative to it; empty if it does not exist.
fn list(root: &Path) -> Vec<PathBuf> {
    let (mut folders, mut found) = (vec![root.to_path_buf()], Vec::new());
    while let Some(folder) = folders.pop() {
        for path in fs::read_dir(folder).into_iter().flatten().flatten().map(|e| e.path()) {
            if path.is_dir() {
                folders.push(path);
            } else if let Ok(file) = path.strip_prefix(root) {
                found.push(file.to_path_buf());
            }
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_fault_has_one_place_and_a_test() {
        let files = files().expect("files");
        let mut wrong = Vec::new();
        for fault in chosen(&[]).expect("faults") {
            wrong.extend(fault::plant(&fault, &workspace(), &files).err());
            if !workspace().join(&fault.tests).exists() {
                wrong.push(format!("{}: there is no {}", fault.name, fault.tests));
            }
        }
        assert!(wrong.is_empty(), "bring dev/faults up to date:\n{}", wrong.join("\n"));
    }
}
