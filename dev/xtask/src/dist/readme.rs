//! READMEs of archives; each is written relative to its own archive.
//!
//! A README of the tree goes into an archive without its section [`ONLY_HERE`]. Links to files of
//! the archive stay as they are; links to other files of the tree lead to the project's page.

use crate::command::{self, in_file, workspace};
use std::fs;
use std::path::{Component, Path, PathBuf};

/// The heading of the section about a checkout.
const ONLY_HERE: &str = "## In the repository";

/// The address at which the files of the tree can be read.
const PAGES: &str = "https://github.com/tess-model/tess/blob/main";

/// Words about the source tree that no archive's README may contain.
const OF_THE_TREE: &[&str] =
    &["cargo build", "cargo run", "cargo xtask", "pip install ./", "target/"];

/// Writes the tree's README `from` into the finished folder of an archive, as `to`.
///
/// # Errors
/// The result mentions the source tree, or a file cannot be read or written.
pub(super) fn put(from: &str, stage: &Path, to: &str) -> Result<(), String> {
    let text = command::read(&workspace().join(from))?;
    let to = stage.join(to);
    let packed = with_links(&without_section(&text), Path::new(from), &to);
    let packed = packed.and_then(|text| check(&text).map(|()| text));
    let text = packed.map_err(|error| format!("{from}, in an archive: {error}"))?;
    fs::write(&to, text).map_err(|error| in_file(&to, &error))
}

/// The text without the section about a checkout.
fn without_section(text: &str) -> String {
    let Some((before, rest)) = text.split_once(&format!("\n{ONLY_HERE}\n")) else {
        return text.to_owned();
    };
    match rest.split_once("\n## ") {
        Some((_, after)) => format!("{before}\n## {after}"),
        None => format!("{}\n", before.trim_end()),
    }
}

/// The text with its links, which are relative to `from` in the tree, rewritten for the file `to`
/// of an archive.
///
/// # Errors
/// A link leads to a file that neither the archive nor the tree has.
fn with_links(text: &str, from: &Path, to: &Path) -> Result<String, String> {
    let (tree, archive) = (from.parent().unwrap_or(from), to.parent().unwrap_or(to));
    let mut parts = text.split("](");
    let mut linked = parts.next().unwrap_or_default().to_owned();
    for part in parts {
        let (link, rest) = part.split_once(')').unwrap_or((part, ""));
        let file = link.split('#').next().unwrap_or_default();
        let stays = file.is_empty() || file.contains("://") || archive.join(file).exists();
        if stays {
            linked += &format!("]({link}){rest}");
            continue;
        }
        if !workspace().join(tree).join(file).exists() {
            return Err(format!("the link {link} leads to no file"));
        }
        linked += &format!("]({PAGES}/{}){rest}", plain(&tree.join(link)));
    }
    Ok(linked)
}

/// The path with `..` resolved, written with slashes.
fn plain(path: &Path) -> String {
    let mut plain = PathBuf::new();
    for component in path.components() {
        match component {
            Component::ParentDir => _ = plain.pop(),
            other => plain.push(other),
        }
    }
    plain.to_string_lossy().replace('\\', "/")
}

/// Refuses text that only makes sense in the source tree.
fn check(text: &str) -> Result<(), String> {
    for (number, line) in text.lines().enumerate() {
        if let Some(words) = OF_THE_TREE.iter().find(|words| line.contains(**words)) {
            return Err(format!("line {} has `{words}`: {line}", number + 1));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_readme_leaves_the_tree() {
        let text = "# Lib\n\n## In the repository\n\n    cargo build\n\n## After\n\nText.\n";
        assert_eq!(
            without_section(text),
            "# Lib\n\n## After\n\nText.\n",
            "a section between others"
        );
        assert_eq!(
            without_section("# Lib\n\n## In the repository\n\nIt.\n"),
            "# Lib\n",
            "the last"
        );
        assert_eq!(without_section("# Lib\n"), "# Lib\n", "none");
    }

    #[test]
    fn links_lead_somewhere() {
        let folder = workspace().join("bindings/c");
        let to = folder.join("README.md");
        let linked =
            |link: &str| with_links(&format!("[a]({link}) b"), Path::new("docs/a.md"), &to);
        let page = |link: &str| Ok(format!("[a]({link}) b"));
        for link in ["include/tess.h", "#part", "https://a.b/c"] {
            assert_eq!(linked(link), page(link), "in the archive, or elsewhere");
        }
        assert_eq!(
            linked("rules.md#one"),
            page(&format!("{PAGES}/docs/rules.md#one")),
            "beside it"
        );
        assert_eq!(linked("../SECURITY.md"), page(&format!("{PAGES}/SECURITY.md")), "above it");
        assert!(linked("nothing.md").is_err(), "neither has it");
    }

    #[test]
    fn words_of_the_tree_are_refused() {
        assert_eq!(check("cc program.c\n"), Ok(()), "an archive's own");
        let error = check("a\nrun `cargo build --release`\n").expect_err("no archive has sources");
        assert!(error.starts_with("line 2 has `cargo build`"), "{error}");
    }
}
