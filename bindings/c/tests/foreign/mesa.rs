//! `integrations/mesa/tess_mesa.c`, driven as Mesa drives a tessellator, under the address
//! sanitizer.

use super::c::{STRICT, SYSTEM_LIBRARIES, golden_listings};
use super::tools::{build_folder, crate_folder, libraries, run};
use libtest_mimic::Failed;
use std::path::PathBuf;
use std::process::Command;
use std::sync::OnceLock;

/// Cases of golden/cases.txt that Mesa can ask for: not the split order `center`, not lines from
/// triangles and quads.
const GOLDEN: usize = 45;

/// `mesa/check.c` with the sources that Mesa compiles, built once.
fn check() -> Result<Command, String> {
    static BUILT: OnceLock<Result<PathBuf, String>> = OnceLock::new();
    BUILT.get_or_init(build).clone().map(Command::new)
}

fn build() -> Result<PathBuf, String> {
    let program = build_folder().join("mesa-check");
    let integration = crate_folder().join("../../integrations/mesa");
    let tests = crate_folder().join("tests/foreign/mesa");
    let mut command = Command::new("cc");
    command.args(["-std=c99", "-O2", "-g", "-pthread", "-fsanitize=address,undefined"]);
    command.arg("-fno-sanitize-recover=all").args(STRICT);
    command.arg("-I").arg(&tests).arg("-I").arg(crate_folder().join("include"));
    command.arg("-I").arg(&integration);
    command.arg(tests.join("check.c")).arg(integration.join("tess_mesa.c"));
    command.arg(libraries()?.archive).args(SYSTEM_LIBRARIES).arg("-o").arg(&program);
    run(&mut command).map(|_| program)
}

/// The listings of golden/cases.txt come out of Mesa's three functions.
pub(crate) fn equals_golden() -> Result<(), Failed> {
    let check = check()?;
    let compared = golden_listings(|arguments| {
        let words: Vec<&str> = arguments.split(' ').collect();
        let is_mesas = words[3] == "ruler" && (words[0] == "isoline" || words[2] != "line");
        let mut command = Command::new(check.get_program());
        command.arg("list").args(words);
        is_mesas.then_some(command)
    })?;
    if compared == GOLDEN {
        return Ok(());
    }
    Err(format!("{compared} cases were compared, not {GOLDEN}").into())
}

/// Random draws in threads, patch by patch and all at once, with denormals kept and flushed by the
/// processor.
pub(crate) fn draws_equal_model() -> Result<(), Failed> {
    let said = run(check()?.args(["draws", "4", "100000"]))?;
    if said == "4 threads, 100000 patches equal, with draws of several parts\n" {
        return Ok(());
    }
    Err(format!("not said that all patches are equal: {said}").into())
}
