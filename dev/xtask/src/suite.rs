//! The test programs of the workspace, all built with one set of features.
//!
//! Cargo gives dependencies the union of the features that the selected packages request. A test
//! file is therefore selected as a target of the whole workspace, so that no dependency is compiled
//! again. The folder of a package selects only that package: its dependencies may be compiled once
//! more, but never the tests of other packages.

use crate::command::{self, cargo, workspace};
use crate::levels;
use crate::packages::{self, Package, Target, WHOLE};
use crate::tally::Job;
use crate::{python, setup};
use serde::Deserialize;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The arguments of `cargo` for the tests of the workspace.
const ALL: &str = "test --workspace --all-features --no-fail-fast";

/// Makes cargo list its build products on its standard output.
const MESSAGES: &str = "--message-format=json-render-diagnostics";

/// The word in the names of tests that run only on request: of a person who has what they need, or
/// of another test that makes their surroundings.
const ON_REQUEST: &str = "on_request";

/// The extent of a test run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Extent {
    /// Everything that is not marked as slow: tests by `#[ignore = "slow: ..."]`, programs and
    /// packages by their manifest ([`packages::TestTable`]).
    Comparisons,
    /// In addition, everything that is marked so.
    All,
}

/// Sources, and the folder of their builds: those of the workspace, or a copy.
pub(crate) struct Tree {
    pub(crate) root: PathBuf,
    pub(crate) target: PathBuf,
}

/// A test program, as cargo's messages describe it.
#[derive(Deserialize)]
struct TestProgram {
    manifest_path: PathBuf,
    target: Target,
    profile: Profile,
    executable: Option<PathBuf>,
}

#[derive(Deserialize)]
struct Profile {
    test: bool,
}

/// Arguments of `cargo xtask test`: paths of tests, and words of which a test's name must contain
/// one.
#[derive(Debug, Default, PartialEq, Eq)]
pub(crate) struct TestSelection<'a> {
    pub(crate) paths: Vec<&'a str>,
    pub(crate) words: Vec<&'a str>,
}

impl<'a> TestSelection<'a> {
    /// The first argument is a path. So are later ones that contain a `/` or are the folder of a
    /// package.
    pub(crate) fn of(arguments: &[&'a str]) -> Self {
        let is_path = |(number, argument): &(usize, &str)| {
            *number == 0
                || argument.contains('/')
                || workspace().join(argument).join("Cargo.toml").is_file()
        };
        let (paths, words): (Vec<_>, Vec<_>) =
            arguments.iter().copied().enumerate().partition(is_path);
        let texts = |list: Vec<(usize, &'a str)>| list.into_iter().map(|(_, text)| text).collect();
        Self { paths: texts(paths), words: texts(words) }
    }
}

/// The jobs of a run, and what it leaves out.
pub(crate) struct Suite {
    /// One job for each program, the largest first. With [`Extent::All`] one is for the examples in
    /// the documentation.
    pub(crate) jobs: Vec<Job>,
    /// Programs that are not run, each with the reason.
    pub(crate) left_out: Vec<String>,
}

/// Builds the tests. For a part, takes only programs whose sources are below one of its paths, and
/// no documentation.
///
/// # Errors
/// They do not compile, or a path has no tests.
pub(crate) fn build(extent: Extent, part: &TestSelection<'_>) -> Result<Suite, String> {
    let packages = packages::all()?;
    let base = base(extent, part, &packages);
    let mut build = cargo(&base);
    println!("\n$ {}", command::shown(build.arg("--no-run")));
    let selected = match (extent, &part.paths[..]) {
        // The examples are not built either; their sources are included in tests.
        (Extent::Comparisons, []) => comparisons(&packages),
        (_, paths) => selection(paths, &packages)?,
    };
    let messages = command::output(build.arg(MESSAGES).args(selected))?;
    let mut jobs = jobs_of(&messages, &workspace(), extent, &part.paths);
    let mut left_out = Vec::new();
    if extent == Extent::Comparisons {
        left_out.extend(packages.iter().flat_map(slow_programs));
    }
    leave_out_what_lacks(&mut jobs, &packages, &mut left_out)?;
    // The largest programs have the GPU's libraries, and take longest.
    jobs.sort_by_key(|job| std::cmp::Reverse(job.size()));
    if !part.words.is_empty() {
        jobs = jobs.iter().flat_map(|job| part.words.iter().map(|word| job.with(word))).collect();
    }
    if extent == Extent::All && part.paths.is_empty() {
        let mut documentation = cargo(&base);
        documentation.arg("--doc");
        prepare(&mut documentation, &base);
        // This job compiles the examples, so it takes long.
        jobs.insert(1.min(jobs.len()), Job::new(documentation));
    }
    for job in &mut jobs {
        prepare(&mut job.command, &base);
    }
    Ok(Suite { jobs, left_out })
}

/// The arguments of `cargo` that select the packages. If all are selected, every dependency has the
/// same features; the folder of a package selects only that package.
fn base(extent: Extent, part: &TestSelection<'_>, packages: &[Package]) -> String {
    let mut base = ALL.to_owned();
    if part.paths.is_empty() {
        if extent == Extent::Comparisons {
            let slow = packages.iter().filter(|package| package.tests().slow.contains_key(WHOLE));
            slow.for_each(|package| base += &format!(" --exclude {}", package.name));
        }
        return base;
    }
    let below = |path: &&str| {
        let folder = workspace().join(path);
        packages.iter().filter(move |package| package.folder().starts_with(&folder))
    };
    if part.paths.iter().all(|path| below(path).next().is_some()) {
        let chosen = part.paths.iter().flat_map(below);
        let chosen: String = chosen.map(|package| format!(" --package {}", package.name)).collect();
        base = ALL.replace(" --workspace", &chosen);
    }
    base
}

/// The programs that the package's manifest calls slow, each with its reason.
fn slow_programs(package: &Package) -> Vec<String> {
    let name = |program: &String| match program.as_str() {
        WHOLE => package.name.clone(),
        _ => format!("{}, {program}", package.name),
    };
    let slow = &package.tests().slow;
    slow.iter().map(|(program, reason)| format!("{}: {reason}", name(program))).collect()
}

/// Removes the programs whose need this machine lacks; their names and needs are left out.
///
/// # Errors
/// A manifest names a need that does not exist.
fn leave_out_what_lacks(
    jobs: &mut Vec<Job>,
    packages: &[Package],
    left_out: &mut Vec<String>,
) -> Result<(), String> {
    for package in packages {
        for (program, need) in &package.tests().needs {
            let Some(missing) = setup::missing(need)? else { continue };
            let targets = package.targets.iter();
            let wanted = targets.filter(|target| program == WHOLE || *program == target.name);
            let sources: Vec<_> = wanted.map(|target| shown(&target.src_path)).collect();
            let (without, with): (Vec<Job>, Vec<Job>) =
                jobs.drain(..).partition(|job| sources.contains(&job.name));
            left_out.extend(without.iter().map(|job| format!("{}: needs {missing}", job.name)));
            *jobs = with;
        }
    }
    Ok(())
}

/// The path of a source file in the workspace.
fn shown(source: &Path) -> String {
    source.strip_prefix(workspace()).unwrap_or(source).display().to_string()
}

/// Builds the test programs of `path` in another tree, and returns their jobs. For tests in Python,
/// builds the package.
///
/// # Errors
/// They do not compile, or do not exist.
pub(crate) fn programs(tree: &Tree, path: &str) -> Result<Vec<Job>, String> {
    if path.ends_with(".py") {
        return Ok(vec![python::of_tree(&tree.root, &tree.target.join("python"), path)?]);
    }
    let mut build = cargo(ALL);
    build.current_dir(&tree.root).env("CARGO_TARGET_DIR", &tree.target);
    build.arg("--no-run").args(selection(&[path], &packages::all()?)?);
    let messages = command::quiet_output(build.arg(MESSAGES))?;
    let mut jobs = jobs_of(&messages, &tree.root, Extent::All, &[path]);
    jobs.iter_mut().for_each(|job| prepare(&mut job.command, ALL));
    Ok(jobs)
}

/// The jobs of a build, from cargo's messages about it in the tree at `root`.
fn jobs_of(messages: &str, root: &Path, extent: Extent, paths: &[&str]) -> Vec<Job> {
    let programs = messages.lines().filter_map(|line| serde_json::from_str(line).ok());
    programs.filter_map(|program| job(program, root, extent, paths)).collect()
}

/// The arguments of cargo that select the targets below these paths.
fn selection(paths: &[&str], packages: &[Package]) -> Result<Vec<String>, String> {
    let mut chosen = Vec::new();
    for path in paths {
        let targets = packages.iter().flat_map(|package| &package.targets);
        let prefix = workspace().join(path);
        let before = chosen.len();
        chosen.extend(targets.filter(|target| target.test && target.src_path.starts_with(&prefix)));
        if chosen.len() == before {
            return Err(format!(
                "there are no tests in `{path}`; try `tess-core` or `tess-core/tests/golden.rs`"
            ));
        }
    }
    Ok(arguments(chosen.into_iter()))
}

/// The arguments of cargo that select the programs of [`Extent::Comparisons`]. Tests inside a
/// library are left out: each compiles its whole crate once more, an eighth of a fresh build, and
/// the programs in `tests` compare the same code from outside.
fn comparisons(packages: &[Package]) -> Vec<String> {
    let chosen = packages.iter().flat_map(|package| {
        let slow = &package.tests().slow;
        let is_whole = slow.contains_key(WHOLE);
        let targets = package.targets.iter().filter(|target| target.test && !target.is_library());
        targets.filter(move |target| !is_whole && !slow.contains_key(&target.name))
    });
    arguments(chosen)
}

/// The arguments of cargo that select these targets. Cargo accepts `--lib` only once.
fn arguments<'a>(targets: impl Iterator<Item = &'a Target>) -> Vec<String> {
    let selections: BTreeSet<_> = targets.map(Target::selection).collect();
    selections.into_iter().flatten().collect()
}

/// The job of a program, if it is to run.
fn job(program: TestProgram, root: &Path, extent: Extent, paths: &[&str]) -> Option<Job> {
    let TestProgram { manifest_path, target, profile, executable } = program;
    let source = target.src_path.strip_prefix(root).unwrap_or(&target.src_path);
    let is_chosen = paths.is_empty() || paths.iter().any(|path| source.starts_with(path));
    let mut command = Command::new(executable.filter(|_| profile.test && is_chosen)?);
    if extent == Extent::All {
        command.args(["--include-ignored", "--skip", ON_REQUEST]);
    }
    let folder = manifest_path.parent().unwrap_or(&manifest_path);
    // The environment in which cargo runs tests.
    command.current_dir(folder).env("CARGO_MANIFEST_DIR", folder);
    command.env("CARGO", cargo("").get_program());
    Some(Job { name: source.display().to_string(), command })
}

/// Sets the environment variables that the tests of a build with these arguments rely on.
fn prepare(tests: &mut Command, base: &str) {
    // With CI set, a test fails if its tool is missing; otherwise it is reported as ignored.
    if setup::installs() {
        tests.env("CI", "1");
    }
    // The libraries of the C interface are those of this build, which includes this program.
    if base.contains("--workspace") {
        tests.env("TESS_CAPI_BUILD", format!("{base} --test foreign"));
    }
    tests.env(levels::VARIABLE, levels::required().join(","));
    // Shaders get no debug information, which saves the driver a tenth of its compile time.
    tests.env("WGPU_DEBUG", "0");
    // Without this variable, drivers complain on the standard error each time a device is opened.
    if std::env::var_os("XDG_RUNTIME_DIR").is_none() {
        tests.env("XDG_RUNTIME_DIR", std::env::temp_dir());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all() -> Vec<Package> {
        packages::all().expect("packages")
    }

    #[test]
    fn manifests_name_programs_and_needs_that_exist() {
        for package in all() {
            let is_program = |name: &str| {
                name == WHOLE || package.targets.iter().any(|it| it.test && it.name == *name)
            };
            let tests = package.tests();
            for name in tests.slow.keys().chain(tests.needs.keys()) {
                assert!(is_program(name), "{}: `{name}` is not a test program", package.name);
            }
            for need in tests.needs.values() {
                assert!(setup::missing(need).is_ok(), "{}: need `{need}`", package.name);
            }
        }
    }

    #[test]
    fn slow_programs_are_left_out_of_the_comparisons() {
        let package = |slow: &str| {
            let target = |name| {
                format!(r#"{{"kind":["test"],"name":"{name}","src_path":"{name}.rs","test":true}}"#)
            };
            let text = format!(
                r#"{{"name":"p","version":"1.0.0","manifest_path":"p/Cargo.toml","publish":null,
                "targets":[{},{}],"metadata":{{"tests":{{"slow":{{{slow}}}}}}}}}"#,
                target("quick"),
                target("long")
            );
            vec![serde_json::from_str::<Package>(&text).expect("a package")]
        };
        let one = package(r#""long":"all of them""#);
        assert_eq!(comparisons(&one), ["--test", "quick"], "one of two");
        assert_eq!(slow_programs(&one[0]), ["p, long: all of them"], "and it is named");
        let whole = package(r#""*":"a page""#);
        assert!(comparisons(&whole).is_empty(), "the whole package");
        let base = base(Extent::Comparisons, &TestSelection::default(), &whole);
        assert!(base.ends_with(" --exclude p"), "{base}");
        assert_eq!(slow_programs(&whole[0]), ["p: a page"], "and it is named");
    }

    #[test]
    fn parts_are_selected_by_their_targets() {
        let paths = ["tess-core/tests/golden.rs", "tess-surface/src", "tess-core/src"];
        let selected = selection(&paths, &all()).expect("some");
        assert_eq!(selected, ["--lib", "--test", "golden"], "targets, each once");
        assert!(selection(&["tess-core/nope"], &all()).is_err(), "no such test");
    }

    #[test]
    fn a_folder_is_its_package_and_words_are_no_paths() {
        let base = |arguments: &[&str]| base(Extent::All, &TestSelection::of(arguments), &all());
        let core = "test --package tess-core --all-features --no-fail-fast";
        assert_eq!(base(&["tess-core"]), core, "one package");
        assert_eq!(base(&["tess-core", "golden"]), core, "a word that is a folder too");
        assert_eq!(base(&["tess-core", "tess-core/tests/golden.rs"]), ALL, "a file");
        assert!(base(&["bindings"]).contains(" --package tess-capi "), "a folder of packages");
        let part = TestSelection::of(&["tess-core", "tess-core/src", "ring", "tess-gpu"]);
        assert_eq!(part.paths, ["tess-core", "tess-core/src", "tess-gpu"], "paths");
        assert_eq!(part.words, ["ring"], "words");
        assert_eq!(TestSelection::of(&["nope"]).paths, ["nope"], "the first is a path");
    }
}
