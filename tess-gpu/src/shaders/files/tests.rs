use super::*;
use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};

/// The shaders: every file that no other needs, with every choice that it has.
fn roots() -> Vec<(&'static str, Vec<Choice>)> {
    let mut all = Vec::new();
    for partitioning in Partitioning::ALL {
        for index_type in [IndexType::U16, IndexType::U32] {
            let config = Config::new(partitioning, OutputPrimitive::TriangleCw);
            let setup = Setup { index_type, ..Setup::new(Domain::Quad, config) };
            let mut add = |stage, contexts, has_catalogue| {
                let own = [indices(setup), listing(has_catalogue)];
                all.push((
                    stage,
                    [placing(setup, contexts).as_slice(), &own, &expanding(!has_catalogue)]
                        .concat(),
                ));
            };
            for root in [
                "entry_points/factors",
                "entry_points/scan",
                "entry_points/totals",
                "entry_points/partition",
                "entry_points/groups",
            ] {
                add(root, "variants/stored_contexts", true);
            }
            add("entry_points/factors", "variants/stored_contexts", false);
            add("entry_points/list", "variants/no_contexts", true);
            for root in ["entry_points/expand_points", "entry_points/expand_primitives"] {
                add(root, "variants/stored_contexts", true);
            }
            add("entry_points/short_batch", "variants/stored_contexts", false);
            add("entry_points/expand_short", "variants/stored_contexts", false);
            add("stages/locate", "variants/stored_contexts", false);
            add("offered/elements", "variants/stored_contexts", false);
            add("offered/counting", "variants/no_contexts", false);
        }
    }
    for tap in ["taps/factors", "taps/contexts", "taps/locations"] {
        all.push(("taps/tap", vec![("tap", tap)]));
    }
    all
}

/// The names that a file declares at module scope, its bindings separately, and the names that it
/// uses.
#[derive(Debug, Default)]
struct Names<'a> {
    declared: BTreeSet<&'a str>,
    bindings: BTreeSet<&'a str>,
    used: BTreeSet<&'a str>,
}

fn names(text: &str) -> Names<'_> {
    let mut names = Names::default();
    for line in text.lines() {
        let code = line.split("//").next().unwrap_or_default();
        let words = words(code);
        let name = match words[..] {
            ["fn" | "const" | "struct", name, ..] | ["var", "workgroup", name, ..] => name,
            ["group", _, "binding", _, "var", "uniform", name, ..]
            | ["group", _, "binding", _, "var", "storage", "read" | "read_write", name, ..] => {
                names.bindings.insert(name);
                name
            }
            _ => "",
        };
        if code.starts_with(' ') || names.bindings.contains(name) {
            names.used.extend(words);
        } else {
            names.declared.extend((!name.is_empty()).then_some(name));
            names.used.extend(words.into_iter().filter(|&word| word != name));
        }
    }
    names
}

/// The words of a line that can be names at module scope. Members, and the declarations of
/// parameters and locals, are left out.
fn words(code: &str) -> Vec<&str> {
    let is_in_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut words = Vec::new();
    let mut rest = code;
    while let Some(begin) = rest.find(is_in_word) {
        let is_member = rest[..begin].ends_with('.');
        let word = &rest[begin..];
        let end = word.find(|c| !is_in_word(c)).unwrap_or(word.len());
        let is_declared = word[end..].starts_with(": ") && !code.contains("var<");
        if !is_member && !is_declared {
            words.push(&word[..end]);
        }
        rest = &word[end..];
    }
    words
}

/// The errors in the first lines of a shader's files.
fn complaints(root: &'static str, choices: &[Choice]) -> Vec<String> {
    let mut files = Vec::new();
    add(root, choices, &mut files);
    let names: BTreeMap<&str, Names<'_>> =
        files.iter().map(|&file| (file, names(text(file)))).collect();
    let mut wrong = Vec::new();
    for &file in &files {
        let needed: Vec<&str> = needs(file).map(|need| chosen(need, choices)).collect();
        let used = &names[file].used;
        let uses = |other: &str| names[other].declared.iter().find(|&name| used.contains(name));
        for other in files.iter().filter(|&&other| other != file && !needed.contains(&other)) {
            wrong.extend(uses(other).map(|name| format!("{file} lacks {other}, for {name}")));
        }
        for other in needed.iter().filter(|other| uses(other).is_none()) {
            wrong.push(format!("{file} needs {other} for nothing"));
        }
        let listed: BTreeSet<&str> =
            first_line(file).1.split(", ").filter(|name| !name.is_empty()).collect();
        let bound = BINDINGS.iter().copied().filter(|name| used.contains(name));
        let bound: BTreeSet<&str> =
            bound.filter(|name| !names[file].bindings.contains(name)).collect();
        if listed != bound {
            wrong.push(format!("{file} lists the bindings {listed:?} and uses {bound:?}"));
        }
    }
    wrong
}

/// Every binding that some file uses without declaring it.
const BINDINGS: [&str; 11] = [
    "job",
    "offsets",
    "status",
    "tables",
    "tiles",
    "topologies",
    "contexts",
    "raw_factors",
    "arguments",
    "points_out",
    "catalogue",
];

#[test]
fn first_lines_name_what_a_file_uses() {
    for (root, choices) in roots() {
        let wrong = complaints(root, &choices);
        assert!(wrong.is_empty(), "{root} with {choices:?}: {wrong:#?}");
    }
}

#[test]
fn every_file_is_part_of_a_shader() {
    let shaders = Path::new(env!("CARGO_MANIFEST_DIR")).join("shaders");
    let mut in_folders = BTreeSet::new();
    // Surfaces are left out: their users join them.
    for folder in entries(&shaders).into_iter().filter(|folder| !folder.ends_with("surfaces")) {
        let folder_name = folder.file_name().expect("a folder").to_string_lossy().into_owned();
        for file in entries(&folder) {
            let name = file.file_name().expect("a file").to_string_lossy().into_owned();
            in_folders.insert(format!("{folder_name}/{name}"));
        }
    }
    let listed: BTreeSet<String> = FILES.iter().map(|(name, _)| format!("{name}.wgsl")).collect();
    assert_eq!(in_folders, listed, "the list and the folders");
    let mut used = BTreeSet::new();
    for (root, choices) in roots() {
        let mut files = Vec::new();
        add(root, &choices, &mut files);
        used.extend(files);
    }
    let unused: Vec<_> =
        FILES.iter().map(|(name, _)| name).filter(|&name| !used.contains(name)).collect();
    assert!(unused.is_empty(), "{unused:?}");
}

/// The files in a folder.
fn entries(folder: &Path) -> Vec<PathBuf> {
    let all = std::fs::read_dir(folder).unwrap_or_else(|error| panic!("{folder:?}: {error}"));
    all.map(|entry| entry.expect("an entry").path()).collect()
}
