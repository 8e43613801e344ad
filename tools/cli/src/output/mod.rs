//! Where results go: stdout, a pipe, or a file that exists whole or not at all.
//!
//! Commands write files only through [`mod@file`], and stdout only through [`stdout()`]. Both
//! register with [`ending`] what a signal must not leave behind. [`form`] chooses a file's format
//! by its name. [`trusted`] removes the results of earlier runs.

mod distinct;
pub(crate) mod ending;
mod file;
mod folder;
pub(crate) mod form;
mod trusted;

use crate::failure::Failure;
use crate::threads::startable;
pub(crate) use distinct::{Role, refuse_shared};
use file::Destination;
pub(crate) use file::{OutputFile, create_unless_there};
pub(crate) use folder::{NewFolder, refuse_stdout};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{self, BufWriter, IsTerminal, StdoutLock, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;
pub(crate) use tess_mesh::counted;
pub(crate) use trusted::{Trusted, begin};

/// The `-o` option.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct OutputArgs {
    /// File to write; - is stdout
    ///
    /// A file is written whole or not at all. A link is followed, and a pipe or a device is written
    /// to as it is.
    #[arg(short = 'o', value_name = "FILE", default_value = "-")]
    pub(crate) file: PathBuf,
}

impl OutputArgs {
    /// Writes `content` to stdout or to the file. Errors: the place cannot be written; an earlier
    /// file there is then unchanged.
    pub(crate) fn write(&self, content: &[u8]) -> Result<(), Failure> {
        self.stream(|out| out.write_all(content))
    }

    /// Writes the output of `content` to stdout or to the file as it comes. Errors: the place
    /// cannot be written; an earlier file there is then unchanged.
    pub(crate) fn stream(
        &self,
        content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let write = || match Destination::of(&self.file)? {
            Destination::Stdout => {
                let mut out = stdout();
                content(&mut out)?;
                out.flush()
            }
            Destination::Stream(path) => {
                let mut out = BufWriter::new(file::open_stream(&path)?);
                content(&mut out)?;
                out.flush()
            }
            Destination::File(path) => {
                let mut out = BufWriter::new(file::Partial::of(&path)?);
                content(&mut out)?;
                out.into_inner().map_err(io::IntoInnerError::into_error)?.persist()
            }
        };
        write().map_err(|error| Failure::write(&self.file, error))
    }

    /// Refuses a place that cannot be written, before long work begins. Errors: those of
    /// [`OutputArgs::write`]. A pipe is not opened, because that would wait for its reader.
    pub(crate) fn require_writable(&self) -> Result<(), Failure> {
        let attempt = || match Destination::of(&self.file)? {
            Destination::Stdout | Destination::Stream(_) => Ok(()),
            Destination::File(path) => file::Partial::of(&path).map(drop),
        };
        attempt().map_err(|error| Failure::write(&self.file, error))
    }

    /// The option as one of the command's files.
    pub(crate) fn role(&self) -> Role<'_> {
        Role::output("-o", &self.file)
    }

    /// Whether the result goes to stdout.
    pub(crate) fn is_stdout(&self) -> bool {
        matches!(Destination::of(&self.file), Ok(Destination::Stdout))
    }

    /// Refuses to write binary data to a terminal. Errors: the result goes to stdout, and stdout is
    /// a terminal.
    pub(crate) fn refuse_terminal(&self, what: &str) -> Result<(), Failure> {
        if self.is_stdout() && io::stdout().is_terminal() {
            let message =
                format!("{what} cannot be shown on a terminal: add -o FILE, or redirect stdout");
            return Err(Failure::bad_input(message));
        }
        Ok(())
    }
}

/// Buffered stdout. Flush it, or errors are lost.
///
/// A write fails with [`io::ErrorKind::BrokenPipe`] when the reader has left; [`Failure::write`]
/// turns that into a quiet end.
pub(crate) fn stdout() -> BufWriter<StdoutLock<'static>> {
    BufWriter::new(io::stdout().lock())
}

/// A progress bar over `length` elements named `unit`, on stderr if that is a terminal. Its
/// message, if one is set, shows the current work.
pub(crate) fn progress(length: u64, unit: &str) -> ProgressBar {
    let template = format!("{{bar:30}} {{human_pos}}/{{human_len}} {unit}, {{eta}} left  {{msg}}");
    let style = ProgressStyle::with_template(&template);
    let bar = ProgressBar::new(length);
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    // The bar ticks from a thread of its own, and panics if none can be started.
    if !bar.is_hidden() && startable(1) == 1 {
        bar.enable_steady_tick(Duration::from_millis(200));
    }
    bar
}

/// Prints results to stdout as soon as they are ready, without disturbing the progress bar. Errors:
/// stdout cannot be written.
pub(crate) fn print(bar: &ProgressBar, text: &str) -> Result<(), Failure> {
    let print = || {
        let mut out = stdout();
        out.write_all(text.as_bytes())?;
        out.flush()
    };
    bar.suspend(print).map_err(|error| Failure::write(Path::new("-"), error))
}

/// Prints a message that is not part of the result to stderr.
pub(crate) fn note(message: &str) {
    // A closed stderr does not affect the result.
    _ = writeln!(io::stderr(), "tess: {message}");
}

/// The length, in characters, of the longest line of JSON that [`json`] makes by joining lines.
const LONGEST_ROW: usize = 400;

/// A document as indented JSON with a newline at its end. An object or list that contains no other
/// is on one line.
///
/// # Panics
/// If the document has a map whose keys are not text; no document of this program has one.
pub(crate) fn json(document: &impl serde::Serialize) -> String {
    let pretty = serde_json::to_string_pretty(document).expect("keys are text");
    let mut lines: Vec<String> = Vec::new();
    let mut opened = 0;
    for line in pretty.lines() {
        lines.push(line.to_owned());
        if line.ends_with(['{', '[']) {
            opened = lines.len();
        } else if line.trim_start().starts_with(['}', ']']) && opened > 0 {
            let close = lines.pop().unwrap_or_default();
            let inside: Vec<&str> = lines[opened..].iter().map(|line| line.trim_start()).collect();
            let row = lines[opened - 1].clone() + &inside.join(" ") + close.trim_start();
            if row.len() <= LONGEST_ROW {
                lines.splice(opened - 1.., [row]);
            } else {
                lines.push(close);
            }
            opened = 0;
        }
    }
    lines.join("\n") + "\n"
}
