//! The circuit's cost: `rtl/synth` runs Yosys, and its reports become tables.

use crate::tools::{YOSYS, sources};
use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use tess_commands::command::{self, in_file, target};
use tess_commands::setup;

/// Prints a table of cells and flip-flops by module, and the resources of two FPGA families.
///
/// # Errors
/// Yosys is missing or fails, or its output is not understood.
pub(crate) fn run() -> Result<(), String> {
    setup::provide(&[YOSYS])?;
    let folder = target().join("rtl/synth");
    command::run(Command::new(sources().join("synth")).arg(&folder))?;
    println!("\n| module | cells | of them flip-flops |\n| --- | --- | --- |");
    for (module, cells) in statistics(&folder, "generic")? {
        let name = module.replace("$paramod\\", "").replace('\\', " ");
        let all: u64 =
            cells.iter().filter(|(kind, _)| kind.starts_with("$_")).map(|(_, n)| n).sum();
        println!("| `{name}` | {all} | {} |", sum(&cells, &["DFF"]));
    }
    println!(
        "\n| family | LUTs | carries | multipliers | flip-flops |\n| --- | --- | --- | --- | --- |"
    );
    for (family, name) in [("iCE40", "ice40"), ("ECP5", "ecp5")] {
        let modules = statistics(&folder, name)?;
        let cells = modules.get("design").ok_or(format!("{name}.txt has no whole design"))?;
        let of = |kinds: &[&str]| sum(cells, kinds);
        let (luts, carries) = (of(&["SB_LUT4", "LUT4"]), of(&["SB_CARRY", "CCU2C"]));
        let (multipliers, registers) = (of(&["SB_MAC16", "MULT18"]), of(&["SB_DFF", "TRELLIS_FF"]));
        println!("| {family} | {luts} | {carries} | {multipliers} | {registers} |");
    }
    Ok(())
}

/// The number of cells of each kind.
type Cells = BTreeMap<String, u64>;

/// The number of cells whose kind contains one of these words.
fn sum(cells: &Cells, kinds: &[&str]) -> u64 {
    let is_meant = |kind: &str| kinds.iter().any(|part| kind.contains(part));
    cells.iter().filter(|(kind, _)| is_meant(kind)).map(|(_, number)| number).sum()
}

/// The cells of each module, and of the whole `design`.
fn statistics(folder: &Path, name: &str) -> Result<BTreeMap<String, Cells>, String> {
    let file = folder.join(format!("{name}.txt"));
    let text = command::read(&file)?;
    let modules = read(&text);
    if modules.is_empty() {
        return Err(in_file(&file, &"no statistics of Yosys"));
    }
    Ok(modules)
}

fn read(text: &str) -> BTreeMap<String, Cells> {
    let mut modules: BTreeMap<String, Cells> = BTreeMap::new();
    let mut module = String::new();
    for line in text.lines() {
        if let Some(title) = line.strip_prefix("=== ") {
            let title = title.trim_end_matches(" ===");
            module = if title == "design hierarchy" { "design" } else { title }.to_owned();
            modules.entry(module.clone()).or_default();
        } else if let [kind, number] = line.split_whitespace().collect::<Vec<_>>()[..]
            && let Ok(number) = number.parse()
            && let Some(cells) = modules.get_mut(&module)
        {
            cells.insert(kind.to_owned(), number);
        }
    }
    // A flat design has one module, which is the whole design.
    if modules.len() == 1 {
        modules = modules.into_values().map(|cells| ("design".to_owned(), cells)).collect();
    }
    modules
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn statistics_are_read() {
        let flat =
            "=== tess_top ===\n\n   Number of cells:    3\n     $_XOR_    2\n     SB_DFFE   1\n";
        let modules = read(flat);
        assert_eq!(sum(&modules["design"], &["DFF"]), 1, "flip-flops");
        let text = format!("{flat}=== design hierarchy ===\n   tess_top  1\n     $_XOR_   5\n");
        assert_eq!(sum(&read(&text)["design"], &["XOR"]), 5, "the whole design");
    }
}
