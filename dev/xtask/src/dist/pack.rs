//! The folder of a release, and archives whose bytes depend only on their contents.

use crate::command::{self, in_file, workspace};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A folder to be filled with archives.
pub(super) struct Release {
    pub(super) out: PathBuf,
    /// The time stamp of everything, in seconds since 1970: that of the commit, unless
    /// `SOURCE_DATE_EPOCH` sets another.
    pub(super) epoch: String,
}

impl Release {
    /// An empty release.
    pub(super) fn new(out: &Path) -> Result<Self, String> {
        let epoch = match std::env::var("SOURCE_DATE_EPOCH") {
            Ok(epoch) => epoch,
            Err(_) => {
                let mut log = Command::new("git");
                log.args(["log", "-1", "--format=%ct"]).current_dir(workspace());
                command::output(&mut log)?.trim().to_owned()
            }
        };
        empty(out)?;
        Ok(Self { out: out.to_owned(), epoch })
    }

    /// Makes an empty folder next to the release, named as the archive shows it, with both
    /// licences.
    pub(super) fn stage(&self, name: &str) -> Result<PathBuf, String> {
        let stage = self.out.with_extension("stage").join(name);
        empty(&stage)?;
        super::add_licences(&stage)?;
        Ok(stage)
    }

    /// Packs a folder into `file`, and removes the folder. Hard links to one file are packed once.
    pub(super) fn archive(&self, folder: &Path, file: &str) -> Result<(), String> {
        let (Some(parent), Some(name)) = (folder.parent(), folder.file_name()) else {
            return Err(format!("{} has no name", folder.display()));
        };
        let mut tar = Command::new("tar");
        tar.args(["--sort=name", "--owner=0", "--group=0", "--numeric-owner", "--format=gnu"]);
        tar.args(["--mode=a+rX,u+w,go-w", "-I", "gzip -9n"])
            .arg(format!("--mtime=@{}", self.epoch));
        tar.arg("-C").arg(parent).arg("-cf").arg(self.out.join(file)).arg(name);
        command::run(&mut tar)?;
        fs::remove_dir_all(parent).map_err(|error| in_file(parent, &error))
    }

    /// Copies a finished archive into the release.
    pub(super) fn take(&self, file: &Path) -> Result<(), String> {
        let to = self.out.join(file.file_name().unwrap_or_default());
        fs::copy(file, to).map(drop).map_err(|error| in_file(file, &error))
    }

    /// Moves the release's files to a folder, replacing files of the same names. If the release is
    /// `whole`, the folder is emptied first.
    pub(super) fn publish(self, to: &Path, whole: bool) -> Result<Self, String> {
        if whole || !to.exists() {
            empty(to)?;
        }
        for name in self.names()? {
            let moved = fs::rename(self.out.join(&name), to.join(name));
            moved.map_err(|error| in_file(to, &error))?;
        }
        fs::remove_dir_all(&self.out).map_err(|error| in_file(&self.out, &error))?;
        let release = Self { out: to.to_owned(), ..self };
        release.write_sums()?;
        Ok(release)
    }

    fn names(&self) -> Result<Vec<String>, String> {
        let entries = fs::read_dir(&self.out).map_err(|error| in_file(&self.out, &error))?;
        let mut names: Vec<_> =
            entries.filter_map(|entry| entry.ok()?.file_name().into_string().ok()).collect();
        names.retain(|name| name != SUMS);
        names.sort();
        Ok(names)
    }

    pub(super) fn write_sums(&self) -> Result<(), String> {
        let mut sums = Command::new("sha256sum");
        let sums = command::output(sums.arg("--").args(self.names()?).current_dir(&self.out))?;
        fs::write(self.out.join(SUMS), sums).map_err(|error| in_file(&self.out, &error))
    }

    pub(super) fn sums(&self) -> Result<String, String> {
        command::read(&self.out.join(SUMS))
    }
}

const SUMS: &str = "SHA256SUMS";

/// Makes an empty folder.
pub(super) fn empty(folder: &Path) -> Result<(), String> {
    if folder.exists() {
        fs::remove_dir_all(folder).map_err(|error| in_file(folder, &error))?;
    }
    fs::create_dir_all(folder).map_err(|error| in_file(folder, &error))
}

/// Copies the tracked files of a folder of the workspace, or one tracked file.
pub(super) fn copy_tracked(from: &str, to: &Path) -> Result<(), String> {
    for name in tracked(from)? {
        match name.strip_prefix(from) {
            Some("") | None => copy(&name, to)?,
            Some(inside) => copy(&name, &to.join(inside.trim_start_matches('/')))?,
        }
    }
    Ok(())
}

/// Copies the tracked files of these folders, files or patterns (`rtl/*.sv`) to their paths below
/// `to`.
pub(super) fn copy_tree(patterns: &[&str], to: &Path) -> Result<(), String> {
    for pattern in patterns {
        tracked(&format!(":(glob){pattern}"))?
            .iter()
            .try_for_each(|name| copy(name, &to.join(name)))?;
    }
    Ok(())
}

/// Copies the tracked files of a pattern (`rtl/*.sv`) into a folder, by their names.
pub(super) fn copy_flat(pattern: &str, to: &Path) -> Result<(), String> {
    let names = tracked(&format!(":(glob){pattern}"))?;
    names.iter().try_for_each(|name| {
        let (_, file) = name.rsplit_once('/').unwrap_or(("", name));
        copy(name, &to.join(file))
    })
}

/// The tracked files of a folder or pattern of the workspace; there must be at least one.
fn tracked(pattern: &str) -> Result<Vec<String>, String> {
    let mut list = Command::new("git");
    list.args(["ls-files", "--", pattern]).current_dir(workspace());
    let names: Vec<_> = command::output(&mut list)?.lines().map(str::to_owned).collect();
    if names.is_empty() { Err(format!("git tracks nothing of {pattern}")) } else { Ok(names) }
}

/// Copies a file of the workspace, and creates the folder for it.
fn copy(name: &str, to: &Path) -> Result<(), String> {
    let path = workspace().join(name);
    let folder = to.parent().unwrap_or(to);
    let copied = fs::create_dir_all(folder).and_then(|()| fs::copy(&path, to));
    copied.map(drop).map_err(|error| in_file(&path, &error))
}
