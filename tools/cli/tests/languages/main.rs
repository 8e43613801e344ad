//! Tests of the files of `tess shaders` with compilers that are not naga, and with the host in C of
//! `bindings/vulkan`, whose output must be the model's.
//!
//! Where a tool is missing, its tests are reported as ignored, with the tool's name; with the
//! environment variable `CI` set they fail.

mod batches;
mod compilers;
mod host;
mod metal;

use libtest_mimic::{Arguments, Failed, Trial};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::OnceLock;

type Test = fn() -> Result<(), Failed>;

const TESTS: &[(&str, &[&str], Test)] = &[
    ("spirv_is_valid", &["spirv-val"], compilers::spirv_is_valid),
    ("sdl_is_valid", &["spirv-val"], compilers::sdl_is_valid),
    ("glsl_compiles", &["spirv-val", "glslangValidator"], compilers::glsl_compiles),
    ("hlsl_compiles", &["spirv-val", "glslangValidator"], compilers::hlsl_compiles),
    ("sdl_hlsl_compiles", &["spirv-val", "glslangValidator"], compilers::sdl_hlsl_compiles),
    ("invalid_shaders_are_refused", &["spirv-val", "glslangValidator"], compilers::faults_are_seen),
    ("metal_compiles_as_cpp", &["c++"], metal::compiles),
    ("sdl_metal_compiles_as_cpp", &["c++"], metal::sdl_compiles),
    ("invalid_metal_is_refused", &["c++"], metal::faults_are_seen),
    ("host_equals_the_model", &["cc"], host::spirv_equals_the_model),
    ("glsl_equals_the_model", &["cc", "glslangValidator"], host::glsl_equals_the_model),
    ("hlsl_equals_the_model", &["cc", "glslangValidator"], host::hlsl_equals_the_model),
    ("unchecked_equals_the_model", &["cc"], host::unchecked_equals_the_model),
    ("host_faults_are_seen", &["cc"], host::faults_are_seen),
    ("host_refuses_bad_usage", &["cc"], host::bad_usage_is_refused),
];

fn main() {
    let in_ci = std::env::var_os("CI").is_some();
    let trials = TESTS.iter().map(|&(name, needed, test)| {
        let missing: Vec<&str> = needed.iter().copied().filter(|tool| !has(tool)).collect();
        if missing.is_empty() {
            return Trial::test(name, test);
        }
        let missing = format!("not run, missing: {}", missing.join(" "));
        let failing = missing.clone();
        Trial::test(name, move || Err(failing.into())).with_kind(missing).with_ignored_flag(!in_ci)
    });
    let conclusion = libtest_mimic::run(&Arguments::from_args(), trials.collect());
    if let (Some(folder), false) = (FOLDERS.get(), conclusion.has_failed()) {
        _ = std::fs::remove_dir_all(folder);
    }
    conclusion.exit();
}

/// Whether a tool can be run.
fn has(tool: &str) -> bool {
    let mut command = Command::new(tool);
    command.arg("--version").stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

/// Runs a command that must succeed; returns its standard output.
fn run(command: &mut Command) -> Result<String, String> {
    let output = command.output().map_err(|error| format!("cannot run {command:?}: {error}"))?;
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    if output.status.success() {
        Ok(out)
    } else {
        Err(format!("{command:?} ended with {}\n{out}\n{err}", output.status))
    }
}

static FOLDERS: OnceLock<PathBuf> = OnceLock::new();

/// The folder of this process, in which every test has its own folders. Another process may run the
/// same tests.
fn folders() -> &'static Path {
    FOLDERS.get_or_init(|| {
        let made =
            tempfile::Builder::new().prefix("shaders-").tempdir_in(env!("CARGO_TARGET_TMPDIR"));
        made.expect("a folder").keep()
    })
}

/// Writes the shaders for these options into a new folder of this name.
fn shaders(name: &str, options: &str) -> Result<PathBuf, String> {
    let folder = folders().join(name);
    let mut command = Command::new(env!("CARGO_BIN_EXE_tess"));
    command.arg("shaders").args(options.split_whitespace()).arg("-o").arg(&folder);
    run(&mut command)?;
    Ok(folder)
}

/// The names of the files in a folder that have this ending, without the ending; there must be
/// some.
fn stages(folder: &Path, ending: &str) -> Result<Vec<String>, String> {
    let entries = std::fs::read_dir(folder).map_err(|error| error.to_string())?;
    let names = entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok());
    let mut stages: Vec<_> =
        names.filter_map(|name| name.strip_suffix(ending).map(str::to_owned)).collect();
    stages.sort();
    if stages.is_empty() { Err(format!("no {ending} in {}", folder.display())) } else { Ok(stages) }
}

/// Options for one configuration of each domain. Together they have every form of shader.
const SETUPS: [&str; 4] = [
    "--domain tri --partitioning fractional_odd --output triangle_cw",
    "--domain quad --partitioning integer --output triangle_ccw --split center --points f32",
    "--domain isoline --partitioning fractional_even --output line --index-type u16 --numbering per-patch",
    "--domain quad --partitioning pow2 --output point --numbering per-patch",
];
