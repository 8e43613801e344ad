//! Cases to answer: those of a vector file, or plain case lines.

use super::header::MAGIC;
use super::lines::Lines;
use super::{Emptiness, Header, VectorError, VectorFile};
use crate::case::{Case, CaseError};
use std::io::{BufRead, Chain, Cursor, Read};

/// The cases of a text: of a vector file whose records are single patches, or of lines that begin
/// with `case`. Such lines may have empty lines and lines that begin with `#` between them.
///
/// The iterator ends after the first error. A text without a case is an error.
#[derive(Debug)]
pub struct Cases<R> {
    source: CaseSource<R>,
    /// Whether a text without a case is accepted, if a header or a remark shows that this is
    /// intended.
    may_be_empty: bool,
    found: bool,
    ended: bool,
}

#[derive(Debug)]
enum CaseSource<R> {
    File(VectorFile<Begun<R>>),
    Lines(Lines<Begun<R>>),
}

/// A reader, preceded by the bytes that were already taken from it.
type Begun<R> = Chain<Cursor<Vec<u8>>, R>;

/// Takes from the reader the longest common beginning of its text and `expected`, however few bytes
/// the reader supplies at a time.
fn common_beginning(reader: &mut impl BufRead, expected: &[u8]) -> Vec<u8> {
    let mut taken = Vec::new();
    while taken.len() < expected.len() {
        // A read error is reported later, as an error of the first line.
        let Ok(buffer) = reader.fill_buf() else { break };
        let pairs = buffer.iter().zip(&expected[taken.len()..]);
        let more = pairs.take_while(|(found, expected)| found == expected).count();
        let is_all = more > 0 && more == buffer.len();
        taken.extend_from_slice(&buffer[..more]);
        reader.consume(more);
        if !is_all {
            break;
        }
    }
    taken
}

impl<R: BufRead> Cases<R> {
    /// Begins to read. `name` is the text's name in errors.
    ///
    /// # Errors
    /// A vector file whose head is wrong, or whose records are not single patches.
    pub fn new(name: impl AsRef<str>, reader: R) -> Result<Self, VectorError> {
        Self::open(name.as_ref(), reader, Emptiness::Refused)
    }

    /// Does what [`Self::new`] does, but accepts a vector file without records and a text of only
    /// remarks, as a baseline may be. An empty text is still an error.
    ///
    /// # Errors
    /// As for [`Self::new`].
    pub(crate) fn maybe_empty(name: impl AsRef<str>, reader: R) -> Result<Self, VectorError> {
        Self::open(name.as_ref(), reader, Emptiness::Accepted)
    }

    fn open(name: &str, mut reader: R, emptiness: Emptiness) -> Result<Self, VectorError> {
        let begun = common_beginning(&mut reader, MAGIC.as_bytes());
        let is_file = begun.len() == MAGIC.len();
        let reader = Cursor::new(begun).chain(reader);
        let source = if is_file {
            let file = VectorFile::open(name, reader, emptiness)?;
            if !file.header().kind.has_cases() {
                let kind = crate::names::Named::name(file.header().kind);
                let message = format!(
                    "records of the kind {kind} are not single patches; use listings or patches"
                );
                return Err(file.lines.error("kind", message));
            }
            CaseSource::File(file)
        } else {
            CaseSource::Lines(Lines::new(name, reader))
        };
        let may_be_empty = emptiness == Emptiness::Accepted;
        Ok(Self { source, may_be_empty, found: false, ended: false })
    }

    /// The header of a vector file; `None` for plain case lines.
    pub const fn header(&self) -> Option<&Header> {
        match &self.source {
            CaseSource::File(file) => Some(file.header()),
            CaseSource::Lines(_) => None,
        }
    }

    /// The next case, through `of_case` from a record, or through `parse` from a line and its
    /// number.
    pub(crate) fn read<T>(
        &mut self,
        of_case: impl FnOnce(Case) -> T,
        parse: impl FnOnce(&str, u64) -> Result<T, CaseError>,
    ) -> Result<Option<T>, VectorError> {
        match &mut self.source {
            CaseSource::File(file) => {
                Ok(file.next().transpose()?.and_then(|record| record.case()).map(of_case))
            }
            CaseSource::Lines(lines) => {
                while let Some(line) = lines.next()? {
                    if line.text.starts_with('#') {
                        self.found |= self.may_be_empty;
                    } else if !line.text.is_empty() {
                        self.found = true;
                        let parsed = parse(line.text, line.place.line);
                        return parsed.map(Some).map_err(|e| line.error(e.field, e.message));
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
        let case = self.read(|case| case, |text, _| text.parse()).transpose();
        self.ended = !matches!(case, Some(Ok(_)));
        case
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::io::BufReader;

    const LINE: &str = "case isoline integer line ruler 40000000 40400000\n";

    /// Only a text that says that it is empty may be.
    #[test]
    fn texts_without_a_case() {
        let header = format!("{MAGIC} 1 kind=listings count=0 source=a\n");
        let count = |cases: Result<Cases<&[u8]>, VectorError>| -> Option<usize> {
            cases.and_then(Iterator::collect::<Result<Vec<_>, _>>).ok().map(|cases| cases.len())
        };
        for (text, found) in [
            (header.as_str(), Some(0)),
            ("# none\n", Some(0)),
            ("", None),
            ("\n \n", None),
            (LINE, Some(1)),
        ] {
            assert_eq!(count(Cases::maybe_empty("a", text.as_bytes())), found, "{text:?}");
            let demanded = found.filter(|cases| *cases > 0);
            assert_eq!(count(Cases::new("a", text.as_bytes())), demanded, "{text:?}");
        }
    }

    /// A pipe may supply few bytes at a time.
    #[test]
    fn the_format_does_not_depend_on_how_much_comes_at_once() {
        let listing = format!("{LINE}points 0\nindices 0\nend\n");
        let file = format!("{MAGIC} 1 kind=listings count=1 source=a\n{listing}");
        for text in [file.as_str(), LINE, &format!("# a remark\n{LINE}")] {
            for capacity in 1..=2 * MAGIC.len() {
                let reader = BufReader::with_capacity(capacity, text.as_bytes());
                let cases: Result<Vec<_>, _> = Cases::new("a", reader).and_then(Iterator::collect);
                let cases = cases.unwrap_or_else(|error| panic!("{capacity} bytes: {error}"));
                assert_eq!(cases.len(), 1, "{capacity} bytes of {text}");
            }
        }
        assert!(Cases::new("a", &b"# tess"[..]).is_ok_and(|mut cases| cases.all(|c| c.is_err())));
    }
}
