use super::*;
use std::collections::{BTreeMap, BTreeSet};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning};

/// The shaders: a file that nothing needs, with every choice that there is for it.
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
            for stage in ["factors", "scan", "totals", "partition", "groups"] {
                add(stage, "stored_contexts", true);
            }
            add("factors", "stored_contexts", false);
            add("list", "no_contexts", true);
            for stage in ["expand_points", "expand_primitives"] {
                add(stage, "stored_contexts", true);
            }
            add("small", "stored_contexts", false);
            add("expand_small", "stored_contexts", false);
            add("locate", "pulled_contexts", false);
            add("element", "pulled_contexts", false);
            add("counted", "no_contexts", false);
        }
    }
    for probe in ["probe_factors", "probe_contexts", "probe_locations"] {
        all.push(("probe", vec![("probe", probe)]));
    }
    all
}

/// What a file declares at module scope, bindings apart, and what it mentions.
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

/// The words of a line that can name something at module scope: not members, parameters or locals
/// where they are declared.
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

/// What is wrong with the first lines of a shader's files.
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

/// Every name of a binding that a file leaves to others.
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
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/shaders");
    let entries = std::fs::read_dir(folder).expect("the folder of shaders");
    let mut in_folder: Vec<String> = entries
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    in_folder.sort();
    let listed: Vec<String> = FILES.iter().map(|(name, _)| format!("{name}.wgsl")).collect();
    assert_eq!(in_folder, listed, "the list and the folder");
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
