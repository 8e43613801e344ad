//! The names that the bench in Verilator prints, written from the signals of `tess-verify`.

use super::sources;
use crate::command::in_file;
use std::fmt::Write;
use std::path::PathBuf;
use tess_verify::show::{Signal, signals};

const HEAD: &str = "\
// Written by `cargo xtask rtl --names` from tess_verify::show::signals. Do not edit.
// The bench includes it: the number of each signal, then names by number. OPTIONS chooses in `tess explain` what
// the signal describes.
";

/// Writes the file anew.
///
/// # Errors
/// It cannot be written.
pub(crate) fn write() -> Result<(), String> {
    std::fs::write(file(), text()).map_err(|error| in_file(&file(), &error))
}

fn file() -> PathBuf {
    sources().join("tb/tess_names.svh")
}

/// The file.
fn text() -> String {
    let signals: Vec<(&str, &Signal)> = signals().collect();
    let mut text = HEAD.to_owned();
    // Writing to a String does not fail.
    for (number, (_, Signal { stage, name, .. })) in signals.iter().enumerate() {
        let constant = format!("{stage}_{name}").to_uppercase();
        _ = writeln!(text, "localparam int unsigned {constant} = {number};");
    }
    let mut array = |title: &str, name: &dyn Fn(&(&str, &Signal)) -> String| {
        let names: Vec<String> =
            signals.iter().map(|one| format!("    \"{}\"", name(one))).collect();
        _ = writeln!(text, "string {title}[{}] = '{{\n{}\n}};", names.len(), names.join(",\n"));
    };
    array("STAGES", &|(_, signal)| signal.stage.to_owned());
    array("SIGNALS", &|(_, signal)| signal.name.to_owned());
    array("MODULES", &|(_, signal)| signal.module.to_owned());
    array("OPTIONS", &|(option, _)| (*option).to_owned());
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_file_is_up_to_date() {
        let found = std::fs::read_to_string(file()).expect("the names");
        assert!(found == text(), "tess_names.svh is stale: run `cargo xtask rtl --names`");
    }

    /// Each module is a file of that name, and has the signal.
    #[test]
    fn modules_have_their_signals() {
        for (_, Signal { name, module, .. }) in signals() {
            let file = sources().join(format!("{module}.sv"));
            let source = std::fs::read_to_string(&file).expect("a module");
            assert!(source.contains(&format!("module {module} ")), "{module}");
            let is_there = source.split(|c: char| !c.is_alphanumeric() && c != '_');
            let names = [(*name).to_owned(), format!("out_{name}"), format!("is_{name}")];
            assert!(
                is_there.into_iter().any(|word| names.iter().any(|name| name == word)),
                "{module} {name}"
            );
        }
    }
}
