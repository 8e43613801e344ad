//! Coverage files, to which commands add hits.

use crate::failure::Failure;
use crate::output::{OutputArgs, Role, create_unless_there};
use std::fs::File;
use std::io;
use std::path::{Path, PathBuf};
use tess_verify::cover::Coverage;

/// A coverage file, and hits to add to it.
#[derive(Debug)]
pub(crate) struct CoverageFile {
    path: PathBuf,
    /// The hits that this command adds.
    pub(crate) coverage: Coverage,
}

impl CoverageFile {
    /// Begins to count for a file that has passed [`role`]. The file need not exist yet. Errors: a
    /// place that cannot be written; a file that cannot be read, or is not a coverage file with the
    /// bins of this version.
    pub(crate) fn open(path: PathBuf) -> Result<Self, Failure> {
        OutputArgs { file: path.clone() }.require_writable()?;
        #[cfg(windows)]
        let _lock = locked_beside(&path).map_err(|error| Failure::file("lock", &path, &error))?;
        match File::open(&path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => {}
            found => drop(read(&path, found)?),
        }
        Ok(Self { path, coverage: Coverage::default() })
    }

    /// Adds the hits to the file, after `report` has received the sum. Processes that add to one
    /// file take turns, so no hit is lost. Errors: those of `report`; a file that cannot be locked,
    /// read or written. The file is then unchanged.
    pub(crate) fn add(
        self,
        report: impl FnOnce(&Coverage) -> Result<(), Failure>,
    ) -> Result<(), Failure> {
        let path = &self.path;
        let _lock = locked(path).map_err(|error| Failure::file("lock", path, &error))?;
        let mut sum = read(path, File::open(path))?;
        sum.merge(&self.coverage);
        report(&sum)?;
        write(path, &sum)
    }
}

/// A coverage file as one of the command's files. Errors: a path that is not a regular file,
/// because a pipe would block and a device may be endless.
pub(crate) fn role(path: &Path) -> Result<Role<'_>, Failure> {
    let is_other = path.metadata().is_ok_and(|found| !found.is_file());
    if path.as_os_str() == "-" || is_other {
        return Err(Failure::bad_input(format!(
            "--coverage {} is not a regular file; the command reads it and replaces it",
            path.display()
        )));
    }
    Ok(Role::output("--coverage", path))
}

/// Writes a coverage file. Errors: the place cannot be written; an earlier file there is then
/// unchanged.
pub(crate) fn write(path: &Path, coverage: &Coverage) -> Result<(), Failure> {
    OutputArgs { file: path.to_owned() }.write(coverage.to_ucis().as_bytes())
}

/// Reads a coverage file; `-` is stdin. Errors: it cannot be read, or is not a coverage file with
/// the bins of this version.
pub(crate) fn read_from(path: &Path) -> Result<Coverage, Failure> {
    if path.as_os_str() == "-" {
        return Coverage::read_ucis(io::stdin().lock())
            .map_err(|error| Failure::bad_input(format!("stdin: {error}")));
    }
    read(path, File::open(path))
}

fn read(path: &Path, file: io::Result<File>) -> Result<Coverage, Failure> {
    let file = file.map_err(|error| Failure::file("read", path, &error))?;
    Coverage::read_ucis(file)
        .map_err(|error| Failure::bad_input(format!("{}: {error}", path.display())))
}

/// Locks the file, which is created empty if it does not exist. The lock ends when the returned
/// value is dropped.
///
/// The previous holder of the lock has replaced the file, so the path may lead to another file
/// after the wait.
#[cfg(not(windows))]
fn locked(path: &Path) -> io::Result<impl Sized> {
    loop {
        match File::options().read(true).write(true).open(path) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => create(path)?,
            Err(error) => return Err(error),
            Ok(file) => {
                file.lock()?;
                let locked = same_file::Handle::from_file(file)?;
                if same_file::Handle::from_path(path).is_ok_and(|now| now == locked) {
                    return Ok(locked);
                }
            }
        }
    }
}

#[cfg(windows)]
fn locked(path: &Path) -> io::Result<impl Sized> {
    let lock = locked_beside(path)?;
    if !path.exists() {
        create(path)?;
    }
    Ok(lock)
}

/// Locks by a second file. Windows cannot read a file that another handle has locked, and cannot
/// replace an open one. So this file is kept open while the lock is held. It is never deleted,
/// because a file that is being deleted cannot be opened.
#[cfg(windows)]
#[expect(clippy::disallowed_methods, reason = "nothing tells when the other program is done")]
fn locked_beside(path: &Path) -> io::Result<File> {
    use std::os::windows::fs::OpenOptionsExt;
    const ERROR_SHARING_VIOLATION: i32 = 32;
    let mut name = path.as_os_str().to_owned();
    name.push(".lock");
    loop {
        match File::options().append(true).create(true).share_mode(0).open(&name) {
            Err(error) if error.raw_os_error() == Some(ERROR_SHARING_VIOLATION) => {
                std::thread::sleep(std::time::Duration::from_millis(10));
            }
            opened => return opened,
        }
    }
}

/// Creates an empty file, unless one exists by now.
fn create(path: &Path) -> io::Result<()> {
    create_unless_there(path, Coverage::default().to_ucis().as_bytes())
}
