//! Installs the C library as C programs expect one: headers, static and shared library, and a file for pkg-config.

use crate::command::{self, cargo, in_file, workspace};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// What a Rust static library needs from the system.
const SYSTEM_LIBRARIES: &str = "-lpthread -ldl -lm";

/// Has cargo list what it built on its standard output.
const MESSAGES: &str = "--message-format=json-render-diagnostics";

/// The version of the package, `MAJOR.MINOR.PATCH`: all packages of the workspace have one.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Builds the C library and installs it below `prefix`: `include/tess.h`, `lib/libtess.a`, `lib/libtess.so` and
/// `lib/pkgconfig/tess.pc`. What is there of these is replaced.
///
/// # Errors
/// The system has no ELF libraries, the build fails, or a file cannot be written.
pub(crate) fn run(prefix: &str) -> Result<(), String> {
    if !cfg!(target_os = "linux") {
        return Err("install: the shared library is laid out as Linux has them; elsewhere, take \
             libtess_capi from `cargo build --release -p tess-capi` and bindings/c/include/tess.h"
            .to_owned());
    }
    let prefix = std::path::absolute(prefix).map_err(|error| in_file(Path::new(prefix), &error))?;
    let mut release = cargo("rustc --release -p tess-capi --lib");
    release.arg(MESSAGES).arg("--").arg(format!("-Clink-arg=-Wl,-soname,{}", soname()));
    let built = build(&mut release)?;
    let files = Files::new(&prefix);
    files.install(&built)?;
    println!("\ninstalled in {}; compile with", prefix.display());
    println!(
        "  PKG_CONFIG_PATH={} cc program.c $(pkg-config --cflags --libs tess)",
        files.pkgconfig.display()
    );
    Ok(())
}

/// The name by which programs find the shared library: another one for each version that may break them.
fn soname() -> String {
    let numbers: Vec<&str> = VERSION.split('.').collect();
    match *numbers {
        ["0", minor, _] => format!("libtess.so.0.{minor}"),
        [major, ..] => format!("libtess.so.{major}"),
        [] => unreachable!("a version has numbers"),
    }
}

/// The libraries as cargo built them.
struct Built {
    archive: PathBuf,
    shared: PathBuf,
}

/// Runs a build that has the library in it, with [`MESSAGES`].
fn build(command: &mut Command) -> Result<Built, String> {
    println!("\n$ {}", command::shown(command));
    let messages = command::output(command)?;
    let files: Vec<PathBuf> = messages.lines().filter_map(artifacts).flatten().collect();
    let with = |extension: &str| {
        let found = files.iter().find(|file| file.extension().is_some_and(|e| e == extension));
        found.cloned().ok_or_else(|| format!("cargo built no .{extension}: {files:?}"))
    };
    Ok(Built { archive: with("a")?, shared: with("so")? })
}

/// The files of the library that one of cargo's messages speaks of.
fn artifacts(line: &str) -> Option<Vec<PathBuf>> {
    let message: serde_json::Value = serde_json::from_str(line).ok()?;
    let is_library =
        message["reason"] == "compiler-artifact" && message["target"]["name"] == "tess_capi";
    let files = message["filenames"].as_array().filter(|_| is_library)?;
    Some(files.iter().filter_map(|file| file.as_str().map(PathBuf::from)).collect())
}

/// Where the files go.
struct Files {
    prefix: PathBuf,
    include: PathBuf,
    lib: PathBuf,
    pkgconfig: PathBuf,
}

impl Files {
    fn new(prefix: &Path) -> Self {
        let lib = prefix.join("lib");
        Self {
            prefix: prefix.to_path_buf(),
            include: prefix.join("include"),
            pkgconfig: lib.join("pkgconfig"),
            lib,
        }
    }

    fn install(&self, built: &Built) -> Result<(), String> {
        for folder in [&self.include, &self.lib, &self.pkgconfig] {
            fs::create_dir_all(folder).map_err(|error| in_file(folder, &error))?;
        }
        let header = workspace().join("bindings/c/include/tess.h");
        replace(&header, &self.include.join("tess.h"))?;
        replace(&built.archive, &self.lib.join("libtess.a"))?;
        let full = format!("libtess.so.{VERSION}");
        replace(&built.shared, &self.lib.join(&full))?;
        for link in [soname(), "libtess.so".to_owned()] {
            self.link(&full, &link)?;
        }
        let description = self.pkgconfig.join("tess.pc");
        fs::write(&description, self.description()).map_err(|error| in_file(&description, &error))
    }

    /// Makes `name` stand for the library `full` beside it.
    fn link(&self, full: &str, name: &str) -> Result<(), String> {
        let link = self.lib.join(name);
        remove(&link)?;
        #[cfg(unix)]
        std::os::unix::fs::symlink(full, &link).map_err(|error| in_file(&link, &error))?;
        #[cfg(not(unix))]
        let _ = full;
        Ok(())
    }

    fn description(&self) -> String {
        format!(
            "prefix={}\n\
             includedir=${{prefix}}/include\n\
             libdir=${{prefix}}/lib\n\
             \n\
             Name: tess\n\
             Description: Bit-exact Direct3D 11 class tessellation\n\
             Version: {VERSION}\n\
             Cflags: -I${{includedir}}\n\
             Libs: -L${{libdir}} -ltess\n\
             Libs.private: {SYSTEM_LIBRARIES}\n",
            self.prefix.display()
        )
    }
}

/// Copies a file to where another may be, which a running program may use. An equal one stays, with its time.
fn replace(from: &Path, to: &Path) -> Result<(), String> {
    let new = fs::read(from).map_err(|error| in_file(from, &error))?;
    if fs::read(to).is_ok_and(|old| old == new) {
        return Ok(());
    }
    remove(to)?;
    fs::copy(from, to).map(drop).map_err(|error| in_file(to, &error))
}

fn remove(path: &Path) -> Result<(), String> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != std::io::ErrorKind::NotFound => Err(in_file(path, &error)),
        _ => Ok(()),
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests;
