//! Takes a new record.

use super::{Record, file, folder, performance};
use crate::command::{self, cargo, workspace};
use std::fs;
use std::process::Command;

/// Usage of `cargo xtask record`.
const USAGE: &str = "\
usage: cargo xtask record NAME [--machine TEXT] [--rows FILE] -- BENCH-ARGUMENT...";

/// Options of `cargo xtask record`.
#[derive(Debug, Default, PartialEq, Eq)]
struct Request<'a> {
    name: &'a str,
    /// Says what ran it, instead of this machine's processor.
    machine: Option<&'a str>,
    /// Rows that `tess bench --json` printed elsewhere, instead of running it here.
    rows: Option<&'a str>,
    bench: &'a [&'a str],
}

/// Runs `tess bench --json` and writes its rows to `benches/records/NAME.json`.
///
/// # Errors
/// Sources that no commit has, a bench that fails, or a processor that has no name here.
pub(crate) fn run(arguments: &[&str]) -> Result<(), String> {
    let request = parsed(arguments)?;
    let bench = format!("run --release --quiet -- bench --json {}", request.bench.join(" "));
    let commit = commit()?;
    let machine = match request.machine {
        Some(machine) => machine.to_owned(),
        None => processor()?,
    };
    let text = match request.rows {
        Some(path) => fs::read_to_string(path).map_err(|error| format!("{path}: {error}"))?,
        None => command::output(&mut cargo(&bench))?,
    };
    let rows = serde_json::from_str(&text)
        .map_err(|error| format!("not the rows of `tess bench --json`: {error}"))?;
    let date = command::output(Command::new("date").args(["-u", "+%F"]))?.trim().to_owned();
    let command = format!("cargo {}", bench.replace(" --quiet", ""));
    let record = Record { command, machine, date, commit, columns: vec![], rows };
    fs::create_dir_all(folder()).map_err(|error| error.to_string())?;
    let path = file(request.name);
    fs::write(&path, record.text()).map_err(|error| format!("{}: {error}", path.display()))?;
    println!("wrote {}", path.display());
    performance::run()
}

fn parsed<'a>(arguments: &'a [&'a str]) -> Result<Request<'a>, String> {
    let at = arguments.iter().position(|&word| word == "--").ok_or(USAGE)?;
    let (own, bench) = (&arguments[..at], &arguments[at + 1..]);
    let [name, options @ ..] = own else { return Err(USAGE.into()) };
    let is_fine = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '-';
    if !name.starts_with(|c: char| c.is_ascii_lowercase()) || !name.chars().all(is_fine) {
        return Err(format!("`{name}`: a name has lower-case letters, digits and hyphens"));
    }
    let mut request = Request { name, bench, ..Request::default() };
    for pair in options.chunks(2) {
        match *pair {
            ["--machine", text] => request.machine = Some(text),
            ["--rows", path] => request.rows = Some(path),
            _ => return Err(format!("`{}`: not an option. {USAGE}", pair.join(" "))),
        }
    }
    Ok(request)
}

/// The commit that is measured; sources must not differ from it.
fn commit() -> Result<String, String> {
    let git = |arguments: &[&str]| {
        let mut git = Command::new("git");
        command::output(git.args(arguments).current_dir(workspace()))
    };
    let changed = git(&["status", "--porcelain", "--", ".", ":!benches/records", ":!docs"])?;
    if !changed.is_empty() {
        return Err(format!("a record names a commit; commit these first:\n{changed}"));
    }
    Ok(git(&["rev-parse", "--short=10", "HEAD"])?.trim().to_owned())
}

/// The name of this machine's processor, as Linux knows it.
fn processor() -> Result<String, String> {
    let unknown = "what machine is this? Say it with --machine TEXT";
    let text =
        fs::read_to_string("/proc/cpuinfo").map_err(|error| format!("{unknown} ({error})"))?;
    let name = text.lines().find_map(|line| line.strip_prefix("model name")?.split_once(": "));
    let (_, name) = name.ok_or(unknown)?;
    let count = std::thread::available_parallelism().map_err(|error| error.to_string())?;
    Ok(format!("{name}, {count} processors"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn options_stand_before_the_arguments_of_the_bench() {
        let words = ["simd-zen", "--machine", "a box", "--", "--backend", "simd"];
        let request = Request {
            name: "simd-zen",
            machine: Some("a box"),
            rows: None,
            bench: &["--backend", "simd"],
        };
        assert_eq!(parsed(&words), Ok(request), "all of them");
        let wrong: [&[&str]; 4] =
            [&["a"], &["--", "x"], &["../a", "--"], &["a", "--machine", "--"]];
        for words in wrong {
            assert!(parsed(words).is_err(), "{words:?}");
        }
    }
}
