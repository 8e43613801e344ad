//! What building Mesa needs from the system.

use crate::setup::{Need, has_program};
use std::path::Path;
use std::process::{Command, Stdio};

/// What every version needs.
pub(super) const NEEDS: &[Need] = &[
    Need {
        what: "Debian's tools for source packages",
        packages: &["dpkg-dev", "patch", "debian-archive-keyring"],
        is_there: || ["dpkg-source", "patch"].into_iter().all(has_program),
    },
    Need {
        what: "what Mesa's build runs (meson, ninja, bison, flex, glslangValidator, pkg-config, Mako, PyYAML)",
        packages: &[
            "meson",
            "ninja-build",
            "bison",
            "flex",
            "glslang-tools",
            "pkg-config",
            "python3-mako",
            "python3-yaml",
            "gcc",
            "g++",
        ],
        is_there: || {
            let programs =
                ["meson", "ninja", "bison", "flex", "glslangValidator", "pkg-config", "c++"];
            programs.into_iter().all(has_program) && ["mako", "yaml"].into_iter().all(has_module)
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

/// What an environment with a newer meson needs.
pub(super) const ENVIRONMENT: &[Need] = &[Need {
    what: "virtual environments of the system's Python",
    packages: &["python3-venv"],
    is_there: || {
        let mut python = Command::new(PYTHON);
        python.args(["-c", "import ensurepip, venv"]).stderr(Stdio::null());
        python.status().is_ok_and(|status| status.success())
    },
}];

/// The system's interpreter: another one may lack the modules that Mesa's build imports.
pub(super) const PYTHON: &str = "/usr/bin/python3";

/// Whether the system's Python has this module from a package of Debian's.
fn has_module(name: &str) -> bool {
    Path::new("/usr/lib/python3/dist-packages").join(name).exists()
}
