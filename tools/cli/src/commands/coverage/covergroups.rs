//! Writes the covergroups of `tess_uvm` from the bins.

use std::fmt::Write;
use tess_verify::cover::Coverage;

const HEAD: &str = "\
// Written by `tess coverage --covergroups FILE`. Do not edit.
//
// A covergroup for each group of bins. Bins are numbered in alphabetical order of their paths, as
// tess_dpi::model_coverage numbers them. It sees one patch, so sequences have none.
";

/// A class in SystemVerilog with one covergroup per group of bins; `sample` takes the number of a
/// bin.
pub(super) fn text() -> String {
    let coverage = Coverage::default();
    let bins: Vec<(&str, &str)> =
        coverage.bins().map(|(bin, _)| bin.split_once('/').unwrap_or((bin, bin))).collect();
    let groups = coverage.groups().into_iter().map(|group| group.name);
    let groups: Vec<String> = groups.filter(|group| group != "sequence").collect();
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
        let last = bins.iter().rposition(|(of, _)| of == group).unwrap_or(0);
        _ = writeln!(text, "        {word} (bin <= {last}) cg_{group}.sample(bin);");
        word = "else if";
    }
    _ = writeln!(text, "    endfunction\nendclass");
    text
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `sample` relies on two facts: the numbers of a group are consecutive, and every bin has one.
    #[test]
    fn every_bin_is_in_its_group() {
        let (text, coverage) = (text(), Coverage::default());
        let group = |line: &str| line.trim().strip_prefix("cp_").map(|rest| rest.to_owned());
        let mut names = Vec::new();
        let mut at = String::new();
        for line in text.lines() {
            at = group(line).and_then(|g| Some(g.split_once(':')?.0.to_owned())).unwrap_or(at);
            if let Some(bin) = line.trim().strip_prefix("bins b_") {
                names.push(format!("{at}_{bin}"));
            }
        }
        let of_patches = |(_, (bin, _)): &(usize, (&str, u64))| !bin.starts_with("sequence/");
        let expected = coverage.bins().enumerate().filter(of_patches);
        let expected =
            expected.map(|(n, (bin, _))| format!("{} = {{{n}}};", bin.replace('/', "_")));
        assert!(names.iter().cloned().eq(expected), "bins in order: {:?}", names.first());
    }
}
