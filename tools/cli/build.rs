//! Passes the program the commit from which it is built, for its reports.

use std::path::Path;
use std::process::Command;

/// The folders of this repository from which the program is built; `.` is this one.
const SOURCES: [&str; 10] = [
    ".",
    "../probe",
    "../../tess-core",
    "../../tess-gpu",
    "../../tess-level",
    "../../tess-mesh",
    "../../tess-simd",
    "../../tess-surface",
    "../../tess-verify",
    "../../tess-wgpu",
];

fn main() {
    println!("cargo::rerun-if-env-changed=TESS_COMMIT");
    let commit = std::env::var("TESS_COMMIT").ok().or_else(packaged).or_else(checked_out);
    println!("cargo::rustc-env=TESS_COMMIT={}", commit.as_deref().unwrap_or("unknown"));
}

/// The commit recorded in a published package.
fn packaged() -> Option<String> {
    println!("cargo::rerun-if-changed=build.rs");
    let info = std::fs::read_to_string(".cargo_vcs_info.json").ok()?;
    let (_, after) = info.split_once("\"sha1\"")?;
    Some(after.split('"').nth(1)?.to_owned())
}

/// The commit of the clone, with `+changes` if a file from which the program is built differs from
/// it.
fn checked_out() -> Option<String> {
    if !SOURCES.iter().all(|folder| Path::new(folder).is_dir()) {
        return None; // in another project's repository
    }
    let mut watched: Vec<String> =
        SOURCES[1..].iter().map(|folder| format!("{folder}/src")).collect();
    watched.extend(["src".to_owned(), "../../tess-gpu/shaders".to_owned()]);
    for reference in ["HEAD", "logs/HEAD"] {
        watched.push(git(&["rev-parse", "--git-path", reference])?);
    }
    for path in watched.iter().filter(|path| Path::new(path).exists()) {
        println!("cargo::rerun-if-changed={path}");
    }
    let commit = git(&["rev-parse", "HEAD"])?;
    let changes = git(&[&["status", "--porcelain", "--"][..], &SOURCES].concat())?;
    Some(if changes.is_empty() { commit } else { commit + "+changes" })
}

/// The output of git, without the newline at the end; `None` if there is no git or no clone.
fn git(words: &[&str]) -> Option<String> {
    let answer = Command::new("git").args(words).output().ok()?;
    let text = String::from_utf8(answer.stdout).ok()?;
    answer.status.success().then(|| text.trim_end().to_owned())
}
