//! The explorer: builds its page, serves it, and tests it in a browser.

use crate::command::{self, cargo, in_file, target, workspace};
use crate::setup::{self, NODE, Need, has_program};
use crate::tally;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const TARGET: &str = "wasm32-unknown-unknown";

/// The largest number of bytes that the page may load; compressed it is a third of that.
const LARGEST: u64 = 1_680_000;

/// The modules of `bindings/webgpu` that run the page's batches.
const HOST: [&str; 2] = ["batch.js", "common.js"];

/// The version of the library that drives the browser.
const PLAYWRIGHT: &str = "playwright-core@1.65.1";

/// What the browser tests need in addition to what the build installs.
const BROWSER: &[Need] = &[
    NODE,
    Need {
        what: "Chromium (tests of the explorer)",
        packages: &["chromium"],
        is_there: || has_program("chromium"),
    },
];

/// Builds the page.
///
/// # Errors
/// A step fails, or the page is too large to load quickly.
pub(crate) fn build() -> Result<(), String> {
    let page = page();
    if page.exists() {
        fs::remove_dir_all(&page).map_err(|error| in_file(&page, &error))?;
    }
    library("tess-explorer", &page)?;
    let host = HOST.map(|name| workspace().join("bindings/webgpu").join(name));
    for file in files(&source().join("web"))?.into_iter().chain(host) {
        let to = page.join(file.file_name().unwrap_or_default());
        fs::copy(&file, &to).map_err(|error| in_file(&file, &error))?;
    }
    let sizes = files(&page)?.into_iter().map(|file| fs::metadata(file).map_or(0, |m| m.len()));
    let bytes: u64 = sizes.sum();
    println!("{}: {bytes} bytes", page.display());
    if bytes > LARGEST {
        return Err(format!("the page has {bytes} bytes; it may have {LARGEST}"));
    }
    Ok(())
}

/// Builds a package for WebAssembly, and writes it with its JavaScript module into a folder.
///
/// # Errors
/// A step fails.
pub(crate) fn library(package: &str, folder: &Path) -> Result<(), String> {
    setup::target(TARGET)?;
    command::run(cargo("fetch --locked --target").arg(TARGET))?;
    let mut library = cargo("build --profile wasm --package");
    library.arg(package).arg("--target").arg(TARGET);
    // Every browser with WebGPU has SIMD, and so has every other one since 2023.
    let flags = command::flags_without_folders("-Ctarget-feature=+simd128")?;
    command::run(library.env("CARGO_ENCODED_RUSTFLAGS", flags))?;
    bind(&format!("wasm/{}.wasm", package.replace('-', "_")), folder)
}

/// Writes the JavaScript module for a WebAssembly file of the target folder.
fn bind(file: &str, folder: &Path) -> Result<(), String> {
    command::lock_versions(&workspace(), "tools/explorer/bindgen")?;
    let mut bindgen = cargo("run --quiet --manifest-path");
    bindgen.arg(source().join("bindgen/Cargo.toml"));
    bindgen.arg("--target-dir").arg(target().join("explorer-bindgen")).arg("--");
    command::run(bindgen.arg(target().join(TARGET).join(file)).arg(folder))
}

/// Builds the page, and serves it until the command is stopped.
///
/// # Errors
/// As for [`build`], or port 8370 is in use.
pub(crate) fn serve() -> Result<(), String> {
    build()?;
    // The address is always the same, so that links stay valid.
    let mut server = command::python();
    server.args(["-m", "http.server", "--bind", "127.0.0.1", "8370", "--directory"]);
    command::run(server.arg(page()))
}

/// Builds the page and tests it in Chromium; the last line printed is the tally.
///
/// # Errors
/// A test fails, or something cannot be installed.
pub(crate) fn test() -> Result<(), String> {
    test_with(&program()?)
}

/// Does what [`test()`] does, with this program `tess` for comparisons.
///
/// # Errors
/// As for [`test()`].
pub(crate) fn test_with(program: &Path) -> Result<(), String> {
    tally::run([tests(program)?])
}

/// Prepares everything, and returns the command that runs the tests, which compare with this
/// program `tess`.
///
/// # Errors
/// As for [`test()`], except for failing tests.
fn tests(program: &Path) -> Result<Command, String> {
    let mut format = cargo("fmt --check --manifest-path");
    command::run(format.arg(source().join("bindgen/Cargo.toml")))?;
    build()?;
    let modules = modules()?;
    let stage = stage(&modules)?;
    let mut node = Command::new("node");
    node.arg(source().join("tests/run.mjs")).current_dir(workspace());
    node.env("EXPLORER", page()).env("TESS_PROGRAM", program).env("EXPLORER_STAGE", stage);
    node.env("EXPLORER_MODULES", &modules).env("EXPLORER_SCREENSHOTS", modules.join("screenshots"));
    Ok(node)
}

/// Provides a browser, and returns the folder with the library that drives it.
///
/// # Errors
/// One of them cannot be installed.
pub(crate) fn modules() -> Result<PathBuf, String> {
    setup::provide(BROWSER)?;
    let modules = target().join("explorer-test");
    fs::create_dir_all(&modules).map_err(|error| in_file(&modules, &error))?;
    if !modules.join("node_modules/playwright-core").exists() {
        command::run(npm(&modules).arg(PLAYWRIGHT))?;
    }
    Ok(modules)
}

/// `npm install` into a folder, without a package description.
pub(crate) fn npm(folder: &Path) -> Command {
    let mut npm = Command::new("npm");
    npm.args(["install", "--no-save", "--no-package-lock", "--no-audit", "--no-fund"]);
    npm.current_dir(folder);
    npm
}

/// Builds the tessellation stage for the browser tests, which is not a part of the page; returns
/// its folder.
fn stage(folder: &Path) -> Result<PathBuf, String> {
    command::run(cargo("build --package tess-explorer-stage --target").arg(TARGET))?;
    let stage = folder.join("stage");
    bind("debug/tess_explorer_stage.wasm", &stage)?;
    Ok(stage)
}

/// The program `tess` for comparisons of files and texts: that of `TESS_PROGRAM`, or a new build.
///
/// # Errors
/// It does not compile.
pub(crate) fn program() -> Result<PathBuf, String> {
    std::env::var_os("TESS_PROGRAM").map_or_else(command::program, |program| Ok(program.into()))
}

fn source() -> PathBuf {
    workspace().join("tools/explorer")
}

/// The folder of the finished page.
fn page() -> PathBuf {
    target().join("explorer")
}

fn files(folder: &Path) -> Result<Vec<PathBuf>, String> {
    let entries = fs::read_dir(folder).map_err(|error| in_file(folder, &error))?;
    Ok(entries.filter_map(|entry| Some(entry.ok()?.path())).filter(|path| path.is_file()).collect())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The page is plain text of moderate length, and requests nothing from other servers.
    #[test]
    fn the_page_is_plain_and_complete() {
        for file in files(&workspace().join("tools/explorer/web")).expect("files") {
            let text = fs::read_to_string(&file).expect("text");
            let shown = file.display();
            assert!(text.lines().all(|line| line.len() < 300), "{shown}: minified");
            assert!(!text.contains("http://") && !text.contains("https://"), "{shown}: a link");
        }
    }
}
