//! The files of one command must be distinct, so that no output replaces an input.

use super::file::{folder_of, follow};
use crate::failure::Failure;
use same_file::Handle;
use std::fs;
use std::path::{Path, PathBuf};

/// A file of a command, with the option that names it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Role<'a> {
    option: &'a str,
    path: &'a Path,
    standard: Standard,
}

/// The meaning of `-`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Standard {
    Input,
    Output,
}

impl<'a> Role<'a> {
    /// A file that is read; `-` is stdin.
    pub(crate) const fn input(option: &'a str, path: &'a Path) -> Self {
        Self { option, path, standard: Standard::Input }
    }

    /// A file that is written; `-` is stdout.
    pub(crate) const fn output(option: &'a str, path: &'a Path) -> Self {
        Self { option, path, standard: Standard::Output }
    }

    /// Whether two roles use the same file.
    pub(crate) fn is_same_file(&self, other: &Self) -> bool {
        self.identity().is_some_and(|own| other.identity() == Some(own))
    }

    /// The results on stdout.
    pub(crate) fn stdout() -> Self {
        Self::output("stdout", Path::new("-"))
    }

    /// The file or place that the path leads to; `None` for a device and for a path that leads
    /// nowhere.
    pub(crate) fn identity(&self) -> Option<Identity> {
        let is_standard = self.path.as_os_str() == "-";
        let there = match self.standard {
            Standard::Input if is_standard => Handle::stdin().ok().and_then(key),
            Standard::Output if is_standard => Handle::stdout().ok().and_then(key),
            // A pipe is not opened, because that would wait for its other end.
            _ => self.path.is_file().then(|| key_of(self.path)).flatten(),
        };
        match there {
            Some(key) => Some(Identity::File(key)),
            None if is_standard => Some(Identity::Standard(self.standard)),
            None => self.place().map(Identity::Place),
        }
    }

    /// The place of a file that does not exist yet, of a pipe, or of an unreadable file.
    fn place(&self) -> Option<PathBuf> {
        let path = follow(self.path).ok()?;
        let is_device = path.metadata().is_ok_and(|found| is_device(&found));
        let folder = fs::canonicalize(folder_of(&path)).ok()?;
        (!is_device).then(|| folder.join(path.file_name().unwrap_or_default()))
    }

    /// The option with its path, for messages.
    fn words(&self) -> String {
        match (self.option, self.path) {
            ("stdout", _) => "stdout".to_owned(),
            (option, path) => format!("{option} {}", path.display()),
        }
    }
}

#[derive(PartialEq, Eq, Hash)]
pub(crate) enum Identity {
    File(FileKey),
    Standard(Standard),
    Place(PathBuf),
}

/// The device and number of a file. Thousands of files then need no descriptors.
#[cfg(unix)]
type FileKey = (u64, u64);
#[cfg(not(unix))]
type FileKey = Handle;

/// The key of a regular file.
#[cfg(unix)]
fn key_of(path: &Path) -> Option<FileKey> {
    use std::os::unix::fs::MetadataExt;
    path.metadata().ok().map(|found| (found.dev(), found.ino()))
}

#[cfg(not(unix))]
fn key_of(path: &Path) -> Option<FileKey> {
    Handle::from_path(path).ok()
}

/// The key of an open file, if it is a regular one.
#[cfg(unix)]
fn key(handle: Handle) -> Option<FileKey> {
    is_regular(handle.as_file()).then(|| (handle.dev(), handle.ino()))
}

#[cfg(not(unix))]
fn key(handle: Handle) -> Option<FileKey> {
    is_regular(handle.as_file()).then_some(handle)
}

fn is_regular(file: &fs::File) -> bool {
    file.metadata().is_ok_and(|found| found.is_file())
}

/// Whether a file is a device such as `/dev/null`, which several roles may use at once.
#[cfg(unix)]
fn is_device(found: &fs::Metadata) -> bool {
    std::os::unix::fs::FileTypeExt::is_char_device(&found.file_type())
}

#[cfg(not(unix))]
fn is_device(found: &fs::Metadata) -> bool {
    !found.is_file()
}

/// Refuses an output that is the same file as an input or another output, whether by equal paths,
/// by links or by redirection. Errors: exit code 2, with the first two roles of one file.
pub(crate) fn refuse_shared(roles: &[Role<'_>]) -> Result<(), Failure> {
    let is_output = |role: &Role<'_>| role.standard == Standard::Output;
    let outputs = roles.iter().enumerate().filter(|(_, role)| is_output(role));
    let outputs: Vec<_> = outputs.map(|(at, role)| (at, role.identity())).collect();
    for (number, role) in roles.iter().enumerate() {
        let Some(identity) = role.identity() else { continue };
        // Two outputs of one file are reported at the second of them.
        let same = outputs.iter().find(|(at, other)| {
            other.as_ref() == Some(&identity) && (*at < number || !is_output(role))
        });
        if let Some(&(at, _)) = same {
            let [first, second] = [at.min(number), at.max(number)].map(|at| roles[at].words());
            return Err(Failure::bad_input(format!(
                "{first} and {second} are the same file; give two files"
            )));
        }
    }
    Ok(())
}
