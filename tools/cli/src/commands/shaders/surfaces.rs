//! The folder `surfaces`, which accompanies shaders in WGSL: modules of functions for the user's
//! own shaders.

use crate::output::json;
use serde::Serialize;
use std::fs;
use std::io;
use std::path::Path;
use tess_gpu::surfaces::{MODULES, README};

/// The folder.
pub(super) const FOLDER: &str = "surfaces";

/// A module in `modules.json`.
#[derive(Serialize)]
struct Entry {
    name: &'static str,
    file: String,
    /// The names of the modules that it needs.
    needs: &'static [&'static str],
}

const LIST: &str = "modules.json";
const TABLES: &str = "README.md";

/// The names of its files.
pub(super) fn files() -> Vec<String> {
    let modules = MODULES.iter().map(|module| format!("{}.wgsl", module.name));
    modules.chain([LIST, TABLES].map(str::to_owned)).collect()
}

/// Writes the folder into another one: a file per module, their list, and the tables of modules and
/// functions.
///
/// # Errors
/// A file cannot be written.
pub(super) fn write(folder: &Path) -> io::Result<()> {
    let folder = folder.join(FOLDER);
    fs::create_dir(&folder)?;
    let mut entries = Vec::new();
    for module in MODULES {
        let file = format!("{}.wgsl", module.name);
        fs::write(folder.join(&file), module.source)?;
        entries.push(Entry { name: module.name, file, needs: module.needs });
    }
    fs::write(folder.join(LIST), json(&entries))?;
    fs::write(folder.join(TABLES), format!("# Surfaces\n\n{README}"))
}
