//! Coverage files, which commands add to.

use crate::failure::Failure;
use crate::output::OutputArgs;
use std::fs;
use std::io;
use std::path::PathBuf;
use tess_verify::coverage::Coverage;

/// A file of coverage and what it holds so far.
#[derive(Debug)]
pub(crate) struct CoverageFile {
    output: OutputArgs,
    /// What the file will hold.
    pub(crate) coverage: Coverage,
}

impl CoverageFile {
    /// Reads the file; one that is not there yet holds nothing.
    ///
    /// # Errors
    /// A file that cannot be read, or holds no coverage of this version's bins.
    pub(crate) fn open(path: PathBuf) -> Result<Self, Failure> {
        let coverage = match fs::read_to_string(&path) {
            Ok(text) => Coverage::from_ucis(&text)
                .map_err(|error| Failure::bad_input(format!("{}: {error}", path.display())))?,
            Err(error) if error.kind() == io::ErrorKind::NotFound => Coverage::new(),
            Err(error) => return Err(Failure::file("read", &path, &error)),
        };
        Ok(Self { output: OutputArgs { file: path }, coverage })
    }

    /// Writes the file, whole or not at all.
    ///
    /// # Errors
    /// The place cannot be written.
    pub(crate) fn write(&self) -> Result<(), Failure> {
        self.output.write(self.coverage.to_ucis().as_bytes())
    }
}
