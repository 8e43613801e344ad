//! The list of faults that are planted by hand: `dev/xtask/faults/*.faults`.

use crate::command::in_file;
use std::fs;
use std::path::{Path, PathBuf};

/// One change of a source file, and the tests that must see it.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Fault {
    /// What is wrong with it planted.
    pub(super) name: String,
    /// The folder that has the text, from the root of the repository; the fault follows its text when files move.
    pub(super) folder: PathBuf,
    /// The sources of the test programs, as `cargo xtask test` takes them.
    pub(super) tests: String,
    /// Words that select tests of these programs, for Python `-k` and a word; none are all.
    pub(super) filters: Vec<String>,
    /// Why no test can see it.
    pub(super) equivalent: Option<String>,
    from: String,
    to: String,
}

/// A file with a fault in it.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Planted {
    pub(super) file: PathBuf,
    pub(super) text: String,
}

impl Planted {
    /// Whether built programs have the file's text as it is.
    pub(super) fn is_shader(&self) -> bool {
        self.file.extension().is_some_and(|extension| extension == "wgsl")
    }
}

/// All faults of the files in `folder`, by file and in their order.
///
/// # Errors
/// A file of another form, or a name that two faults have.
pub(super) fn read(folder: &Path) -> Result<Vec<Fault>, String> {
    let entries = fs::read_dir(folder).map_err(|error| in_file(folder, &error))?;
    let mut files: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "faults"));
    files.sort();
    let mut faults: Vec<Fault> = Vec::new();
    for file in files {
        let text = fs::read_to_string(&file).map_err(|error| in_file(&file, &error))?;
        for fault in parse(&text).map_err(|error| in_file(&file, &error))? {
            if faults.iter().any(|other| other.name == fault.name) {
                return Err(in_file(&file, &format!("two faults are called `{}`", fault.name)));
            }
            faults.push(fault);
        }
    }
    Ok(faults)
}

/// The faults of a file: `in FOLDER` and `seen by TESTS [WORD...]` hold until they are said again;
/// `fault NAME`, perhaps `equivalent: REASON`, `<<<`, the text, `===`, the new text, `>>>`.
fn parse(text: &str) -> Result<Vec<Fault>, String> {
    let (mut folder, mut seen_by, mut faults) = (None, None, Vec::new());
    let mut lines = (1..).zip(text.lines());
    while let Some((number, line)) = lines.next() {
        if let Some(path) = line.strip_prefix("in ") {
            folder = Some(PathBuf::from(path));
        } else if let Some(words) = line.strip_prefix("seen by ") {
            seen_by = Some(words.split(' ').map(str::to_owned).collect::<Vec<_>>());
        } else if let Some(name) = line.strip_prefix("fault ") {
            let folder = folder.clone().ok_or(format!("line {number}: no `in` before it"))?;
            let words = seen_by.clone().ok_or(format!("line {number}: no `seen by` before it"))?;
            let (tests, filters) = words.split_first().ok_or("no tests")?;
            let mut block = lines.by_ref().map(|(_, line)| line).take_while(|line| *line != ">>>");
            let first = block.next().unwrap_or_default();
            let equivalent = first.strip_prefix("equivalent: ").map(str::to_owned);
            let opening = if equivalent.is_some() { block.next() } else { Some(first) };
            let block: Vec<&str> = block.collect();
            let middle = block.iter().position(|line| *line == "===");
            let (Some("<<<"), Some(middle)) = (opening, middle) else {
                return Err(format!("line {number}: `fault` goes on with `<<<`, `===`, `>>>`"));
            };
            let (from, to) = (block[..middle].join("\n"), block[middle + 1..].join("\n"));
            let (name, tests, filters) = (name.to_owned(), tests.clone(), filters.to_vec());
            faults.push(Fault { name, folder, tests, filters, equivalent, from, to });
        } else if !line.is_empty() && !line.starts_with('#') {
            return Err(format!("line {number}: `{line}` is neither `in`, `seen by` nor `fault`"));
        }
    }
    Ok(faults)
}

impl Fault {
    /// The one file below `root` that has the text, and what it becomes. `files` are the paths of all files from
    /// `root` on.
    ///
    /// # Errors
    /// The text is nowhere, or in several places.
    pub(super) fn plant(&self, root: &Path, files: &[PathBuf]) -> Result<Planted, String> {
        let mut found = Vec::new();
        for file in files.iter().filter(|file| file.starts_with(&self.folder)) {
            // What is not text has no fault.
            let text = fs::read_to_string(root.join(file)).unwrap_or_default();
            found.extend(
                text.matches(&self.from).map(|_| (file, text.replacen(&self.from, &self.to, 1))),
            );
        }
        let (name, folder) = (&self.name, self.folder.display());
        match found.len() {
            1 => Ok(found.swap_remove(0)).map(|(file, text)| Planted { file: file.clone(), text }),
            0 => Err(format!("{name}: no file of {folder} has its text")),
            places => Err(format!("{name}: {places} places of {folder} have its text")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIST: &str = "# A list\nin src\nseen by a/tests/b.rs one two\nfault first\n<<<\nx + 1\n===\nx - 1\n>>>\n\n\
        seen by a/tests/c.rs\nfault second\nequivalent: nobody asks\n<<<\ny\nz\n===\n>>>\n";

    #[test]
    fn a_list_has_its_faults() {
        let faults = parse(LIST).expect("a list");
        let [first, second] = &faults[..] else { panic!("{} faults", faults.len()) };
        assert_eq!(
            (first.tests.as_str(), first.filters.join(" ")),
            ("a/tests/b.rs", "one two".into()),
            "tests"
        );
        assert_eq!((first.from.as_str(), first.to.as_str()), ("x + 1", "x - 1"), "texts");
        assert_eq!((second.from.as_str(), second.to.as_str()), ("y\nz", ""), "two lines go");
        assert_eq!(second.equivalent.as_deref(), Some("nobody asks"), "the reason");
        for wrong in ["fault a\n", "in src\nseen by t\nfault a\nx\n===\ny\n>>>\n", "what"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_fault_has_one_place() {
        let folder = std::env::temp_dir().join(format!("tess-faults-{}", std::process::id()));
        fs::create_dir_all(folder.join("src/deep")).expect("a folder");
        let files = ["src/a.rs", "src/deep/b.rs"].map(PathBuf::from);
        let fault = &parse(LIST).expect("a list")[0];
        let plant = |a: &str, b: &str| {
            fs::write(folder.join(&files[0]), a).expect("written");
            fs::write(folder.join(&files[1]), b).expect("written");
            fault.plant(&folder, &files)
        };
        let expected = Planted { file: files[1].clone(), text: "2 * (x - 1)".into() };
        assert_eq!(plant("x", "2 * (x + 1)"), Ok(expected), "one place");
        assert!(plant("x + 1", "x + 1").is_err_and(|e| e.contains("2 places")), "two files");
        assert!(plant("", "x + 1, x + 1").is_err_and(|e| e.contains("2 places")), "one file");
        assert!(plant("x", "").is_err_and(|e| e.contains("no file")), "none");
        fs::remove_dir_all(folder).expect("removed");
    }
}
