//! Satellites: parts that use the product as an outsider does, each with one test command.
//!
//! A satellite is tested where it, or what it uses of the product, has changed since it last
//! passed. `dev/satellites.tsv` has a digest of all that for each; who changes one of them runs
//! `cargo xtask satellites`, which tests those whose digest is another and records those that pass.
//! Continuous integration tests what is stale, except for the long ones, of which it says so.

use crate::command::{self, in_file, workspace};
use crate::{dist, explorer, mesa, python, rtl, sdl};
use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::process::Command;
use tess_commands::digest;

/// A satellite.
struct Satellite {
    name: &'static str,
    /// Its folders, and everything else that it uses: folders, files, patterns of Git, or a crate
    /// of the product, of which its sources, shaders and manifest count.
    uses: &'static [&'static str],
    test: fn() -> Result<(), String>,
    /// Whether it is too long for continuous integration, which only says that it is stale.
    is_long: bool,
}

const SATELLITES: &[Satellite] = &[
    Satellite {
        name: "python",
        uses: &[
            "bindings/python",
            ":(glob)rtl/*.sv",
            ":(glob)rtl/*.svh",
            "rtl/dv/cocotb",
            "tess-core",
            "tess-level",
            "tess-simd",
            "tess-show",
            "tess-verify",
        ],
        test: python::run,
        is_long: false,
    },
    Satellite {
        name: "explorer",
        uses: &[
            // The versions and profile that it is built with.
            "Cargo.toml",
            "tools/explorer",
            "bindings/webgpu",
            "bindings/rooms.txt",
            "tools/cli/src/commands/shaders",
            "tess-core",
            "tess-level",
            "tess-simd",
            "tess-gpu",
            "tess-show",
            "tess-surface",
            "tess-verify",
            "tess-wgpu",
            "tess-workloads",
        ],
        test: in_the_browser,
        is_long: false,
    },
    Satellite {
        name: "rtl",
        uses: &[
            "rtl",
            // The figures and ports that it must have.
            "docs/rtl.md",
            "bindings/systemc",
            "bindings/uvm",
            "bindings/c/Cargo.toml",
            "bindings/c/include",
            "bindings/c/src",
            "bindings/c/verilog",
            "dev/commands/src",
            "dev/testkit/src/listed.rs",
            "tess-core",
            "tess-show",
            "tess-verify",
            "tess-workloads",
        ],
        test: || rtl::run(&[]),
        is_long: false,
    },
    Satellite {
        name: "bevy",
        uses: &[
            "integrations/bevy",
            "tess-core",
            "tess-level",
            "tess-simd",
            "tess-gpu",
            "tess-surface",
            "tess-wgpu",
        ],
        test: || command::run(&mut command::with_pictures(&["integrations"])),
        is_long: true,
    },
    Satellite {
        name: "mesa",
        uses: &["integrations/mesa", "bindings/c", "tess-core", "tess-level", "tess-simd"],
        test: || mesa::run(&["compare"]),
        is_long: true,
    },
    Satellite {
        name: "sdl",
        uses: &[
            "bindings/sdl",
            "bindings/rooms.txt",
            "bindings/c",
            "tools/cli/src/commands/shaders",
            "tess-core",
            "tess-level",
            "tess-simd",
            "tess-gpu",
            "tess-surface",
            "tess-wgpu",
        ],
        test: sdl::run,
        is_long: true,
    },
];

/// The page in Chromium, and the package for browsers.
fn in_the_browser() -> Result<(), String> {
    let program = command::program()?;
    explorer::test_with(&program)?;
    command::run(&mut dist::for_browsers(&program)?)
}

/// The parts of a crate that another workspace can depend on.
const OF_CRATES: [&str; 3] = ["src", "shaders", "Cargo.toml"];

impl Satellite {
    /// A digest of every file that its test depends on: their names and contents.
    ///
    /// # Errors
    /// Git fails.
    fn digest(&self) -> Result<String, String> {
        let root = workspace();
        let mut paths = Vec::new();
        for path in self.uses {
            let is_crate = !path.contains('/') && root.join(path).join("src").is_dir();
            match is_crate {
                true => paths.extend(OF_CRATES.map(|part| format!("{path}/{part}"))),
                false => paths.push((*path).to_owned()),
            }
        }
        digest::of_files(&paths)
    }
}

/// The last passing run of each satellite: its name, date and digest, one a line.
fn record() -> PathBuf {
    workspace().join("dev/satellites.tsv")
}

/// The first line of the record.
const HEAD: &str = "name\tpassed on\tdigest of what it uses";

/// The recorded date and digest of each name.
fn recorded(text: &str) -> Result<BTreeMap<&str, (&str, &str)>, String> {
    let mut lines = text.lines();
    if lines.next() != Some(HEAD) {
        return Err(format!("{}: its first line has to be `{HEAD}`", record().display()));
    }
    let entry = |line| match *str::split(line, '\t').collect::<Vec<_>>() {
        [name, date, digest] => Ok((name, (date, digest))),
        _ => Err(format!("{}: `{line}` has to have 3 columns", record().display())),
    };
    lines.map(entry).collect()
}

/// Tests the satellites with these names, or those that are stale, and records those that pass.
///
/// # Errors
/// A name does not exist, or a satellite fails; the others are tested nevertheless.
pub(crate) fn run(names: &[&str]) -> Result<(), String> {
    if let Some(name) = names.iter().find(|name| SATELLITES.iter().all(|it| it.name != **name)) {
        let known: Vec<&str> = SATELLITES.iter().map(|it| it.name).collect();
        return Err(format!("there is no satellite `{name}`; there are {}", known.join(", ")));
    }
    let is_chosen = |it: &Satellite, is_stale| {
        names.contains(&it.name) || names.is_empty() && is_stale && !it.is_long
    };
    test(is_chosen, |satellite| {
        let path = record();
        let text = command::read(&path)?;
        let mut entries = recorded(&text)?;
        let (date, digest) = (today()?, satellite.digest()?);
        entries.insert(satellite.name, (&date, &digest));
        let lines =
            entries.iter().map(|(name, (date, digest))| format!("{name}\t{date}\t{digest}\n"));
        let text = format!("{HEAD}\n{}", lines.collect::<String>());
        fs::write(&path, text).map_err(|error| in_file(&path, &error))
    })
}

/// Tests the satellites that are stale, or all, without recording.
///
/// # Errors
/// A satellite fails; the others are tested nevertheless.
pub(crate) fn check(all: bool) -> Result<(), String> {
    test(|it, is_stale| all || is_stale && !it.is_long, |_| Ok(()))
}

/// Tests the chosen satellites, passes each that passes on, and says of the others why not.
fn test(
    is_chosen: impl Fn(&Satellite, bool) -> bool,
    passed: impl Fn(&Satellite) -> Result<(), String>,
) -> Result<(), String> {
    let text = command::read(&record())?;
    let entries = recorded(&text)?;
    let mut failures = Vec::new();
    for satellite in SATELLITES {
        let name = satellite.name;
        let entry = entries.get(name);
        let is_stale = entry.is_none_or(|(_, digest)| satellite.digest().as_deref() != Ok(*digest));
        if !is_chosen(satellite, is_stale) {
            let date = entry.map_or("never", |(date, _)| date);
            let since = if is_stale { "is stale" } else { "has not changed since" };
            println!("NOT RUN: the satellite {name} passed on {date} and {since}");
            continue;
        }
        println!("\n== satellite {name}");
        if let Err(error) = (satellite.test)().and_then(|()| passed(satellite)) {
            println!("{name}: {error}");
            failures.push(format!("satellite {name}: {error}"));
        }
    }
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n")) }
}

/// The date, as ISO 8601 has it, in UTC.
fn today() -> Result<String, String> {
    let said = command::quiet_output(Command::new("date").args(["-u", "+%Y-%m-%d"]))?;
    Ok(said.trim().to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn records_are_read_and_faults_are_named() {
        let text = format!("{HEAD}\npython\t2026-01-02\tabc\n");
        let entries = recorded(&text).expect("it is right");
        assert_eq!(entries.get("python"), Some(&("2026-01-02", "abc")), "one entry");
        let short = format!("{HEAD}\npython\tabc\n");
        assert!(recorded(&short).is_err_and(|error| error.contains("`python\tabc`")), "2 columns");
        assert!(recorded("").is_err(), "an empty file");
        let text = command::read(&record()).expect("the record");
        for name in recorded(&text).expect("it is right").keys() {
            assert!(SATELLITES.iter().any(|it| it.name == *name), "{name} does not exist");
        }
    }

    #[test]
    fn everything_that_is_used_exists() {
        for satellite in SATELLITES {
            for path in satellite.uses {
                let mut list = Command::new("git");
                list.args(["ls-files", "--", path]).current_dir(workspace());
                let files = command::quiet_output(&mut list).expect("git runs");
                assert!(!files.is_empty(), "{}: {path}", satellite.name);
            }
        }
    }

    /// A new file in a folder that it uses makes another digest; one elsewhere does not.
    #[test]
    fn a_digest_depends_on_what_is_used() {
        let own: &[&str] = &["dev/nostd-proof"];
        let satellite = Satellite { name: "planted", uses: own, test: || Ok(()), is_long: false };
        let before = satellite.digest().expect("git runs");
        assert_eq!(satellite.digest().as_ref(), Ok(&before), "the same files");
        let planted = |folder: &str| {
            let path = workspace().join(folder).join(format!("planted-{}.txt", std::process::id()));
            fs::write(&path, "planted").expect("it can be written");
            let digest = satellite.digest();
            fs::remove_file(&path).expect("it can be removed");
            digest.expect("git runs")
        };
        assert_ne!(planted("dev/nostd-proof"), before, "a file of its folder");
        assert_eq!(planted("dev"), before, "a file elsewhere");
    }
}
