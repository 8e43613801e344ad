//! References from a glTF file to files beside it (RFC 3986).

use std::path::Path;

/// The reference to a file beside: every byte percent-encoded that has a meaning in a URI.
pub(super) fn encode(file: &Path) -> String {
    let name = file.file_name().unwrap_or_default();
    let mut uri = String::new();
    for &byte in name.as_encoded_bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'.' | b'_' | b'~' => {
                uri.push(char::from(byte));
            }
            _ => uri.push_str(&format!("%{byte:02X}")),
        }
    }
    uri
}

/// The file that a reference names; what is not percent-encoded as it should be stays as it is.
pub(super) fn decode(uri: &str) -> String {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, after)) = rest.split_first() {
        let digits = after.get(..2).and_then(|digits| std::str::from_utf8(digits).ok());
        let is_hex = |digits: &&str| digits.bytes().all(|digit| digit.is_ascii_hexdigit());
        let byte = digits.filter(is_hex).and_then(|digits| u8::from_str_radix(digits, 16).ok());
        match byte.filter(|_| first == b'%') {
            Some(byte) => {
                bytes.push(byte);
                rest = &after[2..];
            }
            None => {
                bytes.push(first);
                rest = after;
            }
        }
    }
    String::from_utf8(bytes).unwrap_or_else(|_| uri.to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_survive() {
        let name = "a/b c#d?e%41é.bin";
        let uri = encode(Path::new(name));
        assert_eq!(uri, "b%20c%23d%3Fe%2541%C3%A9.bin", "what has a meaning is encoded");
        assert_eq!(decode(&uri), "b c#d?e%41é.bin", "and back");
        assert_eq!(decode("100%.bin%2"), "100%.bin%2", "no encoding, as other programs write it");
    }
}
