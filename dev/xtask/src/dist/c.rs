//! The C library: an archive that can be unpacked anywhere, and a Debian package.

use super::VERSION;
use super::bill::{self, SYSTEM};
use super::pack::{Release, copy_tracked};
use super::readme;
use crate::command::{self, cargo, in_file};
use crate::{install, setup};
use std::fs;
use std::path::Path;
use std::process::Command;

/// The name of the package, and of its folder of documents.
const DEB: &str = "libtess-dev";

/// Programs needed in addition to those of the tests.
const DPKG: &[setup::Need] = &[setup::Need {
    what: "dpkg-dev and lintian (the package of Debian)",
    packages: &["dpkg-dev", "lintian"],
    is_there: || setup::has_program("dpkg-shlibdeps") && setup::has_program("lintian"),
}];

pub(super) fn pack(release: &Release) -> Result<(), String> {
    let name = format!("tess-c-{VERSION}-{SYSTEM}");
    let stage = release.stage(&name)?;
    install(&stage)?;
    examples(&stage.join("examples"))?;
    copy_tracked("bindings/c/verilog", &stage.join("verilog"))?;
    bill(release)?;
    copy(&release.out.join(bill::licences_file("c")), &stage.join("LICENCES-DEPENDENCIES.txt"))?;
    readme::put("bindings/c/README.md", &stage, "README.md")?;
    release.archive(&stage, &format!("{name}.tar.gz"))
}

fn bill(release: &Release) -> Result<(), String> {
    let packages = ["tess-capi".to_owned()];
    bill::write(release, &bill::Of { name: "c", manifest: "Cargo.toml", packages: &packages })
}

/// Copies the examples, without those that time calls in a checkout.
fn examples(to: &Path) -> Result<(), String> {
    copy_tracked("bindings/c/examples", to)?;
    let calls = to.join("calls");
    fs::remove_dir_all(&calls).map_err(|error| in_file(&calls, &error))
}

/// Installs the library, without the names that only a debugger reads.
fn install(prefix: &Path) -> Result<(), String> {
    let mut build = cargo("rustc --release -p tess-capi --lib");
    build.env("CARGO_ENCODED_RUSTFLAGS", command::flags_without_folders("-Cdebuginfo=0")?);
    install::run_with(&mut build, &prefix.to_string_lossy(), None)?;
    let library = prefix.join(format!("lib/libtess.so.{VERSION}"));
    command::run(Command::new("strip").args(["--strip-unneeded", "-R", ".comment"]).arg(library))
}

pub(super) fn pack_deb(release: &Release) -> Result<(), String> {
    setup::provide(DPKG)?;
    let stage = release.stage("deb")?;
    let (root, documents) = (stage.join("root"), stage.join("root/usr/share/doc").join(DEB));
    install(&root.join("usr"))?;
    let control = root.join("DEBIAN");
    for folder in [&documents, &control] {
        fs::create_dir_all(folder).map_err(|error| in_file(folder, &error))?;
    }
    bill(release)?;
    copy(&release.out.join(bill::licences_file("c")), &documents.join("dependencies.txt"))?;
    examples(&documents.join("examples"))?;
    readme::put("dev/xtask/src/dist/readmes/deb.md", &documents, "README.Debian")?;
    write(&documents.join("copyright"), COPYRIGHT)?;
    write(&documents.join("changelog"), &changelog(release)?)?;
    let mut gzip = Command::new("gzip");
    gzip.arg("-9n").args(["changelog", "dependencies.txt"]).current_dir(&documents);
    command::run(&mut gzip)?;
    write(&control.join("triggers"), "activate-noawait ldconfig\n")?;
    let soname = install::soname();
    let version = soname.trim_start_matches("libtess.so.");
    write(&control.join("shlibs"), &format!("libtess {version} {DEB}\n"))?;
    write(&control.join("control"), &description(&needs(&stage)?))?;
    let mut modes = Command::new("chmod");
    command::run(modes.args(["-R", "a+rX,u+w,go-w"]).arg(&root))?;
    let library = root.join(format!("usr/lib/libtess.so.{VERSION}"));
    command::run(Command::new("chmod").arg("a-x").arg(library))?;
    let mut build = Command::new("dpkg-deb");
    build.args(["--root-owner-group", "-Zxz", "--build"]).arg(&root).arg(&release.out);
    command::run(build.env("SOURCE_DATE_EPOCH", &release.epoch))?;
    let parent = stage.parent().unwrap_or(&stage);
    fs::remove_dir_all(parent).map_err(|error| in_file(parent, &error))
}

/// The packages whose libraries the shared library loads.
fn needs(stage: &Path) -> Result<String, String> {
    write(
        &stage.join("debian/control"),
        "Source: tess\n\nPackage: libtess-dev\nArchitecture: any\n",
    )?;
    let mut find = Command::new("dpkg-shlibdeps");
    find.arg("-O").arg(format!("root/usr/lib/libtess.so.{VERSION}")).current_dir(stage);
    let said = command::output(&mut find)?;
    let needs = said.lines().find_map(|line| line.strip_prefix("shlibs:Depends="));
    needs.map(str::to_owned).ok_or_else(|| format!("dpkg-shlibdeps said {said}"))
}

fn description(needs: &str) -> String {
    format!(
        "Package: {DEB}\nVersion: {VERSION}\nArchitecture: amd64\nSection: libdevel\nPriority: optional\n\
         Maintainer: {MAINTAINER}\nDepends: {needs}\nHomepage: https://github.com/tess-model/tess\n\
         Description: bit-exact Direct3D 11 class tessellation, for C and C++\n \
         Headers, shared library and archive, found by pkg-config and CMake. Points and\n \
         indices are those of the fixed-function tessellator, to the bit.\n"
    )
}

const MAINTAINER: &str = "The tess authors <tess-model@users.noreply.github.com>";

/// Both licences, by reference or as text.
const COPYRIGHT: &str = concat!(
    "By the authors of https://github.com/tess-model/tess, under either the Apache License 2.0\n\
     (/usr/share/common-licenses/Apache-2.0) or the licence below. The crates inside the library\n\
     have the licences in dependencies.txt.gz.\n\n",
    include_str!("../../../../LICENSE-MIT")
);

fn changelog(release: &Release) -> Result<String, String> {
    let mut date = Command::new("date");
    let date = command::output(date.args(["-u", "-R", "-d"]).arg(format!("@{}", release.epoch)))?;
    Ok(format!(
        "tess ({VERSION}) unstable; urgency=low\n\n  * Release.\n\n -- {MAINTAINER}  {date}"
    ))
}

fn write(path: &Path, text: &str) -> Result<(), String> {
    let folder = path.parent().unwrap_or(path);
    let written = fs::create_dir_all(folder).and_then(|()| fs::write(path, text));
    written.map_err(|error| in_file(path, &error))
}

fn copy(from: &Path, to: &Path) -> Result<(), String> {
    fs::copy(from, to).map(drop).map_err(|error| in_file(from, &error))
}
