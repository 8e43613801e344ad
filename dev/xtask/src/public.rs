//! Nothing public without a caller: an item of a published library that nobody outside uses is a promise that nobody tests.
//!
//! Words are compared, not paths: an item counts as used where its name stands in the code of a test, an example, a
//! bench, a tool, a binding or another crate. A type may also come with its caller: it stands in a signature or a field.
//! The lint `unreachable_pub` sees to it that what is `pub` can be reached.

use crate::command::{self, in_file, workspace};
use std::collections::BTreeSet;
use std::process::Command;

const LIBRARIES: [&str; 6] =
    ["tess-core", "tess-simd", "tess-gpu", "tess-wgpu", "tess-surface", "tess-verify"];
const TYPES: [&str; 5] = ["struct", "enum", "union", "trait", "type"];
const VALUES: [&str; 3] = ["fn", "const", "static"];

/// Names the items that nothing outside uses.
///
/// # Errors
/// There is one, or a file cannot be read.
pub(crate) fn run() -> Result<(), String> {
    let mut git = Command::new("git");
    git.args(["ls-files", "--", "*.rs"]).current_dir(workspace());
    let list = command::output(&mut git)?;
    let mut files = Vec::new();
    for path in list.lines() {
        let found = std::fs::read_to_string(workspace().join(path));
        files.push((path, found.map_err(|error| in_file(path.as_ref(), &error))?));
    }
    let (all, unused) = unused(&LIBRARIES, &files);
    if unused.is_empty() {
        println!("{all} public items of the published libraries, each with a user outside");
        return Ok(());
    }
    Err(format!(
        "{} of {all} public items have no user outside their own crate's src; test them from outside, or make them \
         private:\n{}",
        unused.len(),
        unused.join("\n")
    ))
}

/// How many public items the libraries have, and those whose names stand nowhere else.
fn unused(libraries: &[&str], files: &[(&str, String)]) -> (usize, Vec<String>) {
    let (mut all, mut found) = (0, Vec::new());
    for library in libraries {
        let source = format!("{library}/src/");
        let (own, others): (Vec<_>, Vec<_>) =
            files.iter().partition(|(path, _)| path.starts_with(&source));
        let used: BTreeSet<&str> = others.iter().flat_map(|(_, text)| words(text)).collect();
        let named: BTreeSet<&str> =
            own.iter().flat_map(|(_, text)| signatures(text)).flat_map(words).collect();
        for (path, text) in own.iter().filter(|(path, _)| !path.ends_with("tests.rs")) {
            for (line, kind, name) in items(text) {
                all += 1;
                let comes_with_a_caller = TYPES.contains(&kind) && named.contains(name);
                if !used.contains(name) && !comes_with_a_caller {
                    found.push(format!("{path}:{line}: {name}"));
                }
            }
        }
    }
    (all, found)
}

/// The public items of a file: line, kind and name. Those of its tests are left out.
fn items(text: &str) -> impl Iterator<Item = (usize, &str, &str)> {
    let code = text.split("\n#[cfg(test)]\nmod ").next().unwrap_or(text);
    (1..)
        .zip(code.lines())
        .filter_map(|(line, text)| item(text).map(|(kind, name)| (line, kind, name)))
}

/// Types in signatures and fields: the text behind `->` or the `:` of a public line, or an error type.
fn signatures(text: &str) -> impl Iterator<Item = &str> {
    text.lines().filter_map(|line| {
        let is_public = line.trim_start().starts_with("pub ");
        let result = line.split_once("-> ").or_else(|| line.split_once("type Err"));
        let part = if is_public { line.split_once(['(', ':']) } else { None };
        part.or(result).map(|(_, rest)| rest)
    })
}

/// The kind and the name of the public item that a line declares.
fn item(line: &str) -> Option<(&str, &str)> {
    let mut words = line.trim_start().strip_prefix("pub ")?.split_whitespace();
    let mut kind = words.next()?;
    let mut name = words.next()?;
    while ["const", "unsafe", "async", "extern"].contains(&kind)
        && ["fn", "unsafe", "extern", "\"C\""].contains(&name)
    {
        (kind, name) = (name, words.next()?);
    }
    let is_item = TYPES.contains(&kind) || VALUES.contains(&kind);
    let name = is_item.then(|| self::words(name).next())?;
    name.filter(|name| *name != "_").map(|name| (kind, name))
}

/// The words of code, comments left out.
fn words(text: &str) -> impl Iterator<Item = &str> {
    let code = text.lines().map(|line| line.split("//").next().unwrap_or(line));
    let is_in_word = |c: char| c.is_alphanumeric() || c == '_';
    code.flat_map(move |line| line.split(move |c| !is_in_word(c))).filter(|word| !word.is_empty())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_unused_item_is_named() {
        let source = "pub struct Used;\n/// Text.\npub const fn lonely(x: u32) {}\npub(crate) fn own() {}\n\
                      pub const ALONE: u32 = 1;\nimpl Used {\n    pub fn method(&self) {}\n}\npub use other::Thing;\n\
                      \n#[cfg(test)]\nmod tests {\n    pub fn helper() {}\n}\n";
        let own = ("lib/src/lib.rs", source.to_owned());
        let tests = "use lib::Used; // lonely\nfn f(x: Used) { x.method() }";
        let used = |more: &str| {
            let files = [own.clone(), ("lib/tests/a.rs", format!("{tests}{more}"))];
            unused(&["lib"], &files)
        };
        let lonely = "lib/src/lib.rs:3: lonely".to_owned();
        let alone = "lib/src/lib.rs:5: ALONE".to_owned();
        assert_eq!(used(""), (4, vec![lonely, alone.clone()]), "a comment is no use");
        assert_eq!(used("lonely(1)"), (4, vec![alone]), "a call is");
        assert_eq!(used("lonely(ALONE)"), (4, vec![]), "all are used");
        let types = "pub struct Result;\npub struct Nobody;\npub fn f() -> Result {}\n".to_owned();
        let files = [("lib/src/lib.rs", types), ("lib/tests/a.rs", "f()".to_owned())];
        let nobody = vec!["lib/src/lib.rs:2: Nobody".to_owned()];
        assert_eq!(unused(&["lib"], &files), (3, nobody), "a type comes with its caller");
    }

    #[test]
    fn every_public_item_has_a_user() {
        assert_eq!(run(), Ok(()), "public items");
    }
}
