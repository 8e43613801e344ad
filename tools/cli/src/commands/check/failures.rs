//! The records that differ, as a vector file.

use super::record;
use crate::campaign::cases::CaseSet;
use crate::failure::Failure;
use crate::output::{OutputFile, counted, note};
use std::collections::BTreeMap;
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};
use tess_verify::check::{Checked, Report};
use tess_verify::vectors::Header;

/// The file of failing records. It has no count, so it marks its end.
pub(super) struct Failures {
    path: PathBuf,
    state: Mutex<State>,
}

struct State {
    file: BufWriter<OutputFile>,
    records: u64,
    written: io::Result<()>,
    /// The number of the record that is to be written next.
    next: u64,
    /// Checked records after that one, by the number of the first: how many there are, and the text
    /// of those that differ.
    waiting: BTreeMap<u64, (u64, String)>,
}

impl Failures {
    /// Begins a file of the same kind as the checked one.
    ///
    /// # Errors
    /// The file cannot be written.
    pub(super) fn new(path: &Path, header: &Header) -> Result<Self, Failure> {
        if !OutputFile::would_be_file(path) {
            return Err(Failure::bad_input("--failures needs the path of a regular file"));
        }
        let mut file = BufWriter::new(OutputFile::create(path)?);
        // These records are no longer the set that the notes describe.
        let is_kept = |key: &str| key != record::SHARD && !CaseSet::describes(key);
        let notes = header.notes.iter().filter(|(key, _)| is_kept(key)).cloned().collect();
        let header = Header { count: None, notes, ..header.clone() };
        file.write_all(header.head().as_bytes()).map_err(|error| Failure::write(path, error))?;
        let waiting = BTreeMap::new();
        let state = Mutex::new(State { file, records: 0, written: Ok(()), next: 1, waiting });
        Ok(Self { path: path.to_owned(), state })
    }

    /// Adds those of some records that differ. They are written in the order of the checked file,
    /// whichever thread comes first.
    pub(super) fn add(&self, checked: Checked<'_>) {
        let Checked { first, records, different, .. } = checked;
        let pairs = records.iter().zip(different);
        let wrong: Vec<String> =
            pairs.filter(|(_, different)| **different).map(|(one, _)| one.to_string()).collect();
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        let state = &mut *state;
        state.records += wrong.len() as u64;
        state.waiting.insert(first, (records.len() as u64, wrong.concat()));
        while let Some((records, wrong)) = state.waiting.remove(&state.next) {
            state.next += records;
            if state.written.is_ok() {
                state.written = state.file.write_all(wrong.as_bytes());
            }
        }
    }

    /// Ends the file, which has no records if none differs.
    ///
    /// # Errors
    /// The file could not be written.
    pub(super) fn finish(self, report: &Report) -> Result<(), Failure> {
        let Self { path, state } = self;
        let State { mut file, records, written, .. } =
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
