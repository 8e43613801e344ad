//! The input of commands: a file, or stdin if the path is `-`.

use crate::failure::Failure;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read};
use std::path::Path;
use tess_verify::vectors::Cases;

/// Text from a file or from stdin.
pub(crate) type Reader = Box<dyn BufRead + Send>;

/// The name of a path in messages.
pub(crate) fn name(path: &Path) -> String {
    if path.as_os_str() == "-" { "stdin".to_owned() } else { path.display().to_string() }
}

/// Opens an input. Errors: a file that cannot be opened.
pub(crate) fn open(path: &Path) -> io::Result<Reader> {
    Ok(match path.to_str() {
        Some("-") => Box::new(BufReader::new(io::stdin())),
        _ => Box::new(BufReader::new(File::open(path)?)),
    })
}

/// Does what [`open`] does; a failure has exit code 2.
///
/// # Errors
/// The file cannot be opened.
pub(crate) fn reader(path: &Path) -> Result<Reader, Failure> {
    open(path).map_err(|error| Failure::file("read", path, &error))
}

/// The cases of a file; `-` is stdin.
///
/// # Errors
/// The file cannot be read, or has a wrong head.
pub(crate) fn cases(path: &Path) -> Result<Cases<Reader>, Failure> {
    Cases::new(name(path), reader(path)?).map_err(Failure::bad_input)
}

/// A whole text of at most `max` bytes, so that an endless device does not fill the memory. Errors:
/// the text cannot be read, is longer, or is not UTF-8.
pub(crate) fn text(path: &Path, max: u64) -> io::Result<String> {
    let mut text = String::new();
    let read = open(path)?.take(max + 1).read_to_string(&mut text)?;
    if read as u64 > max {
        return Err(io::Error::other(format!("it has more than {max} bytes")));
    }
    Ok(text)
}
