//! Results that are printed as soon as they are ready, and what is still to come.

use super::ending::{self, Guard};
use super::{note, stdout};
use indicatif::ProgressBar;
use std::collections::VecDeque;
use std::fmt;
use std::io::{self, Write};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// What stands around the rows.
#[derive(Clone, Debug, Default)]
pub(crate) struct Frame {
    /// Before the first row.
    pub(crate) opening: String,
    /// Between two rows.
    pub(crate) between: &'static str,
    /// After the last row.
    pub(crate) closing: &'static str,
    /// All there is if there is no row.
    pub(crate) empty: &'static str,
}

/// Rows on stdout. If a signal ends the program, what was printed is whole, and what is still to
/// come is named on stderr.
pub(crate) struct Rows {
    state: Arc<Mutex<State>>,
    _guard: Guard,
}

struct State {
    frame: Frame,
    printed: usize,
    to_come: VecDeque<String>,
}

impl fmt::Debug for Rows {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Rows").finish_non_exhaustive()
    }
}

impl Rows {
    /// Rows to come, by name.
    ///
    /// # Errors
    /// Signals cannot be listened to.
    pub(crate) fn new(frame: Frame, to_come: impl IntoIterator<Item = String>) -> io::Result<Self> {
        let to_come = to_come.into_iter().collect();
        let (state, guard) = ending::guarded(|| {
            let state = Arc::new(Mutex::new(State { frame, printed: 0, to_come }));
            let at_end = Arc::clone(&state);
            Ok((state, Box::new(move || lock(&at_end).interrupted())))
        })?;
        Ok(Self { state, _guard: guard })
    }

    /// Prints the next row, with the progress bar out of its way.
    ///
    /// # Errors
    /// Stdout cannot be written.
    pub(crate) fn print(&self, bar: &ProgressBar, row: &str) -> io::Result<()> {
        let mut state = lock(&self.state);
        bar.suspend(|| state.print(row))?;
        state.to_come.pop_front();
        Ok(())
    }

    /// Leaves the next row out.
    pub(crate) fn skip(&self) {
        lock(&self.state).to_come.pop_front();
    }

    /// Prints what stands after the rows.
    ///
    /// # Errors
    /// Stdout cannot be written.
    pub(crate) fn finish(self) -> io::Result<()> {
        lock(&self.state).close()
    }
}

fn lock(state: &Mutex<State>) -> MutexGuard<'_, State> {
    state.lock().unwrap_or_else(PoisonError::into_inner)
}

impl State {
    fn print(&mut self, row: &str) -> io::Result<()> {
        let before = if self.printed == 0 { &self.frame.opening } else { self.frame.between };
        let mut out = stdout();
        write!(out, "{before}{row}")?;
        out.flush()?;
        self.printed += 1;
        Ok(())
    }

    fn close(&self) -> io::Result<()> {
        let end = if self.printed == 0 { self.frame.empty } else { self.frame.closing };
        let mut out = stdout();
        out.write_all(end.as_bytes())?;
        out.flush()
    }

    fn interrupted(&self) {
        if self.close().is_err() {
            return; // nobody is reading
        }
        let missing: Vec<&str> = self.to_come.iter().map(String::as_str).collect();
        if !missing.is_empty() {
            note(&format!("interrupted; left out: {}", missing.join("; ")));
        }
    }
}
