//! Circles of imports: modules that need each other cannot be read or changed one at a time.
//!
//! At each level of a crate's modules, the children of one parent must name each other in one direction
//! alone, each with all of its parts. A module and its own parts may name each other. Tests do not count.

mod graph;
mod imports;
mod modules;

use crate::command::{self, in_file, workspace};
use graph::{Circle, circles};
use modules::Modules;
use std::path::PathBuf;
use std::process::Command;

/// The circles of the crate in this folder.
fn of_crate(folder: &str) -> Result<Vec<Circle>, String> {
    Ok(circles(&Modules::read(&workspace().join(folder).join("src"))?))
}

/// Shows the circles of the crates whose folders begin with one of `names`, or of all crates.
///
/// # Errors
/// There is a circle, a name that no crate has, or a file that cannot be read.
pub(crate) fn run(names: &[&str]) -> Result<(), String> {
    let folders = folders()?;
    if let Some(name) = names.iter().find(|name| !folders.iter().any(|path| path.starts_with(name)))
    {
        return Err(format!("no crate is in `{name}`"));
    }
    let is_chosen =
        |folder: &PathBuf| names.is_empty() || names.iter().any(|name| folder.starts_with(name));
    let (mut crates, mut found) = (0, 0);
    for folder in folders.iter().filter(|folder| is_chosen(folder)) {
        crates += 1;
        let folder = folder.display().to_string();
        for circle in of_crate(&folder)? {
            found += 1;
            println!("{}", shown(&folder, &circle));
        }
    }
    if found > 0 {
        return Err(format!("{found} circles of imports in {crates} crates"));
    }
    println!("no circles of imports in {crates} crates");
    Ok(())
}

/// A circle and every import that closes it.
fn shown(folder: &str, Circle { parent, members, edges }: &Circle) -> String {
    let members: Vec<&str> = members.iter().map(String::as_str).collect();
    let parent = if parent.is_empty() { String::new() } else { format!(" in `{parent}`") };
    let mut text = format!("{folder}{parent}: {}\n", members.join(", "));
    for ((from, to), places) in edges {
        text += &format!("    {from} -> {to}\n");
        for place in places {
            text += &format!("        {folder}/src/{place}\n");
        }
    }
    text
}

/// The folders of all crates of the repository, those of other workspaces too.
fn folders() -> Result<Vec<PathBuf>, String> {
    let mut git = Command::new("git");
    git.args(["ls-files", "--", "*Cargo.toml"]).current_dir(workspace());
    let list = command::output(&mut git)?;
    let folders = list.lines().filter_map(|line| line.strip_suffix("/Cargo.toml"));
    let folders: Vec<PathBuf> = folders.map(PathBuf::from).collect();
    let has_source = |folder: &&PathBuf| workspace().join(folder).join("src").is_dir();
    match folders.iter().find(|folder| !has_source(folder)) {
        Some(folder) => Err(in_file(folder, &"a crate without the folder `src`")),
        None => Ok(folders),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn there_is_no_circle() {
        assert_eq!(run(&[]), Ok(()), "cargo xtask circles shows all");
    }
}
