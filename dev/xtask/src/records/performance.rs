//! The tables of `docs/performance.md`, made from the records.

use super::{names, read, table, targets};
use crate::command::workspace;
use std::fs;
use std::path::PathBuf;

const START: &str = "<!-- table: ";
const END: &str = "<!-- end -->";

/// Writes each table anew between its markers, `<!-- table: NAME -->` and `<!-- end -->`.
///
/// # Errors
/// A marker without a record, a record without a marker, or a marker without its end.
pub(crate) fn run() -> Result<(), String> {
    let text = fs::read_to_string(path()).map_err(|error| error.to_string())?;
    let remade = remade(&text)?;
    if remade == text {
        println!("docs/performance.md is up to date");
        return Ok(());
    }
    fs::write(path(), remade).map_err(|error| error.to_string())?;
    println!("docs/performance.md has new tables");
    Ok(())
}

fn path() -> PathBuf {
    workspace().join("docs/performance.md")
}

/// The document with every table as the records make it.
fn remade(text: &str) -> Result<String, String> {
    let targets = targets::read()?;
    let table = |name: &str| read(name).map(|record| table::block(&record, &targets));
    let (remade, used) = with_tables(text, table)?;
    match names()?.into_iter().find(|name| !used.contains(name)) {
        Some(name) => Err(format!("docs/performance.md has no `{START}{name} -->`")),
        None => Ok(remade),
    }
}

/// `text` with the tables that `table` makes, and the names of these.
fn with_tables(
    text: &str,
    table: impl Fn(&str) -> Result<String, String>,
) -> Result<(String, Vec<String>), String> {
    let mut parts = text.split(START);
    let mut remade = parts.next().unwrap_or_default().to_owned();
    let mut used = Vec::new();
    for part in parts {
        let name = part.split(" -->").next().unwrap_or_default();
        let (_, after) = part.split_once(END).ok_or_else(|| format!("{name}: no `{END}`"))?;
        remade += &format!("{START}{name} -->\n{}{END}{after}", table(name)?);
        used.push(name.to_owned());
    }
    Ok((remade, used))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_document_has_the_tables_of_the_records() {
        let text = fs::read_to_string(path()).expect("the document");
        let remade = remade(&text).expect("tables");
        let differing = text.lines().zip(remade.lines()).find(|(here, there)| here != there);
        assert_eq!(differing, None, "cargo xtask performance writes the tables");
        assert_eq!(text, remade, "cargo xtask performance writes the tables");
    }

    #[test]
    fn tables_stand_between_their_markers() {
        let text =
            "a\n<!-- table: one -->\nold\n<!-- end -->\nb\n<!-- table: two -->\n<!-- end -->\n";
        let (remade, used) = with_tables(text, |name| Ok(format!("new {name}\n"))).expect("tables");
        let expected = "a\n<!-- table: one -->\nnew one\n<!-- end -->\nb\n\
                        <!-- table: two -->\nnew two\n<!-- end -->\n";
        assert_eq!((remade.as_str(), used.len()), (expected, 2), "both");
        let open = with_tables("<!-- table: one -->\n", |_| Ok(String::new()));
        assert!(open.is_err_and(|error| error.contains("one")), "no end");
    }
}
