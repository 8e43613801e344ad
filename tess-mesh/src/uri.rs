//! References from one file to another.

use std::path::Path;

/// The reference to a file in the same folder, with every byte percent-encoded that has a meaning
/// in a URI (RFC 3986, section 2).
#[must_use]
pub fn uri_of(file: &Path) -> String {
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
