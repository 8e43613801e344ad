//! Compiles every language with a compiler that is not naga.

use crate::{SETUPS, run, shaders, stages};
use libtest_mimic::Failed;
use std::path::Path;
use std::process::Command;

fn validate(file: &Path) -> Result<(), String> {
    run(Command::new("spirv-val").args(["--target-env", "vulkan1.1"]).arg(file)).map(drop)
}

/// Compiles every stage of a folder to SPIR-V next to it, and validates the result.
pub(crate) fn compile(folder: &Path, ending: &str) -> Result<(), String> {
    for stage in stages(folder, ending)? {
        let mut compiler = Command::new("glslangValidator");
        compiler.args(["-V", "-S", "comp"]);
        if ending == ".hlsl" {
            compiler.args(["-D", "-e", &stage]);
        }
        let binary = folder.join(format!("{stage}.spv"));
        run(compiler.arg(folder.join(format!("{stage}{ending}"))).arg("-o").arg(&binary))?;
        validate(&binary)?;
    }
    Ok(())
}

pub(crate) fn every_setup(
    language: &str,
    each: impl Fn(&Path) -> Result<(), String>,
) -> Result<(), Failed> {
    for (number, setup) in SETUPS.iter().enumerate() {
        for checks in ["full", "none"] {
            let options = format!("--target {language} --checks {checks} {setup}");
            each(&shaders(&format!("{language}-{number}-{checks}"), &options)?)?;
        }
    }
    Ok(())
}

pub(crate) fn spirv_is_valid() -> Result<(), Failed> {
    every_setup("spirv", |folder| {
        stages(folder, ".spv")?
            .iter()
            .try_for_each(|stage| validate(&folder.join(format!("{stage}.spv"))))
    })
}

pub(crate) fn glsl_compiles() -> Result<(), Failed> {
    every_setup("glsl", |folder| compile(folder, ".comp"))
}

pub(crate) fn hlsl_compiles() -> Result<(), Failed> {
    every_setup("hlsl", |folder| compile(folder, ".hlsl"))
}

/// Each compiler refuses a shader with a fault.
pub(crate) fn faults_are_seen() -> Result<(), Failed> {
    let folder = shaders("faulty-spirv", "--target spirv")?;
    let file = folder.join("scan.spv");
    let mut bytes = std::fs::read(&file)?;
    let end = bytes.len() - 4;
    bytes.truncate(end);
    std::fs::write(&file, &bytes)?;
    if validate(&file).is_ok() {
        return Err("a module without its end passes".into());
    }
    for (language, ending) in [("glsl", ".comp"), ("hlsl", ".hlsl")] {
        let folder = shaders(&format!("faulty-{language}"), &format!("--target {language}"))?;
        let file = folder.join(format!("scan{ending}"));
        let text = std::fs::read_to_string(&file)?;
        std::fs::write(&file, text.replace("uint block", "uint blok"))?;
        if text.contains("uint block") && compile(&folder, ending).is_err() {
            continue;
        }
        return Err(format!("a name that is not declared passes in {language}").into());
    }
    Ok(())
}
