//! Removes the results of an earlier run that this run will replace, before anything can fail.
//!
//! ```text
//! tess check - --cases a.txt --report r.jsonl     r.jsonl has said "done" since yesterday
//!                                                 1. r.jsonl is removed   2. stdin is empty: exit code 2
//! ```
//!
//! Other programs trust these files, so a run that ends early, for any reason, must not leave old
//! ones. That is why this module looks at the words and not at parsed options: the command line may
//! not even be valid. A file is kept if its beginning shows another kind of file, and also if the
//! command reads it.

use super::distinct::Role;
use super::file::{Destination, is_gone};
use crate::failure::Failure;
use std::ffi::{OsStr, OsString};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// A kind of file, recognized by its beginning.
#[derive(Clone, Copy, Debug)]
struct TrustedForm {
    option: &'static str,
    name: &'static str,
    /// The file begins with this,
    begins: &'static str,
    /// and contains this in its first bytes.
    has: &'static str,
}

/// The number of bytes that are examined.
const BEGINNING: u64 = 4096;

const fn form(
    option: &'static str,
    name: &'static str,
    [begins, has]: [&'static str; 2],
) -> TrustedForm {
    TrustedForm { option, name, begins, has }
}

const UCIS: [&str; 2] = ["<?xml", "<UCIS"];
const REPORT: TrustedForm = form("--report", "report", ["{", "\"tess-report "]);
const JUNIT: TrustedForm = form("--junit", "JUnit file", ["<", "<testsuite"]);
const CHECK: [TrustedForm; 3] =
    [REPORT, JUNIT, form("--failures", "vector file", ["# tess-vectors", ""])];
const MERGE: [TrustedForm; 1] = [JUNIT];
const COVERAGE: [TrustedForm; 1] = [form("--merged", "coverage file", UCIS)];

/// The outputs of a command that others trust once it has ended. A file to which a command adds,
/// such as that of `--coverage` of other commands, is not one of them: it stays unchanged.
fn trusted(command: &OsStr) -> &'static [TrustedForm] {
    match command.to_str() {
        Some("check") => &CHECK,
        Some("merge") => &MERGE,
        Some("coverage") => &COVERAGE,
        _ => &[REPORT, JUNIT],
    }
}

/// A trusted output that the words name.
struct Named {
    form: TrustedForm,
    path: PathBuf,
    /// The index of the word that has the path.
    at: usize,
}

/// Removes the outputs of earlier runs that these words of a command line name; the first word is
/// the program. Errors: the first file that is kept because it is of another kind, or that cannot
/// be removed. The remaining ones are removed nevertheless.
pub(crate) fn remove_earlier(words: &[OsString]) -> Result<(), Failure> {
    let forms = words.get(1).map_or(&[][..], |command| trusted(command));
    // After `--` there are no more options.
    let end = words.iter().position(|word| word == "--").unwrap_or(words.len());
    let named: Vec<Named> = (2..end).flat_map(|at| named(&words[..end], at, forms)).collect();
    let mut removed = Ok(());
    for output in &named {
        let others = (2..words.len()).filter(|at| named.iter().all(|output| output.at != *at));
        let others = others.flat_map(|at| [Some(&*words[at]), value(&words[at])]).flatten();
        removed = removed.and(output.remove(others));
    }
    removed
}

/// The outputs that a word names, by itself or through the next word.
fn named(words: &[OsString], at: usize, forms: &'static [TrustedForm]) -> Vec<Named> {
    let named = |form: &TrustedForm| {
        if words[at] == form.option {
            let path = words.get(at + 1)?.into();
            return Some(Named { form: *form, path, at: at + 1 });
        }
        let is_option = words[at].as_encoded_bytes().starts_with(form.option.as_bytes());
        let path = value(&words[at])
            .filter(|value| is_option && words[at].len() == form.option.len() + 1 + value.len())?;
        Some(Named { form: *form, path: path.into(), at })
    };
    forms.iter().filter_map(named).collect()
}

/// The text after the first `=` of a word.
#[cfg(unix)]
fn value(word: &OsStr) -> Option<&OsStr> {
    use std::os::unix::ffi::OsStrExt;
    let bytes = word.as_bytes();
    let equals = bytes.iter().position(|byte| *byte == b'=')?;
    Some(OsStr::from_bytes(&bytes[equals + 1..]))
}

#[cfg(not(unix))]
fn value(word: &OsStr) -> Option<&OsStr> {
    word.to_str()?.split_once('=').map(|(_, value)| value.as_ref())
}

impl Named {
    fn remove<'a>(&self, mut others: impl Iterator<Item = &'a OsStr>) -> Result<(), Failure> {
        let Self { form, path, .. } = self;
        let own = Role::output(form.option, path);
        // The command itself refuses a path that is not a file, with a better reason, or writes to
        // it as it is.
        let found = Destination::of(path).map_err(|error| Failure::write(path, error))?;
        let Destination::File(file) = found else { return Ok(()) };
        let is_own = |other: &Role<'_>| own.is_same_file(other);
        let standard = Path::new("-");
        if !file.exists()
            || [Role::input("", standard), Role::output("", standard)].iter().any(is_own)
            || others.any(|other| is_own(&Role::input("", other.as_ref())))
        {
            return Ok(());
        }
        // Another run may remove the same file meanwhile.
        let fits =
            form.fits(&file).or_else(|error| if is_gone(&error) { Ok(true) } else { Err(error) });
        if !fits.map_err(|error| Failure::file("read", path, &error))? {
            return Err(Failure::bad_input(format!(
                "{} {} exists and is not a {}, so it is kept; give another file, or remove it",
                form.option,
                path.display(),
                form.name
            )));
        }
        match fs::remove_file(file) {
            Err(error) if !is_gone(&error) => Err(Failure::file("replace", path, &error)),
            _ => Ok(()),
        }
    }
}

impl TrustedForm {
    /// Whether a file has such a beginning. An empty file may become anything.
    fn fits(&self, file: &Path) -> io::Result<bool> {
        let mut bytes = Vec::new();
        File::open(file)?.take(BEGINNING).read_to_end(&mut bytes)?;
        let text = String::from_utf8_lossy(&bytes);
        Ok(text.is_empty() || text.trim_start().starts_with(self.begins) && text.contains(self.has))
    }
}
