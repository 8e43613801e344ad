//! The planted faults of `rtl/dv/circuit.faults`: each must be found, by the stage and the signal that stand there.

use super::bench::Bench;
use super::sources;
use crate::command;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

/// Random patches that find every fault.
const PATCHES: &str = "+random=20000";

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
/// One is not found, or another stage or signal is named first.
pub(crate) fn run() -> Result<(), String> {
    let bench = Bench::with_faults()?;
    println!("\nplanted faults, each found by random patches:");
    for fault in list()? {
        let began = Instant::now();
        let (succeeded, said) =
            bench.output(&[&format!("+fault={}", fault.number), PATCHES, "+gaps"])?;
        let first = said.lines().find(|line| line.starts_with("MISMATCH")).unwrap_or("nothing");
        let Fault { number, kind, module, name, .. } = &fault;
        if succeeded || !first.starts_with(&fault.names()?) {
            return Err(format!(
                "fault {number} is not found as `{}`, but: {first}",
                fault.names()?
            ));
        }
        let asserts = said.lines().find_map(|line| line.strip_prefix("ASSERTION "));
        let asserts = asserts.and_then(|line| line.split(" at ").next()).unwrap_or("none");
        let seconds = began.elapsed().as_secs_f32();
        println!(
            "  {number:>2} {kind}, {module}: {name}: {} (assertion: {asserts}), {seconds:.1} s",
            fault.seen_by
        );
    }
    Ok(())
}

impl Fault {
    /// The beginning of the line by which the bench names it.
    fn names(&self) -> Result<String, String> {
        let (stage, signal) = self.seen_by.split_once(' ').ok_or("not STAGE SIGNAL")?;
        Ok(format!("MISMATCH stage={stage} signal={signal} "))
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
    use crate::kit::rtl::names::signals;

    /// Each has its place, and is seen by a signal that there is.
    #[test]
    fn the_list_is_read() {
        let folder = std::env::temp_dir().join(format!("tess-circuit-{}", std::process::id()));
        command::run(planter().arg(&folder)).expect("every fault has one place");
        std::fs::remove_dir_all(folder).expect("removed");
        let faults = list().expect("a list");
        assert!(faults.len() >= 16, "all faults");
        for fault in &faults {
            let names = fault.names().expect("a stage and a signal");
            let is_known = signals().any(|known| {
                names == format!("MISMATCH stage={} signal={} ", known.stage, known.name)
            });
            assert!(is_known, "{}: {}", fault.name, fault.seen_by);
        }
    }
}
