//! Where results go: stdout, or a file that is there whole or not at all.

use crate::failure::Failure;
use indicatif::{ProgressBar, ProgressStyle};
use std::fs;
use std::io::{self, BufWriter, ErrorKind, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

/// The `-o` option.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct OutputArgs {
    /// File to write; - is stdout
    #[arg(short = 'o', long = "out", value_name = "FILE", default_value = "-")]
    pub(crate) file: PathBuf,
}

impl OutputArgs {
    /// Writes `content` to stdout or to the file.
    ///
    /// # Errors
    /// The place cannot be written; a file that was there is then as it was.
    pub(crate) fn write(&self, content: &[u8]) -> Result<(), Failure> {
        self.stream(|out| out.write_all(content))
    }

    /// Writes to stdout or to the file what `content` writes, as it comes.
    ///
    /// # Errors
    /// The place cannot be written; a file that was there is then as it was.
    pub(crate) fn stream(
        &self,
        content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Failure> {
        let path = &self.file;
        let written =
            if path.as_os_str() == "-" { write_stdout(content) } else { write_file(path, content) };
        written.map_err(|error| Failure::file("write", path, &error))
    }
}

fn write_stdout(content: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    let mut out = stdout();
    content(&mut out)?;
    out.flush()
}

/// Writes a sibling first, then renames it. What is not a regular file is written directly.
fn write_file(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    if path.metadata().is_ok_and(|metadata| !metadata.is_file()) {
        return write_directly(path, content);
    }
    let mut name = path.file_name().unwrap_or_default().to_owned();
    name.push(format!(".{}.partial", std::process::id()));
    let partial = path.with_file_name(name);
    let written = write_directly(&partial, content).and_then(|()| fs::rename(&partial, path));
    if written.is_err() {
        // It may never have been created; the first error is the one to report.
        _ = fs::remove_file(&partial);
    }
    written
}

fn write_directly(
    path: &Path,
    content: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut out = BufWriter::new(fs::File::create(path)?);
    content(&mut out)?;
    out.flush()
}

/// Stdout, buffered, that stays quiet when its reader leaves.
#[must_use]
pub(crate) fn stdout() -> BufWriter<UntilClosed<io::StdoutLock<'static>>> {
    BufWriter::new(UntilClosed { inner: io::stdout().lock(), closed: false })
}

/// A writer that drops what comes after its reader has closed the pipe, so that a command still
/// ends with the exit code that it came to.
#[derive(Debug)]
pub(crate) struct UntilClosed<W> {
    inner: W,
    closed: bool,
}

impl<W> UntilClosed<W> {
    fn note<T>(&mut self, result: io::Result<T>, if_closed: T) -> io::Result<T> {
        match result {
            Err(error) if error.kind() == ErrorKind::BrokenPipe => {
                self.closed = true;
                Ok(if_closed)
            }
            other => other,
        }
    }
}

impl<W: Write> Write for UntilClosed<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        if self.closed {
            return Ok(bytes.len());
        }
        let result = self.inner.write(bytes);
        self.note(result, bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.closed {
            return Ok(());
        }
        let result = self.inner.flush();
        self.note(result, ())
    }
}

/// A progress bar over `length` of what `unit` names, on stderr if that is a terminal. Its message,
/// if one is set, says what is being done.
#[must_use]
pub(crate) fn progress(length: u64, unit: &str) -> ProgressBar {
    let template = format!("{{bar:30}} {{human_pos}}/{{human_len}} {unit}, {{eta}} left  {{msg}}");
    let style = ProgressStyle::with_template(&template);
    let bar = ProgressBar::new(length);
    bar.set_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()));
    bar.enable_steady_tick(Duration::from_millis(200));
    bar
}

/// A document as indented JSON with a newline at its end.
///
/// # Panics
/// If the document has a map whose keys are not text; none of this program's has.
pub(crate) fn json(document: &impl serde::Serialize) -> String {
    let mut text = serde_json::to_string_pretty(document).expect("keys are text");
    text.push('\n');
    text
}
