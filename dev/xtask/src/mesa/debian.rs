//! Debian's packages, sources and programs, by lists of this command's own: the system's stay as they are.

use super::{Place, release};
use crate::command::{self, in_file};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// Downloads and unpacks the sources that a release has of a package, in the release's folder.
pub(super) fn source(place: &Place, package: &str) -> Result<(), String> {
    let lists = Lists::update(place, place.release.codename)?;
    command::run(lists.apt().args(["source", package]).current_dir(&place.folder))
}

/// Downloads packages of this machine's release and unpacks them, without installing them, to `folder`, which does
/// not exist before: nor after, if something fails.
pub(super) fn unpack(place: &Place, packages: &[&str], folder: &Path) -> Result<(), String> {
    let lists = Lists::update(place, &release::codename()?)?;
    let archives = place.root.join("archives");
    let unpacked = place.root.join("unpacked");
    for folder in [&archives, &unpacked] {
        if folder.exists() {
            fs::remove_dir_all(folder).map_err(|error| in_file(folder, &error))?;
        }
        fs::create_dir_all(folder).map_err(|error| in_file(folder, &error))?;
    }
    command::run(lists.apt().arg("download").args(packages).current_dir(&archives))?;
    for entry in fs::read_dir(&archives).map_err(|error| in_file(&archives, &error))? {
        let entry = entry.map_err(|error| in_file(&archives, &error))?;
        command::run(Command::new("dpkg").arg("-x").arg(entry.path()).arg(&unpacked))?;
    }
    fs::rename(&unpacked, folder).map_err(|error| in_file(folder, &error))
}

/// The lists of one release of Debian, in a folder of their own.
struct Lists {
    folder: PathBuf,
}

impl Lists {
    /// Gets the lists.
    fn update(place: &Place, codename: &str) -> Result<Self, String> {
        let lists = Self { folder: place.root.join("debian").join(codename) };
        let partial = lists.folder.join("lists/partial");
        fs::create_dir_all(&partial).map_err(|error| in_file(&partial, &error))?;
        let keys = "/usr/share/keyrings/debian-archive-keyring.gpg";
        let of = format!("[signed-by={keys}] {} {codename} main\n", mirror()?);
        let list = lists.folder.join("sources.list");
        fs::write(&list, format!("deb {of}deb-src {of}"))
            .map_err(|error| in_file(&list, &error))?;
        command::run(lists.apt().arg("update"))?;
        Ok(lists)
    }

    /// `apt-get` with these lists.
    fn apt(&self) -> Command {
        let mut apt = Command::new("apt-get");
        let own = |name: &str| self.folder.join(name).display().to_string();
        apt.arg("-q").arg(format!("-oDir::Etc::SourceList={}", own("sources.list")));
        apt.arg("-oDir::Etc::SourceParts=/dev/null");
        apt.arg(format!("-oDir::State::Lists={}", own("lists"))).current_dir(&self.folder);
        // What is cached of the system's lists is of others.
        apt.args(["-oDir::Cache::pkgcache=", "-oDir::Cache::srcpkgcache="]);
        apt
    }
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
