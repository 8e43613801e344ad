//! Foreign text in messages: shortened, and without control characters that a terminal would obey.

/// The largest number of characters of foreign text that a message repeats.
const MOST: usize = 60;

/// `text` between backquotes, with unprintable characters escaped and a long text cut.
#[must_use]
pub fn quoted(text: &str) -> String {
    let shown: String = text.chars().take(MOST).flat_map(char::escape_debug).collect();
    match text.chars().nth(MOST) {
        None => format!("`{shown}`"),
        Some(_) => format!("`{shown}...` ({} bytes)", text.len()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_and_unprintable_text() {
        assert_eq!(quoted("point 3"), "`point 3`", "plain text stays as it is");
        assert_eq!(quoted("\u{1b}[2J\u{202e}"), "`\\u{1b}[2J\\u{202e}`", "escaped");
        let long = quoted(&"é".repeat(1000));
        assert_eq!(long, format!("`{}...` (2000 bytes)", "é".repeat(60)), "cut");
    }
}
