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

/// Ends the process, quietly, as soon as the reader of stdout leaves.
///
/// For commands that work for a long time between two lines: a write would notice only then.
#[cfg(unix)]
pub(crate) fn stop_when_reader_leaves() {
    use super::ending;
    use crate::failure::Exit;
    use rustix::event::{PollFd, PollFlags, poll};
    let wait = || {
        let stdout = io::stdout();
        // Errors and a reader that leaves are reported whatever is asked for.
        let mut asked = [PollFd::new(&stdout, PollFlags::empty())];
        let left = PollFlags::ERR | PollFlags::HUP;
        if poll(&mut asked, None).is_ok() && asked[0].revents().intersects(left) {
            ending::end(|| signal_hook::low_level::exit(Exit::ReaderLeft as i32));
        }
    };
    // Without the thread, the next write notices.
    _ = std::thread::Builder::new().spawn(wait);
}

/// Elsewhere the next write notices.
#[cfg(not(unix))]
pub(crate) fn stop_when_reader_leaves() {}
