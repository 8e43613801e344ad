//! The planted faults of `rtl/dv/circuit.faults`: each must be found, by the stage and the signal that stand there.

use super::bench::Bench;
use super::sources;
use crate::command;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// Random patches that find every fault, and those by whose clocks the slow ones are found.
const PATCHES: [&str; 3] = ["+random=20000", "+gaps", "+resets=200"];
const TIMED: [&str; 1] = ["+random=500"];

/// A fault of the list, as `plant.py --list` prints it.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Fault {
    pub(super) number: String,
    kind: String,
    module: String,
    seen_by: String,
    pub(super) name: String,
}

/// Plants each fault, and prints what finds it.
///
/// # Errors
/// One is not found, or something else is named first.
pub(crate) fn run() -> Result<(), String> {
    let bench = Bench::with_faults()?;
    bench.compare(&PATCHES)?;
    let clocks = bench.compare(&TIMED)?.clocks;
    println!("\nplanted faults, each found by random patches:");
    for fault in list()? {
        let began = Instant::now();
        let seen = fault.seen(&bench, clocks)?;
        let Fault { number, kind, module, seen_by, name } = fault;
        if seen != seen_by {
            return Err(format!("fault {number}, {name}: seen by {seen_by} so far, now by {seen}"));
        }
        let seconds = began.elapsed().as_secs_f32();
        println!("  {number:>2} {kind}, {module}: {name}: {seen_by}, {seconds:.1} s");
    }
    Ok(())
}

impl Fault {
    /// What sees it, as the list says it: the first difference or assertion, more clocks than without it, or nobody.
    fn seen(&self, bench: &Bench, clocks: u64) -> Result<String, String> {
        let planted = format!("+fault={}", self.number);
        if self.kind == "throughput" {
            let slow = bench.compare(&[&planted, TIMED[0]])?;
            return Ok(if slow.clocks > clocks { "clocks" } else { "nobody" }.to_owned());
        }
        let (succeeded, said) = bench.output(&[&[planted.as_str()], &PATCHES[..]].concat())?;
        let mut words = said.lines().filter_map(|line| {
            let (kind, rest) = line.split_once(" stage=")?;
            let (stage, signal) = rest.split_once(" signal=")?;
            let of = match kind {
                "MISMATCH" => "",
                "ASSERTION" => "assertion ",
                _ => return None,
            };
            Some(format!("{of}{stage} {}", signal.split(' ').next()?))
        });
        Ok(words.next().filter(|_| !succeeded).unwrap_or_else(|| "nobody".to_owned()))
    }
}

/// All faults, in their order.
///
/// # Errors
/// The list is not understood, or Python is missing.
pub(super) fn list() -> Result<Vec<Fault>, String> {
    let said = command::output(planter().arg("--list"))?;
    let fault = |line: &str| match line.split('\t').collect::<Vec<_>>()[..] {
        [number, kind, module, seen_by, name] => Ok(Fault {
            number: number.to_owned(),
            kind: kind.to_owned(),
            module: module.to_owned(),
            seen_by: seen_by.to_owned(),
            name: name.to_owned(),
        }),
        _ => Err(format!("not NUMBER KIND MODULE SEEN NAME: `{line}`")),
    };
    said.lines().map(fault).collect()
}

/// Writes the design to a folder, with the fault of this name or with none.
///
/// # Errors
/// There is no such fault, or it has no place in the design.
pub(super) fn plant(folder: &Path, name: Option<&str>) -> Result<(), String> {
    let number = match name {
        None => "0".to_owned(),
        Some(name) => {
            let found = list()?.into_iter().find(|fault| fault.name == name);
            found.ok_or_else(|| format!("no fault `{name}`"))?.number
        }
    };
    command::run(planter().arg(folder).args(["--fault", &number]))
}

fn planter() -> Command {
    let mut planter = Command::new("python3");
    planter.arg(sources().join("dv/plant.py"));
    planter
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kit::rtl::names::{Signal, signals};

    /// Each has its place, and is seen by a signal that there is.
    #[test]
    fn the_list_is_read() {
        let folder = std::env::temp_dir().join(format!("tess-circuit-{}", std::process::id()));
        command::run(planter().arg(&folder)).expect("every fault has one place");
        std::fs::remove_dir_all(folder).expect("removed");
        let faults = list().expect("a list");
        assert!(faults.len() >= 90, "all faults");
        for Fault { name, seen_by, .. } in &faults {
            let names = |known: Signal| *seen_by == format!("{} {}", known.stage, known.name);
            let is_known =
                seen_by == "clocks" || seen_by.starts_with("assertion ") || signals().any(names);
            assert!(is_known, "{name}: {seen_by}");
        }
    }
}
