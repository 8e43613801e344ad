//! Builds lavapipe and llvmpipe, once for each variant, in one folder: a variant compiles again what its patches change.

use super::release::{EGL, LAVAPIPE};
use super::{Place, Variant, meson, source};
use crate::command::{self, in_file};
use crate::install;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Builds every variant whose driver is missing or older than what it is made of.
pub(super) fn all(place: &Place) -> Result<(), String> {
    let prefix = place.root.join("tess");
    install::run(&prefix.display().to_string(), None)?;
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
    let folder = place.folder.join("build");
    source::become_variant(place, variant)?;
    let mut setup = tool(&meson::provide(place)?);
    setup.arg("setup");
    if folder.join("build.ninja").exists() {
        setup.arg("--reconfigure");
    }
    // The environment's variable counts in the first set-up of a folder alone.
    setup.arg(format!("-Dpkg_config_path={}", prefix.join("lib/pkgconfig").display()));
    setup.args(place.release.options());
    setup.arg(format!("--prefix={}", place.folder.join("install").display()));
    if variant != Variant::Unpatched {
        setup.arg("-Dtessellator=tess");
    }
    command::run(setup.arg(&folder).arg(place.source()))?;
    let built = place.release.libraries.iter().map(|library| library.built);
    command::run(tool(Path::new("ninja")).arg("-C").arg(&folder).args(built))?;
    keep(place, variant, &folder)
}

/// A program of the build. The system's Python has Mako, so its folder comes first.
fn tool(name: &Path) -> Command {
    let mut command = Command::new(name);
    let path = std::env::var("PATH").unwrap_or_default();
    command.env("PATH", format!("/usr/bin:{path}"));
    command
}

/// Puts the libraries in their variant's folder, with the manifests that EGL and the Vulkan loader want; Vulkan's is
/// written last.
fn keep(place: &Place, variant: Variant, built: &Path) -> Result<(), String> {
    let folder = place.driver(variant);
    for library in place.release.libraries {
        source::copy(&built.join(library.built), &folder.join(library.kept))?;
    }
    let egl = serde_json::json!({ "library_path": folder.join(EGL) });
    write_manifest(&place.egl_manifest(variant), &egl)?;
    let version = place.release.vulkan;
    let lavapipe =
        serde_json::json!({ "library_path": folder.join(LAVAPIPE), "api_version": version });
    write_manifest(&place.manifest(variant), &lavapipe)
}

fn write_manifest(path: &Path, icd: &serde_json::Value) -> Result<(), String> {
    let manifest = serde_json::json!({ "file_format_version": "1.0.0", "ICD": icd });
    fs::write(path, format!("{manifest:#}\n")).map_err(|error| in_file(path, &error))
}
