//! How a command ends: the exit codes and the one error type.

use std::error::Error;
use std::fmt;
use std::io;
use std::path::Path;
use std::process::ExitCode;
use tess_verify::BackendError;

/// The exit codes of the program.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Exit {
    /// Done, or everything compared equal.
    Done = 0,
    /// Something compared different.
    Different = 1,
    /// Bad usage, or malformed, short or empty input.
    BadInput = 2,
    /// The backend is not available here.
    Unavailable = 3,
    /// The reader of the output left early. Shells report this code for a program that ends this
    /// way.
    ReaderLeft = 141,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(exit as u8)
    }
}

/// The reason why a command could not do what was asked.
///
/// The message names the fault, its place, and what is expected.
#[derive(Debug)]
pub(crate) struct Failure {
    /// The code to exit with.
    pub(crate) exit: Exit,
    /// The message, without a trailing newline; empty if there is nothing to say.
    pub(crate) message: String,
}

#[expect(clippy::needless_pass_by_value, reason = "for map_err")]
impl Failure {
    /// Bad usage or bad input: exit code 2.
    pub(crate) fn bad_input(message: impl ToString) -> Self {
        Self { exit: Exit::BadInput, message: message.to_string() }
    }

    /// A result that is not as it must be: exit code 1.
    pub(crate) fn different(message: impl ToString) -> Self {
        Self { exit: Exit::Different, message: message.to_string() }
    }

    /// A backend that is not built in or cannot run here: exit code 3.
    pub(crate) fn unavailable(message: impl ToString) -> Self {
        Self { exit: Exit::Unavailable, message: message.to_string() }
    }

    /// A place that could not be written: exit code 2. If the reader has left, the program ends
    /// quietly.
    pub(crate) fn write(path: &Path, error: io::Error) -> Self {
        if error.kind() == io::ErrorKind::BrokenPipe {
            return Self { exit: Exit::ReaderLeft, message: String::new() };
        }
        let path = if path.as_os_str() == "-" { Path::new("stdout") } else { path };
        Self::file("write", path, &error)
    }

    /// A file that could not be read or written: exit code 2.
    pub(crate) fn file(action: &str, path: &Path, error: &dyn Error) -> Self {
        let why = error.to_string();
        // The crate for temporary files appends its own file name to the cause.
        let why = why.split_once(" at path \"").map_or(why.as_str(), |(why, _)| why);
        Self::bad_input(format!("cannot {action} {}: {why}", path.display()))
    }
}

impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl Error for Failure {}

/// A backend that failed while it ran: exit code 3, with every cause.
impl From<BackendError> for Failure {
    fn from(error: BackendError) -> Self {
        let mut message = error.to_string();
        let mut cause = error.source();
        while let Some(error) = cause {
            message.push_str(&format!("\n  because: {error}"));
            cause = error.source();
        }
        Self::unavailable(message)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exit_codes_are_the_documented_ones() {
        let failures = [
            (Failure::different(""), 1),
            (Failure::bad_input(""), 2),
            (Failure::file("read", Path::new("x"), &io::Error::other("y")), 2),
            (Failure::unavailable(""), 3),
            (BackendError::new("no adapter").into(), 3),
            (Failure::write(Path::new("-"), io::ErrorKind::BrokenPipe.into()), 141),
        ];
        for (failure, code) in failures {
            assert_eq!(failure.exit as u8, code, "{failure:?}");
        }
    }

    #[test]
    fn causes_are_shown() {
        let source = Some(io::Error::other("device lost").into());
        let failure = Failure::from(BackendError { message: "gpu failed".into(), source });
        assert_eq!(failure.to_string(), "gpu failed\n  because: device lost", "both lines");
    }
}
