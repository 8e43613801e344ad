//! The tables of `docs/performance.md` and the charts, made from the records.

use super::{chart, names, read, table, targets};
use crate::command::{in_file, workspace};
use std::fs;
use std::path::PathBuf;

const START: &str = "<!-- table: ";
const END: &str = "<!-- end -->";

/// The document that has tables.
const RESULTS: &str = "docs/performance.md";

/// The document that only names records, by links to their files.
const EXPERIMENTS: &str = "docs/experiments.md";

/// Brings the tables between their markers, `<!-- table: NAME -->` and `<!-- end -->`, and the charts up to date.
///
/// # Errors
/// A marker without a record, a record without a marker, or a marker without its end.
pub(crate) fn run() -> Result<(), String> {
    let mut changed = 0;
    for (path, text) in made()? {
        if fs::read_to_string(&path).is_ok_and(|old| old == text) {
            continue;
        }
        fs::write(&path, text).map_err(|error| in_file(&path, &error))?;
        println!("{} is new", path.display());
        changed += 1;
    }
    if changed == 0 {
        println!("tables and charts are up to date");
    }
    Ok(())
}

/// Every document and chart as the records make it.
fn made() -> Result<Vec<(PathBuf, String)>, String> {
    let targets = targets::read()?;
    let table = |name: &str| read(name).map(|record| table::block(&record, &targets));
    let text_of = |document: &str| {
        let path = workspace().join(document);
        fs::read_to_string(&path).map_err(|error| in_file(&path, &error))
    };
    let (text, used) = with_tables(&text_of(RESULTS)?, table)
        .map_err(|error| in_file(RESULTS.as_ref(), &error))?;
    let experiments = text_of(EXPERIMENTS)?;
    let is_named = |name: &String| {
        used.contains(name) || experiments.contains(&format!("](../benches/records/{name}.json)"))
    };
    if let Some(name) = names()?.iter().find(|name| !is_named(name)) {
        return Err(format!("{RESULTS} has no `{START}{name} -->`, {EXPERIMENTS} no link to it"));
    }
    let mut files = vec![(workspace().join(RESULTS), text)];
    for (name, svg) in chart::all()? {
        files.push((workspace().join(format!("docs/images/{name}.svg")), svg));
    }
    Ok(files)
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
    fn documents_and_charts_are_those_of_the_records() {
        for (path, made) in made().expect("documents and charts") {
            let text = fs::read_to_string(&path).expect("a file");
            let differing = text.lines().zip(made.lines()).find(|(here, there)| here != there);
            let shown = path.display();
            assert_eq!(differing, None, "{shown}: cargo xtask performance");
            assert_eq!(text, made, "{shown}: cargo xtask performance");
        }
    }

    #[test]
    fn every_chart_is_shown() {
        let text = fs::read_to_string(workspace().join(RESULTS)).expect("the document");
        for (name, _) in chart::all().expect("charts") {
            assert!(text.contains(&format!("](images/{name}.svg)")), "{name}");
        }
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
