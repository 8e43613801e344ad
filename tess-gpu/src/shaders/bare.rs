//! Shader text for pages, which download it: without indentation, empty lines and lines of comment.
//! The line that names what a file needs stays.

/// The bytes that [`bare`] leaves of a text.
pub(super) const fn bare_len(text: &str) -> usize {
    let (bytes, mut from, mut count) = (text.as_bytes(), 0, 0);
    while from < bytes.len() {
        let (begin, end) = line(bytes, from);
        if stays(bytes, begin) {
            count += end - begin;
        }
        from = end;
    }
    count
}

/// The text's first `N` bytes of lines that stay; `N` is [`bare_len`].
pub(super) const fn bare<const N: usize>(text: &str) -> [u8; N] {
    let (bytes, mut from) = (text.as_bytes(), 0);
    let (mut left, mut count) = ([0; N], 0);
    while from < bytes.len() {
        let (mut begin, end) = line(bytes, from);
        if stays(bytes, begin) {
            while begin < end {
                left[count] = bytes[begin];
                (begin, count) = (begin + 1, count + 1);
            }
        }
        from = end;
    }
    left
}

/// Where the line at `from` begins behind its indentation, and where the next one does.
const fn line(bytes: &[u8], from: usize) -> (usize, usize) {
    let mut begin = from;
    while begin < bytes.len() && bytes[begin] == b' ' {
        begin += 1;
    }
    let mut end = begin;
    while end < bytes.len() && bytes[end] != b'\n' {
        end += 1;
    }
    (begin, if end < bytes.len() { end + 1 } else { end })
}

const fn stays(bytes: &[u8], begin: usize) -> bool {
    !begins(bytes, begin, b"\n")
        && (!begins(bytes, begin, b"//") || begins(bytes, begin, b"// needs:"))
}

const fn begins(bytes: &[u8], at: usize, with: &[u8]) -> bool {
    let mut k = 0;
    while k < with.len() {
        if at + k >= bytes.len() || bytes[at + k] != with[k] {
            return false;
        }
        k += 1;
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn code_and_needs_stay() {
        const TEXT: &str =
            "// needs: place\n\n// About.\nfn f() {\n    // More.\n    a = 1 / 2; // half\n}";
        const LEFT: [u8; bare_len(TEXT)] = bare(TEXT);
        assert_eq!(
            str::from_utf8(&LEFT),
            Ok("// needs: place\nfn f() {\na = 1 / 2; // half\n}"),
            "without comments of their own"
        );
    }
}
