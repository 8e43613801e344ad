//! The lists of the design's files for Bender and `FuseSoC`, generated from `rtl/tess.f`; and tests
//! of the signals in `rtl/stages.tsv`.

use crate::tools::sources;
use std::path::{Path, PathBuf};
use tess_commands::command::{self, in_file};

/// Writes the files again.
///
/// # Errors
/// A file cannot be read or written.
pub(crate) fn write() -> Result<(), String> {
    for (file, text) in files()? {
        std::fs::write(&file, text).map_err(|error| in_file(&file, &error))?;
    }
    Ok(())
}

/// Each file, and its text.
fn files() -> Result<[(PathBuf, String); 2], String> {
    let list = command::read(&sources().join("tess.f"))?;
    let listed = |name: &str| {
        let file = sources().join(name);
        let text = command::read(&file)?;
        Ok::<_, String>((file, with_list(&text, &list)))
    };
    Ok([listed("Bender.yml")?, listed("tess.core")?])
}

/// The text with these sources in place of those that it lists.
fn with_list(text: &str, list: &str) -> String {
    let is_source = |line: &str| Path::new(line).extension().is_some_and(|end| end == "sv");
    let mut sources: Vec<&str> = list.lines().filter(|line| is_source(line)).collect();
    let mut lines = Vec::new();
    for line in text.lines() {
        match line.split_once("- ").filter(|(_, file)| file.starts_with("tess_") && is_source(file))
        {
            Some((indent, _)) => {
                lines.extend(sources.drain(..).map(|source| format!("{indent}- {source}")));
            }
            None => lines.push(line.to_owned()),
        }
    }
    lines.join("\n") + "\n"
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{faults, ports, proofs};
    use tess_commands::command::workspace;
    use tess_testkit::listed::ListedFault;

    /// The signals that benches and `tess explain --observed` compare, in an order in which each
    /// feeds those after it.
    const STAGES: &str = include_str!("../../../stages.tsv");

    /// A signal of the circuit.
    struct Signal {
        /// The stage, as test benches name it.
        stage: &'static str,
        /// Its name.
        name: &'static str,
        /// The module that drives it; its file has the same name.
        module: &'static str,
    }

    /// All signals.
    fn signals() -> impl Iterator<Item = Signal> {
        STAGES.lines().filter(|line| !line.starts_with('#')).filter_map(|row| {
            let [_, stage, name, module] = row.split('\t').collect::<Vec<_>>().try_into().ok()?;
            Some(Signal { stage, name, module })
        })
    }

    #[test]
    fn the_files_are_up_to_date() {
        assert_eq!(
            signals().count(),
            STAGES.lines().count() - 2,
            "every row but the head is a signal"
        );
        for (file, text) in files().expect("files") {
            let found = std::fs::read_to_string(&file).expect("a file");
            assert!(found == text, "{} is stale: run `cargo xtask rtl --names`", file.display());
        }
        let listed =
            with_list("a:\n  - tess_b.sv\n  - tess_c.sv\n  - dv/x.sv\n", "tess_d.sv\ntess_b.sv\n");
        assert_eq!(
            listed, "a:\n  - tess_d.sv\n  - tess_b.sv\n  - dv/x.sv\n",
            "in the list's place and order"
        );
    }

    /// Each fault of the circuit is detected by a signal that exists, or by a proof that names it.
    #[test]
    fn faults_name_signals() {
        let faults = faults::listed().expect("a list");
        assert!(faults.len() >= 100, "all faults");
        for (_, ListedFault { name, tests, filters, .. }) in &faults {
            let (stage, filters) = match (&tests[..], &filters[..]) {
                ("buffered" | "four", [stage, filters @ ..]) => (&stage[..], filters),
                both => both,
            };
            let names = |known: Signal| known.stage == stage && [known.name] == *filters;
            let is_seen = match stage {
                "clocks" | "assertion" => true,
                "proof" => proofs::sees(name) || ports::FAULTS.iter().any(|(own, _)| own == name),
                _ => signals().any(names),
            };
            assert!(is_seen, "{name}");
        }
    }

    /// Every module is in the list of the design's files, except one that exists only for its own
    /// tests.
    #[test]
    fn every_module_is_listed() {
        let list = command::read(&sources().join("tess.f")).expect("a list");
        for entry in std::fs::read_dir(sources()).expect("a folder") {
            let name = entry.expect("a file").file_name().to_string_lossy().into_owned();
            let is_listed = list.lines().any(|line| line == name) || name == "tess_placer.sv";
            assert!(is_listed || !name.ends_with(".sv"), "{name} is not in tess.f");
        }
    }

    /// Each port of `tess_top` has its row in the document, and each port and parameter is in the
    /// template.
    #[test]
    fn the_document_has_every_port() {
        let document = command::read(&workspace().join("docs/rtl.md")).expect("a document");
        let template = document.split("```").find(|text| text.contains("tess_top #("));
        let template = template.expect("a template");
        let text = command::read(&sources().join("tess_top.sv")).expect("the top");
        let head = text.split("\n);").next().expect("ports");
        let mut ports = Vec::new();
        for line in head.lines() {
            let code = line.split("//").next().unwrap_or_default().trim().trim_end_matches(',');
            let words: Vec<&str> = code.split_whitespace().collect();
            let (direction, bits, name) = match words[..] {
                ["input", "logic", name] => ("in", "1".to_owned(), name),
                ["output", "logic", name] => ("out", "1".to_owned(), name),
                [side @ ("input" | "output"), "logic", range, name] => {
                    let highest = range.trim_start_matches('[').trim_end_matches(":0]");
                    let bits = highest.strip_suffix("-1").map(|named| format!("`{named}`"));
                    let bits = bits.unwrap_or_else(|| {
                        (highest.parse::<u32>().expect("a range") + 1).to_string()
                    });
                    (if side == "input" { "in" } else { "out" }, bits, name)
                }
                ["parameter", kind, name, "=", default] => {
                    let number = default.trim_start_matches("1'b");
                    let is_row = |line: &str| {
                        line.starts_with(&format!("| `{name}` |"))
                            && line.contains(&format!("| {kind} |"))
                            && line.contains(&format!("| {number} |"))
                    };
                    assert!(document.lines().any(is_row), "{name}, {kind}");
                    let given = format!(".{name}({default})");
                    assert!(template.contains(&given), "{name} in the template");
                    continue;
                }
                _ => continue,
            };
            let row = format!("| `{name}` | {direction} | {bits} | ");
            assert!(document.lines().any(|line| line.starts_with(&row)), "no row {row}");
            let mut named = template.split(|c: char| !c.is_alphanumeric() && c != '_');
            assert!(named.any(|word| word == name), "{name} in the template");
            ports.push(name);
        }
        assert_eq!(ports.len(), 31, "all ports");
    }

    /// `tess explain --signals` refuses a list with other signals than the model's. This one has
    /// all of them.
    #[test]
    fn the_model_has_the_same_signals() {
        use tess_show::Part;
        let parts = [
            ("factor", Part::Factor(0)),
            ("patch", Part::Patch),
            ("point", Part::Point(0)),
            ("primitive", Part::Primitive(0)),
        ];
        let of_model = parts.into_iter().flat_map(|(word, part)| {
            part.signals().iter().map(move |own| format!("{word}\t{}\t{}", own.stage, own.name))
        });
        let rows = STAGES.lines().filter(|line| !line.starts_with('#'));
        let without_modules = rows.filter_map(|row| Some(row.rsplit_once('\t')?.0));
        assert_eq!(without_modules.collect::<Vec<_>>(), of_model.collect::<Vec<_>>(), "in order");
    }

    /// Each module is in a file of the same name, and has the signal.
    #[test]
    fn modules_have_their_signals() {
        for Signal { name, module, .. } in signals() {
            let file = sources().join(format!("{module}.sv"));
            let source = std::fs::read_to_string(&file).expect("a module");
            assert!(source.contains(&format!("module {module} ")), "{module}");
            let is_there = source.split(|c: char| !c.is_alphanumeric() && c != '_');
            let names = [name.to_owned(), format!("out_{name}"), format!("is_{name}")];
            assert!(
                is_there.into_iter().any(|word| names.iter().any(|name| name == word)),
                "{module} {name}"
            );
        }
    }
}
