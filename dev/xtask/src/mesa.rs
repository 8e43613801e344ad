//! Mesa's lavapipe and llvmpipe with this library as their tessellator; `integrations/mesa/mesa.py`
//! builds and compares them.

use crate::command::{self, workspace};
use crate::setup::{self, Need};
use std::process::{Command, Stdio};

/// Debian packages: its tools for sources, the programs of Mesa's build, LLVM and other bases of
/// the drivers, and the libraries of X11 and Wayland.
const PACKAGES: &str = "dpkg-dev patch git debian-archive-keyring meson ninja-build bison flex glslang-tools pkg-config \
    python3-mako python3-yaml python3-venv gcc g++ llvm-dev libdrm-dev libexpat1-dev zlib1g-dev libelf-dev libudev-dev \
    libglvnd-dev libx11-dev libx11-xcb-dev libxcb-dri2-0-dev libxcb-dri3-dev libxcb-present-dev libxcb-randr0-dev \
    libxcb-shm0-dev libxcb-sync-dev libxcb-xfixes0-dev libxrandr-dev libxshmfence-dev libwayland-dev \
    libwayland-egl-backend-dev wayland-protocols";

/// Runs `cargo xtask mesa WORDS`.
///
/// # Errors
/// The words are wrong, a step fails, or a patched driver is less exact than the unpatched one.
pub(crate) fn run(words: &[&str]) -> Result<(), String> {
    setup::provide(&[Need {
        what: "what builds Mesa",
        packages: PACKAGES.split(' ').collect::<Vec<_>>().leak(),
        is_there: || {
            let mut dpkg = Command::new("dpkg");
            dpkg.arg("-s").args(PACKAGES.split(' ')).stdout(Stdio::null()).stderr(Stdio::null());
            dpkg.status().is_ok_and(|status| status.success())
        },
    }])?;
    // The system's interpreter is used, because another one may lack the modules that Mesa's build
    // imports.
    let mut python = Command::new("/usr/bin/python3");
    python.arg("-BE").arg(workspace().join("integrations/mesa/mesa.py")).args(words);
    command::run(&mut python)
}
