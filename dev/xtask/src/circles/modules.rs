//! The modules of a crate, and which of them name which.

use super::imports::{self, Import, Source};
use crate::command::in_file;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The path of a module in its crate; empty for the root.
pub(super) type ModulePath = Vec<String>;

/// How many `use`s a name is followed through.
const FOLLOWED: usize = 8;

/// The modules of a crate that have files, tests apart.
#[derive(Debug, Default)]
pub(super) struct Modules(BTreeMap<ModulePath, Module>);

#[derive(Debug)]
struct Module {
    file: PathBuf,
    source: Source,
}

/// One module names another.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Reference {
    pub(super) from: ModulePath,
    pub(super) to: ModulePath,
    /// `FILE:LINE: PATH`.
    pub(super) place: String,
}

impl Modules {
    /// Reads the files below `source`, a folder with `lib.rs` or `main.rs`.
    ///
    /// # Errors
    /// A file that cannot be read, or is no Rust.
    pub(super) fn read(source: &Path) -> Result<Self, String> {
        let mut files = Vec::new();
        list(source, &mut files)?;
        let texts = files.into_iter().map(|file| {
            let text = fs::read_to_string(&file).map_err(|error| in_file(&file, &error))?;
            Ok((file.strip_prefix(source).unwrap_or(&file).to_path_buf(), text))
        });
        Self::of(texts.collect::<Result<_, String>>()?)
    }

    /// The modules of these files, whose paths begin at the source folder. A `main.rs` beside a `lib.rs` is a
    /// crate that has nothing else, and is left out, as `bin/` is.
    ///
    /// # Errors
    /// A file that is no Rust.
    pub(super) fn of(files: Vec<(PathBuf, String)>) -> Result<Self, String> {
        let has_library = files.iter().any(|(file, _)| file == Path::new("lib.rs"));
        let is_other =
            |file: &Path| file.starts_with("bin") || has_library && file == Path::new("main.rs");
        let files = files.into_iter().filter(|(file, _)| !is_other(file));
        let read = |(file, text): (PathBuf, String)| {
            let source = imports::read(&text).map_err(|error| in_file(&file, &error))?;
            Ok((path_of(&file), Module { file, source }))
        };
        let mut modules = files.map(read).collect::<Result<BTreeMap<_, _>, String>>()?;
        let tests: Vec<ModulePath> = modules
            .iter()
            .flat_map(|(path, module)| {
                module.source.test_modules.iter().map(|name| joined(path, name))
            })
            .collect();
        modules.retain(|path, _| !tests.iter().any(|test| path.starts_with(test)));
        Ok(Self(modules))
    }

    pub(super) fn paths(&self) -> impl Iterator<Item = &ModulePath> {
        self.0.keys()
    }

    /// Everything that modules name of other modules.
    pub(super) fn references(&self) -> Vec<Reference> {
        let of_module = |(from, module): (&ModulePath, &Module)| {
            let reference = |import: &Import| {
                let to = self.target(from, import, FOLLOWED)?;
                let (file, path) = (module.file.display(), import.path.join("::"));
                let place = format!("{file}:{}: {path}", import.line);
                (to != *from).then(|| Reference { from: from.clone(), to, place })
            };
            module.source.imports.iter().filter_map(reference).collect::<Vec<_>>()
        };
        self.0.iter().flat_map(of_module).collect()
    }

    /// The module that has what `import` names in `from`; `None` if that is another crate's.
    fn target(&self, from: &ModulePath, import: &Import, left: usize) -> Option<ModulePath> {
        let mut at: ModulePath = from.iter().chain(&import.inside).cloned().collect();
        let mut path = &import.path[..];
        let is_child = |name: &String| self.0.contains_key(&joined(&at, name));
        if path.first().is_some_and(|first| {
            !matches!(first.as_str(), "crate" | "self" | "super") && !is_child(first)
        }) {
            return None;
        }
        while let Some((first, rest)) = path.split_first() {
            match first.as_str() {
                "crate" => at.clear(),
                "self" => {}
                "super" => _ = at.pop(),
                _ => break,
            }
            path = rest;
        }
        Some(self.file_of(self.walk(at, path, left)))
    }

    /// The module that `path` leads to from `at`, through other modules' `use`s.
    fn walk(&self, mut at: ModulePath, path: &[String], left: usize) -> ModulePath {
        for name in path {
            let child = joined(&at, name);
            if self.0.contains_key(&child) {
                at = child;
                continue;
            }
            let imports = self.0.get(&at).map_or(&[][..], |module| &module.source.imports);
            let is_meant =
                |import: &&Import| import.inside.is_empty() && import.name.as_ref() == Some(name);
            let further = imports.iter().find(is_meant).filter(|_| left > 0);
            match further.and_then(|import| self.target(&at, import, left - 1)) {
                Some(target) => at = target,
                None => break,
            }
        }
        at
    }

    /// The innermost module around `path` that has a file.
    fn file_of(&self, mut path: ModulePath) -> ModulePath {
        while !path.is_empty() && !self.0.contains_key(&path) {
            path.pop();
        }
        path
    }
}

fn joined(path: &[String], name: &str) -> ModulePath {
    let mut joined = path.to_vec();
    joined.push(name.to_owned());
    joined
}

/// The module of a file, whose path begins at the source folder.
fn path_of(file: &Path) -> ModulePath {
    let words = file.with_extension("");
    let mut path: ModulePath =
        words.iter().map(|word| word.to_string_lossy().into_owned()).collect();
    let is_root = path.len() == 1 && matches!(path[0].as_str(), "lib" | "main");
    if is_root || path.last().is_some_and(|last| last == "mod") {
        path.pop();
    }
    path
}

/// Adds the Rust files below `folder`.
fn list(folder: &Path, files: &mut Vec<PathBuf>) -> Result<(), String> {
    for entry in fs::read_dir(folder).map_err(|error| in_file(folder, &error))? {
        let path = entry.map_err(|error| in_file(folder, &error))?.path();
        if path.is_dir() {
            list(&path, files)?;
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn modules(files: &[(&str, &str)]) -> Modules {
        let files = files.iter().map(|&(file, text)| (file.into(), text.to_owned()));
        Modules::of(files.collect()).expect("Rust")
    }

    fn shown(modules: &Modules) -> Vec<String> {
        let show = |Reference { from, to, place }: Reference| {
            format!("{} -> {} ({place})", from.join("."), to.join("."))
        };
        modules.references().into_iter().map(show).collect()
    }

    #[test]
    fn names_lead_through_reexports() {
        let found = modules(&[
            ("lib.rs", "mod a; mod b; pub use a::inner::Thing; pub use other::X;"),
            ("a.rs", "pub mod inner; pub(crate) use inner::Thing as Renamed;"),
            ("a/inner.rs", "pub struct Thing;"),
            ("b.rs", "use crate::Thing; use crate::a::Renamed; use crate::X; use std::fmt;"),
        ]);
        let expected = [
            " -> a.inner (lib.rs:1: a::inner::Thing)",
            "a -> a.inner (a.rs:1: inner::Thing)",
            "b -> a.inner (b.rs:1: crate::Thing)",
            "b -> a.inner (b.rs:1: crate::a::Renamed)",
            "b ->  (b.rs:1: crate::X)",
        ];
        assert_eq!(shown(&found), expected, "references");
    }

    #[test]
    fn files_of_tests_and_of_other_crates_are_left_out() {
        let found = modules(&[
            ("lib.rs", "#[cfg(test)] mod tests; mod a;"),
            ("main.rs", "use crate::a;"),
            ("bin/tool.rs", "use crate::a;"),
            ("tests.rs", "use crate::a;"),
            ("tests/more.rs", "use crate::a;"),
            ("a/mod.rs", "mod b { fn c() { super::super::d() } }"),
        ]);
        assert_eq!(shown(&found), ["a ->  (a/mod.rs:1: super::super::d)"], "one is left");
    }
}
