//! The records that differ, as a vector file.

use crate::failure::Failure;
use crate::output::{OutputFile, counted, note};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use tess_verify::checker::{Checked, Report};
use tess_verify::vectors::Header;

/// The file of failing records. It has no count: it marks its end.
pub(super) struct Failures {
    path: PathBuf,
    state: Mutex<State>,
}

struct State {
    file: BufWriter<OutputFile>,
    records: u64,
    written: io::Result<()>,
}

impl Failures {
    /// Begins a file of the same kind as the one that is checked.
    ///
    /// # Errors
    /// It cannot be written.
    pub(super) fn new(path: &Path, header: &Header) -> Result<Self, Failure> {
        if !OutputFile::would_be_file(path) {
            return Err(Failure::bad_input("--failures writes a file, and this is none"));
        }
        let mut file = BufWriter::new(OutputFile::create(path)?);
        let header = Header { count: None, ..header.clone() };
        let columns = header.kind.columns().map(|columns| columns.join(",") + "\n");
        let begun = write!(file, "{header}\n{}", columns.unwrap_or_default());
        begun.map_err(|error| Failure::write(path, error))?;
        let state = Mutex::new(State { file, records: 0, written: Ok(()) });
        Ok(Self { path: path.to_owned(), state })
    }

    /// Adds what differs of some records.
    pub(super) fn add(&self, checked: Checked<'_>) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let pairs = checked.records.iter().zip(checked.different);
        for (record, _) in pairs.filter(|(_, different)| **different) {
            state.records += 1;
            if state.written.is_ok() {
                state.written = write!(state.file, "{record}");
            }
        }
    }

    /// Ends the file, which has no record if none differs.
    ///
    /// # Errors
    /// It could not be written.
    pub(super) fn finish(self, report: &Report) -> Result<(), Failure> {
        let Self { path, state } = self;
        let State { mut file, records, written } =
            state.into_inner().unwrap_or_else(PoisonError::into_inner);
        let others = report.mismatches.saturating_sub(records);
        if others > 0 {
            let path = path.display();
            let left = counted(others, "difference");
            note(&format!(
                "{left} left out of {path}: cases without a record, and records that are right for the \
                 case that they state but answer another or contradict one before them"
            ));
        }
        let ended = written.and_then(|()| writeln!(file, "# end"));
        let ended = ended.and_then(|()| file.into_inner().map_err(io::IntoInnerError::into_error));
        ended.and_then(OutputFile::finish).map_err(|error| Failure::write(&path, error))
    }
}
