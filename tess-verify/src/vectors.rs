//! Vector files: recorded or expected results, read record by record.
//!
//! `golden/README.md` describes the format. The reader is strict: a file that is truncated, longer
//! than its header says, empty, or of an unknown kind or version is an error that names file,
//! line and field, so that nothing passes because it was not there.

mod error;
mod header;
mod listing;
mod record;
mod row;
mod write;

pub use error::VectorError;
pub use header::{Header, Kind};
pub use listing::{Listing, primitive_size};
pub use record::{
    ChainRow, FactorsRow, LocationsRow, PatchRow, PreparationRow, Record, Recorded, Sizes,
};
pub use write::{write_listings, write_patches};

use error::Place;
use row::Row;
use std::io::BufRead;

/// Lines of a text, numbered from 1, without their ends.
#[derive(Debug)]
pub(crate) struct Lines<R> {
    reader: R,
    place: Place,
}

impl<R: BufRead> Lines<R> {
    /// The next line; `None` at the end.
    fn next(&mut self) -> Result<Option<String>, VectorError> {
        self.place.line += 1;
        let mut line = String::new();
        match self.reader.read_line(&mut line) {
            Ok(0) => Ok(None),
            Ok(_) => Ok(Some(line.trim_end_matches(['\n', '\r']).to_owned())),
            Err(error) => Err(self.place.error("line", format!("cannot be read: {error}"))),
        }
    }

    /// The next line, which must be there.
    fn expect(&mut self, what: &'static str) -> Result<String, VectorError> {
        let line = self.next()?;
        line.ok_or_else(|| self.place.error(what, "the file ends here; it is truncated"))
    }
}

/// A vector file that is being read: an iterator over its records that ends after the first error.
///
/// ```
/// use tess_verify::vectors::{Record, VectorFile};
///
/// let text = "# tess-vectors 1 kind=locations count=1 source=example\n\
///             split,parity,factor_bucket,contexts_fnv1a64,locations_fnv1a64,locations\n\
///             ruler,odd,63,cbf29ce484222325,cbf29ce484222325,64\n";
/// let mut file = VectorFile::new("example.csv", text.as_bytes())?;
/// let Some(Record::Locations(row)) = file.next().transpose()? else { panic!("one row") };
/// assert_eq!(row.bucket, 63);
/// assert!(file.next().is_none());
/// # Ok::<(), tess_verify::vectors::VectorError>(())
/// ```
#[derive(Debug)]
pub struct VectorFile<R> {
    lines: Lines<R>,
    header: Header,
    records: u64,
    ended: bool,
}

impl<R: BufRead> VectorFile<R> {
    /// Reads the header, and the column names of a CSV kind. `name` is what errors call the file.
    ///
    /// # Errors
    /// An empty file, or a header or column names that are not those of this format.
    pub fn new(name: impl Into<String>, reader: R) -> Result<Self, VectorError> {
        let place = Place { file: name.into().into(), line: 0 };
        let mut lines = Lines { reader, place };
        let first = lines.next()?;
        let header = Header::parse(first.as_deref().unwrap_or(""), &lines.place)?;
        if let Some(columns) = header.kind.columns() {
            let found = lines.expect("columns")?;
            let expected = columns.join(",");
            if found != expected {
                let message = format!("the column names must be `{expected}`, not `{found}`");
                return Err(lines.place.error("columns", message));
            }
        }
        Ok(Self { lines, header, records: 0, ended: false })
    }

    /// What the first line says.
    pub const fn header(&self) -> &Header {
        &self.header
    }

    /// The next record with the line that it starts on; `None` after the last.
    fn read(&mut self) -> Result<Option<Record>, VectorError> {
        let line = self.lines.next()?;
        let announced = self.header.count;
        let Some(line) = line else {
            if self.records == announced {
                return Ok(None);
            }
            let message = format!(
                "the header announces {announced}, but the file ends after {}; it is truncated",
                self.records
            );
            return Err(self.lines.place.error("count", message));
        };
        if self.records == announced {
            let message =
                format!("the header announces {announced}, but the file goes on: `{line}`");
            return Err(self.lines.place.error("count", message));
        }
        self.records += 1;
        let record = match self.header.kind.columns() {
            None => Record::Listing(listing::read(&mut self.lines, &line)?),
            Some(columns) => {
                let row = Row::new(&line, columns, &self.lines.place)?;
                record::read(self.header.kind, &row)?
            }
        };
        Ok(Some(record))
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
