//! The covergroups of `tess_uvm`, written from the bins of `tess-verify`.

use crate::command::workspace;
use std::fmt::Write;
use std::path::PathBuf;
use tess_verify::coverage::Coverage;

/// Writes the file anew.
pub(crate) fn write() -> Result<(), String> {
    let file = file();
    std::fs::write(&file, text()).map_err(|error| format!("{}: {error}", file.display()))
}

fn file() -> PathBuf {
    workspace().join("bindings/uvm/src/tess_covergroups.svh")
}

const HEAD: &str = "\
// Written by `cargo xtask covergroups` from the bins of tess-verify. Do not edit.
//
// A covergroup for each group of bins. Bins are numbered in alphabetical order of their paths, as
// tess_dpi::model_coverage numbers them.
";

/// The file.
fn text() -> String {
    let coverage = Coverage::new();
    let bins: Vec<(&str, &str)> =
        coverage.bins().map(|(bin, _)| bin.split_once('/').unwrap_or((bin, bin))).collect();
    let groups: Vec<String> = coverage.groups().into_iter().map(|group| group.name).collect();
    let mut text = HEAD.to_owned();
    // Writing to a String does not fail.
    _ = writeln!(text, "class tess_covergroups;");
    for group in &groups {
        _ = writeln!(text, "    covergroup cg_{group} with function sample(int unsigned bin);");
        _ = writeln!(text, "        cp_{group}: coverpoint bin {{");
        for (number, (_, name)) in bins.iter().enumerate().filter(|(_, (of, _))| of == group) {
            _ = writeln!(text, "            bins b_{} = {{{number}}};", name.replace('/', "_"));
        }
        _ = writeln!(text, "        }}\n    endgroup\n");
    }
    _ = writeln!(text, "    function new();");
    groups.iter().for_each(|group| _ = writeln!(text, "        cg_{group} = new();"));
    _ = writeln!(text, "    endfunction\n\n    // Counts a bin in the group that has it.");
    _ = writeln!(text, "    function void sample(int unsigned bin);");
    let mut word = "if";
    for group in &groups {
        let numbers = || (0..).zip(&bins).filter(|(_, (of, _))| of == group).map(|(n, _)| n);
        let last: usize = numbers().last().unwrap_or(0);
        _ = writeln!(text, "        {word} (bin <= {last}) cg_{group}.sample(bin);");
        word = "else if";
    }
    _ = writeln!(text, "    endfunction\nendclass");
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn covergroups_are_up_to_date() {
        let found = std::fs::read_to_string(file()).expect("the file");
        let same = found == text();
        assert!(same, "the bins have changed: run `cargo xtask covergroups`");
    }

    /// The numbers of a group are consecutive, as `sample` takes them to be.
    #[test]
    fn groups_are_consecutive() {
        let coverage = Coverage::new();
        let mut groups: Vec<&str> =
            coverage.bins().map(|(bin, _)| bin.split('/').next().unwrap_or(bin)).collect();
        groups.dedup();
        assert_eq!(groups.len(), coverage.groups().len(), "each group once");
    }
}
