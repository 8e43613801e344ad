//! The Metal Shading Language, which is C++ with a library: a C++ compiler checks syntax, names and
//! types against the declarations in `metal/metal_stdlib`. Only Metal's own compiler can check
//! address spaces and entry points.

use crate::compilers::{batches_for_sdl, every_setup};
use crate::{run, shaders, stages};
use libtest_mimic::Failed;
use std::fs;
use std::path::Path;
use std::process::Command;

const LIBRARY: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/languages/metal");

/// Compiles every stage of a folder.
fn compile(folder: &Path) -> Result<(), String> {
    stages(folder, ".metal")?.iter().try_for_each(|stage| {
        let error = |error: std::io::Error| error.to_string();
        let text = fs::read_to_string(folder.join(format!("{stage}.metal"))).map_err(error)?;
        // naga writes one function for each address space. C++, which has no address spaces, takes
        // them for the same function.
        let text = text.replace("threadgroup A *", "threadgroup volatile A *");
        let file = folder.join(format!("{stage}.cc"));
        fs::write(&file, text).map_err(error)?;
        let mut compiler = Command::new("c++");
        compiler.args(["-std=c++17", "-fsyntax-only", "-Wno-attributes", "-I", LIBRARY]);
        run(compiler.arg(file)).map(drop)
    })
}

pub(crate) fn compiles() -> Result<(), Failed> {
    every_setup("msl", compile)
}

pub(crate) fn sdl_compiles() -> Result<(), Failed> {
    // The declarations have no words for what the stage uses beyond that: swizzles, textures.
    batches_for_sdl("msl", compile)
}

/// A name that is not declared, a component that a vector lacks, and an argument too many.
pub(crate) fn faults_are_seen() -> Result<(), Failed> {
    for (number, (right, wrong)) in
        [("uint block", "uint blok"), (".x", ".q"), ("metal::min(", "metal::min(1u, 1u, ")]
            .into_iter()
            .enumerate()
    {
        let folder = shaders(&format!("faulty-msl-{number}"), "--target msl")?;
        let file = folder.join("scan.metal");
        let text = fs::read_to_string(&file)?;
        fs::write(&file, text.replacen(right, wrong, 1))?;
        if !text.contains(right) || compile(&folder).is_ok() {
            return Err(format!("{wrong} for {right} passes in MSL").into());
        }
    }
    Ok(())
}
