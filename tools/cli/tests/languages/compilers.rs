//! Compiles every language with a compiler that is not naga.

use crate::{SETUPS, folders, run, shaders, stages};
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

/// The folders of batches with the layout for SDL.
pub(crate) fn batches_for_sdl(
    language: &str,
    each: impl Fn(&Path) -> Result<(), String>,
) -> Result<(), Failed> {
    for (number, setup) in SETUPS.iter().enumerate() {
        let options = format!("--target {language} --layout sdl {setup}");
        each(&shaders(&format!("{language}-sdl-{number}"), &options)?)?;
    }
    Ok(())
}

/// The folders of batches and of stages with the layout for SDL.
fn for_sdl(language: &str, each: impl Fn(&Path) -> Result<(), String>) -> Result<(), Failed> {
    batches_for_sdl(language, &each)?;
    if !cfg!(feature = "gpu") {
        return Ok(());
    }
    let (declared, sampled) = match language {
        "hlsl" => ("", "textureLoad(map, vec2i(vertex.uv), 0)"),
        _ => {
            ("@group(1) @binding(1) var linear: sampler;", "textureSample(map, linear, vertex.uv)")
        }
    };
    let text = include_str!("stage.wgsl").replace("SAMPLER", declared);
    let file = folders().join(format!("stage-{language}.wgsl"));
    std::fs::write(&file, text.replace("SAMPLED", sampled))?;
    for (name, more) in [("stored", ""), ("evaluated", " --evaluate")] {
        let options = format!("--target {language} --layout sdl --domain quad{more} --stage");
        let options = format!("{options} {}", file.display());
        each(&shaders(&format!("{language}-sdl-{name}"), &options)?)?;
    }
    Ok(())
}

/// SDL opens Vulkan 1.0.
pub(crate) fn sdl_is_valid() -> Result<(), Failed> {
    for_sdl("spirv", |folder| {
        stages(folder, ".spv")?.iter().try_for_each(|stage| {
            let file = folder.join(format!("{stage}.spv"));
            run(Command::new("spirv-val").args(["--target-env", "vulkan1.0"]).arg(file)).map(drop)
        })
    })
}

/// What an entry point of the stage is in HLSL: its stage and its name.
fn entry_of(file: &str) -> (&str, String) {
    match file.strip_prefix("stage_").unwrap_or(file) {
        "vertex" => ("vert", "tess_vertex".to_owned()),
        "hull" => ("comp", "tess_hull".to_owned()),
        "evaluate" => ("comp", "tess_evaluate".to_owned()),
        other => match other.strip_prefix("fragment_") {
            Some(name) => ("frag", name.to_owned()),
            None => ("comp", other.to_owned()),
        },
    }
}

/// Zeros of arrays in HLSL, which glslang does not know, and what it knows.
const ZEROS: [(&str, &str); 2] = [
    ("= (uint[6])0;", "= {0u, 0u, 0u, 0u, 0u, 0u};"),
    ("sums = (uint[32])0;", "for (uint zero = 0u; zero < 32u; zero++) { sums[zero] = 0u; }"),
];

pub(crate) fn sdl_hlsl_compiles() -> Result<(), Failed> {
    for_sdl("hlsl", |folder| {
        for stage in stages(folder, ".hlsl")? {
            let (kind, entry) = entry_of(&stage);
            let path = folder.join(format!("{stage}.hlsl"));
            let text = std::fs::read_to_string(&path).map_err(|error| error.to_string())?;
            let known = |text: String, (from, to): &(&str, &str)| text.replace(from, to);
            let text = ZEROS.iter().fold(text, known);
            std::fs::write(&path, text).map_err(|error| error.to_string())?;
            let mut compiler = Command::new("glslangValidator");
            compiler.args(["-V", "-D", "-S", kind, "-e", &entry]).arg(&path);
            let binary = folder.join(format!("{stage}.spv"));
            run(compiler.arg("-o").arg(&binary))?;
            validate(&binary)?;
        }
        Ok(())
    })
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
