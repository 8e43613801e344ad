//! Vector files: recorded or expected results, read record by record.
//!
//! `golden/README.md` describes the format. The reader is strict: a file that is truncated, longer
//! than its header announces, empty, or of an unknown kind or version is an error that names the
//! file, the line and the field. Nothing passes because it was missing.

mod cases;
mod coordinate;
mod coordinates;
mod digest;
mod error;
mod formats;
mod header;
mod lines;
mod listing;
mod record;
mod row;
mod rows;
mod words;
mod write;

pub use cases::Cases;
pub use coordinate::fixed;
pub use coordinates::Coordinates;
pub use digest::Fnv1a;
pub(crate) use digest::words_digest;
pub use error::VectorError;
pub use header::{Header, Kind};
pub use listing::Listing;
pub use record::Record;
pub use rows::CsvRow;
pub(crate) use rows::{
    ChainRow, FactorsRow, LocationsRow, PatchRow, PreparationRow, Sizes, Values,
};
pub use write::write_cases;

use crate::quote::quoted;
use header::END;
use lines::Lines;
use row::Row;
use std::io::BufRead;

/// A vector file being read: an iterator over its records that ends after the first error.
///
/// ```
/// use tess_verify::vectors::VectorFile;
///
/// let text = "# tess-vectors 1 kind=locations count=1 source=example\n\
///             split,parity,factor_bucket,contexts_fnv1a64,locations_fnv1a64,locations\n\
///             ruler,odd,63,cbf29ce484222325,cbf29ce484222325,64\n";
/// let mut file = VectorFile::new("example.csv", text.as_bytes())?;
/// let record = file.next().transpose()?.expect("one row");
/// assert_eq!((record.line(), record.case()), (3, None));
/// assert!(file.next().is_none());
/// # Ok::<(), tess_verify::vectors::VectorError>(())
/// ```
#[derive(Debug)]
pub struct VectorFile<R> {
    lines: Lines<R>,
    header: Header,
    records: u64,
    /// Whether the line that marks the end has been read.
    marked: bool,
    ended: bool,
    emptiness: Emptiness,
}

/// Whether a file may have no records.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Emptiness {
    Refused,
    Accepted,
}

impl<R: BufRead> VectorFile<R> {
    /// Reads the header, and the column names if the kind is CSV. `name` is the file's name in
    /// errors.
    ///
    /// # Errors
    /// The file is empty, or its header or column names are not of this format.
    pub fn new(name: impl AsRef<str>, reader: R) -> Result<Self, VectorError> {
        Self::open(name.as_ref(), reader, Emptiness::Refused)
    }

    fn open(name: &str, reader: R, emptiness: Emptiness) -> Result<Self, VectorError> {
        let mut lines = Lines::new(name, reader);
        let header = match lines.next()? {
            Some(first) => Header::parse(first)?,
            None => return Err(lines.error("header", Header::missing("an empty file"))),
        };
        if header.count == Some(0) && emptiness == Emptiness::Refused {
            return Err(lines.error("count", "is 0; a file without records shows nothing"));
        }
        if let Some(columns) = header.kind.columns() {
            let found = lines.expect("columns")?;
            if found.text != columns {
                let found_text = quoted(found.text);
                let message = format!("the column names must be `{columns}`, not {found_text}");
                return Err(found.error("columns", message));
            }
        }
        Ok(Self { lines, header, records: 0, marked: false, ended: false, emptiness })
    }

    /// The contents of the first line.
    pub const fn header(&self) -> &Header {
        &self.header
    }

    /// An error in a record that has been read.
    pub(crate) fn error_at(&self, line: u64, field: &'static str, message: &str) -> VectorError {
        VectorError { line, ..self.lines.error(field, message) }
    }

    /// The next record; `None` after the last.
    fn read(&mut self) -> Result<Option<Record>, VectorError> {
        let (announced, records) = (self.header.count, self.records);
        let is_whole = announced.map_or(self.marked, |announced| announced == records);
        let Some(line) = self.lines.next()? else {
            return if is_whole { Ok(None) } else { Err(self.truncated()) };
        };
        if line.text == END && !self.marked && (announced.is_none() || is_whole) {
            if records == 0 && self.emptiness == Emptiness::Refused {
                return Err(line.error("end", "a file without records shows nothing"));
            }
            self.marked = true;
            return self.read();
        }
        if self.marked || is_whole {
            let text = quoted(line.text);
            let before = match announced {
                Some(count) => format!("the header announces {count}"),
                None => format!("`{END}` marks the end"),
            };
            return Err(line.error("count", format!("{before}, but the file goes on: {text}")));
        }
        self.records += 1;
        match self.header.kind.columns() {
            None => record::read_listing(&mut self.lines, self.records).map(Some),
            Some(columns) => {
                let row = Row::new(self.lines.last(), columns)?;
                record::read_row(self.header.kind, &row).map(Some)
            }
        }
    }

    fn truncated(&self) -> VectorError {
        let records = self.records;
        let before = match self.header.count {
            Some(count) => format!("the header announces {count}"),
            None => format!("the header has no count, so the last line must be `{END}`"),
        };
        let message = format!("{before}, but the file ends after {records}; it is truncated");
        self.lines.error("count", message)
    }
}

impl<R: BufRead> Iterator for VectorFile<R> {
    type Item = Result<Record, VectorError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let record = self.read().transpose();
        self.ended = !matches!(record, Some(Ok(_)));
        record
    }
}

#[cfg(test)]
mod tests;
