//! Builds lavapipe, once for each variant, in one folder: a variant compiles again what its patches change.

use super::{Place, Variant, source};
use crate::command::{self, in_file};
use crate::install;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// lavapipe and what it needs, and nothing else.
const OPTIONS: &[&str] = &[
    "-Dbuildtype=release",
    "-Dplatforms=",
    "-Dgallium-drivers=swrast",
    "-Dvulkan-drivers=swrast",
    "-Dllvm=enabled",
    "-Dshared-llvm=enabled",
    "-Dopengl=false",
    "-Degl=disabled",
    "-Dglx=disabled",
    "-Dgbm=disabled",
    "-Dgles1=disabled",
    "-Dgles2=disabled",
    "-Dgallium-vdpau=disabled",
    "-Dgallium-va=disabled",
    "-Dgallium-omx=disabled",
    "-Dgallium-xa=disabled",
    "-Dvalgrind=disabled",
    "-Dlibunwind=disabled",
    "-Dlmsensors=disabled",
    "-Dbuild-tests=false",
    "-Dmicrosoft-clc=disabled",
    "-Dvideo-codecs=",
    "-Dzstd=disabled",
    "-Dshader-cache=disabled",
];

/// The driver, in the folder of the build.
const DRIVER: &str = "src/gallium/targets/lavapipe/libvulkan_lvp.so";

/// Builds every variant whose driver is missing or older than what it is made of.
pub(super) fn all(place: &Place) -> Result<(), String> {
    let prefix = place.root.join("tess");
    install::run(&prefix.display().to_string())?;
    for variant in Variant::ALL {
        if !is_current(place, variant, &prefix)? {
            build(place, variant, &prefix)?;
        }
    }
    Ok(())
}

/// Whether a variant's driver is newer than its patches and than what it links.
fn is_current(place: &Place, variant: Variant, prefix: &Path) -> Result<bool, String> {
    let made = |path: &Path| fs::metadata(path).and_then(|file| file.modified());
    let mut parts = place.patches(variant.patches())?;
    if variant != Variant::Unpatched {
        parts.extend(["tess_mesa.c", "tess_mesa.h"].map(|file| place.integration.join(file)));
        parts.push(prefix.join("lib/libtess.a"));
    }
    let Ok(driver) = made(&place.manifest(variant)) else { return Ok(false) };
    let is_older = |part: &PathBuf| made(part).is_ok_and(|part| part <= driver);
    Ok(parts.iter().all(is_older))
}

fn build(place: &Place, variant: Variant, prefix: &Path) -> Result<(), String> {
    let folder = place.root.join("build");
    source::become_variant(place, variant)?;
    let mut setup = tool("meson");
    setup.arg("setup");
    if folder.join("build.ninja").exists() {
        setup.arg("--reconfigure");
    }
    // The environment's variable counts in the first set-up of a folder alone.
    setup.arg(format!("-Dpkg_config_path={}", prefix.join("lib/pkgconfig").display()));
    setup.args(OPTIONS).arg(format!("--prefix={}", place.root.join("install").display()));
    if variant != Variant::Unpatched {
        setup.arg("-Dtessellator=tess");
    }
    command::run(setup.arg(&folder).arg(place.source()))?;
    command::run(tool("ninja").arg("-C").arg(&folder).arg(DRIVER))?;
    keep(place, variant, &folder.join(DRIVER))
}

/// A program of the build. The system's Python has Mako, so its folder comes first.
fn tool(name: &str) -> Command {
    let mut command = Command::new(name);
    let path = std::env::var("PATH").unwrap_or_default();
    command.env("PATH", format!("/usr/bin:{path}"));
    command
}

/// Puts a driver in its variant's folder, with the manifest that the Vulkan loader wants, which is written last.
fn keep(place: &Place, variant: Variant, built: &Path) -> Result<(), String> {
    let folder = place.driver(variant);
    fs::create_dir_all(&folder).map_err(|error| in_file(&folder, &error))?;
    let driver = folder.join("libvulkan_lvp.so");
    fs::copy(built, &driver).map_err(|error| in_file(built, &error))?;
    let icd = serde_json::json!({ "library_path": driver, "api_version": "1.3.230" });
    let manifest = serde_json::json!({ "file_format_version": "1.0.0", "ICD": icd });
    let path = place.manifest(variant);
    fs::write(&path, format!("{manifest:#}\n")).map_err(|error| in_file(&path, &error))
}
