//! Mesa's sources: from Debian, with Debian's patches, and with some of ours.

use super::debian;
use super::release::Release;
use super::{Place, Variant};
use crate::command::{self, in_file};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

impl Place {
    /// Mesa's sources.
    pub(super) fn source(&self) -> PathBuf {
        self.folder.join("source")
    }

    /// The files that our patches change, as they were before.
    fn original(&self) -> PathBuf {
        self.folder.join("original")
    }

    /// The first `count` patches, in order.
    pub(super) fn patches(&self, count: usize) -> Result<Vec<PathBuf>, String> {
        let folder = self.integration.join(self.release.patches);
        let entries = fs::read_dir(&folder).map_err(|error| in_file(&folder, &error))?;
        let mut files: Vec<PathBuf> =
            entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
        files.sort();
        if files.len() < count {
            return Err(in_file(&folder, &format!("{count} patches are wanted")));
        }
        files.truncate(count);
        Ok(files)
    }
}

/// Gets and unpacks Mesa's sources where they are missing, and applies Debian's patches.
pub(super) fn provide(place: &Place) -> Result<(), String> {
    let source = place.source();
    if source.exists() {
        return Ok(());
    }
    debian::source(place, "mesa")?;
    let Release { version, codename, .. } = place.release;
    let unpacked = place.folder.join(format!("mesa-{version}"));
    if !unpacked.exists() {
        let other = format!("Debian's {codename} has another version of Mesa than {version}");
        return Err(in_file(&place.folder, &other));
    }
    // Sources of the newer format come with the patches applied, and say so.
    if !unpacked.join(".pc/applied-patches").exists() {
        apply_series(&unpacked)?;
    }
    for path in changed(&place.patches(Variant::ALL.len() - 1)?)? {
        copy(&unpacked.join(&path), &place.original().join(&path))?;
    }
    fs::rename(&unpacked, &source).map_err(|error| in_file(&source, &error))
}

/// Applies Debian's patches.
fn apply_series(unpacked: &Path) -> Result<(), String> {
    let series = unpacked.join("debian/patches/series");
    let names = fs::read_to_string(&series).map_err(|error| in_file(&series, &error))?;
    for name in names.lines().filter(|line| !line.is_empty() && !line.starts_with('#')) {
        apply(unpacked, &unpacked.join("debian/patches").join(name))?;
    }
    Ok(())
}

/// Makes the sources those of a variant. Files that stay the same are not touched, so that little is built again.
pub(super) fn become_variant(place: &Place, variant: Variant) -> Result<(), String> {
    let patches = place.patches(variant.patches())?;
    let scratch = place.folder.join("scratch");
    let all = changed(&place.patches(Variant::ALL.len() - 1)?)?;
    for path in &all {
        copy(&place.original().join(path), &scratch.join(path))?;
    }
    for patch in &patches {
        apply(&scratch, patch)?;
    }
    for path in &all {
        copy_changed(&scratch.join(path), &place.source().join(path))?;
    }
    for file in ["tess_mesa.c", "tess_mesa.h"] {
        let to = place.source().join("src/gallium/auxiliary/tessellator").join(file);
        copy_changed(&place.integration.join(file), &to)?;
    }
    fs::remove_dir_all(&scratch).map_err(|error| in_file(&scratch, &error))
}

/// The files that patches change, as the lines `+++ b/PATH` name them.
fn changed(patches: &[PathBuf]) -> Result<Vec<String>, String> {
    let mut paths = Vec::new();
    for patch in patches {
        let text = fs::read_to_string(patch).map_err(|error| in_file(patch, &error))?;
        paths
            .extend(text.lines().filter_map(|line| line.strip_prefix("+++ b/")).map(str::to_owned));
    }
    paths.sort();
    paths.dedup();
    Ok(paths)
}

fn apply(folder: &Path, patch: &Path) -> Result<(), String> {
    let mut command = Command::new("patch");
    command.args(["-s", "-p1", "--no-backup-if-mismatch", "-i"]).arg(patch).current_dir(folder);
    command::run(&mut command)
}

pub(super) fn copy(from: &Path, to: &Path) -> Result<(), String> {
    if let Some(folder) = to.parent() {
        fs::create_dir_all(folder).map_err(|error| in_file(folder, &error))?;
    }
    fs::copy(from, to).map(drop).map_err(|error| in_file(from, &error))
}

fn copy_changed(from: &Path, to: &Path) -> Result<(), String> {
    let new = fs::read(from).map_err(|error| in_file(from, &error))?;
    if fs::read(to).is_ok_and(|old| old == new) {
        return Ok(());
    }
    fs::write(to, new).map_err(|error| in_file(to, &error))
}
