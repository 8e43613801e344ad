//! Builds lavapipe and llvmpipe, once for each variant, in one folder: a variant compiles again what its patches change.

use super::{Place, Variant, source};
use crate::command::{self, in_file};
use crate::install;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// lavapipe and llvmpipe behind EGL, both with windows of X11 and Wayland, and what they need.
const OPTIONS: &[&str] = &[
    "-Dbuildtype=release",
    "-Dplatforms=x11,wayland",
    "-Dgallium-drivers=swrast",
    "-Dvulkan-drivers=swrast",
    "-Dllvm=enabled",
    "-Dshared-llvm=enabled",
    "-Dopengl=true",
    "-Dshared-glapi=enabled",
    "-Dglvnd=true",
    "-Degl=enabled",
    "-Dglx=disabled",
    "-Dgbm=disabled",
    "-Dgles1=disabled",
    "-Dgles2=enabled",
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

/// What is built, in the folder of the build, and what a variant's folder has it as: at the same place, since Mesa's
/// libraries find each other by paths from their own.
const LIBRARIES: &[(&str, &str)] = &[
    (LAVAPIPE, LAVAPIPE),
    ("src/gallium/targets/dri/libgallium_dri.so", LLVMPIPE),
    ("src/egl/libEGL_mesa.so.0.0.0", EGL),
    ("src/mapi/shared-glapi/libglapi.so.0.0.0", "src/mapi/shared-glapi/libglapi.so.0"),
];
const LAVAPIPE: &str = "src/gallium/targets/lavapipe/libvulkan_lvp.so";
pub(super) const LLVMPIPE: &str = "src/gallium/targets/dri/swrast_dri.so";
const EGL: &str = "src/egl/libEGL_mesa.so.0";

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
    let built = LIBRARIES.iter().map(|(built, _)| built);
    command::run(tool("ninja").arg("-C").arg(&folder).args(built))?;
    keep(place, variant, &folder)
}

/// A program of the build. The system's Python has Mako, so its folder comes first.
fn tool(name: &str) -> Command {
    let mut command = Command::new(name);
    let path = std::env::var("PATH").unwrap_or_default();
    command.env("PATH", format!("/usr/bin:{path}"));
    command
}

/// Puts the libraries in their variant's folder, with the manifests that EGL and the Vulkan loader want; Vulkan's is
/// written last.
fn keep(place: &Place, variant: Variant, built: &Path) -> Result<(), String> {
    let folder = place.driver(variant);
    for (from, to) in LIBRARIES {
        source::copy(&built.join(from), &folder.join(to))?;
    }
    let egl = serde_json::json!({ "library_path": folder.join(EGL) });
    write_manifest(&place.egl_manifest(variant), &egl)?;
    let lavapipe =
        serde_json::json!({ "library_path": folder.join(LAVAPIPE), "api_version": "1.3.230" });
    write_manifest(&place.manifest(variant), &lavapipe)
}

fn write_manifest(path: &Path, icd: &serde_json::Value) -> Result<(), String> {
    let manifest = serde_json::json!({ "file_format_version": "1.0.0", "ICD": icd });
    fs::write(path, format!("{manifest:#}\n")).map_err(|error| in_file(path, &error))
}
