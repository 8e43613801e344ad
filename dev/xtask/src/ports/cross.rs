//! Tests the model and the CPU backend on other processors, in emulators.

use super::Extent;
use crate::command::cargo;
use crate::setup::{self, Need, has_program};
use crate::tally;
use std::path::Path;
use std::process::Command;

/// A processor or system whose programs an x86-64 machine with Debian's cross compilers can run.
pub(super) struct Host {
    pub(super) target: &'static str,
    pub(super) linker: &'static str,
    pub(super) runner: &'static str,
    /// Arguments of `cargo` for every test that can run there.
    pub(super) whole: &'static [&'static str],
    pub(super) need: Need,
}

/// A 32-bit processor, on which `usize` is as wide as an index.
pub(super) const I686: Host = Host {
    target: "i686-unknown-linux-gnu",
    linker: "i686-linux-gnu-gcc",
    runner: "/usr/i686-linux-gnu/lib/ld-linux.so.2 --library-path /usr/i686-linux-gnu/lib",
    whole: WHOLE,
    need: Need {
        what: "a C compiler and C library for i686",
        packages: &["gcc-i686-linux-gnu", "libc6-dev-i386-cross"],
        is_there: || {
            has_program("i686-linux-gnu-gcc")
                && Path::new("/usr/i686-linux-gnu/lib/ld-linux.so.2").exists()
        },
    },
};

/// Another instruction set with the byte order of x86.
pub(super) const AARCH64: Host = Host {
    target: "aarch64-unknown-linux-gnu",
    linker: "aarch64-linux-gnu-gcc",
    runner: "qemu-aarch64-static -L /usr/aarch64-linux-gnu",
    whole: WHOLE,
    need: Need {
        what: "a C compiler, C library and emulator for aarch64",
        packages: &["gcc-aarch64-linux-gnu", "libc6-dev-arm64-cross", "qemu-user-static"],
        is_there: || has_program("aarch64-linux-gnu-gcc") && has_program("qemu-aarch64-static"),
    },
};

/// A processor with the most significant byte first.
pub(super) const S390X: Host = Host {
    target: "s390x-unknown-linux-gnu",
    linker: "s390x-linux-gnu-gcc",
    runner: "qemu-s390x-static -L /usr/s390x-linux-gnu",
    whole: WHOLE,
    need: Need {
        what: "a C compiler, C library and emulator for s390x",
        packages: &["gcc-s390x-linux-gnu", "libc6-dev-s390x-cross", "qemu-user-static"],
        is_there: || has_program("s390x-linux-gnu-gcc") && has_program("qemu-s390x-static"),
    },
};

/// Tests that compare with `golden/` and take seconds in an emulator.
pub(super) const BRIEF: &[&str] = &[
    "test --package tess-core --lib --test golden",
    "test --package tess-simd --no-default-features --test baseline",
];

/// All tests except one that starts itself, which emulated programs cannot do. `tess-simd` has one
/// CPU level on these processors.
const WHOLE: &[&str] = &[
    "test --package tess-core",
    "test --package tess-simd --all-features -- --skip too_large_a_pool",
];

/// Runs the tests on this host.
pub(super) fn check(host: &Host, extent: Extent) -> Result<(), String> {
    setup::provide(&[host.need])?;
    run(host, extent, &[])
}

/// Runs the tests with these additional environment variables.
pub(super) fn run(host: &Host, extent: Extent, set: &[(&str, String)]) -> Result<(), String> {
    setup::target(host.target)?;
    let variable = |what: &str| {
        format!("CARGO_TARGET_{}_{what}", host.target.to_uppercase().replace('-', "_"))
    };
    tally::run(commands(host, extent).iter().map(|arguments| {
        let mut command: Command = cargo(arguments);
        command.envs(set.iter().map(|(key, value)| (key, value)));
        command.env("CARGO_BUILD_TARGET", host.target);
        command.env(variable("LINKER"), host.linker);
        command.env(variable("RUNNER"), host.runner);
        command
    }))
}

/// Arguments of `cargo` for the tests that run there.
const fn commands(host: &Host, extent: Extent) -> &'static [&'static str] {
    match extent {
        Extent::Brief => BRIEF,
        Extent::Whole => host.whole,
    }
}
