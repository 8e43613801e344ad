//! Packs the archives of a release into `target/dist`, with the same bytes each time, and tries
//! each archive by itself.

mod bill;
mod c;
mod pack;
mod program;
mod readme;
mod shaders;

use crate::command::{self, in_file, target, workspace};
use crate::{explorer, packages, publish, python, sdl, setup};
use pack::Release;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

/// The version of every package except `tess-wgpu`.
const VERSION: &str = env!("CARGO_PKG_VERSION");

type Pack = fn(&Release) -> Result<(), String>;

/// The parts of a release.
const PARTS: &[(&str, Pack)] = &[
    ("tess", program::pack),
    ("shaders", shaders::pack),
    ("npm", shaders::pack_npm),
    ("sdl", shaders::pack_sdl),
    ("covergroups", covergroups),
    ("c", c::pack),
    ("deb", c::pack_deb),
    ("python", wheel),
    ("crates", crates),
];

/// Packs these parts of a release, or all of them. With `--try` first, packs twice, compares the
/// archives, and uses them.
///
/// # Errors
/// A part does not exist, a program is missing or fails, two packings differ, or an archive does
/// not work.
pub(crate) fn run(words: &[&str]) -> Result<(), String> {
    let (tries, names) = match words {
        ["--try", names @ ..] => (true, names),
        names => (false, names),
    };
    let all: Vec<_> = PARTS.iter().map(|(name, _)| *name).collect();
    if let Some(unknown) = names.iter().find(|name| !all.contains(name)) {
        return Err(format!("dist: no part {unknown}; there are {}", all.join(" ")));
    }
    let is_wanted = |part: &&(&str, _)| names.is_empty() || names.contains(&part.0);
    let parts: Vec<_> = PARTS.iter().filter(is_wanted).collect();
    let release = pack(&parts, "dist-new")?;
    if tries {
        let again = pack(&parts, "dist-again")?;
        same(&release.sums()?, &again.sums()?)?;
        fs::remove_dir_all(&again.out).map_err(|error| in_file(&again.out, &error))?;
        parts.iter().try_for_each(|(name, _)| try_it(&release, name))?;
    }
    let release = release.publish(&target().join("dist"), names.is_empty())?;
    println!("\n{}:\n{}", release.out.display(), release.sums()?);
    Ok(())
}

fn pack(parts: &[&(&str, Pack)], folder: &str) -> Result<Release, String> {
    let release = Release::new(&target().join(folder))?;
    parts.iter().try_for_each(|(_, pack)| pack(&release))?;
    release.write_sums()?;
    Ok(release)
}

/// Uses a part in a place where nothing else of the project exists.
fn try_it(release: &Release, part: &str) -> Result<(), String> {
    setup::for_comparisons()?;
    let modules = if part == "npm" { Some(explorer::modules()?) } else { None };
    let folder = std::env::temp_dir().join(format!("tess-dist-{}", std::process::id()));
    pack::empty(&folder)?;
    let mut script = Command::new("sh");
    script.arg("-eu").arg(workspace().join("dev/xtask/src/dist/try.sh")).arg(part);
    script.current_dir(&folder).env("OUT", &release.out).env("ROOT", workspace());
    script.env_remove("PYTHONPATH");
    if let Some(modules) = modules {
        script.env("EXPLORER_MODULES", modules).env("TESS_PROGRAM", tess()?.get_program());
    }
    if part == "sdl" {
        script.envs(sdl::environment()?).env("TESS_PROGRAM", tess()?.get_program());
    }
    command::run(&mut script)?;
    fs::remove_dir_all(&folder).map_err(|error| in_file(&folder, &error))
}

/// Refuses two packings whose sums differ. Each line is the sum of one file.
fn same(first: &str, second: &str) -> Result<(), String> {
    let differs = |line: &&str| !second.lines().any(|other| other == *line);
    match first.lines().find(differs) {
        None if first.lines().count() == second.lines().count() => Ok(()),
        line => Err(format!("two packings differ: {}", line.unwrap_or("one has more files"))),
    }
}

/// Packs the crates as a registry receives them.
fn crates(release: &Release) -> Result<(), String> {
    for file in publish::pack()? {
        release.take(&file)?;
    }
    let packages: Vec<_> = packages::published()?.into_iter().map(|package| package.name).collect();
    bill::write(release, &bill::Of { name: "crates", manifest: "Cargo.toml", packages: &packages })
}

/// Packs the Python package, as a wheel and as sources.
fn wheel(release: &Release) -> Result<(), String> {
    let (name, manifest) = ("python", "bindings/python/Cargo.toml");
    bill::write(release, &bill::Of { name, manifest, packages: &["tess-python".to_owned()] })?;
    python::release(&release.epoch, &release.out.join(bill::file(name)), |file| release.take(file))
}

/// Packs `tess_uvm` with its covergroups, the DPI-C interface and the circuit of its example, in
/// the folders that its file lists expect.
fn covergroups(release: &Release) -> Result<(), String> {
    let stage = release.stage(&format!("tess-uvm-{VERSION}"))?;
    let files =
        ["bindings/uvm/**", "bindings/c/verilog/*", "bindings/c/include/tess.h", "rtl/tess*"];
    pack::copy_tree(&files, &stage)?;
    let file = stage.join("bindings/uvm/src/tess_covergroups.svh");
    command::run(tess()?.args(["coverage", "--covergroups"]).arg(file))?;
    readme::put("bindings/uvm/README.md", &stage, "bindings/uvm/README.md")?;
    readme::put("dev/xtask/src/dist/readmes/uvm.md", &stage, "README.md")?;
    release.archive(&stage, &format!("tess-uvm-{VERSION}.tar.gz"))
}

/// The program `tess`, built once.
fn tess() -> Result<Command, String> {
    static PROGRAM: OnceLock<Result<PathBuf, String>> = OnceLock::new();
    PROGRAM.get_or_init(explorer::program).clone().map(Command::new)
}

/// The command that tries the package for browsers in a process of its own, with this program
/// `tess`.
///
/// # Errors
/// This program's path is unknown.
pub(crate) fn for_browsers(program: &Path) -> Result<Command, String> {
    let mut command = this(&["dist", "--try", "npm"])?;
    command.env("TESS_PROGRAM", program);
    Ok(command)
}

/// Copies both licences into a folder.
fn add_licences(folder: &Path) -> Result<(), String> {
    publish::LICENCES.iter().try_for_each(|name| {
        let from = workspace().join(name);
        fs::copy(&from, folder.join(name)).map(drop).map_err(|error| in_file(&from, &error))
    })
}

/// This program with other arguments, in a process of its own, so that other tests can run at the
/// same time.
///
/// # Errors
/// This program's path is unknown.
fn this(arguments: &[&str]) -> Result<Command, String> {
    let own = std::env::current_exe().map_err(|error| format!("this program: {error}"))?;
    let mut command = Command::new(own);
    // The person who can answer has answered this process.
    command.arg(if setup::installs() { setup::YES } else { setup::NO_INSTALL });
    command.args(arguments).current_dir(workspace());
    Ok(command)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Packs the cheapest archive twice; a planted difference must be detected.
    #[test]
    fn archives_have_the_same_bytes() {
        let sums = |name: &str, text: &str, age: u64| {
            let out = target().join(format!("tmp/dist-{}-{name}", std::process::id()));
            let release = Release::new(&out).expect("a folder");
            let stage = release.stage("notes").expect("a folder");
            for file in ["b", "a", "c"] {
                fs::write(stage.join(file), text).expect("written");
                let file =
                    fs::File::options().write(true).open(stage.join(file)).expect("it is there");
                let time = std::time::UNIX_EPOCH + std::time::Duration::from_secs(age);
                file.set_modified(time).expect("dated");
            }
            release.archive(&stage, "notes.tar.gz").expect("packed");
            release.write_sums().expect("written");
            let sums = release.sums().expect("read");
            fs::remove_dir_all(&out).expect("it was made here");
            sums
        };
        let first = sums("first", "text", 0);
        assert!(first.ends_with("  notes.tar.gz\n"), "{first}");
        assert_eq!(same(&first, &sums("second", "text", 1)), Ok(()), "sorted, dated, owned alike");
        let other = same(&first, &sums("other", "test", 0)).expect_err("another text");
        assert!(other.contains("notes.tar.gz"), "{other}");
        let published = target().join(format!("tmp/dist-{}", std::process::id()));
        let files = |names: &[&str], whole| {
            let release = Release::new(&published.with_extension("new")).expect("a folder");
            names.iter().for_each(|name| fs::write(release.out.join(name), name).expect("written"));
            let sums = release.publish(&published, whole).and_then(|it| it.sums()).expect("moved");
            sums.lines().map(|line| line[66..].to_owned()).collect::<Vec<_>>()
        };
        assert_eq!(files(&["old", "part"], true), ["old", "part"], "a first release");
        assert_eq!(files(&["part", "that"], false), ["old", "part", "that"], "parts");
        assert_eq!(files(&["that"], true), ["that"], "a whole release");
        fs::remove_dir_all(&published).expect("it was made here");
        assert!(same("", &first).is_err() && same(&first, "").is_err(), "a file more");
    }
}
