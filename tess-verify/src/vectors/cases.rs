//! What was asked: the cases of a vector file, or case lines alone.

use super::header::MAGIC;
use super::lines::Lines;
use super::{VectorError, VectorFile};
use crate::case::Case;
use std::io::BufRead;

/// The cases of a text: of a vector file whose records are single patches, or lines that begin with
/// `case`, between which empty lines and lines that begin with `#` may stand.
///
/// It ends after the first error. A text without a case is an error.
#[derive(Debug)]
pub struct Cases<R> {
    source: Source<R>,
    found: bool,
    ended: bool,
}

#[derive(Debug)]
enum Source<R> {
    File(VectorFile<R>),
    Lines(Lines<R>),
}

impl<R: BufRead> Cases<R> {
    /// Begins to read. `name` is what errors call the text.
    ///
    /// # Errors
    /// A vector file that begins wrongly, or whose records are no single patches.
    pub fn new(name: impl AsRef<str>, mut reader: R) -> Result<Self, VectorError> {
        let is_file = reader.fill_buf().is_ok_and(|text| text.starts_with(MAGIC.as_bytes()));
        let source = if is_file {
            let file = VectorFile::new(name, reader)?;
            if !file.header().kind.has_cases() {
                let kind = crate::names::Named::name(file.header().kind);
                let message = format!("{kind} has no single patches; listings and patches have");
                return Err(file.lines.error("kind", message));
            }
            Source::File(file)
        } else {
            Source::Lines(Lines::new(name.as_ref(), reader))
        };
        Ok(Self { source, found: false, ended: false })
    }

    fn read(&mut self) -> Result<Option<Case>, VectorError> {
        match &mut self.source {
            Source::File(file) => Ok(file.next().transpose()?.and_then(|record| record.case())),
            Source::Lines(lines) => {
                while let Some(line) = lines.next()? {
                    if !line.text.is_empty() && !line.text.starts_with('#') {
                        let case = line.text.parse::<Case>();
                        return case.map(Some).map_err(|e| line.error(e.field, e.message));
                    }
                }
                if self.found { Ok(None) } else { Err(lines.error("case", "there is no case")) }
            }
        }
    }
}

impl<R: BufRead> Iterator for Cases<R> {
    type Item = Result<Case, VectorError>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let case = self.read().transpose();
        self.found = true;
        self.ended = !matches!(case, Some(Ok(_)));
        case
    }
}
