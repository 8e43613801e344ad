//! The shaders of the common setups: in every language for hosts without Rust, as WGSL with a host
//! for browsers, and those of an example with the host for SDL.

use super::pack::{Release, copy_flat, copy_tracked};
use super::{VERSION, readme, tess};
use crate::command::{self, in_file, workspace};
use crate::explorer;
use std::fs;
use std::path::Path;

const LANGUAGES: [&str; 5] = ["wgsl", "spirv", "glsl", "hlsl", "msl"];
const DOMAINS: [(&str, &str); 3] =
    [("isoline", "line"), ("tri", "triangle_cw"), ("quad", "triangle_cw")];
const PARTITIONINGS: [&str; 4] = ["integer", "pow2", "fractional_odd", "fractional_even"];

/// Writes a folder per setup into `to`; `options` are further options of the command.
fn write(language: &str, options: &[&str], to: &Path) -> Result<(), String> {
    fs::create_dir_all(to).map_err(|error| in_file(to, &error))?;
    for (domain, output) in DOMAINS {
        for partitioning in PARTITIONINGS {
            let mut shaders = tess()?;
            shaders.args(["shaders", "--target", language, "--domain", domain, "--output", output]);
            shaders.args(["--partitioning", partitioning]).args(options).arg("-o");
            command::output(shaders.arg(to.join(format!("{domain}-{partitioning}"))))?;
        }
    }
    Ok(())
}

/// The folders of setups in `folder`.
fn setups(folder: &Path) -> impl Iterator<Item = std::path::PathBuf> {
    let names = DOMAINS.iter().flat_map(|(domain, _)| {
        PARTITIONINGS.iter().map(move |partitioning| format!("{domain}-{partitioning}"))
    });
    let folder = folder.to_owned();
    names.map(move |name| folder.join(name))
}

/// Moves one copy of the modules for the user's own shaders to `shared`, and removes the other
/// copies.
fn share_surfaces(folder: &Path, shared: &Path) -> Result<(), String> {
    for setup in setups(folder) {
        let own = setup.join("surfaces");
        let moved =
            if shared.exists() { fs::remove_dir_all(&own) } else { fs::rename(&own, shared) };
        moved.map_err(|error| in_file(&own, &error))?;
    }
    Ok(())
}

/// Keeps one copy of the tables, which depend only on the split order. `keep` decides what happens
/// to each setup's copy.
fn share_tables(
    folder: &Path,
    shared: &Path,
    keep: impl Fn(&Path) -> std::io::Result<()>,
) -> Result<(), String> {
    let read = |path: &Path| fs::read(path).map_err(|error| in_file(path, &error));
    for setup in setups(folder) {
        let own = setup.join("tables.bin");
        if !shared.exists() {
            fs::copy(&own, shared).map_err(|error| in_file(&own, &error))?;
        }
        if read(&own)? != read(shared)? {
            return Err(format!("{} differs from the others", own.display()));
        }
        fs::remove_file(&own).and_then(|()| keep(&own)).map_err(|error| in_file(&own, &error))?;
    }
    Ok(())
}

pub(super) fn pack(release: &Release) -> Result<(), String> {
    let name = format!("tess-shaders-{VERSION}");
    let stage = release.stage(&name)?;
    copy_tracked("bindings/vulkan", &stage.join("vulkan"))?;
    let shared = stage.join("tables.bin");
    for language in LANGUAGES {
        let options: &[&str] = if language == "wgsl" { &["--stage"] } else { &[] };
        write(language, options, &stage.join(language))?;
        share_tables(&stage.join(language), &shared, |own| fs::hard_link(&shared, own))?;
    }
    share_surfaces(&stage.join("wgsl"), &stage.join("surfaces"))?;
    readme::put("docs/shaders.md", &stage, "shaders.md")?;
    readme::put("bindings/vulkan/README.md", &stage, "vulkan/README.md")?;
    readme::put("dev/xtask/src/dist/readmes/shaders.md", &stage, "README.md")?;
    release.archive(&stage, &format!("{name}.tar.gz"))
}

pub(super) fn pack_npm(release: &Release) -> Result<(), String> {
    let stage = release.stage("package")?;
    // All modules, with the declarations of those that users import.
    for pattern in ["*.js", "*.d.ts"] {
        copy_flat(&format!("bindings/webgpu/{pattern}"), &stage)?;
    }
    // The CPU backend, for renderers without WebGPU.
    explorer::library("tess-webgpu-cpu", &stage.join("cpu"))?;
    let description = workspace().join("bindings/webgpu/package.json");
    let text = command::read(&description)?;
    fs::write(stage.join("package.json"), text.replace("@VERSION@", VERSION))
        .map_err(|error| in_file(&stage, &error))?;
    let shaders = stage.join("shaders");
    write("wgsl", &["--stage"], &shaders)?;
    // npm does not unpack links, and the host takes the tables from here.
    share_tables(&shaders, &shaders.join("tables.bin"), |own| {
        fs::remove_file(own.with_file_name("tess_shaders.h"))
    })?;
    share_surfaces(&shaders, &shaders.join("surfaces"))?;
    readme::put("bindings/webgpu/README.md", &stage, "README.md")?;
    release.archive(&stage, &format!("tess-webgpu-{VERSION}.tgz"))
}

/// The host for SDL and its example.
const SDL: [&str; 7] = [
    "tess_sdl.c",
    "tess_sdl.h",
    "terrain.c",
    "terrain.h",
    "offscreen.c",
    "terrain.wgsl",
    "terrain.png",
];

pub(super) fn pack_sdl(release: &Release) -> Result<(), String> {
    let name = format!("tess-sdl-{VERSION}");
    let stage = release.stage(&name)?;
    for file in SDL {
        copy_flat(&format!("bindings/sdl/{file}"), &stage)?;
    }
    let mut shaders = tess()?;
    shaders.args(["shaders", "--target", "spirv", "--layout", "sdl", "--domain", "quad"]);
    shaders.args(["--partitioning", "fractional_odd", "--stage"]).arg(stage.join("terrain.wgsl"));
    command::output(shaders.arg("-o").arg(stage.join("shaders")))?;
    readme::put("bindings/sdl/README.md", &stage, "README.md")?;
    release.archive(&stage, &format!("{name}.tar.gz"))
}
