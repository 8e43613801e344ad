//! glTF in two files: the JSON, and next to it the binary part with the extension `.bin`.

use super::Options;
use super::binary::Binary;
use crate::failure::Failure;
use crate::output::OutputFile;
use serde_json::Value;
use std::path::Path;

/// Begins both files.
pub(super) fn create(path: &Path, options: &Options) -> Result<Binary, Failure> {
    let beside = path.with_extension("bin");
    let uri = encode(&beside);
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
    let json = Some((OutputFile::create(path)?, uri));
    Ok(Binary::new(OutputFile::create(&beside)?, 0, json, options))
}

/// The reference to a file in the same folder, with every byte percent-encoded that has a meaning
/// in a URI (RFC 3986, section 2).
fn encode(file: &Path) -> String {
    let mut uri = String::new();
    for &byte in file.file_name().unwrap_or_default().as_encoded_bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' => {
                uri.push(char::from(byte));
            }
            _ => uri.push_str(&format!("%{byte:02X}")),
        }
    }
    uri
}

/// Whether an existing glTF file refers to this binary part.
fn refers_to(gltf: &Path, uri: &str) -> bool {
    let Ok(text) = std::fs::read(gltf) else { return false };
    let document: Value = serde_json::from_slice(&text).unwrap_or_default();
    let buffers = document["buffers"].as_array().cloned().unwrap_or_default();
    buffers.iter().any(|buffer| buffer["uri"].as_str() == Some(uri))
}
