//! Installs the C library in the form that C and C++ programs expect: headers, the static and the
//! shared library, and the files that pkg-config and CMake look for.
//!
//! | system | archive | shared library | beside it |
//! | --- | --- | --- | --- |
//! | Linux | `lib/libtess.a` | `lib/libtess.so.0.1.0` | links `libtess.so.0.1` and `libtess.so`, `lib/pkgconfig/tess.pc` |
//! | macOS | `lib/libtess.a` | `lib/libtess.dylib` | `lib/pkgconfig/tess.pc` |
//! | Windows (GNU) | `lib/libtess.a` | `bin/tess_capi.dll` | `lib/libtess.dll.a` |
//!
//! The headers go to `include`, CMake's package to `lib/cmake/tess`. cargo-c installs all of this
//! except CMake's package. It is not used because it compiles cargo itself first, which takes
//! minutes.

use crate::command::{self, cargo, in_file, workspace};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The system libraries that a Rust static library needs.
const SYSTEM_LIBRARIES: &str = "-lpthread -ldl -lm";

/// Makes this system's linker leave out those functions of an archive that a program does not call.
const WITHOUT_UNUSED: &str =
    if cfg!(target_os = "macos") { "-Wl,-dead_strip" } else { "-Wl,--gc-sections" };

/// Makes cargo list its build products on its standard output.
const MESSAGES: &str = "--message-format=json-render-diagnostics";

/// The version of the package, `MAJOR.MINOR.PATCH`, which all packages of the workspace share.
const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Builds the C library for `target`, or for this machine, and installs it below `prefix`. Existing
/// files are replaced.
///
/// # Errors
/// The system is not in the table above, the build fails, or a file cannot be written.
pub(crate) fn run(prefix: &str, target: Option<&str>) -> Result<(), String> {
    run_with(&mut cargo("rustc --release -p tess-capi --lib"), prefix, target)
}

/// Does what [`run`] does, with this build.
///
/// # Errors
/// As for [`run`].
pub(crate) fn run_with(
    release: &mut Command,
    prefix: &str,
    target: Option<&str>,
) -> Result<(), String> {
    let system = System::of(target.unwrap_or(std::env::consts::OS))?;
    let prefix = std::path::absolute(prefix).map_err(|error| in_file(Path::new(prefix), &error))?;
    release.args(target.map(|target| format!("--target={target}"))).arg(MESSAGES).arg("--");
    release.args(system.name_of_library());
    let files = Files { prefix, system };
    files.install(&build(release, system)?)?;
    println!("\ninstalled in {}; compile with", files.prefix.display());
    if system != System::Windows {
        let pkgconfig = files.prefix.join("lib/pkgconfig");
        println!(
            "  PKG_CONFIG_PATH={} cc program.c $(pkg-config --cflags --libs tess)",
            pkgconfig.display()
        );
    }
    println!(
        "  cmake -DCMAKE_PREFIX_PATH={}   # find_package(tess), tess::tess or tess::static",
        files.prefix.display()
    );
    Ok(())
}

/// A system, by the names of its libraries.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum System {
    Linux,
    Macos,
    Windows,
}

impl System {
    /// The system of a target, or of `std::env::consts::OS`.
    fn of(target: &str) -> Result<Self, String> {
        match target {
            _ if target.contains("linux") => Ok(Self::Linux),
            _ if target.contains("apple") || target == "macos" => Ok(Self::Macos),
            _ if target.ends_with("windows-gnu") => Ok(Self::Windows),
            _ => Err(format!(
                "install: {target} has none of the layouts of Linux, macOS and Windows with GNU's tools; take \
                 tess_capi from `cargo build --release -p tess-capi` and bindings/c/include/tess.h"
            )),
        }
    }

    /// The linker flag that sets the name by which programs find the shared library.
    fn name_of_library(self) -> Option<String> {
        match self {
            Self::Linux => Some(format!("-Clink-arg=-Wl,-soname,{}", soname())),
            Self::Macos => Some("-Clink-arg=-Wl,-install_name,@rpath/libtess.dylib".to_owned()),
            Self::Windows => None,
        }
    }

    fn shared(self) -> &'static str {
        match self {
            Self::Linux => ".so",
            Self::Macos => ".dylib",
            Self::Windows => ".dll",
        }
    }
}

/// The name by which programs find the shared library. It changes with each version that may break
/// them.
pub(crate) fn soname() -> String {
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

/// Runs a build that includes the library, with [`MESSAGES`].
fn build(command: &mut Command, system: System) -> Result<Built, String> {
    println!("\n$ {}", command::shown(command));
    let messages = command::output(command)?;
    let files: Vec<PathBuf> = messages.lines().filter_map(artifacts).flatten().collect();
    let with = |extension: &str| {
        let is_it = |file: &&PathBuf| {
            let name = file.to_string_lossy();
            name.ends_with(extension) && !name.ends_with(".dll.a")
        };
        files
            .iter()
            .find(is_it)
            .cloned()
            .ok_or_else(|| format!("cargo built no {extension}: {files:?}"))
    };
    Ok(Built { archive: with(".a")?, shared: with(system.shared())? })
}

/// The files of the library in one of cargo's messages.
pub(crate) fn artifacts(line: &str) -> Option<Vec<PathBuf>> {
    let message: serde_json::Value = serde_json::from_str(line).ok()?;
    let is_library =
        message["reason"] == "compiler-artifact" && message["target"]["name"] == "tess_capi";
    let files = message["filenames"].as_array().filter(|_| is_library)?;
    Some(files.iter().filter_map(|file| file.as_str().map(PathBuf::from)).collect())
}

/// The destination of the files.
struct Files {
    prefix: PathBuf,
    system: System,
}

impl Files {
    /// The path of the file `name` in the installation; its folder is created.
    fn at(&self, name: &str) -> Result<PathBuf, String> {
        let path = self.prefix.join(name);
        let folder = path.parent().unwrap_or(&self.prefix);
        fs::create_dir_all(folder).map_err(|error| in_file(folder, &error))?;
        Ok(path)
    }

    fn write(&self, name: &str, text: &str) -> Result<(), String> {
        let path = self.at(name)?;
        fs::write(&path, text).map_err(|error| in_file(&path, &error))
    }

    fn install(&self, built: &Built) -> Result<(), String> {
        let bindings = workspace().join("bindings/c");
        for header in ["tess.h", "tess.hpp"] {
            replace(
                &bindings.join("include").join(header),
                &self.at(&format!("include/{header}"))?,
            )?;
        }
        self.archive(&built.archive)?;
        match self.system {
            System::Linux => {
                let full = format!("libtess.so.{VERSION}");
                replace(&built.shared, &self.at(&format!("lib/{full}"))?)?;
                for link in [soname(), "libtess.so".to_owned()] {
                    self.link(&full, &link)?;
                }
            }
            System::Macos => replace(&built.shared, &self.at("lib/libtess.dylib")?)?,
            System::Windows => {
                replace(&built.shared, &self.at("bin/tess_capi.dll")?)?;
                let import = built.shared.with_file_name("libtess_capi.dll.a");
                replace(&import, &self.at("lib/libtess.dll.a")?)?;
            }
        }
        for file in ["tess-config.cmake", "tess-config-version.cmake"] {
            let path = bindings.join("cmake").join(file);
            let text = command::read(&path)?;
            self.write(&format!("lib/cmake/tess/{file}"), &text.replace("@VERSION@", VERSION))?;
        }
        if self.system == System::Windows {
            Ok(())
        } else {
            self.write("lib/pkgconfig/tess.pc", &description())
        }
    }

    /// Installs the archive without symbols for debuggers, which make up most of its bytes and of
    /// those of Rust's library; the linker takes only what a program calls. On Windows the symbols
    /// are kept, because `strip` of mingw-w64 refuses members without sections.
    fn archive(&self, built: &Path) -> Result<(), String> {
        let archive = self.at("lib/libtess.a")?;
        replace(built, &archive)?;
        if self.system == System::Windows {
            return Ok(());
        }
        let flag = if cfg!(target_os = "macos") { "-S" } else { "--strip-debug" };
        match Command::new("strip").arg(flag).arg(&archive).status() {
            Ok(status) if status.success() => Ok(()),
            Ok(status) => Err(format!("strip {flag} {}: {status}", archive.display())),
            Err(_) => {
                println!("strip is not there: lib/libtess.a keeps its symbols for debuggers");
                Ok(())
            }
        }
    }

    /// Makes `name` a link to the library `full` next to it.
    fn link(&self, full: &str, name: &str) -> Result<(), String> {
        let link = self.at(&format!("lib/{name}"))?;
        remove(&link)?;
        #[cfg(unix)]
        std::os::unix::fs::symlink(full, &link).map_err(|error| in_file(&link, &error))?;
        #[cfg(not(unix))]
        let _ = full;
        Ok(())
    }
}

/// The file `tess.pc` for pkg-config. Its paths are relative to the file, so the installation may
/// be moved.
fn description() -> String {
    format!(
        "prefix=${{pcfiledir}}/../..\n\
         includedir=${{prefix}}/include\n\
         libdir=${{prefix}}/lib\n\
         \n\
         Name: tess\n\
         Description: Bit-exact Direct3D 11 class tessellation\n\
         Version: {VERSION}\n\
         Cflags: -I${{includedir}}\n\
         Libs: -L${{libdir}} -ltess\n\
         Libs.private: {WITHOUT_UNUSED} {SYSTEM_LIBRARIES}\n"
    )
}

/// Copies a file to a path that may hold another file, which a running program may use. An equal
/// file is left as it is, with its time.
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
