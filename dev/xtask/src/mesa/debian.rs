//! Debian's packages, sources and programs, by lists of this command's own: the system's stay as they are.

use super::Place;
use crate::command::{self, in_file};
use std::fs;
use std::path::Path;
use std::process::Command;

/// The release of Debian whose Mesa the patches are for.
pub(super) const RELEASE: &str = "bookworm";

/// Downloads and unpacks the sources of a package in `target/mesa`.
pub(super) fn source(place: &Place, package: &str) -> Result<(), String> {
    update(place)?;
    command::run(apt(place).args(["source", package]))
}

/// Downloads packages and unpacks them, without installing them, to `folder`, which does not exist before: nor after,
/// if something fails.
pub(super) fn unpack(place: &Place, packages: &[&str], folder: &Path) -> Result<(), String> {
    update(place)?;
    let archives = place.root.join("archives");
    let unpacked = place.root.join("unpacked");
    for folder in [&archives, &unpacked] {
        if folder.exists() {
            fs::remove_dir_all(folder).map_err(|error| in_file(folder, &error))?;
        }
        fs::create_dir_all(folder).map_err(|error| in_file(folder, &error))?;
    }
    command::run(apt(place).arg("download").args(packages).current_dir(&archives))?;
    for entry in fs::read_dir(&archives).map_err(|error| in_file(&archives, &error))? {
        let entry = entry.map_err(|error| in_file(&archives, &error))?;
        command::run(Command::new("dpkg").arg("-x").arg(entry.path()).arg(&unpacked))?;
    }
    fs::rename(&unpacked, folder).map_err(|error| in_file(folder, &error))
}

/// Gets the lists.
fn update(place: &Place) -> Result<(), String> {
    let keys = "/usr/share/keyrings/debian-archive-keyring.gpg";
    let of = format!("[signed-by={keys}] {} {RELEASE} main\n", mirror()?);
    let list = place.root.join("sources.list");
    fs::write(&list, format!("deb {of}deb-src {of}")).map_err(|error| in_file(&list, &error))?;
    let partial = place.root.join("lists/partial");
    fs::create_dir_all(&partial).map_err(|error| in_file(&partial, &error))?;
    command::run(apt(place).arg("update"))
}

/// `apt-get` with the lists of this command.
fn apt(place: &Place) -> Command {
    let mut apt = Command::new("apt-get");
    let in_place = |name: &str| place.root.join(name).display().to_string();
    apt.arg("-q").arg(format!("-oDir::Etc::SourceList={}", in_place("sources.list")));
    apt.arg("-oDir::Etc::SourceParts=/dev/null");
    apt.arg(format!("-oDir::State::Lists={}", in_place("lists"))).current_dir(&place.root);
    // What is cached of the system's lists is of others.
    apt.args(["-oDir::Cache::pkgcache=", "-oDir::Cache::srcpkgcache="]);
    apt
}

/// Where this system gets Debian's packages.
fn mirror() -> Result<String, String> {
    let mut apt = Command::new("apt-get");
    apt.args(["indextargets", "--format", "$(REPO_URI) $(CODENAME)"]);
    let known = command::output(apt.args(["Created-By: Packages", "Origin: Debian"]))?;
    let own = known.lines().find_map(|line| {
        let (mirror, codename) = line.split_once(' ')?;
        // Others are of security updates and the like.
        (!codename.contains('-')).then_some(mirror)
    });
    own.map(str::to_owned).ok_or_else(|| {
        "no list of packages of Debian is known here; on Debian, `apt-get update` gets it"
            .to_owned()
    })
}
