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
            Ok((folder, Box::new(move || remove(&temporary))))
        })?;
        Ok(Self { folder, becomes: path.to_owned(), replaces: true, _guard: guard })
    }

    /// The path at which its files are written.
    pub(crate) fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Moves the complete folder into its place. Errors: it cannot be moved; then it is removed.
    pub(crate) fn finish(mut self) -> io::Result<()> {
        ending::uninterrupted(|| self.replace())
    }

    fn replace(&mut self) -> io::Result<()> {
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

/// Removes a folder in which another thread may still create files. Under another name it gets no
/// more of them, except one that was on its way: that is removed in another round.
fn remove(folder: &Path) {
    let gone = folder.with_extension("gone");
    let last = if fs::rename(folder, &gone).is_ok() { &gone } else { folder };
    while let Err(error) = fs::remove_dir_all(last)
        && error.kind() == io::ErrorKind::DirectoryNotEmpty
    {}
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::fs::File;

    #[test]
    fn a_folder_that_is_written_is_removed() {
        let parent = tempfile::tempdir().expect("a folder");
        for round in 0..20 {
            let folder = parent.path().join(round.to_string());
            fs::create_dir(&folder).expect("created");
            std::thread::scope(|scope| {
                let write =
                    || (0..).take_while(|n| File::create(folder.join(n.to_string())).is_ok());
                let writer = scope.spawn(move || write().count());
                while fs::read_dir(&folder).expect("there").next().is_none() {}
                remove(&folder);
                let left = fs::read_dir(parent.path()).expect("there").count();
                assert_eq!(left, 0, "it is gone");
                assert!(writer.join().expect("ended") > 0, "files were created meanwhile");
            });
        }
    }
}
