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
use clap_lex::OsStrExt;
use std::ffi::{OsStr, OsString};
use std::fs::{self, File};
use std::io::{self, Read};
use std::path::Path;

/// An output that others trust once the run has ended. A file to which a command adds, such as that
/// of `--coverage`, is not one of them: it stays unchanged.
struct Trusted {
    option: &'static str,
    name: &'static str,
    /// Its file begins with this,
    begins: &'static str,
    /// and contains this in its first bytes.
    has: &'static str,
}

const TRUSTED: [Trusted; 4] = [
    Trusted { option: "--report", name: "report", begins: "{", has: "\"tess-report " },
    Trusted { option: "--junit", name: "JUnit file", begins: "<", has: "<testsuite" },
    Trusted { option: "--failures", name: "vector file", begins: "# tess-vectors", has: "" },
    Trusted { option: "--merged", name: "coverage file", begins: "<?xml", has: "<UCIS" },
];

/// The number of bytes that are examined.
const BEGINNING: u64 = 4096;

/// Removes the outputs of earlier runs that these words of a command line name; the first two words
/// are the program and its command. Errors: the first file that is kept because it is of another
/// kind, or that cannot be removed. The remaining ones are removed nevertheless.
pub(crate) fn remove_earlier(words: &[OsString]) -> Result<(), Failure> {
    let (outputs, others) = named(words.get(2..).unwrap_or_default());
    let mut removed = Ok(());
    for (output, path) in outputs {
        removed = removed.and(output.remove(path, &others));
    }
    removed
}

/// The trusted outputs with their paths, and all words and values that may be paths of others.
fn named(words: &[OsString]) -> (Vec<(&'static Trusted, &Path)>, Vec<&OsStr>) {
    let (mut outputs, mut others) = (Vec::new(), Vec::new());
    let mut words = words.iter().map(OsString::as_os_str).peekable();
    while let Some(word) = words.next() {
        if word == "--" {
            others.extend(words.by_ref()); // no options follow
        }
        let (option, value) = word.split_once("=").map_or((word, None), |(o, v)| (o, Some(v)));
        match TRUSTED.iter().find(|output| option == output.option) {
            Some(output) => {
                let next = || words.next_if(|next| !next.starts_with("--"));
                let path = value.or_else(next);
                outputs.extend(path.map(|path| (output, Path::new(path))));
            }
            None => others.extend([Some(word), value].into_iter().flatten()),
        }
    }
    (outputs, others)
}

impl Trusted {
    /// Removes the file of an earlier run, unless one of the other words names it too.
    fn remove(&self, path: &Path, others: &[&OsStr]) -> Result<(), Failure> {
        // The command itself refuses a path that is not a file, with a better reason, or writes to
        // it as it is.
        let found = Destination::of(path).map_err(|error| Failure::write(path, error))?;
        let Destination::File(file) = found else { return Ok(()) };
        let (own, standard) = (Role::output(self.option, path), Path::new("-"));
        let others = others.iter().map(|other| Role::input("", other.as_ref()));
        let mut others = others.chain([Role::input("", standard), Role::output("", standard)]);
        if !file.exists() || others.any(|other| own.is_same_file(&other)) {
            return Ok(());
        }
        // Another run may remove the same file meanwhile.
        match self.fits(&file) {
            Ok(false) => {
                let Self { option, name, .. } = self;
                return Err(Failure::bad_input(format!(
                    "{option} {} exists and is not a {name}, so it is kept; give another file, or remove it",
                    path.display()
                )));
            }
            Err(error) if !is_gone(&error) => return Err(Failure::file("read", path, &error)),
            _ => {}
        }
        match fs::remove_file(file) {
            Err(error) if !is_gone(&error) => Err(Failure::file("replace", path, &error)),
            _ => Ok(()),
        }
    }

    /// Whether a file has such a beginning. An empty file may become anything.
    fn fits(&self, file: &Path) -> io::Result<bool> {
        let mut bytes = Vec::new();
        File::open(file)?.take(BEGINNING).read_to_end(&mut bytes)?;
        let text = String::from_utf8_lossy(&bytes);
        Ok(text.is_empty() || text.trim_start().starts_with(self.begins) && text.contains(self.has))
    }
}
