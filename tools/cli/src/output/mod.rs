//! Where results go: stdout, a pipe, or a file that is there whole or not at all.
//!
//! [`mod@file`] is the one way in which commands write files, [`stdout()`] the one way to stdout.
//! Both name [`ending`] what must not stay behind when a signal ends the process. [`form`] chooses
//! the form of a file by its name. [`earlier`] removes what a run before this one left.

mod distinct;
mod earlier;
pub(crate) mod ending;
mod file;
mod folder;
pub(crate) mod form;

use crate::failure::Failure;
use crate::threads::startable;
pub(crate) use distinct::{Role, refuse_shared};
pub(crate) use earlier::remove_earlier;
use file::Destination;
pub(crate) use file::{OutputFile, create_unless_there};
pub(crate) use folder::{NewFolder, refuse_stdout};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::{self, BufWriter, IsTerminal, StdoutLock, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

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
    /// Writes `content` to stdout or to the file. Errors: the place cannot be written; a file that
    /// was there is then as it was.
    pub(crate) fn write(&self, content: &[u8]) -> Result<(), Failure> {
        self.stream(|out| out.write_all(content))
    }

    /// Writes to stdout or to the file what `content` writes, as it comes. Errors: the place cannot
    /// be written; a file that was there is then as it was.
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

    /// Refuses a place that cannot be written, before long work for it. Errors: as
    /// [`OutputArgs::write`] would; but a pipe is not opened, which waits for its reader.
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

    /// Refuses to write bytes that are no text to a terminal. Errors: the result goes to stdout,
    /// and that is a terminal.
    pub(crate) fn refuse_terminal(&self, what: &str) -> Result<(), Failure> {
        if self.is_stdout() && io::stdout().is_terminal() {
            let message =
                format!("{what} is no text for a terminal: add -o FILE, or redirect stdout");
            return Err(Failure::bad_input(message));
        }
        Ok(())
    }
}

/// Stdout, buffered. It must be flushed, or errors are lost.
///
/// A write fails with [`io::ErrorKind::BrokenPipe`] when the reader has left;
/// [`Failure::write`] makes that a quiet end.
pub(crate) fn stdout() -> BufWriter<StdoutLock<'static>> {
    BufWriter::new(io::stdout().lock())
}

/// A progress bar over `length` of what `unit` names, on stderr if that is a terminal. Its message,
/// if one is set, says what is being done.
pub(crate) fn progress(length: u64, unit: &str) -> ProgressBar {
    let template = format!("{{bar:30}} {{human_pos}}/{{human_len}} {unit}, {{eta}} left  {{msg}}");
    let style = ProgressStyle::with_template(&template);
    let bar = ProgressBar::new(length);
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    // The bar ticks from a thread, and panics if there is none.
    if !bar.is_hidden() && startable(1) == 1 {
        bar.enable_steady_tick(Duration::from_millis(200));
    }
    bar
}

/// Prints results to stdout as soon as they are ready, with the progress bar out of their way.
/// Errors: stdout cannot be written.
pub(crate) fn print(bar: &ProgressBar, text: &str) -> Result<(), Failure> {
    let print = || {
        let mut out = stdout();
        out.write_all(text.as_bytes())?;
        out.flush()
    };
    bar.suspend(print).map_err(|error| Failure::write(Path::new("-"), error))
}

/// A number with what it counts: `1 point`, `2 points`.
pub(crate) fn counted(number: u64, one: &str) -> String {
    let ending = match number {
        1 => "",
        _ if one.ends_with("ch") => "es",
        _ => "s",
    };
    format!("{number} {one}{ending}")
}

/// Says something on stderr that is no part of the result.
pub(crate) fn note(message: &str) {
    // A closed stderr does not change the result.
    _ = writeln!(io::stderr(), "tess: {message}");
}

/// Characters of the longest line of JSON that [`json`] joins.
const LONGEST_ROW: usize = 400;

/// A document as indented JSON with a newline at its end. An object or a list that has no other
/// inside is one line.
///
/// # Panics
/// If the document has a map whose keys are not text; none of this program's has.
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
