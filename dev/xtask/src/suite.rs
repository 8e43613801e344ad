//! The test programs of the workspace, all built with one set of features.
//!
//! Cargo gives dependencies the union of the features that the selected packages request. A test
//! file is therefore selected as a target of the whole workspace, so that no dependency is compiled
//! again. The folder of a package selects only that package: its dependencies may be compiled once
//! more, but never the tests of other packages.

use crate::command::{self, cargo, workspace};
use crate::levels;
use crate::packages::{self, Target};
use crate::python;
use crate::tally::Job;
use serde::Deserialize;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The arguments of `cargo` for the tests of the workspace.
const ALL: &str = "test --workspace --all-features --no-fail-fast";

/// The packages that are not part of [`Extent::Comparisons`] and have many dependencies that
/// nothing else needs.
const APART: &[&str] = &["tess-explorer", "tess-explorer-stage", "tess-benches"];

/// Makes cargo list its build products on its standard output.
const MESSAGES: &str = "--message-format=json-render-diagnostics";

/// The programs that take longest. They start first, so that the last ones to start end soon.
const LONG: &[&str] = &[
    "tools/cli/tests/program/main.rs",
    "tess-wgpu/tests/batches/main.rs",
    "tess-wgpu/tests/stage/main.rs",
    "tess-wgpu/tests/sequences/main.rs",
    "tess-gpu/tests/twins/main.rs",
    "tools/cli/tests/shaders/main.rs",
    "tess-gpu/tests/shaders.rs",
    "tess-verify/tests/golden.rs",
    "tools/cli/src/lib.rs",
    "tess-core/tests/no_std.rs",
    "bindings/c/tests/foreign.rs",
];

/// Tests that only [`Extent::All`] runs, by program; an empty list stands for all of its tests.
struct Beyond {
    program: &'static str,
    /// Prefixes of test names.
    tests: &'static [&'static str],
}

const BEYOND: &[Beyond] = &[
    // These tests need OpenGL or a simulator.
    Beyond { program: "tess-wgpu/tests/gl/main.rs", tests: &[] },
    Beyond { program: "bindings/c/tests/foreign.rs", tests: &["rtl_", "uvm_"] },
    // They are slow. The comparisons that stay reach the same code with fewer patches, with shorter
    // sequences of frames, or in one language.
    Beyond {
        program: "tools/cli/tests/program/main.rs",
        tests: &[
            "backends::gpu_equals_recorded",
            "backends::gpu_random_patches_are_equal",
            "backends::narrow_indices_equal_recorded_patches",
            "backends::simd_equals_every_recorded_result",
            "backends::simd_random_patches_are_equal",
            "crossed::backends_are_timed",
            "rules::backends_are_judged",
        ],
    },
    Beyond {
        program: "tess-wgpu/tests/stage/main.rs",
        tests: &[
            "evaluated::one_output_is_drawn_with_many_materials",
            "evaluated::project_is_called",
            "lost::",
            "porting::",
            "rising::",
            "room::a_frame_that_does_not_fit_is_coarser",
            "sequences::",
            "shared::no_frame_makes_a_pipeline",
        ],
    },
    Beyond {
        program: "tess-wgpu/tests/batches/main.rs",
        tests: &[
            "alike::",
            "catalogue::planted_faults",
            "cut::",
            "groups::planted_faults",
            "order::",
            "short::",
        ],
    },
    Beyond {
        program: "tess-wgpu/tests/sequences/main.rs",
        tests: &["options::every_two_options_together"],
    },
    Beyond { program: "tess-wgpu/tests/pictures/main.rs", tests: &[] },
    Beyond { program: "tess-gpu/tests/twins/main.rs", tests: &[] },
    Beyond { program: "tess-gpu/tests/shaders.rs", tests: &["every_shader_is_valid"] },
    Beyond { program: "tools/cli/tests/shaders/main.rs", tests: &[] },
    Beyond { program: "tools/probe/tests/bench.rs", tests: &[] },
    Beyond {
        program: "tess-verify/tests/rules/main.rs",
        tests: &["mistakes::mistakes_are_broken_or_allowed"],
    },
    Beyond {
        program: "tess-verify/tests/selections.rs",
        tests: &["level_1_of_any_selection", "level_1_sees_halves"],
    },
    Beyond { program: "dev/testkit/tests/faults.rs", tests: &["wrong_records"] },
];

/// The extent of a test run.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Extent {
    /// The model, the CPU, the GPU with Vulkan, surfaces, the kit, the program and C.
    Comparisons,
    /// In addition, tests that need OpenGL, a window or a simulator.
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

/// Builds the tests, and returns a job for each program, the longest first, and one for the
/// examples in the documentation. For a part, returns only programs whose sources are below one of
/// its paths, and no documentation.
///
/// # Errors
/// They do not compile, or a path has no tests.
pub(crate) fn jobs(extent: Extent, part: &TestSelection<'_>) -> Result<Vec<Job>, String> {
    let base = base(extent, part)?;
    let mut build = cargo(&base);
    println!("\n$ {}", command::shown(build.arg("--no-run")));
    let root = workspace();
    let selected = match (extent, &part.paths[..]) {
        // The examples are not built either; their sources are included in tests.
        (Extent::Comparisons, []) => comparisons()?,
        (_, paths) => selection(paths)?,
    };
    let messages = command::output(build.arg(MESSAGES).args(selected))?;
    let mut jobs = jobs_of(&messages, &root, extent, &part.paths);
    let place = |job: &Job| LONG.iter().position(|long| *long == job.name).unwrap_or(LONG.len());
    jobs.sort_by_key(place);
    if !part.words.is_empty() {
        jobs = jobs.iter().flat_map(|job| part.words.iter().map(|word| job.with(word))).collect();
    }
    if part.paths.is_empty() {
        let mut documentation = cargo(&base);
        documentation.arg("--doc");
        prepare(&mut documentation, &base);
        // This job compiles the examples, so it takes long.
        jobs.insert(1.min(jobs.len()), Job::new(documentation));
    }
    for job in &mut jobs {
        prepare(&mut job.command, &base);
    }
    Ok(jobs)
}

/// The arguments of `cargo` that select the packages. If all are selected, every dependency has the
/// same features; the folder of a package selects only that package.
fn base(extent: Extent, part: &TestSelection<'_>) -> Result<String, String> {
    let mut base = ALL.to_owned();
    if part.paths.is_empty() {
        if extent == Extent::Comparisons {
            APART.iter().for_each(|package| base += &format!(" --exclude {package}"));
        }
        return Ok(base);
    }
    let packages = packages::all()?;
    let below = |path: &&str| {
        let folder = workspace().join(path);
        packages.iter().filter(move |package| package.folder().starts_with(&folder))
    };
    if part.paths.iter().all(|path| below(path).next().is_some()) {
        let chosen = part.paths.iter().flat_map(below);
        let chosen: String = chosen.map(|package| format!(" --package {}", package.name)).collect();
        base = ALL.replace(" --workspace", &chosen);
    }
    Ok(base)
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
    build.arg("--no-run").args(selection(&[path])?);
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
fn selection(paths: &[&str]) -> Result<Vec<String>, String> {
    let mut chosen = Vec::new();
    let packages = packages::all()?;
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
    // Cargo accepts `--lib` only once.
    let selections: BTreeSet<_> = chosen.into_iter().map(Target::selection).collect();
    Ok(selections.into_iter().flatten().collect())
}

/// The arguments of cargo that select the programs of [`Extent::Comparisons`]. Tests inside a
/// library are left out: each compiles its whole crate once more, an eighth of a fresh build, and
/// the programs in `tests` compare the same code from outside.
fn comparisons() -> Result<Vec<String>, String> {
    let packages = packages::all()?;
    let chosen = packages.iter().filter(|package| !APART.contains(&package.name.as_str()));
    let targets = chosen.flat_map(|package| &package.targets);
    let targets = targets.filter(|target| target.test && !target.is_library());
    let wanted =
        targets.filter(|target| tests_beyond(&target.src_path).is_none_or(|t| !t.is_empty()));
    let selections: BTreeSet<_> = wanted.map(Target::selection).collect();
    Ok(selections.into_iter().flatten().collect())
}

/// The tests of a program that [`BEYOND`] leaves out; an empty list stands for all.
fn tests_beyond(source: &Path) -> Option<&'static [&'static str]> {
    BEYOND.iter().find(|beyond| source.ends_with(beyond.program)).map(|beyond| beyond.tests)
}

/// The job of a program, if it is to run.
fn job(program: TestProgram, root: &Path, extent: Extent, paths: &[&str]) -> Option<Job> {
    let TestProgram { manifest_path, target, profile, executable } = program;
    let source = target.src_path.strip_prefix(root).unwrap_or(&target.src_path);
    let is_chosen = paths.is_empty() || paths.iter().any(|path| source.starts_with(path));
    let mut command = Command::new(executable.filter(|_| profile.test && is_chosen)?);
    if extent == Extent::Comparisons
        && let Some(left_out) = tests_beyond(source)
    {
        if left_out.is_empty() {
            return None;
        }
        command.args(left_out.iter().flat_map(|name| ["--skip", name]));
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
    tests.env("CI", "1");
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
    use std::fs;

    #[test]
    fn listed_programs_exist() {
        for file in LONG.iter().chain(BEYOND.iter().map(|beyond| &beyond.program)) {
            assert!(workspace().join(file).is_file(), "{file} is listed here and is no test");
        }
        let packages = packages::all().expect("packages");
        let is_there = |name: &&str| packages.iter().any(|package| package.name == *name);
        assert!(APART.iter().all(is_there), "a package of {APART:?} has another name");
        for Beyond { program, tests } in BEYOND {
            for name in *tests {
                let (module, test) = name.split_once("::").unwrap_or(("", name));
                let beside = |name: String| workspace().join(program).with_file_name(name);
                let file = match module {
                    "" => workspace().join(program),
                    _ => beside(format!("{module}.rs")),
                };
                let file = if file.is_file() { file } else { beside(format!("{module}/mod.rs")) };
                let text = fs::read_to_string(file).expect("text");
                let is_there =
                    text.contains(&format!("fn {test}")) || text.contains(&format!("\"{test}"));
                assert!(is_there, "{program}: a test of {tests:?} has another name");
            }
        }
    }

    #[test]
    fn parts_are_selected_by_their_targets() {
        let paths = ["tess-core/tests/golden.rs", "tess-surface/src", "tess-core/src"];
        let selected = selection(&paths).expect("some");
        assert_eq!(selected, ["--lib", "--test", "golden"], "targets, each once");
        assert!(selection(&["tess-core/nope"]).is_err(), "no such test");
    }

    #[test]
    fn a_folder_is_its_package_and_words_are_no_paths() {
        let base = |arguments: &[&str]| {
            base(Extent::All, &TestSelection::of(arguments)).expect("packages")
        };
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
