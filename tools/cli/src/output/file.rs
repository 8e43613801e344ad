//! Files that exist whole or not at all, and paths that are not regular files.

use super::ending::{self, Guard};
use super::stdout;
use crate::failure::Failure;
use std::fs::{self, File, Metadata};
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile};

/// The kind of place that a path given to `-o` leads to.
#[derive(Debug)]
pub(super) enum Destination {
    /// Standard output.
    Stdout,
    /// A pipe or a device, which is written directly.
    Stream(PathBuf),
    /// A regular file, or one that does not exist yet; never a symbolic link.
    File(PathBuf),
}

impl Destination {
    /// Finds out what the path leads to, following symbolic links. Errors: a folder, a file without
    /// write permission, a cycle of links.
    pub(super) fn of(path: &Path) -> io::Result<Self> {
        const STDOUT: [&str; 4] = ["-", "/dev/stdout", "/dev/fd/1", "/proc/self/fd/1"];
        if STDOUT.iter().any(|name| path.as_os_str() == *name) {
            return Ok(Self::Stdout);
        }
        if path.as_os_str().as_encoded_bytes().ends_with(b"/") {
            return Err(io::ErrorKind::IsADirectory.into());
        }
        let is_descriptor = ["/dev/fd", "/proc"].iter().any(|folder| path.starts_with(folder));
        match path.metadata() {
            Ok(found) if found.is_dir() => Err(io::ErrorKind::IsADirectory.into()),
            Ok(found) if is_descriptor || path == Path::new("/dev/stderr") || !found.is_file() => {
                Ok(Self::Stream(path.to_owned()))
            }
            // A file without write permission must not be replaced either. Another run may remove
            // the file meanwhile.
            Ok(_) => match File::options().write(true).open(path) {
                Err(error) if !is_gone(&error) => Err(error),
                _ => follow(path).map(Self::File),
            },
            Err(error) if is_gone(&error) => follow(path).map(Self::File),
            Err(error) => Err(error),
        }
    }
}

/// Whether the error is that a file does not exist.
pub(super) fn is_gone(error: &io::Error) -> bool {
    error.kind() == io::ErrorKind::NotFound
}

/// The path at which a chain of symbolic links ends, whether or not anything exists there.
pub(super) fn follow(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_owned();
    for _ in 0..40 {
        match fs::read_link(&path) {
            Ok(target) => path = folder_of(&path).join(target),
            Err(_) => return Ok(path),
        }
    }
    Err(io::Error::other("too many symbolic links"))
}

pub(super) fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

/// Opens a pipe or a device. A file behind a descriptor is appended to.
pub(super) fn open_stream(path: &Path) -> io::Result<File> {
    File::options().append(true).open(path)
}

/// Temporary files have short names that show that they belong to this program.
pub(super) fn temporary<'a, 'b>() -> Builder<'a, 'b> {
    let mut builder = Builder::new();
    builder.prefix(".tess-");
    builder
}

/// The permissions of a new file or folder; the user's mask removes some of them.
#[cfg(unix)]
pub(super) fn permissions(mode: u32) -> fs::Permissions {
    std::os::unix::fs::PermissionsExt::from_mode(mode)
}

/// A temporary file next to the path that it will take when it is complete.
#[derive(Debug)]
pub(crate) struct Partial {
    file: NamedTempFile,
    path: PathBuf,
    _guard: Guard,
}

impl Partial {
    /// Begins a file for a path that is not a symbolic link. Errors: the folder cannot be written.
    pub(super) fn of(path: &Path) -> io::Result<Self> {
        let replaced = path.metadata().ok();
        let (file, guard) = ending::guarded(|| {
            let file = Self::create(path, replaced.as_ref())?;
            let temporary = file.path().to_owned();
            Ok((file, Box::new(move || _ = fs::remove_file(temporary))))
        })?;
        Ok(Self { file, path: path.to_owned(), _guard: guard })
    }

    fn create(path: &Path, replaced: Option<&Metadata>) -> io::Result<NamedTempFile> {
        let folder = folder_of(path);
        if !folder.metadata()?.is_dir() {
            return Err(io::ErrorKind::NotADirectory.into());
        }
        #[cfg_attr(not(unix), expect(unused_mut, reason = "only Unix gives permissions"))]
        let mut builder = temporary();
        let old = replaced.map(Metadata::permissions);
        #[cfg(unix)]
        builder.permissions(old.clone().unwrap_or_else(|| permissions(0o666)));
        let file = builder.tempfile_in(folder)?;
        if let Some(old) = old {
            // The user's mask may have removed permissions that the old file had.
            file.as_file().set_permissions(old)?;
        }
        Ok(file)
    }

    /// Moves the complete file into its place. Errors: it cannot be moved; then it is removed.
    pub(super) fn persist(self) -> io::Result<()> {
        persist(self.file, &self.path)
    }
}

#[cfg(not(windows))]
fn persist(file: NamedTempFile, path: &Path) -> io::Result<()> {
    file.persist(path).map(drop).map_err(|error| error.error)
}

/// Windows does not replace a file that another program is examining. That lasts only a moment, but
/// may recur.
#[cfg(windows)]
#[expect(clippy::disallowed_methods, reason = "nothing tells when the other program is done")]
fn persist(mut file: NamedTempFile, path: &Path) -> io::Result<()> {
    for _ in 0..100 {
        match file.persist(path) {
            Err(denied) if denied.error.kind() == io::ErrorKind::PermissionDenied => {
                file = denied.file
            }
            persisted => return persisted.map(drop).map_err(|error| error.error),
        }
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    file.persist(path).map(drop).map_err(|error| error.error)
}

impl Write for Partial {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file.flush()
    }
}

/// Creates a file with this content, unless a file exists already. Errors: the folder cannot be
/// written, or the path does not lead to a file.
pub(crate) fn create_unless_there(path: &Path, content: &[u8]) -> io::Result<()> {
    let mut partial = Partial::of(&follow(path)?)?;
    partial.write_all(content)?;
    match partial.file.persist_noclobber(&partial.path) {
        Err(error) if error.error.kind() == io::ErrorKind::AlreadyExists => Ok(()),
        made => made.map(drop).map_err(|error| error.error),
    }
}

/// An output that can be written in any order, and is moved into its place at the end.
#[derive(Debug)]
pub(crate) enum OutputFile {
    /// A file that will take its place.
    Partial(Partial),
    /// A file that is copied at the end: to stdout, or to a pipe or a device that is already open.
    Spool(File, Option<File>),
}

impl OutputFile {
    /// Begins an output. Errors: the place cannot be written.
    pub(crate) fn create(path: &Path) -> Result<Self, Failure> {
        let failed = |error| Failure::write(path, error);
        match Destination::of(path).map_err(failed)? {
            Destination::Stdout => Ok(Self::Spool(spool()?, None)),
            Destination::Stream(path) => {
                Ok(Self::Spool(spool()?, Some(open_stream(&path).map_err(failed)?)))
            }
            Destination::File(path) => Partial::of(&path).map(Self::Partial).map_err(failed),
        }
    }

    /// Whether a path leads neither to a pipe nor to a device nor to stdout. Nothing is opened,
    /// because opening a pipe waits for its reader.
    pub(crate) fn would_be_file(path: &Path) -> bool {
        !matches!(Destination::of(path), Ok(Destination::Stdout | Destination::Stream(_)))
    }

    /// The file that holds the output until it is complete.
    pub(crate) fn file(&self) -> &File {
        match self {
            Self::Partial(partial) => partial.file.as_file(),
            Self::Spool(file, _) => file,
        }
    }

    /// Moves the complete output into its place. Errors: it cannot be moved; then the place is as
    /// it was before.
    pub(crate) fn finish(self) -> io::Result<()> {
        match self {
            Self::Partial(partial) => partial.persist(),
            Self::Spool(file, Some(mut stream)) => copy(file, &mut stream),
            Self::Spool(file, None) => copy(file, &mut stdout()),
        }
    }
}

/// A temporary file for an output that finally goes to a pipe. Errors: the folder for temporary
/// files cannot be written.
fn spool() -> Result<File, Failure> {
    let folder = std::env::temp_dir();
    tempfile::tempfile_in(&folder)
        .map_err(|error| Failure::file("make a temporary file in", &folder, &error))
}

fn copy(mut from: File, to: &mut impl Write) -> io::Result<()> {
    from.rewind()?;
    io::copy(&mut from, to)?;
    to.flush()
}

impl Write for OutputFile {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.file().write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.file().flush()
    }
}
