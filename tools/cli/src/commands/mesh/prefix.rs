//! The way from the folder of the output to that of the model, for references to images and
//! material libraries.

use std::path::{Component, Path, PathBuf};
use tess_mesh::write::uri_of;

/// The path that leads from the output's folder to the model's, with a slash at its end; empty if
/// they are the same folder or if there is no model.
pub(super) fn between(model: Option<&Path>, output: &Path) -> String {
    let Some(model) = model else { return String::new() };
    let folder = |file: &Path| -> Option<PathBuf> {
        let parent = file.parent().filter(|parent| !parent.as_os_str().is_empty());
        parent.unwrap_or(Path::new(".")).canonicalize().ok()
    };
    let (Some(to), Some(from)) = (folder(model), folder(output)) else { return String::new() };
    let shared = to.components().zip(from.components()).take_while(|(a, b)| a == b).count();
    // On different drives there is no way.
    if shared == 0 {
        return format!("{}/", to.display());
    }
    let up = from.components().skip(shared).map(|_| "..".to_owned());
    let down = to.components().skip(shared).map(|part| match part {
        Component::Normal(name) => name.to_string_lossy().into_owned(),
        _ => String::new(),
    });
    up.chain(down).map(|name| name + "/").collect()
}

/// The path as the beginning of a URI.
pub(super) fn uri(prefix: &str) -> String {
    let encode = |name: &str| match name {
        "" | ".." => name.to_owned(),
        name => uri_of(Path::new(name)),
    };
    prefix.split('/').map(encode).collect::<Vec<_>>().join("/")
}
