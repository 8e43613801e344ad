//! Sets up what the tests need beyond Rust.

use crate::command;
use std::path::Path;
use std::process::Command;

/// Something that tests need from the system.
struct Need {
    what: &'static str,
    /// Debian packages that bring it.
    packages: &'static [&'static str],
    is_there: fn() -> bool,
}

const NEEDS: &[Need] = &[
    Need {
        what: "a Vulkan driver (GPU tests run on the software driver lavapipe)",
        packages: &["libvulkan1", "mesa-vulkan-drivers"],
        is_there: has_vulkan,
    },
    Need {
        what: "C and C++ compilers and make (tests of the C interface)",
        packages: &["gcc", "g++", "libc6-dev", "make"],
        is_there: || ["cc", "c++", "make"].into_iter().all(has_program),
    },
    Need {
        what: "Verilator (tests of the SystemVerilog interface)",
        packages: &["verilator"],
        is_there: || has_program("verilator"),
    },
];

/// Installs what is missing where the system allows it, and says what to install where not.
pub(crate) fn run() -> Result<(), String> {
    let missing: Vec<&Need> = NEEDS.iter().filter(|need| !(need.is_there)()).collect();
    if missing.is_empty() {
        return Ok(());
    }
    let packages: Vec<&str> = missing.iter().flat_map(|need| need.packages).copied().collect();
    let wanted: Vec<&str> = missing.iter().map(|need| need.what).collect();
    println!("missing: {}", wanted.join("; "));
    let by_hand = format!(
        "missing: {}. On Debian or Ubuntu: sudo apt-get install {}",
        wanted.join("; "),
        packages.join(" ")
    );
    if !Path::new("/usr/bin/apt-get").exists() {
        return Err(by_hand);
    }
    install(&packages).map_err(|error| format!("{error}. {by_hand}"))
}

fn install(packages: &[&str]) -> Result<(), String> {
    command::run(apt().arg("update").arg("-q"))?;
    command::run(apt().args(["install", "-y", "-q", "--no-install-recommends"]).args(packages))
}

/// `apt-get`, through `sudo` (which must not ask) unless this is root.
fn apt() -> Command {
    let is_root = Command::new("id").arg("-u").output().is_ok_and(|id| id.stdout == b"0\n");
    let mut command = if is_root {
        Command::new("apt-get")
    } else {
        let mut sudo = Command::new("sudo");
        sudo.args(["-n", "apt-get"]);
        sudo
    };
    command.env("DEBIAN_FRONTEND", "noninteractive");
    command
}

/// Whether the loader and any driver's manifest are where Vulkan looks for them.
fn has_vulkan() -> bool {
    let has_driver = std::env::var_os("VK_DRIVER_FILES").is_some()
        || ["/usr/share/vulkan/icd.d", "/etc/vulkan/icd.d", "/usr/local/share/vulkan/icd.d"]
            .iter()
            .any(|folder| {
                std::fs::read_dir(folder).is_ok_and(|mut entries| entries.next().is_some())
            });
    has_driver && has_library("libvulkan.so.1")
}

fn has_library(name: &str) -> bool {
    let known = Command::new("/sbin/ldconfig").arg("-p").output();
    known.is_ok_and(|list| String::from_utf8_lossy(&list.stdout).contains(name))
}

fn has_program(name: &str) -> bool {
    let path = std::env::var_os("PATH").unwrap_or_default();
    std::env::split_paths(&path).any(|folder| folder.join(name).is_file())
}
