//! Mesa's lavapipe and llvmpipe with this library as their tessellator: gets Mesa's sources from Debian, builds the
//! drivers as they are and with the patches of `integrations/mesa`, all below target/mesa, and compares what they draw.

mod build;
mod debian;
mod meson;
mod needs;
mod piglit;
mod probe;
mod proof;
mod release;
mod source;

use crate::command::{self, in_file};
use crate::setup;
use release::Release;
use std::fs;
use std::path::PathBuf;

/// Mesa's sources with some of the patches, built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Variant {
    /// As Debian has them.
    Unpatched,
    /// The library in the place of Mesa's tessellator, one patch a call.
    OnePatch,
    /// All patches of a draw in one call.
    WholeDraws,
}

impl Variant {
    pub(super) const ALL: [Self; 3] = [Self::Unpatched, Self::OnePatch, Self::WholeDraws];

    /// How many of the release's patches it has: the first ones, by name.
    pub(super) const fn patches(self) -> usize {
        self as usize
    }

    /// Its name in the table, and the folder of its build.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Unpatched => "unpatched",
            Self::OnePatch => "0001",
            Self::WholeDraws => "0001+0002",
        }
    }
}

/// Where everything of one release lies.
#[derive(Debug)]
pub(super) struct Place {
    release: &'static Release,
    /// `target/mesa`: what all releases share.
    pub(super) root: PathBuf,
    /// `target/mesa/VERSION`
    pub(super) folder: PathBuf,
    /// `integrations/mesa`
    pub(super) integration: PathBuf,
}

impl Place {
    /// The folder of a variant's driver.
    pub(super) fn driver(&self, variant: Variant) -> PathBuf {
        self.folder.join(variant.name())
    }

    /// The manifest by which the Vulkan loader finds a variant's driver.
    pub(super) fn manifest(&self, variant: Variant) -> PathBuf {
        self.driver(variant).join("lvp_icd.json")
    }

    /// The manifest by which EGL finds a variant's OpenGL.
    fn egl_manifest(&self, variant: Variant) -> PathBuf {
        self.driver(variant).join("50_mesa.json")
    }

    /// The environment in which Vulkan is a variant's lavapipe, and OpenGL its llvmpipe.
    pub(super) fn environment(&self, variant: Variant) -> Vec<(&'static str, PathBuf)> {
        let mut variables = vec![
            ("VK_DRIVER_FILES", self.manifest(variant)),
            ("__EGL_VENDOR_LIBRARY_FILENAMES", self.egl_manifest(variant)),
        ];
        if let Some(drivers) = self.release.drivers_path {
            variables.push(("LIBGL_DRIVERS_PATH", self.driver(variant).join(drivers)));
        }
        variables
    }

    fn open(release: &'static Release) -> Result<Self, String> {
        // Meson and the loader are given absolute paths.
        let target = command::target();
        let root = std::path::absolute(&target).map_err(|error| in_file(&target, &error))?;
        let root = root.join("mesa");
        let folder = root.join(release.version);
        fs::create_dir_all(&folder).map_err(|error| in_file(&folder, &error))?;
        Ok(Self {
            release,
            root,
            folder,
            integration: command::workspace().join("integrations/mesa"),
        })
    }
}

/// Which part of the work is done.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Work {
    /// Builds the drivers and compares them.
    All,
    /// Builds the drivers and says where they are.
    Build,
    /// Prints the table of drivers that are built.
    Compare,
    /// Runs this project's tests of Vulkan and OpenGL on the drivers with all patches.
    Test,
}

/// Runs `cargo xtask mesa WORDS`: a part of the work and a version, either of which may be missing. The version is
/// then that of this machine's Debian.
///
/// # Errors
/// A word is unknown, or this machine's release is; a step fails; or a patched driver is less exact than the
/// unpatched one.
pub(crate) fn run(words: &[&str]) -> Result<(), String> {
    let (part, release) = parse(words)?;
    let release = release.map_or_else(Release::of_machine, Ok)?;
    println!("Mesa {}, of Debian's {}", release.version, release.codename);
    let place = Place::open(release)?;
    if matches!(part, Work::All | Work::Build) {
        build_all(&place)?;
    }
    match part {
        Work::All | Work::Compare => proof::run(&place),
        Work::Build => Ok(()),
        Work::Test => proof::test(&place),
    }
}

/// The part of the work, and the release where the words name one.
fn parse(words: &[&str]) -> Result<(Work, Option<&'static Release>), String> {
    let (part, rest) = match words {
        ["build", rest @ ..] => (Work::Build, rest),
        ["compare", rest @ ..] => (Work::Compare, rest),
        ["test", rest @ ..] => (Work::Test, rest),
        rest => (Work::All, rest),
    };
    let release = match *rest {
        [] => Some(None),
        [version] => Release::of_version(version).map(Some),
        _ => None,
    };
    let wrong = || {
        format!("mesa [build | compare | test] [VERSION]; the versions are {}", release::known())
    };
    release.map(|release| (part, release)).ok_or_else(wrong)
}

fn build_all(place: &Place) -> Result<(), String> {
    setup::provide(needs::NEEDS)?;
    source::provide(place)?;
    build::all(place)?;
    for variant in Variant::ALL {
        println!("\n{}:", variant.name());
        for (name, value) in place.environment(variant) {
            println!("  {name}={}", value.display());
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_part_and_a_version_may_be_named() {
        let trixie = Release::of_version("25.0.7");
        assert!(trixie.is_some(), "a version");
        assert_eq!(parse(&[]), Ok((Work::All, None)), "neither");
        assert_eq!(parse(&["compare"]), Ok((Work::Compare, None)), "a part");
        assert_eq!(parse(&["25.0.7"]), Ok((Work::All, trixie)), "a version");
        assert_eq!(parse(&["test", "25.0.7"]), Ok((Work::Test, trixie)), "both");
        for wrong in [&["24.0"][..], &["25.0.7", "build"], &["build", "25.0.7", "22.3.6"]] {
            let message = parse(wrong).expect_err("the words make no sense");
            assert!(message.contains("22.3.6 of Debian's bookworm and 25.0.7"), "{message}");
        }
    }
}
