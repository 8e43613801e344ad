//! The program `tess`, built for this system.

use super::VERSION;
use super::bill::{self, SYSTEM};
use super::pack::Release;
use super::readme;
use crate::command::{self, cargo, in_file, target};
use std::fs;
use std::process::Command;

/// The package of the program.
const PACKAGE: &str = "tess-program";

pub(super) fn pack(release: &Release) -> Result<(), String> {
    let name = format!("tess-{VERSION}-{SYSTEM}");
    let stage = release.stage(&name)?;
    let mut build = cargo("build --release --target");
    build.args([SYSTEM, "--package", PACKAGE]);
    build.env("CARGO_ENCODED_RUSTFLAGS", command::flags_without_folders("-Cdebuginfo=0")?);
    command::run(&mut build)?;
    let (built, program) = (target().join(SYSTEM).join("release/tess"), stage.join("tess"));
    fs::copy(&built, &program).map_err(|error| in_file(&built, &error))?;
    command::run(Command::new("strip").args(["-R", ".comment"]).arg(program))?;
    let packages = [PACKAGE.to_owned()];
    bill::write(
        release,
        &bill::Of { name: "program", manifest: "Cargo.toml", packages: &packages },
    )?;
    let licences = release.out.join(bill::licences_file("program"));
    fs::copy(&licences, stage.join("LICENCES-DEPENDENCIES.txt"))
        .map_err(|error| in_file(&licences, &error))?;
    readme::put("tools/cli/README.md", &stage, "README.md")?;
    release.archive(&stage, &format!("{name}.tar.gz"))
}
