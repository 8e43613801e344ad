//! A program that uses only the core links without the standard library, an allocator or libc, and
//! runs.
#![cfg(all(target_os = "linux", target_arch = "x86_64"))]

use std::process::Command;

#[test]
fn a_program_without_the_standard_library_links_and_runs() {
    let root = concat!(env!("CARGO_MANIFEST_DIR"), "/..");
    let manifest = &format!("{root}/dev/nostd-proof/Cargo.toml");
    // It is a workspace of its own, with this one's versions.
    std::fs::copy(format!("{root}/Cargo.lock"), format!("{root}/dev/nostd-proof/Cargo.lock"))
        .expect("the versions");
    let target = concat!(env!("CARGO_TARGET_TMPDIR"), "/nostd-proof");
    let mut build = Command::new(env!("CARGO"));
    build.args(["build", "--quiet", "--manifest-path", manifest, "--target-dir", target]);
    // Flags for this workspace, such as those that measure coverage, need the standard library.
    build.env_remove("RUSTFLAGS").env_remove("CARGO_ENCODED_RUSTFLAGS");
    build.env_remove("CARGO_BUILD_TARGET");
    let output = build.output().expect("cargo runs");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let program = format!("{target}/debug/tess-nostd-proof");
    let status = Command::new(program).status().expect("it was built");
    assert_eq!(status.code(), Some(0), "0: equal, 1: the formulations differ, 2: a panic");
}
