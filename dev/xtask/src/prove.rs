//! The checks of `docs/proof.md` that take long. The lemmas are printed with what was counted.

use crate::command::{self, cargo, in_file, workspace};
use crate::{rtl, setup};
use std::process::Command;
use std::time::{Duration, Instant};

/// A group of checks, and the lemmas of `docs/proof.md` that rest on it.
struct Part {
    name: &'static str,
    lemmas: &'static [&'static str],
    /// Runs the checks; returns what they counted, a line each.
    run: fn() -> Result<Vec<String>, String>,
}

const PARTS: &[Part] = &[
    Part {
        name: "composition",
        lemmas: &[
            "a factor is processed from its bits, its role, the settings and one bit of its patch",
            "stitches are made of point counts, each at the sum of the counts before it",
            "points are made of locations",
        ],
        run: composition,
    },
    Part {
        name: "triangle",
        lemmas: &["points inside a triangle are in the triangle, for all locations"],
        run: triangle,
    },
    Part {
        name: "exhaustive",
        lemmas: &[
            "every factor in each role and spacing",
            "every context and every location",
            "every transition and every interior",
        ],
        run: exhaustive,
    },
    Part {
        name: "circuit",
        lemmas: &[
            "tess_factor equals section 3 and tess_place section 5, for all inputs",
            "no element is dropped or duplicated, for any number of clocks",
        ],
        run: circuit,
    },
];

/// Runs the parts with these names, or all; prints the lemmas with counts, and what is only tested.
///
/// # Errors
/// There is no part of a name, a check fails, or a planted fault is not seen.
pub(crate) fn run(names: &[&str]) -> Result<(), String> {
    let known = || PARTS.iter().map(|part| part.name).collect::<Vec<_>>().join(", ");
    if let Some(name) = names.iter().find(|name| PARTS.iter().all(|part| part.name != **name)) {
        return Err(format!("prove has no part {name}; it has {}", known()));
    }
    let mut table = String::new();
    for part in PARTS.iter().filter(|part| names.is_empty() || names.contains(&part.name)) {
        let start = Instant::now();
        let counted = (part.run)()?;
        table += &rows(part, &counted, start.elapsed());
    }
    println!("\n{table}\n{ENDS}");
    Ok(())
}

/// A part in the table at the end.
fn rows(part: &Part, counted: &[String], time: Duration) -> String {
    let mut rows = format!("{}, {} s\n", part.name, time.as_secs());
    part.lemmas.iter().for_each(|lemma| rows += &format!("  lemma    {lemma}\n"));
    counted.iter().for_each(|line| rows += &format!("  checked  {line}\n"));
    rows
}

/// The last lines of the output: what follows from the lemmas, and what does not.
const ENDS: &str = "\
proved, by enumeration of every input of each part and by the signatures that docs/proof.md lists:
  the output of the model, of tess-simd and of tess-gpu is determined by the parts above
only tested, on random and extreme inputs:
  the code that joins the parts in tess-simd and tess-gpu (lanes, chunks, threads, tiles, windows)
  the circuit's walks (tess_points, tess_connect, tess_rows) and its counts
  compilers, drivers and devices, which a proof about source text cannot include";

/// The tests of the composition, with those that take long.
fn composition() -> Result<Vec<String>, String> {
    let mut tests = cargo("test --package tess-core --test composition");
    let said = command::output(tests.args(["--", "--include-ignored", "--nocapture"]))?;
    let classes = |line: &str| line.strip_prefix("classes: ").map(str::to_owned);
    let counted: Vec<String> = said.lines().filter_map(classes).collect();
    if counted.is_empty() {
        return Err(format!("the tests of the composition counted nothing:\n{said}"));
    }
    Ok(counted)
}

/// The file of the solver's proof, and faults of it with which it must fail.
const PROOF: &str = "dev/proofs/triangle.smt2";
const FAULTS: &[(&str, &str, &str)] = &[
    ("distances of more than twice the ring's", "000000000000aaaa", "000000000002aaaa"),
    ("points before their ring near the edge", "0000000000000400", "0000000000000000"),
];

/// Has Z3 prove the formula of points inside triangles, and refute it with planted faults.
fn triangle() -> Result<Vec<String>, String> {
    setup::provide(&[setup::Z3])?;
    let path = workspace().join(PROOF);
    let text = command::read(&path)?;
    if answer(&text)? != "unsat" {
        return Err(format!("{PROOF}: z3 finds locations that lead out of the triangle"));
    }
    for (fault, right, wrong) in FAULTS {
        let planted = text.replace(right, wrong);
        if planted == text {
            return Err(format!("{PROOF} does not have the text of the fault `{fault}`: {right}"));
        }
        let answer = answer(&planted)?;
        if answer != "sat" {
            return Err(format!("{PROOF}: z3 says {answer}, not sat, with the fault `{fault}`"));
        }
    }
    Ok(vec![format!("all pairs of locations, by z3; {} planted faults refuted", FAULTS.len())])
}

/// Z3's answer to a text.
fn answer(text: &str) -> Result<String, String> {
    let folder = command::target().join("tmp");
    let file = folder.join("prove.smt2");
    std::fs::create_dir_all(&folder)
        .and_then(|()| std::fs::write(&file, text))
        .map_err(|error| in_file(&file, &error))?;
    let said = command::quiet_output(Command::new("z3").arg(&file))?;
    Ok(said.trim().to_owned())
}

/// Everything finite: the model's second formulation and `tess-simd` with the model.
fn exhaustive() -> Result<Vec<String>, String> {
    let mut verify = cargo("run --release --package tess-program --no-default-features --");
    verify.args(["verify", "--exhaustive", "--backend", "core", "--backend", "simd"]);
    println!("\n$ {}", command::shown(&verify));
    let said = command::output(&mut verify)?;
    let counted: Vec<String> = said.lines().skip(1).map(str::to_owned).collect();
    Ok(counted)
}

/// The proofs of the circuit, which plant faults of their own.
fn circuit() -> Result<Vec<String>, String> {
    rtl::run(&["--prove"])?;
    Ok(vec!["the proofs of rtl/dv/formal and the gates, whose lines are above".to_owned()])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A part that does not exist is refused before anything runs.
    #[test]
    fn an_unknown_part_is_refused() {
        let error = run(&["compositon"]).expect_err("a misspelt name");
        assert!(error.contains("composition, triangle"), "{error}");
    }
}
