//! The lists of faults planted by hand: `dev/faults/*.faults`.

use crate::command::{self, in_file};
use std::fs;
use std::path::{Path, PathBuf};
use tess_testkit::listed::{ListedFault, parse};

/// A file with a fault planted in it.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Planted {
    pub(super) file: PathBuf,
    pub(super) text: String,
}

/// All faults of the files in `folder`, by file and in order.
///
/// # Errors
/// A file has another form, or two faults have the same name.
pub(super) fn read(folder: &Path) -> Result<Vec<ListedFault>, String> {
    let entries = fs::read_dir(folder).map_err(|error| in_file(folder, &error))?;
    let mut files: Vec<PathBuf> = entries.filter_map(|entry| Some(entry.ok()?.path())).collect();
    files.retain(|file| file.extension().is_some_and(|extension| extension == "faults"));
    files.sort();
    let mut faults: Vec<ListedFault> = Vec::new();
    for file in files {
        let text = command::read(&file)?;
        for fault in parse(&text).map_err(|error| in_file(&file, &error))? {
            if faults.iter().any(|other| other.name == fault.name) {
                return Err(in_file(&file, &format!("two faults are called `{}`", fault.name)));
            }
            faults.push(fault);
        }
    }
    Ok(faults)
}

/// The single file below `root` that has the fault's text, and its changed text. `files` are the
/// paths of all files relative to `root`.
///
/// # Errors
/// The text does not occur, or occurs in several places.
pub(super) fn plant(
    fault: &ListedFault,
    root: &Path,
    files: &[PathBuf],
) -> Result<Planted, String> {
    let ListedFault { name, folder, .. } = fault;
    let (mut places, mut planted) = (0, None);
    for file in files.iter().filter(|file| file.starts_with(folder)) {
        // A file that is not text has no faults.
        let text = fs::read_to_string(root.join(file)).unwrap_or_default();
        places += fault.places(&text);
        if let Some(text) = fault.planted(&text) {
            planted = Some(Planted { file: file.clone(), text });
        }
    }
    match planted {
        Some(planted) if places == 1 => Ok(planted),
        Some(_) => Err(format!("{name}: {places} places of {folder} have its text")),
        None => Err(format!("{name}: no file of {folder} has its text")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_fault_has_one_place() {
        let folder = std::env::temp_dir().join(format!("tess-faults-{}", std::process::id()));
        fs::create_dir_all(folder.join("src/deep")).expect("a folder");
        let files = ["src/a.rs", "src/deep/b.rs"].map(PathBuf::from);
        let list = "in src\nseen by a/tests/b.rs\nfault first\n<<<\nx + 1\n===\nx - 1\n>>>\n";
        let faults = parse(list).expect("a list");
        let planted = |a: &str, b: &str| {
            fs::write(folder.join(&files[0]), a).expect("written");
            fs::write(folder.join(&files[1]), b).expect("written");
            plant(&faults[0], &folder, &files)
        };
        let expected = Planted { file: files[1].clone(), text: "2 * (x - 1)".into() };
        assert_eq!(planted("x", "2 * (x + 1)"), Ok(expected), "one place");
        assert!(planted("x + 1", "x + 1").is_err_and(|e| e.contains("2 places")), "two files");
        assert!(planted("", "x + 1, x + 1").is_err_and(|e| e.contains("2 places")), "one file");
        assert!(planted("x", "").is_err_and(|e| e.contains("no file")), "none");
        fs::remove_dir_all(folder).expect("removed");
    }
}
