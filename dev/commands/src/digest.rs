//! Digests of files, by which a record tells whether what it is about has changed.

use crate::command::{self, workspace};
use std::io::Write;
use std::process::{Command, Stdio};

/// A digest of the names and contents of the files that these paths or patterns of Git name.
///
/// # Errors
/// Git fails.
pub fn of_files(paths: &[String]) -> Result<String, String> {
    let mut list = git(&["ls-files", "--cached", "--others", "--exclude-standard", "--"]);
    let names = command::quiet_output(list.args(paths))?;
    // A file that was removed is still listed until the removal is committed.
    let is_there = |name: &&str| workspace().join(name).symlink_metadata().is_ok();
    let names: Vec<&str> = names.lines().filter(is_there).collect();
    let hashes = fed(&["hash-object", "--stdin-paths"], &names.join("\n"))?;
    let lines: Vec<String> =
        names.iter().zip(hashes.lines()).map(|(name, hash)| format!("{name} {hash}")).collect();
    Ok(fed(&["hash-object", "--stdin"], &lines.join("\n"))?.trim().to_owned())
}

fn git(words: &[&str]) -> Command {
    let mut git = Command::new("git");
    git.args(words).current_dir(workspace());
    git
}

/// The output of `git` for this input.
fn fed(words: &[&str], input: &str) -> Result<String, String> {
    let cannot = |error: std::io::Error| format!("cannot run `git {}`: {error}", words.join(" "));
    let mut git = git(words);
    let mut child = git.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().map_err(cannot)?;
    let mut stdin = child.stdin.take().ok_or("git has no standard input")?;
    let text = input.to_owned();
    // Git answers while it reads, so that a pipe could fill.
    let writer = std::thread::spawn(move || stdin.write_all(text.as_bytes()));
    let output = child.wait_with_output().map_err(cannot)?;
    let written = writer.join().map_err(|_| "the writer panicked".to_owned())?;
    written.map_err(cannot)?;
    match output.status.success() {
        true => String::from_utf8(output.stdout).map_err(|error| error.to_string()),
        false => Err(format!("`git {}` ended with {}", words.join(" "), output.status)),
    }
}
