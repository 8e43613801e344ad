//! The versions of Mesa that there are patches for, and what differs between them.

use crate::command::in_file;
use std::fs;
use std::path::Path;

/// A version of Mesa, as a release of Debian has it.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Release {
    pub(super) version: &'static str,
    /// Debian's name of its release.
    pub(super) codename: &'static str,
    /// The folder of `integrations/mesa` that has the patches.
    pub(super) patches: &'static str,
    /// Options of its build, beside [`OPTIONS`].
    options: &'static [&'static str],
    /// The oldest meson that its build runs with: major and minor.
    pub(super) meson: (u32, u32),
    /// The version of Vulkan that lavapipe has.
    pub(super) vulkan: &'static str,
    pub(super) libraries: &'static [Library],
    /// The folder of llvmpipe, where EGL looks for it in the folder that `LIBGL_DRIVERS_PATH` names; later it is linked.
    pub(super) drivers_path: Option<&'static str>,
}

/// A library that the build makes, by its paths in the folder of the build and in a variant's. The folders are the same,
/// since Mesa's libraries find each other by paths from their own.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct Library {
    pub(super) built: &'static str,
    pub(super) kept: &'static str,
}

impl Library {
    const fn new(built: &'static str, kept: &'static str) -> Self {
        Self { built, kept }
    }
}

pub(super) const LAVAPIPE: &str = "src/gallium/targets/lavapipe/libvulkan_lvp.so";
pub(super) const EGL: &str = "src/egl/libEGL_mesa.so.0";

const RELEASES: [Release; 2] = [
    Release {
        version: "22.3.6",
        codename: "bookworm",
        patches: "patches",
        options: &[
            "-Dplatforms=x11,wayland",
            "-Dgallium-drivers=swrast",
            "-Dglvnd=true",
            "-Dgallium-omx=disabled",
        ],
        meson: (0, 53),
        vulkan: "1.3.230",
        libraries: &[
            Library::new(LAVAPIPE, LAVAPIPE),
            Library::new(
                "src/gallium/targets/dri/libgallium_dri.so",
                "src/gallium/targets/dri/swrast_dri.so",
            ),
            Library::new("src/egl/libEGL_mesa.so.0.0.0", EGL),
            Library::new(
                "src/mapi/shared-glapi/libglapi.so.0.0.0",
                "src/mapi/shared-glapi/libglapi.so.0",
            ),
        ],
        drivers_path: Some("src/gallium/targets/dri"),
    },
    Release {
        version: "25.0.7",
        codename: "trixie",
        patches: "patches-25.0.7",
        // Wayland's windows want protocols that are newer than bookworm.
        options: &["-Dplatforms=x11", "-Dgallium-drivers=llvmpipe", "-Dglvnd=enabled"],
        meson: (1, 1),
        vulkan: "1.4.305",
        libraries: &[
            Library::new(LAVAPIPE, LAVAPIPE),
            Library::new(
                "src/gallium/targets/dri/libgallium-25.0.7.so",
                "src/gallium/targets/dri/libgallium-25.0.7.so",
            ),
            Library::new("src/egl/libEGL_mesa.so.0.0.0", EGL),
        ],
        drivers_path: None,
    },
];

/// The options of every version: lavapipe and llvmpipe behind EGL, and what they need.
const OPTIONS: &[&str] = &[
    "-Dbuildtype=release",
    "-Dvulkan-drivers=swrast",
    "-Dllvm=enabled",
    "-Dshared-llvm=enabled",
    "-Dopengl=true",
    "-Dshared-glapi=enabled",
    "-Degl=enabled",
    "-Dglx=disabled",
    "-Dgbm=disabled",
    "-Dgles1=disabled",
    "-Dgles2=enabled",
    "-Dgallium-vdpau=disabled",
    "-Dgallium-va=disabled",
    "-Dgallium-xa=disabled",
    "-Dvalgrind=disabled",
    "-Dlibunwind=disabled",
    "-Dlmsensors=disabled",
    "-Dbuild-tests=false",
    "-Dmicrosoft-clc=disabled",
    "-Dvideo-codecs=",
    "-Dzstd=disabled",
    "-Dshader-cache=disabled",
];

impl Release {
    /// The release with this version of Mesa.
    pub(super) fn of_version(version: &str) -> Option<&'static Self> {
        RELEASES.iter().find(|release| release.version == version)
    }

    /// The release that this machine has.
    ///
    /// # Errors
    /// This machine has another one.
    pub(super) fn of_machine() -> Result<&'static Self, String> {
        let own = codename()?;
        RELEASES.iter().find(|release| release.codename == own).ok_or_else(|| {
            format!("this is {own}, and the patches are for Mesa {}: name a version", known())
        })
    }

    /// The options of `meson setup`.
    pub(super) fn options(&self) -> impl Iterator<Item = &'static str> {
        OPTIONS.iter().chain(self.options).copied()
    }
}

/// The versions with their releases of Debian, for a message.
pub(super) fn known() -> String {
    RELEASES
        .each_ref()
        .map(|Release { version, codename, .. }| format!("{version} of Debian's {codename}"))
        .join(" and ")
}

/// What Debian calls the release that this machine has.
///
/// # Errors
/// The system does not say.
pub(super) fn codename() -> Result<String, String> {
    let path = Path::new("/etc/os-release");
    let text = fs::read_to_string(path).map_err(|error| in_file(path, &error))?;
    let name = codename_in(&text).map(str::to_owned);
    name.ok_or_else(|| in_file(path, &"the release has no name, so it is not one of Debian's"))
}

fn codename_in(os_release: &str) -> Option<&str> {
    let name = os_release.lines().find_map(|line| line.strip_prefix("VERSION_CODENAME="))?;
    Some(name.trim_matches('"'))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::command;

    #[test]
    fn every_release_is_named_once_and_has_its_patches() {
        for release in &RELEASES {
            assert_eq!(Release::of_version(release.version), Some(release), "by its version");
            let same = RELEASES.iter().filter(|other| other.codename == release.codename);
            assert_eq!(same.count(), 1, "by its codename");
            let (version, codename) = (release.version, release.codename);
            assert!(crate::USAGE.contains(version) && crate::USAGE.contains(codename), "--help");
            let mut keys: Vec<&str> =
                release.options().filter_map(|option| option.split('=').next()).collect();
            keys.sort_unstable();
            assert!(
                keys.is_sorted_by(|one, next| one < next),
                "an option is given twice: {keys:?}"
            );
            let folder = command::workspace().join("integrations/mesa").join(release.patches);
            for file in fs::read_dir(&folder).expect("the patches are there") {
                let text = fs::read_to_string(file.expect("a file").path()).expect("a patch");
                let line = format!("For Mesa {version}");
                assert!(text.contains(&line), "{}: `{line}`", folder.display());
            }
        }
        assert_eq!(Release::of_version("22.3.5"), None, "another version");
    }

    #[test]
    fn the_system_says_its_release() {
        let debian =
            "PRETTY_NAME=\"Debian\"\nVERSION_ID=\"13\"\nVERSION_CODENAME=trixie\nID=debian\n";
        assert_eq!(codename_in(debian), Some("trixie"), "Debian");
        assert_eq!(codename_in("VERSION_CODENAME=\"noble\"\n"), Some("noble"), "with quotes");
        assert_eq!(codename_in("ID=debian\n"), None, "an unstable Debian");
    }
}
