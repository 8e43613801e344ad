//! `tess check`: runs the cases of a vector file and compares.

use crate::backends::BackendArgs;
use crate::failure::{Exit, Failure};
use std::path::PathBuf;

/// Compare a file of test vectors, or the listings of a device under test, with a backend
#[derive(Debug, clap::Args)]
#[command(after_help = "\
Example:
  tess check golden/cases.txt
  tess patch tri --outer 3,4,5 --inner 4 | tess check -")]
pub struct Args {
    /// Vector file; - is stdin
    #[arg(value_name = "FILE")]
    file: PathBuf,
    #[command(flatten)]
    backend: BackendArgs,
}

/// Runs the command.
///
/// # Errors
/// Malformed, short or empty input; a backend that is not available.
pub fn run(args: &Args) -> Result<Exit, Failure> {
    let backend = args.backend.select()?;
    Err(Failure::unavailable(format!(
        "cannot check {} with {}: this build has no comparison yet",
        args.file.display(),
        backend.name()
    )))
}
