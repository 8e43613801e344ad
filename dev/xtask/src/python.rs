//! The Python package: its wheel, and tests of the wheel in a fresh virtual environment.

use crate::command::{self, cargo, in_file, workspace};
use crate::setup::{self, ICARUS, PYTHON};
use crate::tally::{self, Job};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The packages of the virtual environment besides the wheel; the wheel's extras name the rest.
const TOOLS: &[&str] = &["maturin>=1.9,<2"];

/// Checks and tests the package; the last line printed is the tally.
///
/// # Errors
/// A lint, a type check or a test fails, or a package of the environment is not available.
pub(crate) fn run() -> Result<(), String> {
    run_with(&command::program()?)
}

/// Does what [`run`] does, with this program `tess` for comparisons.
///
/// # Errors
/// As for [`run`].
pub(crate) fn run_with(program: &Path) -> Result<(), String> {
    tally::run([tests(program)?])
}

/// Prepares everything, and returns the command that runs the tests, which compare with this
/// program `tess`.
fn tests(program: &Path) -> Result<Command, String> {
    setup::provide(&[PYTHON, ICARUS])?;
    command::lock_versions(&workspace(), "bindings/python")?;
    lint()?;
    let environment = Environment::fresh()?;
    environment.install(TOOLS)?;
    let wheel = environment.wheel()?;
    environment.install(&[&format!("{}[test,cocotb]", wheel.display())])?;
    environment.check_types()?;
    let mut tests = environment.python("pytest -q -p no:cacheprovider");
    tests.env("TESS_PROGRAM", program).env("TESS_COCOTB_BUILD", target().join("cocotb"));
    Ok(tests)
}

/// Builds the wheel, with this bill of materials, and the source archive of a release with this
/// time stamp, and passes each to `take`. The wheel's name contains the oldest glibc that it runs
/// with, as determined by maturin.
///
/// # Errors
/// A build or `take` fails.
pub(crate) fn release(
    epoch: &str,
    bill: &Path,
    take: impl Fn(&Path) -> Result<(), String>,
) -> Result<(), String> {
    setup::provide(&[PYTHON])?;
    command::lock_versions(&workspace(), "bindings/python")?;
    let environment = Environment::fresh()?;
    environment.install(TOOLS)?;
    let flags = command::flags_without_folders("-Cdebuginfo=0")?;
    for what in ["build", "sdist"] {
        let mut maturin = environment.python(&format!("maturin {what}"));
        if what == "build" {
            maturin.args(["--release", "--sbom-include"]).arg(bill);
        }
        maturin.env("SOURCE_DATE_EPOCH", epoch).env("CARGO_ENCODED_RUSTFLAGS", &flags);
        take(&Environment::build(&mut maturin)?)?;
    }
    Ok(())
}

/// The imports of those tests that detect planted faults.
const FOR_FAULTS: &[&str] = &["numpy>=1.21", "hypothesis>=6", "pytest>=7"];

/// Builds the package of the tree at `root` with `cargo build`, which takes less time than a wheel,
/// and returns the command that runs the tests in `file` on it. All products go to `target`.
///
/// # Errors
/// It does not compile, or a package of the environment is not available.
pub(crate) fn of_tree(root: &Path, target: &Path, file: &str) -> Result<Job, String> {
    let environment = Environment(target.join("venv"));
    if !environment.0.exists() {
        setup::provide(&[PYTHON])?;
        command::run(command::python().args(["-m", "venv"]).arg(&environment.0))?;
        environment.install(FOR_FAULTS)?;
    }
    let sources = root.join("bindings/python");
    command::lock_versions(root, "bindings/python")?;
    let mut build = cargo("build");
    command::quiet_output(build.current_dir(&sources).env("CARGO_TARGET_DIR", target))?;
    let built = target.join("package/tess_model");
    fs::create_dir_all(&built).map_err(|error| in_file(&built, &error))?;
    let own = sources.join("python/tess_model");
    command::quiet_output(Command::new("cp").arg("-rL").args([own.join("."), built.clone()]))?;
    copy(&target.join("debug/libtess_native.so"), &built.join("_native.abi3.so"))?;
    let mut tests = environment.python("pytest -q -x -p no:cacheprovider");
    tests.arg(root.join(file)).current_dir(&sources).env("PYTHONPATH", target.join("package"));
    Ok(Job { name: file.to_owned(), command: tests })
}

fn copy(from: &Path, to: &Path) -> Result<(), String> {
    fs::copy(from, to).map(drop).map_err(|error| in_file(from, &error))
}

/// The folder of the package.
fn package() -> PathBuf {
    workspace().join("bindings/python")
}

/// The folder of its builds.
fn target() -> PathBuf {
    package().join("target")
}

/// Lints the package, which is a separate workspace that the main workspace's lints do not cover.
fn lint() -> Result<(), String> {
    let manifest = ["--manifest-path", "bindings/python/Cargo.toml"];
    command::run(cargo("fmt --check").args(manifest))?;
    command::run(cargo("clippy --all-targets").args(manifest).args(["--", "-D", "warnings"]))
}

/// A virtual environment.
struct Environment(PathBuf);

impl Environment {
    /// An environment without anything from an earlier run.
    fn fresh() -> Result<Self, String> {
        let folder = target().join("venv");
        command::run(command::python().args(["-m", "venv", "--clear"]).arg(&folder))?;
        Ok(Self(folder))
    }

    /// The command that runs a module with these arguments, split at spaces, in the folder of the
    /// package.
    fn python(&self, words: &str) -> Command {
        let folder = if cfg!(windows) { "Scripts" } else { "bin" };
        let mut python = Command::new(self.0.join(folder).join("python"));
        python.arg("-m").args(words.split(' ')).current_dir(package()).env_remove("PYTHONPATH");
        python
    }

    /// Installs packages from pip's configured index.
    fn install(&self, packages: &[&str]) -> Result<(), String> {
        let mut pip = self.python("pip install --quiet --disable-pip-version-check");
        command::run(pip.args(packages)).map_err(|error| {
            format!("{error}. The tests of the Python package need {}", packages.join(", "))
        })
    }

    /// Builds the wheel.
    fn wheel(&self) -> Result<PathBuf, String> {
        Self::build(&mut self.python("maturin build --release"))
    }

    /// Runs a build by maturin, whose product is the only file in its folder.
    fn build(maturin: &mut Command) -> Result<PathBuf, String> {
        let folder = target().join("wheels");
        if folder.exists() {
            fs::remove_dir_all(&folder).map_err(|error| in_file(&folder, &error))?;
        }
        command::run(maturin.arg("--out").arg(&folder))?;
        let entries = fs::read_dir(&folder).map_err(|error| in_file(&folder, &error))?;
        let files: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
        match &files[..] {
            [file] => Ok(file.clone()),
            others => Err(format!("maturin built {} files, not one", others.len())),
        }
    }

    /// Checks that the stubs match the module, and that the tests and examples match the stubs.
    fn check_types(&self) -> Result<(), String> {
        command::run(
            &mut self.python("mypy.stubtest --mypy-config-file pyproject.toml tess_model"),
        )?;
        let typed = "mypy tests python/tess_model/examples benches ../../rtl/dv/cocotb";
        command::run(&mut self.python(typed))
    }
}
