//! Windows: programs that mingw-w64 links and Wine runs.

use super::Extent;
use super::cross::{self, Host};
use crate::command::{self, in_file, target, workspace};
use crate::setup::{self, Need, has_program};
use std::fs;
use std::process::Command;

/// 64 bits, with another calling convention, C library, line end and path syntax, as Wine provides
/// them.
const WINDOWS: Host = Host {
    target: "x86_64-pc-windows-gnu",
    linker: "x86_64-w64-mingw32-gcc",
    runner: "wine",
    whole: &[
        "test --package tess-core",
        "test --package tess-simd --all-features -- --skip too_large_a_pool",
        "test --package tess-program --no-default-features",
    ],
    need: Need {
        what: "a C compiler for Windows (mingw-w64), and Wine",
        packages: &["gcc-mingw-w64-x86-64-win32", "wine64", "wine"],
        is_there: || has_program("x86_64-w64-mingw32-gcc") && has_program("wine"),
    },
};

/// Runs the tests of the model and of the CPU backend and, if the whole is checked, of the program.
pub(super) fn check(extent: Extent) -> Result<(), String> {
    setup::provide(&[WINDOWS.need])?;
    let folder = target().join("wine");
    fs::create_dir_all(&folder).map_err(|error| in_file(&folder, &error))?;
    let mut library = Command::new(WINDOWS.linker);
    library.args(["-shared", "-o"]).arg(folder.join("bcryptprimitives.dll"));
    library.arg(workspace().join("dev/xtask/src/ports/bcryptprimitives.c")).arg("-ladvapi32");
    command::run(&mut library)?;
    // Wine's drive Z is the whole file system. WINEDEBUG silences messages about features that Wine
    // lacks.
    let path = format!("Z:{}", folder.display());
    cross::run(&WINDOWS, extent, &[("WINEPATH", path), ("WINEDEBUG", "-all".to_owned())])
}
