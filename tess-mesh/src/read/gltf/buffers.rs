//! The contents of buffers: from the file itself, from base64 in it, or from a file next to it.

use super::document::{Document, broken};
use crate::budget::Budget;
use crate::read::beside;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use std::borrow::Cow;
use std::cell::{OnceCell, RefCell};
use std::path::{Path, PathBuf};

/// The buffers of a document, each loaded when it is needed.
#[derive(Debug)]
pub(crate) struct Buffers<'a> {
    /// The contents of each, exactly as long as the buffer declares.
    contents: Vec<OnceCell<Result<Cow<'a, [u8]>, String>>>,
    folder: Option<&'a Path>,
    blob: Option<&'a [u8]>,
    budget: &'a Budget,
    /// The other files that were read.
    pub(crate) files: RefCell<Vec<PathBuf>>,
}

impl<'a> Buffers<'a> {
    /// The buffers of a document in `folder`; the first may be in the `blob` of a GLB file.
    pub(crate) fn new(
        count: usize,
        folder: Option<&'a Path>,
        blob: Option<&'a [u8]>,
        budget: &'a Budget,
    ) -> Self {
        let contents = (0..count).map(|_| OnceCell::new()).collect();
        Self { contents, folder, blob, budget, files: RefCell::default() }
    }

    /// The contents of a buffer. Errors: a buffer without contents or with too few bytes; a URI
    /// that leads out of the folder; a file that cannot be read or is not an ordinary file; too
    /// many bytes in all.
    pub(crate) fn get(&self, document: &Document, number: usize) -> Result<&[u8], String> {
        let content = self.contents[number].get_or_init(|| self.load(document, number));
        content.as_ref().map(|content| &**content).map_err(Clone::clone)
    }

    fn load(&self, document: &Document, number: usize) -> Result<Cow<'a, [u8]>, String> {
        let path = format!("buffers[{number}]");
        let buffer = document.buffers.get(number, &path)?;
        let length = buffer.byte_length;
        let content = match &buffer.uri {
            Some(uri) => {
                let charged = self.budget.charge(length, 1, "bytes");
                charged.map_err(|what| broken(format!("{path}.byteLength"), what))?;
                let read = from_uri(uri, self.folder, length);
                let (bytes, file) = read.map_err(|what| broken(format!("{path}.uri"), what))?;
                self.files.borrow_mut().extend(file);
                Cow::Owned(bytes)
            }
            None => {
                let blob = self.blob.filter(|_| number == 0);
                Cow::Borrowed(blob.ok_or_else(|| {
                    broken(&path, "it has no uri, and is not the first buffer of a GLB file")
                })?)
            }
        };
        exactly(content, length).map_err(|what| broken(&path, what))
    }
}

fn exactly(content: Cow<'_, [u8]>, length: u64) -> Result<Cow<'_, [u8]>, String> {
    let too_short = || format!("it has {} of its {length} bytes", content.len());
    let end = usize::try_from(length).ok().filter(|&end| end <= content.len());
    let end = end.ok_or_else(too_short)?;
    Ok(match content {
        Cow::Borrowed(bytes) => Cow::Borrowed(&bytes[..end]),
        Cow::Owned(mut bytes) => {
            bytes.truncate(end);
            Cow::Owned(bytes)
        }
    })
}

/// The bytes that a URI refers to, and the file from which they were read.
fn from_uri(
    uri: &str,
    folder: Option<&Path>,
    length: u64,
) -> Result<(Vec<u8>, Option<PathBuf>), String> {
    if let Some(data) = uri.strip_prefix("data:") {
        let text = data.split_once(";base64,").ok_or("data without `;base64,` is not read")?.1;
        let bytes = BASE64_STANDARD.decode(text).map_err(|error| error.to_string())?;
        return Ok((bytes, None));
    }
    let relative = file_name(uri)?;
    let file = beside::path(folder, &relative)?;
    let bytes = beside::read(&file, folder.unwrap_or(Path::new("")), length)?;
    Ok((bytes, Some(file)))
}

/// The relative path of a URI that names a file in the model's folder or below it.
fn file_name(uri: &str) -> Result<PathBuf, String> {
    let outside = || format!("`{uri}` is not a file in the model's folder or below it");
    let scheme = uri.split(['/', '?', '#']).next().is_some_and(|first| first.contains(':'));
    let path = PathBuf::from(percent_decoded(uri).ok_or_else(outside)?);
    if scheme || !beside::is_below(&path) { Err(outside()) } else { Ok(path) }
}

/// Decodes percent encoding (RFC 3986, section 2.1); `None` if a `%` is not followed by two digits,
/// or the result is not UTF-8.
fn percent_decoded(uri: &str) -> Option<String> {
    let mut pieces = uri.split('%');
    let mut bytes = pieces.next()?.as_bytes().to_vec();
    for piece in pieces {
        let (digits, rest) = piece.split_at_checked(2)?;
        if !digits.bytes().all(|digit| digit.is_ascii_hexdigit()) {
            return None;
        }
        bytes.push(u8::from_str_radix(digits, 16).ok()?);
        bytes.extend(rest.as_bytes());
    }
    String::from_utf8(bytes).ok().filter(|path| !path.contains('\0'))
}
