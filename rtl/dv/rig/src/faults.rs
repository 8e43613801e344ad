//! The planted faults of the circuit: copies of the design with one of them, or with all of them
//! behind a switch.
//!
//! The text of a fault occurs once in its file. It is an expression, `assign` with one
//! (declarations may precede the wrong one), or whole statements of a procedure, so that a switch
//! can choose between it and the wrong text. The third fault of the list, `wide[7]` replaced by
//! `1'b1`, changes the design like this:
//!
//! ```text
//! up = wide[7] && low;
//! up = (tess_fault_pkg::number == 3 ? (1'b1) : (wide[7])) && low;
//! ```

use std::cmp::Reverse;
use std::fs;
use std::ops::Range;
use std::path::Path;
use tess_commands::command::{in_file, read, workspace};
use tess_testkit::listed::{ListedFault, parse};

/// The list, from the root of the repository. Its `seen by` names the first report of the bench.
const LIST: &str = "rtl/dv/circuit.faults";

const SWITCH: &str = "\
// Which fault is planted: +fault=N, 0 none.
package tess_fault_pkg;
    function automatic int chosen();
        chosen = 0;
        void'($value$plusargs(\"fault=%d\", chosen));
    endfunction
    int number = chosen();
endpackage
";

/// The faults, numbered from 1.
///
/// # Errors
/// The list cannot be read, or it names a file that does not exist.
pub(crate) fn listed() -> Result<Vec<(usize, ListedFault)>, String> {
    let root = workspace();
    let list = read(&root.join(LIST))?;
    let faults = parse(&list).map_err(|error| format!("{LIST}: {error}"))?;
    if let Some(fault) = faults.iter().find(|fault| !root.join(&fault.folder).is_file()) {
        return Err(format!("{LIST}: there is no file {}", fault.folder));
    }
    Ok((1..).zip(faults).collect())
}

/// Writes the design to `folder`, with all faults or with one, and prints the numbers of those it
/// has.
///
/// # Errors
/// `number` is not the number of a fault, or see [`plant`].
pub(crate) fn write(folder: &Path, number: Option<&str>) -> Result<(), String> {
    let number = number.map(|number| number.parse().map_err(|error| format!("{number}: {error}")));
    let number: Option<usize> = number.transpose()?;
    plant(folder, number)?;
    for (own, fault) in listed()? {
        if number.is_none_or(|number| number == own) {
            println!("{own:>3} {}: {}", fault.folder, fault.name);
        }
    }
    Ok(())
}

/// Writes the design to `folder`: with the fault of this number, with none for 0, or without a
/// number with every fault, of which a simulation's `+fault=N` plants one. A file that already has
/// the right contents is not touched.
///
/// # Errors
/// There is no such fault, its text does not occur exactly once, or a file cannot be read or
/// written.
pub(crate) fn plant(folder: &Path, number: Option<usize>) -> Result<(), String> {
    let (root, all) = (workspace(), listed()?);
    if number.is_some_and(|number| number > all.len()) {
        return Err(format!("{LIST} has {} faults", all.len()));
    }
    fs::create_dir_all(folder).map_err(|error| in_file(folder, &error))?;
    let design = root.join("rtl");
    for entry in fs::read_dir(&design).map_err(|error| in_file(&design, &error))? {
        let file = entry.map_err(|error| in_file(&design, &error))?.path();
        let name = file.file_name().unwrap_or_default().to_string_lossy().into_owned();
        let is_source = [".sv", ".svh", ".f"].iter().any(|end| name.ends_with(end));
        if !is_source || !name.starts_with("tess") {
            continue;
        }
        let is_here = |(_, fault): &&(usize, ListedFault)| root.join(&fault.folder) == file;
        let here: Vec<_> = all.iter().filter(is_here).collect();
        let text = read(&file)?;
        let planted = match number {
            None => switched(&text, &here)?,
            Some(number) => match here.into_iter().find(|(own, _)| *own == number) {
                Some((_, fault)) => {
                    place(&text, fault)?;
                    text.replace(&fault.right, &fault.wrong)
                }
                None => text,
            },
        };
        let package =
            if number.is_none() { "\ntess_fault_pkg.sv\ntess_pkg.sv" } else { "\ntess_pkg.sv" };
        update(&folder.join(&name), &planted.replace("\ntess_pkg.sv", package))?;
    }
    match number {
        None => update(&folder.join("tess_fault_pkg.sv"), SWITCH),
        Some(_) => Ok(()),
    }
}

/// The text with these faults behind switches; the text of one may be inside another's.
fn switched(text: &str, faults: &[&(usize, ListedFault)]) -> Result<String, String> {
    let placed = faults.iter().map(|&fault| Ok((place(text, &fault.1)?, fault)));
    let mut places = placed.collect::<Result<Vec<_>, String>>()?;
    places.sort_by_key(|(place, _)| (place.start, Reverse(place.end)));
    let (mut made, mut at, mut rest) = (String::new(), 0, &places[..]);
    while let [(outer, (_, fault)), ..] = rest {
        let (touched, later) =
            rest.split_at(rest.partition_point(|(place, _)| place.start < outer.end));
        if touched.iter().any(|(place, _)| place.end > outer.end) {
            return Err(format!("{}: overlaps another fault", fault.name));
        }
        let (same, within) = touched.split_at(touched.partition_point(|(place, _)| place == outer));
        let within: Vec<_> = within.iter().map(|&(_, fault)| fault).collect();
        let right = switched(&text[outer.clone()], &within)?;
        let wrong: Vec<(usize, &str)> =
            same.iter().map(|(_, (number, fault))| (*number, fault.wrong.as_str())).collect();
        made = made + &text[at..outer.start] + &chosen(&right, &wrong)?;
        (at, rest) = (outer.end, later);
    }
    Ok(made + &text[at..])
}

/// The right text, or one of the wrong ones, selected by number.
fn chosen(right: &str, wrong: &[(usize, &str)]) -> Result<String, String> {
    let each = |form: &dyn Fn(usize, &str) -> String| -> String {
        wrong.iter().map(|&(number, wrong)| form(number, wrong)).collect()
    };
    let Some(statements) = right.strip_suffix(';').or_else(|| right.strip_suffix(" end")) else {
        let wrong = each(&|n, wrong| format!("tess_fault_pkg::number == {n} ? ({wrong}) : "));
        return Ok(format!("({wrong}({right}))"));
    };
    let assigned =
        statements.trim_start().starts_with("assign ").then(|| statements.split_once("= "));
    let Some((head, value)) = assigned.flatten() else {
        let wrong =
            each(&|n, wrong| format!("if (tess_fault_pkg::number == {n}) begin {wrong} end else "));
        return Ok(format!("{wrong}begin {right} end"));
    };
    // The declarations that precede a wrong `assign` stay before it.
    let same = format!("{}= ", head.trim_start());
    let (mut before, mut values) = (String::new(), Vec::new());
    for &(number, wrong) in wrong {
        let parts =
            wrong.rsplit_once(&same).and_then(|(b, value)| Some((b, value.strip_suffix(';')?)));
        let (declared, value) = parts.ok_or_else(|| format!("`{wrong}` has no `{same}`"))?;
        before += declared;
        values.push((number, value));
    }
    Ok(format!("{before}{head}= {};", chosen(value, &values)?))
}

/// The only place of a fault's text.
fn place(text: &str, fault: &ListedFault) -> Result<Range<usize>, String> {
    let ListedFault { name, folder, right, .. } = fault;
    match (text.find(right), fault.places(text)) {
        (Some(start), 1) => Ok(start..start + right.len()),
        (_, places) => Err(format!("{name}: {folder} has its text {places} times")),
    }
}

/// Writes a file, unless it has this text.
fn update(file: &Path, text: &str) -> Result<(), String> {
    if read(file).is_ok_and(|old| old == text) {
        return Ok(());
    }
    fs::write(file, text).map_err(|error| in_file(file, &error))
}
