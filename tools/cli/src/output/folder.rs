//! A new folder of files that exists whole or not at all.

use super::ending::{self, Guard};
use super::file::{folder_of, temporary};
use crate::failure::Failure;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use tempfile::TempDir;

/// A temporary folder next to the path that it will take when all its files are written.
#[derive(Debug)]
pub(crate) struct NewFolder {
    folder: TempDir,
    becomes: PathBuf,
    replaces: bool,
    _guard: Guard,
}

/// Refuses `-` as the path of a folder. Errors: the path is `-`.
pub(crate) fn refuse_stdout(folder: &Path, why: &str) -> Result<(), Failure> {
    if folder.as_os_str() == "-" {
        return Err(Failure::bad_input(format!("{why}: give a folder with -o")));
    }
    Ok(())
}

impl NewFolder {
    /// Begins a folder, and creates its parent folders. Errors: the path exists already, or the
    /// folder cannot be created.
    pub(crate) fn create(path: &Path) -> io::Result<Self> {
        if path.symlink_metadata().is_ok() {
            return Err(io::Error::new(
                io::ErrorKind::AlreadyExists,
                "it exists already; give a new folder",
            ));
        }
        Self::replacing(path).map(|new| Self { replaces: false, ..new })
    }

    /// Begins a folder that will replace another one with all its contents.
    ///
    /// # Errors
    /// The folder cannot be created.
    pub(crate) fn replacing(path: &Path) -> io::Result<Self> {
        fs::create_dir_all(folder_of(path))?;
        let (folder, guard) = ending::guarded(|| {
            #[cfg_attr(not(unix), expect(unused_mut, reason = "only Unix gives permissions"))]
            let mut builder = temporary();
            #[cfg(unix)]
            builder.permissions(super::file::permissions(0o777));
            let folder = builder.tempdir_in(folder_of(path))?;
            let temporary = folder.path().to_owned();
            Ok((folder, Box::new(move || _ = fs::remove_dir_all(temporary))))
        })?;
        Ok(Self { folder, becomes: path.to_owned(), replaces: true, _guard: guard })
    }

    /// The path at which its files are written.
    pub(crate) fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Moves the complete folder into its place. Errors: it cannot be moved; then it is removed.
    pub(crate) fn finish(mut self) -> io::Result<()> {
        let aside = temporary().tempdir_in(folder_of(&self.becomes))?;
        let old = aside.path().join("old");
        if self.replaces {
            fs::rename(&self.becomes, &old)?;
        }
        if let Err(error) = fs::rename(self.folder.path(), &self.becomes) {
            _ = fs::rename(&old, &self.becomes);
            return Err(error);
        }
        self.folder.disable_cleanup(true);
        Ok(())
    }
}
