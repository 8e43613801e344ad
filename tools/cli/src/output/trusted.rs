//! Results that others trust: while a run goes on, no earlier run's result is in their place.

use super::OutputArgs;
use super::file::{Destination, is_gone};
use crate::failure::Failure;
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

/// An output that a reader takes for the result of a whole run.
///
/// An earlier file at its path is removed before the run, so it must show that it is such a result:
/// anything else is kept.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Trusted<'a> {
    option: &'static str,
    path: &'a Path,
    /// The name of such a file, and the text that it begins with.
    name: &'static str,
    begins: &'static str,
}

impl<'a> Trusted<'a> {
    /// The file of `--report`.
    pub(crate) const fn report(path: &'a Path) -> Self {
        Self { option: "--report", path, name: "report", begins: "{\"format\":\"tess-report " }
    }

    /// The file of `--junit`.
    pub(crate) const fn junit(path: &'a Path) -> Self {
        let begins = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"tess\"";
        Self { option: "--junit", path, name: "JUnit file of tess", begins }
    }

    /// The file of `--failures`.
    pub(crate) const fn failures(path: &'a Path) -> Self {
        Self { option: "--failures", path, name: "vector file", begins: "# tess-vectors" }
    }

    /// The file of `--merged`.
    pub(crate) const fn merged(path: &'a Path) -> Self {
        let begins = "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<UCIS";
        Self { option: "--merged", path, name: "coverage file", begins }
    }

    /// Errors: the place cannot be written, or has a file of another kind.
    fn check(&self) -> Result<(), Failure> {
        let Self { option, path, name, begins } = *self;
        OutputArgs { file: path.to_owned() }.require_writable()?;
        let Some(found) = self.beginning()? else { return Ok(()) };
        // An empty file, as `mktemp` makes it, may become anything.
        if found.is_empty() || found == begins.as_bytes() {
            return Ok(());
        }
        Err(Failure::bad_input(format!(
            "{option} {} exists and is not a {name}, so it is kept; give another file, or remove it",
            path.display()
        )))
    }

    /// As many bytes of the earlier file as such a result begins with; `None` if there is no file.
    fn beginning(&self) -> Result<Option<Vec<u8>>, Failure> {
        let read = || -> io::Result<Option<Vec<u8>>> {
            let Destination::File(file) = Destination::of(self.path)? else { return Ok(None) };
            let mut bytes = Vec::new();
            File::open(file)?.take(self.begins.len() as u64).read_to_end(&mut bytes)?;
            Ok(Some(bytes))
        };
        match read() {
            Err(error) if is_gone(&error) => Ok(None),
            read => read.map_err(|error| Failure::file("read", self.path, &error)),
        }
    }

    /// Removes the earlier file. Another run may remove the same one meanwhile.
    fn remove(&self) -> Result<(), Failure> {
        let remove = || match Destination::of(self.path)? {
            Destination::File(file) => fs::remove_file(file),
            _ => Ok(()),
        };
        match remove() {
            Err(error) if !is_gone(&error) => Err(Failure::file("replace", self.path, &error)),
            _ => Ok(()),
        }
    }
}

/// Removes the results of earlier runs that this run will replace. Call it once the command line is
/// understood and its files are known to be distinct, and before anything is read.
///
/// # Errors
/// A place cannot be written, or has a file of another kind. Every file is then as it was.
pub(crate) fn begin(outputs: &[Trusted<'_>]) -> Result<(), Failure> {
    outputs.iter().try_for_each(Trusted::check)?;
    outputs.iter().try_for_each(Trusted::remove)
}
