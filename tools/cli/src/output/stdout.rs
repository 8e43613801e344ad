//! Stdout: left by its reader, or a terminal.

use crate::failure::Failure;
use std::io::{self, BufWriter, IsTerminal, StdoutLock};

/// Stdout, buffered. It must be flushed, or errors are lost.
///
/// A write fails with [`io::ErrorKind::BrokenPipe`] when the reader has left;
/// [`Failure::write`] makes that a quiet end.
pub(crate) fn stdout() -> BufWriter<StdoutLock<'static>> {
    BufWriter::new(io::stdout().lock())
}

/// Refuses to write bytes that are no text to stdout if that is a terminal.
pub(super) fn refuse_terminal(what: &str) -> Result<(), Failure> {
    if io::stdout().is_terminal() {
        return Err(Failure::bad_input(format!(
            "{what} is no text for a terminal: add -o FILE, or redirect stdout"
        )));
    }
    Ok(())
}
