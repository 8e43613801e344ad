//! The explorer: builds its page, serves it, tests it in a browser.

use crate::command::{self, cargo, in_file, target, workspace};
use crate::setup::{self, Need, has_program};
use crate::tally;
use std::fs;
use std::io::{BufRead, BufReader, Write};
use std::net::{TcpListener, TcpStream};
use std::path::{Path, PathBuf};
use std::process::Command;

const TARGET: &str = "wasm32-unknown-unknown";

/// The most bytes that the page may load.
const LARGEST: u64 = 1_550_000;

/// The version of the library that drives the browser.
const PLAYWRIGHT: &str = "playwright-core@1.65.1";

/// Needs of the browser tests beyond what the build installs.
const BROWSER: &[Need] = &[
    Need {
        what: "Node.js with npm (drives the browser)",
        packages: &["nodejs", "npm"],
        is_there: || has_program("node") && has_program("npm"),
    },
    Need {
        what: "Chromium (tests of the explorer)",
        packages: &["chromium"],
        is_there: || has_program("chromium"),
    },
];

/// Builds the page.
///
/// # Errors
/// A step that fails, or a page that is too large to load quickly.
pub(crate) fn build() -> Result<(), String> {
    setup::target(TARGET)?;
    let mut library = cargo("build --package tess-explorer --profile wasm --target");
    command::run(cargo("fetch --locked --target").arg(TARGET))?;
    // Every browser with WebGPU has SIMD, and so has every other one since 2023.
    let flags = command::flags_without_folders("-Ctarget-feature=+simd128")?;
    command::run(library.arg(TARGET).env("CARGO_ENCODED_RUSTFLAGS", flags))?;
    let page = page();
    if page.exists() {
        fs::remove_dir_all(&page).map_err(|error| in_file(&page, &error))?;
    }
    bind("wasm/tess_explorer.wasm", &page)?;
    for file in files(&source().join("web"))? {
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

/// Writes the JavaScript module of a WebAssembly file of the target folder.
fn bind(file: &str, folder: &Path) -> Result<(), String> {
    command::lock_versions(&workspace(), "tools/explorer/bindgen")?;
    let mut bindgen = cargo("run --quiet --manifest-path");
    bindgen.arg(source().join("bindgen/Cargo.toml"));
    bindgen.arg("--target-dir").arg(target().join("explorer-bindgen")).arg("--");
    command::run(bindgen.arg(target().join(TARGET).join(file)).arg(folder))
}

/// Builds the page and serves it until the command is stopped.
///
/// # Errors
/// As for [`build`]; no port is free.
pub(crate) fn serve() -> Result<(), String> {
    build()?;
    // The same address each time, if it is free, so that links stay valid.
    let listener =
        TcpListener::bind("127.0.0.1:8370").or_else(|_| TcpListener::bind("127.0.0.1:0"));
    let listener = listener.map_err(|error| format!("cannot serve: {error}"))?;
    println!("the explorer is at http://{}/", address(&listener)?);
    answer_all(&listener);
    Ok(())
}

/// Builds the page and tests it in Chromium; the last line printed is the tally.
///
/// # Errors
/// A test fails, or something cannot be installed.
pub(crate) fn test() -> Result<(), String> {
    tally::run([tests(&program()?)?])
}

/// The need that the tests lack and this system cannot install; `None` if they can run.
pub(crate) fn lacking() -> Option<String> {
    setup::provide(BROWSER).err()
}

/// Makes everything ready, and gives the command that runs the tests, which compare with this program `tess`.
///
/// # Errors
/// As for [`test()`], but for the tests.
pub(crate) fn tests(program: &Path) -> Result<Command, String> {
    let mut format = cargo("fmt --check --manifest-path");
    command::run(format.arg(source().join("bindgen/Cargo.toml")))?;
    build()?;
    let modules = modules()?;
    let stage = stage(&modules)?;
    let listener = TcpListener::bind("127.0.0.1:0").map_err(|error| error.to_string())?;
    let address = address(&listener)?;
    std::thread::spawn(move || answer_all(&listener));
    let mut node = Command::new("node");
    node.arg(source().join("tests/run.mjs")).current_dir(workspace());
    node.env("EXPLORER", format!("http://{address}/")).env("TESS_PROGRAM", program);
    node.env("EXPLORER_STAGE", stage);
    node.env("EXPLORER_MODULES", &modules).env("EXPLORER_SCREENSHOTS", modules.join("screenshots"));
    Ok(node)
}

/// Provides a browser, and gives the folder with the library that drives it.
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

/// `npm install` into a folder, without a description of a package.
pub(crate) fn npm(folder: &Path) -> Command {
    let mut npm = Command::new("npm");
    npm.args(["install", "--no-save", "--no-package-lock", "--no-audit", "--no-fund"]);
    npm.current_dir(folder);
    npm
}

/// Builds the tessellation stage for the browser tests, which is no part of the page; where it is.
fn stage(folder: &Path) -> Result<PathBuf, String> {
    command::run(cargo("build --package tess-explorer-stage --target").arg(TARGET))?;
    let stage = folder.join("stage");
    bind("debug/tess_explorer_stage.wasm", &stage)?;
    Ok(stage)
}

/// The program `tess` that files and texts are compared with: `TESS_PROGRAM`, or one that is built now.
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

fn address(listener: &TcpListener) -> Result<std::net::SocketAddr, String> {
    listener.local_addr().map_err(|error| error.to_string())
}

/// Serves the page to every connection, each on a thread of its own.
fn answer_all(listener: &TcpListener) {
    for stream in listener.incoming().flatten() {
        // A browser that leaves early is no fault of the server.
        std::thread::spawn(move || drop(answer(&stream)));
    }
}

/// Answers one request for a file of the page.
fn answer(mut stream: &TcpStream) -> std::io::Result<()> {
    let mut lines = BufReader::new(stream).lines();
    let request = lines.next().unwrap_or_else(|| Ok(String::new()))?;
    // A browser wants to have sent its whole request.
    while lines.next().transpose()?.is_some_and(|line| !line.is_empty()) {}
    let (status, kind, body) = response(&request, &page());
    let length = body.len();
    write!(
        stream,
        "HTTP/1.1 {status}\r\nContent-Type: {kind}\r\nContent-Length: {length}\r\n\
         Cache-Control: no-cache\r\nConnection: close\r\n\r\n"
    )?;
    stream.write_all(&body)
}

/// Status, type and contents for the first line of a request. Only names of files in `folder` itself exist.
fn response(request: &str, folder: &Path) -> (&'static str, &'static str, Vec<u8>) {
    let path = request.strip_prefix("GET /").and_then(|rest| rest.split([' ', '?']).next());
    let name = match path {
        Some("") => "index.html",
        Some(name) => name,
        None => return ("405 Method Not Allowed", "text/plain", b"only GET".to_vec()),
    };
    let is_plain = !name.contains(['/', '\\']) && !name.starts_with('.');
    let kind = match Path::new(name).extension().and_then(|extension| extension.to_str()) {
        Some("html") => "text/html; charset=utf-8",
        Some("css") => "text/css; charset=utf-8",
        Some("js") => "text/javascript; charset=utf-8",
        Some("wasm") => "application/wasm",
        _ => "application/octet-stream",
    };
    match fs::read(folder.join(name)) {
        Ok(body) if is_plain => ("200 OK", kind, body),
        _ => ("404 Not Found", "text/plain", b"no such file".to_vec()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_files_of_the_folder_are_served() {
        let folder = workspace().join("tools/explorer/web");
        let get = |path: &str| response(&format!("GET {path} HTTP/1.1"), &folder);
        assert_eq!(get("/").0, "200 OK", "the page");
        assert_eq!(get("/?x#y").2, get("/index.html").2, "the page, by name");
        assert_eq!(get("/style.css").1, "text/css; charset=utf-8", "types");
        for path in ["/../Cargo.toml", "/..\\Cargo.toml", "/none.js", "/.hidden", "//etc/passwd"] {
            assert_eq!(get(path).0, "404 Not Found", "{path}");
        }
        assert_eq!(response("POST / HTTP/1.1", &folder).0, "405 Method Not Allowed", "methods");
    }

    /// The page stays plain text of moderate length, and asks no other server for anything.
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
