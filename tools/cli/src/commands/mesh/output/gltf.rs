//! The two files of glTF: the JSON, and next to it the binary part with the extension `.bin`.

use crate::failure::Failure;
use crate::output::OutputFile;
use serde_json::Value;
use std::path::Path;
use tess_mesh::write::{Gltf, GltfOptions, uri_of};

/// Begins both files.
pub(super) fn create<'a>(
    path: &Path,
    options: GltfOptions<'a>,
) -> Result<Gltf<'a, OutputFile, OutputFile>, Failure> {
    let beside = path.with_extension("bin");
    let uri = uri_of(&beside);
    if !OutputFile::would_be_file(path) {
        return Err(Failure::bad_input(format!(
            "{} is not a regular file, but glTF is two files; --format glb is one",
            path.display()
        )));
    }
    if beside.symlink_metadata().is_ok() && !refers_to(path, &uri) {
        return Err(Failure::bad_input(format!(
            "{} is there already and {} does not refer to it, so it may be something else; \
             remove it, or give another name",
            beside.display(),
            path.display()
        )));
    }
    let json = OutputFile::create(path)?;
    Ok(Gltf::new(json, OutputFile::create(&beside)?, uri, options))
}

/// Whether an existing glTF file refers to this binary part.
fn refers_to(gltf: &Path, uri: &str) -> bool {
    let Ok(text) = std::fs::read(gltf) else { return false };
    let document: Value = serde_json::from_slice(&text).unwrap_or_default();
    let buffers = document["buffers"].as_array().cloned().unwrap_or_default();
    buffers.iter().any(|buffer| buffer["uri"].as_str() == Some(uri))
}
