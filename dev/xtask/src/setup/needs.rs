//! The tests' needs from the system.

use super::{Need, PYTHON, has_program};
use std::path::Path;
use std::process::Command;
use tess_commands::setup::VERILATOR;

/// The needs of `cargo xtask test`.
pub(super) const COMPARISONS: &[Need] = &[
    VULKAN,
    Need {
        what: "C and C++ compilers, make, CMake and pkg-config (tests of the C interface)",
        packages: &["gcc", "g++", "libc6-dev", "make", "cmake", "pkg-config"],
        is_there: || ["cc", "c++", "make", "cmake", "pkg-config"].into_iter().all(has_program),
    },
    Need {
        what: "compilers of shaders and Vulkan's header (tests of `tess shaders` and `tess probe`)",
        packages: &["spirv-tools", "glslang-tools", "libvulkan-dev"],
        is_there: || {
            ["spirv-val", "glslangValidator"].into_iter().all(has_program)
                && Path::new("/usr/include/vulkan/vulkan.h").exists()
        },
    },
    PYTHON,
];

/// The additional needs of `cargo xtask test all`, without the browser.
pub(super) const BEYOND: &[Need] = &[
    Need {
        what: "an OpenGL driver through EGL (tests of wgpu's OpenGL backend)",
        packages: &["libegl1", "libegl-mesa0", "libgl1-mesa-dri"],
        is_there: has_opengl,
    },
    XVFB,
    VERILATOR,
    ICARUS,
];

/// The need of tests that open windows.
pub(crate) const XVFB: Need = Need {
    what: "an X server without a screen, and its libraries (tests of examples' windows)",
    packages: &["xvfb", "libx11-xcb1", "libxcursor1", "libxi6", "libxkbcommon-x11-0"],
    is_there: || has_program("Xvfb"),
};

/// The need of everything that runs shaders.
pub(crate) const VULKAN: Need = Need {
    what: "a Vulkan driver (GPU tests run on the software driver lavapipe)",
    packages: &["libvulkan1", "mesa-vulkan-drivers"],
    is_there: has_vulkan,
};

/// The runtime for JavaScript programs.
pub(crate) const NODE: Need = Need {
    what: "Node.js with npm (drives the browser, runs the validator of glTF)",
    packages: &["nodejs", "npm"],
    is_there: || has_program("node") && has_program("npm"),
};

/// The solver of the proof about triangles.
pub(crate) const Z3: Need = Need {
    what: "Z3 (a proof about the points of triangles)",
    packages: &["z3"],
    is_there: || has_program("z3"),
};

/// The second simulator of the cocotb bench.
pub(crate) const ICARUS: Need = Need {
    what: "Icarus Verilog (tests of the cocotb bench)",
    packages: &["iverilog"],
    is_there: || has_program("iverilog"),
};

/// Whether the loader, and some driver's manifest, are in the places where Vulkan looks for them.
fn has_vulkan() -> bool {
    let has_driver = std::env::var_os("VK_DRIVER_FILES").is_some()
        || ["/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d"]
            .into_iter()
            .any(has_files);
    has_driver && has_library("libvulkan.so.1")
}

/// Whether EGL's dispatcher, and some driver's manifest, are in the places where EGL looks for
/// them.
fn has_opengl() -> bool {
    ["/usr/share/glvnd/egl_vendor.d", "/etc/glvnd/egl_vendor.d"].into_iter().any(has_files)
        && has_library("libEGL.so.1")
}

fn has_files(folder: &str) -> bool {
    std::fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_some())
}

fn has_library(name: &str) -> bool {
    let known = Command::new("/sbin/ldconfig").arg("-p").output();
    known.is_ok_and(|list| String::from_utf8_lossy(&list.stdout).contains(name))
}
