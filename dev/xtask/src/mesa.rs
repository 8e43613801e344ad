//! Mesa's lavapipe and llvmpipe with this library as their tessellator: gets Mesa's sources from Debian, builds the
//! drivers as they are and with the patches of `integrations/mesa`, all below target/mesa, and compares what they draw.

mod build;
mod debian;
mod piglit;
mod probe;
mod proof;
mod source;

use crate::command::{self, in_file};
use crate::setup::{self, Need, has_program};
use std::fs;
use std::path::{Path, PathBuf};

const NEEDS: &[Need] = &[
    Need {
        what: "Debian's tools for source packages",
        packages: &["dpkg-dev", "patch", "debian-archive-keyring"],
        is_there: || ["dpkg-source", "patch"].into_iter().all(has_program),
    },
    Need {
        what: "what Mesa's build runs (meson, ninja, bison, flex, glslangValidator, pkg-config, Mako)",
        packages: &[
            "meson",
            "ninja-build",
            "bison",
            "flex",
            "glslang-tools",
            "pkg-config",
            "python3-mako",
            "gcc",
            "g++",
        ],
        is_there: || {
            let programs =
                ["meson", "ninja", "bison", "flex", "glslangValidator", "pkg-config", "c++"];
            programs.into_iter().all(has_program)
                && Path::new("/usr/lib/python3/dist-packages/mako").exists()
        },
    },
    Need {
        what: "the libraries that the drivers are built on (LLVM, libdrm, expat, zlib, elf, udev, glvnd)",
        packages: &[
            "llvm-dev",
            "libdrm-dev",
            "libexpat1-dev",
            "zlib1g-dev",
            "libelf-dev",
            "libudev-dev",
            "libglvnd-dev",
        ],
        is_there: || {
            let headers =
                ["libdrm/drm.h", "expat.h", "zlib.h", "libelf.h", "libudev.h", "glvnd/libeglabi.h"];
            let is_there = |header: &&str| Path::new("/usr/include").join(header).exists();
            headers.iter().all(is_there)
                && (has_program("llvm-config") || has_program("llvm-config-14"))
        },
    },
    Need {
        what: "the libraries of the window systems X11 and Wayland",
        packages: &[
            "libx11-dev",
            "libx11-xcb-dev",
            "libxcb-dri2-0-dev",
            "libxcb-dri3-dev",
            "libxcb-present-dev",
            "libxcb-randr0-dev",
            "libxcb-shm0-dev",
            "libxcb-sync-dev",
            "libxcb-xfixes0-dev",
            "libxrandr-dev",
            "libxshmfence-dev",
            "libwayland-dev",
            "libwayland-egl-backend-dev",
            "wayland-protocols",
        ],
        is_there: || {
            let headers = [
                "X11/Xlib-xcb.h",
                "X11/xshmfence.h",
                "X11/extensions/Xrandr.h",
                "xcb/dri2.h",
                "xcb/dri3.h",
                "xcb/present.h",
                "xcb/randr.h",
                "xcb/shm.h",
                "xcb/sync.h",
                "xcb/xfixes.h",
                "wayland-client.h",
                "wayland-egl-backend.h",
            ];
            headers.iter().all(|header| Path::new("/usr/include").join(header).exists())
                && Path::new("/usr/share/wayland-protocols").exists()
        },
    },
];

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

    /// The first patches of `integrations/mesa/patches`, by name.
    pub(super) const fn patches(self) -> usize {
        self as usize
    }

    /// What it is called in the table, and the folder of what it is built to.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Unpatched => "unpatched",
            Self::OnePatch => "0001",
            Self::WholeDraws => "0001+0002",
        }
    }
}

/// Where everything lies.
#[derive(Debug)]
pub(super) struct Place {
    /// `target/mesa`
    pub(super) root: PathBuf,
    /// `integrations/mesa`
    pub(super) integration: PathBuf,
}

impl Place {
    /// The folder of a variant's driver.
    pub(super) fn driver(&self, variant: Variant) -> PathBuf {
        self.root.join(variant.name())
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
    pub(super) fn environment(&self, variant: Variant) -> [(&'static str, PathBuf); 3] {
        let mut llvmpipe = self.driver(variant).join(build::LLVMPIPE);
        llvmpipe.pop();
        [
            ("VK_DRIVER_FILES", self.manifest(variant)),
            ("__EGL_VENDOR_LIBRARY_FILENAMES", self.egl_manifest(variant)),
            ("LIBGL_DRIVERS_PATH", llvmpipe),
        ]
    }

    fn open() -> Result<Self, String> {
        // Meson and the loader are given absolute paths.
        let target = command::target();
        let root = std::path::absolute(&target).map_err(|error| in_file(&target, &error))?;
        let root = root.join("mesa");
        fs::create_dir_all(&root).map_err(|error| in_file(&root, &error))?;
        Ok(Self { root, integration: command::workspace().join("integrations/mesa") })
    }
}

/// Builds the drivers, says where they are, and prints the table of what each does.
///
/// # Errors
/// A step fails; or a patched driver is less exact than the unpatched one.
pub(crate) fn run() -> Result<(), String> {
    let place = build_all()?;
    proof::run(&place)
}

/// Builds the drivers and says where they are.
///
/// # Errors
/// A step fails.
pub(crate) fn build() -> Result<(), String> {
    build_all().map(drop)
}

/// Prints the table of drivers that are built.
///
/// # Errors
/// As for [`run`]; or a driver is not built.
pub(crate) fn compare() -> Result<(), String> {
    proof::run(&Place::open()?)
}

/// Runs this project's tests of Vulkan and OpenGL on the drivers with all patches.
///
/// # Errors
/// A test fails, or the driver is not built.
pub(crate) fn test() -> Result<(), String> {
    proof::test(&Place::open()?)
}

fn build_all() -> Result<Place, String> {
    setup::provide(NEEDS)?;
    let place = Place::open()?;
    source::provide(&place)?;
    build::all(&place)?;
    for variant in Variant::ALL {
        println!("\n{}:", variant.name());
        for (name, value) in place.environment(variant) {
            println!("  {name}={}", value.display());
        }
    }
    Ok(place)
}
