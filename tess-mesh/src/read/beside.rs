//! Files next to the model, to which it refers. They must be in its folder or below it.

use std::fs::{self, File};
use std::io::Read;
use std::path::{Component, Path, PathBuf};

/// Whether a relative path names something below the folder that it starts from.
pub(crate) fn is_below(path: &Path) -> bool {
    let mut depth = 0i32;
    for component in path.components() {
        depth += match component {
            Component::Normal(_) => 1,
            Component::CurDir => 0,
            Component::ParentDir => -1,
            Component::RootDir | Component::Prefix(_) => return false,
        };
        if depth < 0 {
            return false;
        }
    }
    depth > 0
}

/// The path of a file in the model's `folder`. Errors: there is no folder.
pub(crate) fn path(folder: Option<&Path>, relative: &Path) -> Result<PathBuf, String> {
    let folder = folder.ok_or("a file without a folder cannot have other files beside it")?;
    Ok(real(folder).join(relative))
}

/// The folder of a path without one is the current folder.
fn real(folder: &Path) -> &Path {
    if folder.as_os_str().is_empty() { Path::new(".") } else { folder }
}

/// Reads at most `length` bytes of an ordinary file that is below `folder` after links are
/// followed.
pub(crate) fn read(path: &Path, folder: &Path, length: u64) -> Result<Vec<u8>, String> {
    let shown = path.display();
    let cannot = |error: std::io::Error| format!("cannot read {shown}: {error}");
    let found = fs::canonicalize(path).map_err(cannot)?;
    if !found.starts_with(fs::canonicalize(real(folder)).map_err(cannot)?) {
        return Err(format!("{shown} is a link to a file outside of the model's folder"));
    }
    let is_file = fs::metadata(&found).map_err(cannot)?.is_file();
    if !is_file {
        return Err(format!("{shown} is not an ordinary file"));
    }
    let mut bytes = Vec::new();
    File::open(&found)
        .and_then(|file| file.take(length).read_to_end(&mut bytes))
        .map_err(cannot)?;
    Ok(bytes)
}
