//! The files of one command must be different files, so that no output replaces what is read.

use super::file::{folder_of, follow};
use crate::failure::Failure;
use same_file::Handle;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

/// A file of a command, by the option that names it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Role<'a> {
    option: &'a str,
    path: &'a Path,
    standard: Standard,
}

/// What `-` stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Standard {
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

    /// Whether two roles have the same file.
    pub(crate) fn is_same_file(&self, other: &Self) -> bool {
        self.identity().is_some_and(|own| other.identity() == Some(own))
    }

    /// The results on stdout.
    pub(crate) fn stdout() -> Self {
        Self::output("stdout", Path::new("-"))
    }

    /// The file or place behind the path; `None` of a device and of a path that leads nowhere.
    fn identity(&self) -> Option<Identity> {
        let standard = self.path.as_os_str() == "-";
        let there = match self.standard {
            Standard::Input if standard => Handle::stdin(),
            Standard::Output if standard => Handle::stdout(),
            // A pipe is not opened: that waits for its other end.
            _ if self.path.is_file() => Handle::from_path(self.path),
            _ => Err(io::ErrorKind::NotFound.into()),
        };
        let there = there.ok().filter(|handle| is_regular(handle.as_file()));
        match there {
            Some(handle) => Some(Identity::File(handle)),
            None if standard => Some(Identity::Standard(self.standard)),
            None => self.place().map(Identity::Place),
        }
    }

    /// Where a file will be, or a pipe or an unreadable file is.
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

#[derive(PartialEq, Eq)]
enum Identity {
    File(Handle),
    Standard(Standard),
    Place(PathBuf),
}

fn is_regular(file: &fs::File) -> bool {
    file.metadata().is_ok_and(|found| found.is_file())
}

/// Whether a file is a device such as `/dev/null`, which every role may use at once.
#[cfg(unix)]
fn is_device(found: &fs::Metadata) -> bool {
    std::os::unix::fs::FileTypeExt::is_char_device(&found.file_type())
}

#[cfg(not(unix))]
fn is_device(found: &fs::Metadata) -> bool {
    !found.is_file()
}

/// Refuses an output that is the same file as an input or as another output, whether by one path, by
/// links or by redirection.
///
/// # Errors
/// Exit code 2, with the first two roles of one file.
pub(crate) fn refuse_shared(roles: &[Role<'_>]) -> Result<(), Failure> {
    let known: Vec<_> = roles.iter().map(|role| (role, role.identity())).collect();
    for (number, (role, identity)) in known.iter().enumerate() {
        let may_share = |other: &Role<'_>| {
            (role.standard, other.standard) == (Standard::Input, Standard::Input)
        };
        let same = known[..number]
            .iter()
            .find(|(other, earlier)| !may_share(other) && earlier.is_some() && earlier == identity);
        if let Some((other, _)) = same {
            return Err(Failure::bad_input(format!(
                "{} and {} are the same file; give two files",
                other.words(),
                role.words()
            )));
        }
    }
    Ok(())
}
