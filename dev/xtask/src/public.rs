//! Nothing public without a caller: an item of a published library that nobody outside uses is a promise that nobody tests.
//!
//! Words are compared, not paths: an item counts as used where its name stands in the code of a test, an example, a
//! bench, a tool, a binding or another crate. The lint `unreachable_pub` sees to it that what is `pub` can be reached.

use crate::command::{self, in_file, workspace};
use std::collections::BTreeSet;
use std::process::Command;

const LIBRARIES: [&str; 6] =
    ["tess-core", "tess-simd", "tess-gpu", "tess-wgpu", "tess-surface", "tess-verify"];
const KINDS: [&str; 8] = ["fn", "struct", "enum", "union", "trait", "const", "static", "type"];

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
        for (path, text) in own.iter().filter(|(path, _)| !path.ends_with("tests.rs")) {
            for (line, name) in items(text) {
                all += 1;
                if !used.contains(name) {
                    found.push(format!("{path}:{line}: {name}"));
                }
            }
        }
    }
    (all, found)
}

/// The public items of a file and their lines, those of its tests left out.
fn items(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let code = text.split("\n#[cfg(test)]\nmod ").next().unwrap_or(text);
    (1..).zip(code.lines()).filter_map(|(line, text)| Some((line, item(text)?)))
}

/// The name of the public item that a line declares.
fn item(line: &str) -> Option<&str> {
    let mut words = line.trim_start().strip_prefix("pub ")?.split_whitespace();
    let mut kind = words.next()?;
    let mut name = words.next()?;
    while ["const", "unsafe", "async", "extern"].contains(&kind)
        && ["fn", "unsafe", "extern", "\"C\""].contains(&name)
    {
        (kind, name) = (name, words.next()?);
    }
    let name = KINDS.contains(&kind).then(|| self::words(name).next())?;
    name.filter(|name| *name != "_")
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
    }

    #[test]
    fn every_public_item_has_a_user() {
        assert_eq!(run(), Ok(()), "public items");
    }
}
