//! The host in C on Vulkan device 0: its output is the model's, byte for byte.

use crate::batches::{Batch, Expected, Form, recorded};
use crate::compilers::compile;
use crate::{run, shaders};
use libtest_mimic::Failed;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const SOURCES: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../bindings/vulkan");
const PATCHES: usize = 300;

/// Builds the host for the shaders in a folder.
fn build(folder: &Path) -> Result<PathBuf, String> {
    let program = folder.join("tess_vulkan");
    let mut cc = Command::new("cc");
    cc.args(["-std=c99", "-O1", "-Wall", "-Wextra", "-pedantic", "-Werror", "-I"]).arg(folder);
    let sources = ["main.c", "tess_vulkan.c"].map(|file| Path::new(SOURCES).join(file));
    run(cc.args(sources).arg("-o").arg(&program).arg("-lvulkan"))?;
    Ok(program)
}

/// Runs the host on batches and returns what it wrote for each.
fn tessellate(folder: &Path, batches: &[&Batch]) -> Result<Vec<Expected>, String> {
    let mut host = Command::new(build(folder)?);
    // Mesa's loader complains if the directory does not exist.
    host.env("XDG_RUNTIME_DIR", std::env::temp_dir()).arg(folder);
    let files: Vec<_> = (0..batches.len()).map(|i| folder.join(format!("factors-{i}"))).collect();
    for (file, batch) in files.iter().zip(batches) {
        fs::write(file, batch.factor_bytes()).map_err(|error| error.to_string())?;
        host.arg(file);
    }
    run(&mut host)?;
    let read = |file: &PathBuf, ending: &str| {
        fs::read(file.with_extension(ending)).map_err(|error| error.to_string())
    };
    let written = |file| {
        Ok(Expected {
            points: read(file, "points")?,
            indices: read(file, "indices")?,
            draw: read(file, "draw")?,
        })
    };
    files.iter().map(written).collect()
}

fn compare(folder: &Path, batches: &[&Batch], form: Form) -> Result<(), String> {
    for (batch, written) in batches.iter().zip(tessellate(folder, batches)?) {
        let expected = batch.expected(form);
        if expected.indices.is_empty() && batch.patches.len() >= PATCHES {
            return Err("a batch without any index compares nothing".into());
        }
        if written != expected {
            return Err(format!("{} differs from the model", batch.options(form)));
        }
    }
    Ok(())
}

/// The forms of output, one after another.
fn form(number: usize) -> Form {
    let is_per_patch = number % 3 == 1;
    Form {
        is_f32: number % 2 == 1,
        is_narrow: is_per_patch && number.is_multiple_of(2),
        is_per_patch,
        is_for_cache: number % 4 == 3,
    }
}

/// The recorded cases, and a random batch of each of their configurations.
pub(crate) fn spirv_equals_the_model() -> Result<(), Failed> {
    let batches = recorded()?;
    for (number, batch) in batches.iter().enumerate() {
        let form = form(number);
        let options = format!("--target spirv {}", batch.options(form));
        let folder = shaders(&format!("host-{number}"), &options)?;
        compare(&folder, &[batch, &batch.random(number as u64, PATCHES)], form)?;
    }
    if batches.len() < 20 { Err("there are few setups".into()) } else { Ok(()) }
}

/// A few configurations of each domain, through another compiler.
fn through(language: &str, ending: &str) -> Result<(), Failed> {
    for (number, batch) in recorded()?.iter().enumerate().step_by(4) {
        let form = form(number);
        let options = format!("--target {language} {}", batch.options(form));
        let folder = shaders(&format!("host-{language}-{number}"), &options)?;
        compile(&folder, ending)?;
        compare(&folder, &[batch, &batch.random(number as u64, PATCHES)], form)?;
    }
    Ok(())
}

pub(crate) fn glsl_equals_the_model() -> Result<(), Failed> {
    through("glsl", ".comp")
}

pub(crate) fn hlsl_equals_the_model() -> Result<(), Failed> {
    through("hlsl", ".hlsl")
}

/// The sizes in the manifest are enough for shaders that check nothing.
pub(crate) fn unchecked_equals_the_model() -> Result<(), Failed> {
    for (number, batch) in recorded()?.iter().enumerate().skip(2).step_by(5) {
        let form = form(number);
        let options = format!("--target spirv --checks none {}", batch.options(form));
        let folder = shaders(&format!("host-unchecked-{number}"), &options)?;
        compare(&folder, &[batch, &batch.random(number as u64, PATCHES)], form)?;
    }
    Ok(())
}

/// A table with one wrong word, and factors that differ from those compared, are detected.
pub(crate) fn faults_are_seen() -> Result<(), Failed> {
    let recorded = recorded()?;
    let batch = recorded[0].random(1, PATCHES);
    let form = form(0);
    let options = format!("--target spirv {}", batch.options(form));
    let folder = shaders("host-faulty", &options)?;
    compare(&folder, &[&batch], form)?;
    let tables = folder.join("tables.bin");
    let mut words = fs::read(&tables)?;
    words[4 * 4] ^= 1;
    fs::write(&tables, &words)?;
    match compare(&folder, &[&batch], form) {
        Err(said) if said.contains("differs from the model") => Ok(()),
        other => Err(format!("a wrong reciprocal gives {other:?}").into()),
    }
}

pub(crate) fn bad_usage_is_refused() -> Result<(), Failed> {
    let folder = shaders("host-usage", "--target spirv")?;
    let program = build(&folder)?;
    let factors = folder.join("factors");
    fs::write(&factors, [0; 7])?;
    let folder = folder.display().to_string();
    let cases: [(&[&str], i32, &str); 4] = [
        (&[], 2, "usage"),
        (&["-d", "1000", &folder, "x"], 3, "there is no Vulkan device 1000"),
        (&["/nowhere", "x"], 3, "cannot open /nowhere/"),
        (&[&folder, factors.to_str().unwrap_or("x")], 2, "whole patches"),
    ];
    for (words, code, said) in cases {
        let output = Command::new(&program).args(words).output()?;
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        if output.status.code() != Some(code) || !message.contains(said) {
            return Err(format!("{words:?} gave {:?}: {message}", output.status).into());
        }
    }
    Ok(())
}
