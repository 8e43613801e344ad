//! Finding tools, running them, and building the library that they link.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::sync::OnceLock;

/// The folder of this crate.
pub(crate) fn crate_folder() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// A folder for what the tests build. One process has it at a time: another that runs the same
/// tests waits.
pub(crate) fn build_folder() -> &'static Path {
    static LOCK: OnceLock<File> = OnceLock::new();
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    LOCK.get_or_init(|| {
        let file = File::create(folder.join("foreign.lock")).expect("the folder can be written");
        file.lock().expect("files can be locked");
        file
    });
    folder
}

/// Whether a tool can be run.
pub(crate) fn has(tool: &str) -> bool {
    let mut command = Command::new(tool);
    command.arg("--version").stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

/// Runs a command to its end, whatever that is.
pub(crate) fn output(command: &mut Command) -> Result<Output, String> {
    command.output().map_err(|error| format!("cannot run {command:?}: {error}"))
}

/// Runs a command that must succeed; gives its standard output.
pub(crate) fn run(command: &mut Command) -> Result<String, String> {
    let output = output(command)?;
    let (out, err) = (text(&output.stdout), text(&output.stderr));
    if output.status.success() {
        Ok(out)
    } else {
        Err(format!("{command:?} ended with {}\n{out}\n{err}", output.status))
    }
}

pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// The libraries that this crate's sources make now.
#[derive(Clone)]
pub(crate) struct Libraries {
    pub(crate) archive: PathBuf,
    pub(crate) shared: PathBuf,
}

/// Builds the libraries, once.
pub(crate) fn libraries() -> Result<Libraries, String> {
    static BUILT: OnceLock<Result<Libraries, String>> = OnceLock::new();
    BUILT.get_or_init(build).clone()
}

fn build() -> Result<Libraries, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    // A larger build that the tests are part of has the libraries already.
    match std::env::var("TESS_CAPI_BUILD") {
        Ok(build) => command.args(build.split_whitespace()).arg("--no-run"),
        Err(_) => command.args(["build", "-p", "tess-capi", "--lib"]),
    };
    command.arg("--message-format=json");
    let messages = run(command.current_dir(crate_folder()))?;
    let files: Vec<PathBuf> = messages.lines().filter_map(artifacts).flatten().collect();
    let with = |extension: &str| {
        let found = files.iter().find(|file| file.extension().is_some_and(|e| e == extension));
        found.cloned().ok_or_else(|| format!("cargo built no .{extension}: {files:?}"))
    };
    Ok(Libraries { archive: with("a")?, shared: with(std::env::consts::DLL_EXTENSION)? })
}

/// The files of this crate that one of cargo's messages speaks of.
fn artifacts(line: &str) -> Option<Vec<PathBuf>> {
    let message: serde_json::Value = serde_json::from_str(line).ok()?;
    let ours = message["reason"] == "compiler-artifact" && message["target"]["name"] == "tess_capi";
    let files = message["filenames"].as_array().filter(|_| ours)?;
    Some(files.iter().filter_map(|file| file.as_str().map(PathBuf::from)).collect())
}
