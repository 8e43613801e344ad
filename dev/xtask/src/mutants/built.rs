//! Shaders of a built program: a fault of a shader needs no build.
//!
//! A program has the text of each `.wgsl` file that it includes, byte by byte. The text with a fault takes the same
//! place, so it must have the same length: a shorter one gets spaces at its end, a longer one loses words of comments.
//!
//! ```text
//! program   ... | // needs: layout/topology\n// Corners.\nfn f() { return a; }\n | ...
//! with it   ... | // needs: layout/topology\n//\nfn f() { return a + 1u; }\n    | ...
//! ```
//!
//! Building one crate and linking one program again for each fault takes half a minute; this takes the time of the test.

use crate::command::in_file;
use std::fs;
use std::path::{Path, PathBuf};

/// Writes a copy of `program` that has the shader `text` where it has `original`, and says where it is. `None` if the
/// program cannot take it: it must be built then.
///
/// # Errors
/// The program cannot be read or written.
pub(super) fn with_fault(
    program: &Path,
    text: &str,
    original: &str,
) -> Result<Option<PathBuf>, String> {
    let Some(text) = fitted(text, original.len()) else { return Ok(None) };
    let mut bytes = fs::read(program).map_err(|error| in_file(program, &error))?;
    if replace(&mut bytes, original.as_bytes(), text.as_bytes()) == 0 {
        return Ok(None);
    }
    let changed = program.with_extension("fault");
    // A copy keeps the permission to run.
    fs::copy(program, &changed).map_err(|error| in_file(&changed, &error))?;
    fs::write(&changed, bytes).map_err(|error| in_file(&changed, &error))?;
    Ok(Some(changed))
}

/// The same WGSL in this many bytes, if its comments are long enough. The first line says what a file needs, so it
/// stays.
fn fitted(text: &str, length: usize) -> Option<String> {
    let mut surplus = text.len().saturating_sub(length);
    let mut fitted = String::with_capacity(length);
    for (number, line) in text.split_inclusive('\n').enumerate() {
        let words = line.trim_end();
        // Two slashes stay.
        let comment = words.find("//").map_or(0, |begin| words.len() - begin - 2);
        let gone = if number == 0 { 0 } else { surplus.min(comment) };
        surplus -= gone;
        fitted.push_str(words.get(..words.len() - gone)?);
        fitted.push_str(&line[words.len()..]);
    }
    fitted.extend(std::iter::repeat_n(' ', length.saturating_sub(fitted.len())));
    (surplus == 0).then_some(fitted)
}

/// Puts `to` wherever `from` stands, which is as long, and says in how many places.
fn replace(bytes: &mut [u8], from: &[u8], to: &[u8]) -> usize {
    let mut places = 0;
    let mut at = 0;
    while let Some(next) = bytes[at..].windows(from.len()).position(|window| window == from) {
        bytes[at + next..][..to.len()].copy_from_slice(to);
        at += next + to.len();
        places += 1;
    }
    places
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "// needs: a\n// Corners.\nfn f() { return a; } // of a\n";

    #[test]
    fn a_text_keeps_its_length() {
        let shorter = TEXT.replace("return a;", "");
        let fitted_shorter = fitted(&shorter, TEXT.len()).expect("there are spaces");
        assert_eq!(fitted_shorter, format!("{shorter}         "), "spaces at its end");
        let longer = TEXT.replace("return a;", "return a + 12u;");
        let expected = "// needs: a\n// Co\nfn f() { return a + 12u; } // of a\n";
        let cut = fitted(&longer, TEXT.len()).expect("the comments are longer");
        assert_eq!((cut.len(), cut), (TEXT.len(), expected.to_owned()), "words of a comment");
        assert_eq!(
            fitted(&TEXT.replace("return", "some more than that, and more"), TEXT.len()),
            None,
            "too long"
        );
    }

    #[test]
    fn a_shader_is_found_wherever_a_program_has_it() {
        let mut bytes = b"\x7fELF..one two..one.".to_vec();
        assert_eq!(replace(&mut bytes, b"one", b"own"), 2, "places");
        assert_eq!(bytes, b"\x7fELF..own two..own.", "nothing else");
        assert_eq!(replace(&mut bytes, b"three", b"33333"), 0, "it is not there");
    }
}
