//! Rust source as words and punctuation, without comments, strings and characters.

/// A word, `::`, or one character of punctuation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Token<'a> {
    pub(super) text: &'a str,
    /// From 1 on.
    pub(super) line: usize,
}

impl Token<'_> {
    pub(super) fn is_word(&self) -> bool {
        self.text.starts_with(is_in_word)
    }
}

fn is_in_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The tokens of a source file. `r#name` is `name`.
pub(super) fn tokens(source: &str) -> Vec<Token<'_>> {
    let mut found = Vec::new();
    let (mut rest, mut line) = (source, 1);
    while let Some(first) = rest.chars().next() {
        let skipped = skipped(rest);
        let length = skipped.unwrap_or_else(|| length(rest, first));
        let text = &rest[..length];
        if skipped.is_none() && !first.is_whitespace() {
            found.push(Token { text, line });
        }
        line += text.matches('\n').count();
        rest = &rest[length..];
    }
    found
}

/// The length of the token that begins with `first`.
fn length(rest: &str, first: char) -> usize {
    if is_in_word(first) {
        return rest.find(|c| !is_in_word(c)).unwrap_or(rest.len());
    }
    if rest.starts_with("::") { 2 } else { first.len_utf8() }
}

/// The length of the comment, string, character or prefix `r#` that `rest` begins with.
fn skipped(rest: &str) -> Option<usize> {
    if rest.starts_with("//") {
        return Some(rest.find('\n').unwrap_or(rest.len()));
    }
    if rest.starts_with("/*") {
        return Some(block_comment(rest));
    }
    if rest.starts_with('\'') {
        return character(rest);
    }
    let prefix = ["", "b", "c", "r", "br", "cr"].into_iter().rfind(|prefix| {
        rest.strip_prefix(prefix).is_some_and(|after| after.starts_with(['"', '#']))
    })?;
    let after = &rest[prefix.len()..];
    if prefix.ends_with('r') {
        let hashes = after.len() - after.trim_start_matches('#').len();
        if !after[hashes..].starts_with('"') {
            return Some(prefix.len() + 1);
        }
        let end = format!("\"{}", "#".repeat(hashes));
        let start = prefix.len() + hashes + 1;
        return Some(rest[start..].find(&end).map_or(rest.len(), |at| start + at + end.len()));
    }
    after.starts_with('"').then(|| prefix.len() + quoted(after, '"'))
}

/// The length of a comment, with the comments inside of it.
fn block_comment(rest: &str) -> usize {
    let (mut depth, mut at) = (0, 0);
    while at < rest.len() {
        let here = &rest.as_bytes()[at..];
        if here.starts_with(b"/*") {
            (depth, at) = (depth + 1, at + 2);
        } else if here.starts_with(b"*/") {
            (depth, at) = (depth - 1, at + 2);
            if depth == 0 {
                return at;
            }
        } else {
            at += 1;
        }
    }
    rest.len()
}

/// The length of a character literal; of a lifetime, that of its apostrophe.
fn character(rest: &str) -> Option<usize> {
    let mut inside = rest[1..].chars();
    let first = inside.next()?;
    if first == '\\' {
        return Some(quoted(rest, '\''));
    }
    let is_literal = inside.next() == Some('\'');
    Some(if is_literal { 2 + first.len_utf8() } else { 1 })
}

/// The length of what stands between two `quote`s, with both of them.
fn quoted(rest: &str, quote: char) -> usize {
    let mut is_escaped = true;
    for (at, c) in rest.char_indices() {
        if c == quote && !is_escaped {
            return at + quote.len_utf8();
        }
        is_escaped = c == '\\' && !is_escaped;
    }
    rest.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(source: &str) -> Vec<&str> {
        tokens(source).iter().map(|token| token.text).collect()
    }

    #[test]
    fn comments_and_literals_are_left_out() {
        let source = "a // crate::x\n/* b /* c */ d */ e \"crate::y \\\" z\" f r#\"g \" h\"# i";
        assert_eq!(texts(source), ["a", "e", "f", "i"], "comments and strings");
        assert_eq!(texts("x('\"', '\\'', b'a') y<'a>"), texts("x( , , b) y<a>"), "characters");
        assert_eq!(texts("r#type::b \"\" b\"x\" c"), ["type", "::", "b", "c"], "names and empty");
    }

    #[test]
    fn tokens_know_their_lines() {
        let found = tokens("a\n/* \n */ b\n\"\n\" c");
        let lines: Vec<usize> = found.iter().map(|token| token.line).collect();
        assert_eq!(lines, [1, 3, 5], "lines");
    }
}
