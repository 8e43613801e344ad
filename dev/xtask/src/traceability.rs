//! From sentence to test: docs/traceability.md says of each sentence of the specification what sees a violation.
//!
//! A mark, `<!-- r:SECTION/NUMBER -->`, stands behind its sentence. `<!-- r:- -->` stands behind text that demands nothing.

use crate::command::workspace;
use std::collections::BTreeMap;

const NOTHING: &str = "-";

/// Compares the specification, the table and what the table names.
///
/// # Errors
/// Marks and names that are missing, doubled or unknown, a line each.
pub(crate) fn run() -> Result<(), String> {
    let read = |path: &str| {
        let found = std::fs::read_to_string(workspace().join(path));
        found.map_err(|error| format!("{path}: {error}"))
    };
    let (specification, table) = (read("docs/specification.md")?, read("docs/traceability.md")?);
    let (rows, errors) = check(&specification, &table, read);
    if errors.is_empty() {
        println!("{rows} sentences of the specification, each with what sees a violation");
        return Ok(());
    }
    Err(errors.join("\n"))
}

/// The number of rows of the table, and what is wrong.
fn check(
    specification: &str,
    table: &str,
    read: impl Fn(&str) -> Result<String, String>,
) -> (usize, Vec<String>) {
    let mut errors = Vec::new();
    let mut marks = BTreeMap::new();
    for block in blocks(specification) {
        let section = block.section;
        for mark in block.marks(&mut errors) {
            let number = mark.strip_prefix(section).and_then(|rest| rest.strip_prefix('/'));
            if number.is_none_or(|number| number.parse::<u16>().is_err()) {
                errors.push(format!("r:{mark} stands in section {section}"));
            }
            if marks.insert(mark.clone(), 0).is_some() {
                errors.push(format!("r:{mark} stands in the specification twice"));
            }
        }
    }
    let rows = table.lines().filter(|line| line.starts_with("| ")).skip(1);
    let rows: Vec<Vec<&str>> = rows.map(|row| row.split('|').map(str::trim).collect()).collect();
    for row in rows.iter().filter(|row| !row[1].starts_with("---")) {
        match marks.get_mut(row[1]) {
            Some(rows) => *rows += 1,
            None => errors.push(format!("the specification has no mark r:{}", row[1])),
        }
        let named: Vec<&str> = row.get(3).map_or("", |cell| cell).split(", ").collect();
        let wrong = named.iter().filter_map(|name| evidence(name, &read).err());
        errors.extend(wrong.map(|error| format!("r:{}: {error}", row[1])));
    }
    for (mark, rows) in marks.iter().filter(|(_, rows)| **rows != 1) {
        errors.push(format!("docs/traceability.md has {rows} rows for r:{mark}"));
    }
    (marks.len(), errors)
}

/// A paragraph, an item of a list, a table or a listing, with the number of its section.
struct Block<'a> {
    section: &'a str,
    text: String,
    /// Whether it consists of sentences.
    prose: bool,
}

/// The blocks of a page. A line that begins with a mark belongs to the table or the listing above it.
fn blocks(page: &str) -> Vec<Block<'_>> {
    let mut blocks: Vec<Block<'_>> = Vec::new();
    let (mut section, mut listing, mut goes_on) = ("0", false, false);
    for line in page.lines() {
        let words = line.trim();
        let fence = words.starts_with("```");
        if !listing && words.starts_with('#') {
            let number = words.trim_start_matches('#').split_whitespace().next().unwrap_or("");
            let number = number.trim_end_matches('.');
            section = if number.starts_with(|c: char| c.is_ascii_digit()) { number } else { "0" };
        }
        if !listing && (words.is_empty() || words.starts_with('#')) {
            goes_on = false;
            continue;
        }
        let number = words.split_once(". ").is_some_and(|(n, _)| n.parse::<u8>().is_ok());
        let prose = !listing && !fence && !words.starts_with(['|', '<']);
        let begins = prose && (number || words.starts_with("- "));
        let last = blocks.last().map(|block| block.prose);
        if !goes_on || begins || (last == Some(true) && !prose && !words.starts_with('<')) {
            let text = String::new();
            blocks.push(Block { section, text, prose });
        }
        goes_on = true;
        listing ^= fence;
        if let Some(block) = blocks.last_mut() {
            // Behind the sign of a list no sentence ends.
            let words =
                if begins { words.split_once(' ').map_or("", |(_, rest)| rest) } else { words };
            if block.prose && words.starts_with("<!--") {
                block.text += "\nThis mark begins a line, which then is no text:";
            }
            block.text += "\n";
            block.text += words;
        }
    }
    blocks
}

impl Block<'_> {
    /// The marks, but for those of text that demands nothing.
    fn marks(&self, errors: &mut Vec<String>) -> Vec<String> {
        let mut marks = Vec::new();
        let mut rest = self.text.as_str();
        while let Some((before, mark)) = rest.split_once("<!-- r:") {
            let Some((mark, behind)) = mark.split_once(" -->") else { break };
            rest = behind;
            if mark == NOTHING {
                continue;
            }
            if self.prose && sentences(before) > 1 {
                errors.push(format!("r:{mark} stands behind more than one sentence:{before}"));
            }
            marks.push(mark.to_owned());
        }
        if !rest.trim().is_empty() {
            errors.push(format!("section {}, no mark stands behind:{rest}", self.section));
        }
        marks
    }
}

/// Sentences: full stops that something follows which begins one, and the last.
fn sentences(text: &str) -> usize {
    let text = text.trim().replace(".)", ".");
    let begins = |rest: &str| {
        let rest = rest.trim_start();
        rest.starts_with(|c: char| c.is_ascii_uppercase() || "`*(".contains(c))
    };
    let ends = text.match_indices(['.']).filter(|(at, _)| {
        let (before, rest) = (&text[..*at], &text[at + 1..]);
        !before.ends_with('.') && rest.starts_with(char::is_whitespace) && begins(rest)
    });
    ends.count() + 1
}

/// The evidence that a row names: a test, a recorded result, a rule or a proof.
fn evidence(quoted: &str, read: impl Fn(&str) -> Result<String, String>) -> Result<(), String> {
    let name = quoted.strip_prefix('`').and_then(|name| name.strip_suffix('`'));
    let name = name.ok_or_else(|| format!("`{quoted}` is no name in backticks"))?;
    let (path, item) = name.split_once("::").unwrap_or((name, ""));
    let text = read(path)?;
    let found = match path {
        "docs/rules.md" => text.contains(&format!("\n| `{item}` | ")),
        _ if item.is_empty() => {
            path.starts_with("golden/") || path.starts_with("rtl/dv/formal/prove_")
        }
        _ => is_test(&text, item),
    };
    if found { Ok(()) } else { Err(format!("there is no {name}")) }
}

/// Whether a source has a test of this name that is not ignored.
fn is_test(text: &str, name: &str) -> bool {
    let Some((before, _)) = text.split_once(&format!("fn {name}(")) else { return false };
    let attributes = before.rsplit(['}', ';']).next().unwrap_or("");
    attributes.contains("#[test]") && !attributes.contains("#[ignore")
}

#[cfg(test)]
mod tests {
    use super::*;

    const PAGE: &str = "# Page\n\n## 1. One\n\nIt is. <!-- r:1/1 --> So. And so. <!-- r:- -->\n\n1. Item one: <!-- r:1/2 -->\n\n   | a |\n   | --- |\n   <!-- r:1/3 -->\n\n```\ncode. More\n```\n<!-- r:1/4 -->\n";
    const TABLE: &str = "| mark | demands | seen by |\n| --- | --- | --- |\n| 1/1 | a | `t.rs::one` |\n| 1/2 | b | `golden/a.csv`, `t.rs::one` |\n| 1/3 | c | `docs/rules.md::same` |\n| 1/4 | d | `rtl/dv/formal/prove_place.sv` |\n";

    fn errors(page: &str, table: &str) -> Vec<String> {
        let read = |path: &str| match path {
            "t.rs" => {
                Ok("#[test]\nfn one() {}\nfn two() {}\n#[test]\n#[ignore]\nfn three() {}"
                    .to_owned())
            }
            "docs/rules.md" => Ok("\n| `same` | x |".to_owned()),
            "golden/a.csv" | "rtl/dv/formal/prove_place.sv" => Ok(String::new()),
            _ => Err(format!("{path}: no file")),
        };
        check(page, table, read).1
    }

    #[test]
    fn every_fault_is_named() {
        assert_eq!(errors(PAGE, TABLE), [""; 0], "as it is");
        let in_page = [
            (
                "It is. <!-- r:1/1 -->",
                "It is. More. <!-- r:1/1 -->",
                "r:1/1 stands behind more than one",
            ),
            ("<!-- r:- -->", "", "no mark stands behind: So. And so."),
            ("one: <!-- r:1/2 -->", "one:", "no mark stands behind:\nItem one:"),
            ("\n   <!-- r:1/3 -->", "", "no mark stands behind:\n| a |"),
            ("r:1/2", "r:1/1", "r:1/1 stands in the specification twice"),
            ("r:1/2", "r:2/2", "r:2/2 stands in section 1"),
            ("It is.", "It is.\n<!-- r:1/7 --> More.", "This mark begins a line"),
        ];
        for (from, to, expected) in in_page {
            let found = errors(&PAGE.replacen(from, to, 1), TABLE);
            assert!(found.iter().any(|error| error.contains(expected)), "{expected}: {found:?}");
        }
        let in_table = [
            ("| 1/1 | a | `t.rs::one` |\n", "", "has 0 rows for r:1/1"),
            ("| 1/2 |", "| 1/1 |", "has 2 rows for r:1/1"),
            ("| 1/2 |", "| 1/9 |", "has no mark r:1/9"),
            ("`t.rs::one` |\n| 1/2", "|\n| 1/2", "r:1/1: `` is no name"),
            ("t.rs::one", "t.rs::two", "r:1/1: there is no t.rs::two"),
            ("t.rs::one", "t.rs::three", "there is no t.rs::three"),
            ("t.rs::one", "u.rs::one", "r:1/1: u.rs: no file"),
            ("same", "other", "there is no docs/rules.md::other"),
            ("golden/a.csv", "t.rs", "there is no t.rs"),
        ];
        for (from, to, expected) in in_table {
            let found = errors(PAGE, &TABLE.replacen(from, to, 1));
            assert!(found.iter().any(|error| error.contains(expected)), "{expected}: {found:?}");
        }
    }

    #[test]
    fn every_sentence_has_what_sees_a_violation() {
        assert_eq!(run(), Ok(()), "docs/traceability.md");
    }
}
