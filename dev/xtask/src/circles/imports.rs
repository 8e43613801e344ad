//! The paths of one source file that name other modules of its crate.

use super::tokens::{Token, tokens};

/// A path as it stands in a source file, outside of tests.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Import {
    pub(super) line: usize,
    /// The modules in braces that it stands in, the outermost first.
    pub(super) inside: Vec<String>,
    pub(super) path: Vec<String>,
    /// The name that a `use` gives it; `None` for `*` and for paths in other code.
    pub(super) name: Option<String>,
}

/// What a source file says of modules.
#[derive(Debug, Default)]
pub(super) struct Source {
    pub(super) imports: Vec<Import>,
    /// Modules in files that only tests have.
    pub(super) test_modules: Vec<String>,
}

/// Reads a source file. Paths count if they begin with `crate`, `self` or `super`; every `use` counts, as it
/// may give a child's item another place.
pub(super) fn read(text: &str) -> Source {
    let mut reader = Reader { tokens: &tokens(text), ..Reader::default() };
    while !reader.tokens.is_empty() {
        reader.item();
    }
    reader.source
}

#[derive(Default)]
struct Reader<'a> {
    tokens: &'a [Token<'a>],
    source: Source,
    /// Open braces; the name of a module where one begins it.
    braces: Vec<Option<String>>,
}

impl<'a> Reader<'a> {
    /// Takes what comes next: an attribute, a `use`, the head of a module, a path, or one token.
    fn item(&mut self) {
        let texts = |n: usize| self.tokens.get(n).map_or("", |token| token.text);
        match (texts(0), texts(1), texts(2)) {
            ("#", "[", _) => self.attribute(),
            ("use", next, _) if next != "<" => self.import(),
            ("mod", name, "{") => {
                self.braces.push(Some(name.to_owned()));
                self.advance(3);
            }
            ("{", ..) => {
                self.braces.push(None);
                self.advance(1);
            }
            ("}", ..) => {
                self.braces.pop();
                self.advance(1);
            }
            ("crate" | "self" | "super", "::", _) => self.path(),
            // The rest of a path whose beginning is something else.
            ("::", ..) => self.advance(2),
            _ => self.advance(1),
        }
    }

    fn advance(&mut self, count: usize) {
        self.tokens = self.tokens.get(count..).unwrap_or_default();
    }

    fn next(&mut self) -> Option<&'a Token<'a>> {
        let (first, rest) = self.tokens.split_first()?;
        self.tokens = rest;
        Some(first)
    }

    /// Skips an attribute, and with `#[cfg(test)]` its item.
    fn attribute(&mut self) {
        let words: Vec<&str> = self.tokens.iter().take(7).map(|token| token.text).collect();
        let is_test = words.starts_with(&["#", "[", "cfg", "(", "test", ")"])
            || words.starts_with(&["#", "[", "cfg", "(", "all", "(", "test"]);
        self.advance(1);
        self.group();
        if is_test {
            self.skip_item();
        }
    }

    /// Skips from one bracket to the one that closes it.
    fn group(&mut self) {
        let mut depth = 0;
        while let Some(token) = self.next() {
            match token.text {
                "(" | "[" | "{" => depth += 1,
                ")" | "]" | "}" => depth -= 1,
                _ => {}
            }
            if depth == 0 {
                return;
            }
        }
    }

    /// Skips an item of tests; if it is a module in a file, notes its name.
    fn skip_item(&mut self) {
        while let Some(token) = self.tokens.first() {
            match token.text {
                "{" => return self.group(),
                "(" | "[" => self.group(),
                ";" => return self.advance(1),
                "mod" => {
                    let name = self.tokens.get(1).map_or("", |name| name.text);
                    self.source.test_modules.push(name.to_owned());
                    self.advance(2);
                }
                _ => self.advance(1),
            }
        }
    }

    /// A `use` with everything that it names.
    fn import(&mut self) {
        self.advance(1);
        self.tree(&[]);
    }

    /// One branch of a `use`, behind `before`; ends at the comma, brace or semicolon behind it.
    fn tree(&mut self, before: &[String]) {
        let mut path = before.to_vec();
        let mut line = self.tokens.first().map_or(0, |token| token.line);
        let mut name = None;
        while let Some(token) = self.tokens.first() {
            match token.text {
                "," | "}" | ";" => break,
                "{" => return self.branches(&path),
                "as" => {
                    name = self.tokens.get(1).map(|token| token.text.to_owned());
                    self.advance(2);
                    continue;
                }
                "self" if !path.is_empty() => {}
                "::" | "*" => {}
                word => {
                    line = token.line;
                    path.push(word.to_owned());
                }
            }
            name = (token.text != "*").then(|| path.last().cloned()).flatten();
            self.advance(1);
        }
        self.add(line, path, name);
    }

    /// The branches of a `use` between braces.
    fn branches(&mut self, before: &[String]) {
        self.advance(1);
        while let Some(token) = self.tokens.first() {
            match token.text {
                "}" => return self.advance(1),
                "," => self.advance(1),
                _ => self.tree(before),
            }
        }
    }

    /// A path in other code than a `use`.
    fn path(&mut self) {
        let line = self.tokens.first().map_or(0, |token| token.line);
        let mut path = Vec::new();
        while let Some(word) = self.tokens.first().filter(|token| token.is_word()) {
            path.push(word.text.to_owned());
            let goes_on = self.tokens.get(1).is_some_and(|token| token.text == "::");
            self.advance(if goes_on { 2 } else { 1 });
            if !goes_on {
                break;
            }
        }
        self.add(line, path, None);
    }

    fn add(&mut self, line: usize, path: Vec<String>, name: Option<String>) {
        let inside = self.braces.iter().flatten().cloned().collect();
        self.source.imports.push(Import { line, inside, path, name });
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Each import as `LINE MODULES PATH as NAME`.
    fn shown(text: &str) -> Vec<String> {
        let show = |import: &Import| {
            let Import { line, inside, path, name } = import;
            let name = name.as_deref().unwrap_or("-");
            format!("{line} {} {} {name}", inside.join("."), path.join("::"))
        };
        read(text).imports.iter().map(show).collect()
    }

    #[test]
    fn uses_are_taken_apart() {
        let text = "use crate::{a::{self, B, c::*}, d as e};\npub(crate) use super::f;\nfn g<'a>() -> impl H + use<'a> {}";
        let expected = [
            "1  crate::a a",
            "1  crate::a::B B",
            "1  crate::a::c -",
            "1  crate::d e",
            "2  super::f f",
        ];
        assert_eq!(shown(text), expected, "uses");
    }

    #[test]
    fn paths_in_code_count_and_tests_do_not() {
        let text = "fn a() { crate::b::c::<u32>(x::crate_y) }\n\
                    #[cfg(test)]\nuse crate::d;\n#[cfg(all(test, unix))]\nmod e { use super::f; }\n\
                    #[cfg(test)]\nmod g;\n#[cfg(not(test))]\nuse crate::h;\n\
                    mod i { use super::j; fn k() { super::super::l() } }\nuse crate::m;";
        let expected = [
            "1  crate::b::c -",
            "9  crate::h h",
            "10 i super::j j",
            "10 i super::super::l -",
            "11  crate::m m",
        ];
        assert_eq!(shown(text), expected, "paths");
        assert_eq!(read(text).test_modules, ["e", "g"], "modules of tests");
    }
}
