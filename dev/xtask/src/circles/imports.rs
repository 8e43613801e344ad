//! The paths of one source file that name other modules of its crate.

use proc_macro2::{Delimiter, Group, TokenStream, TokenTree};

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

/// Reads a source file. Paths count if they begin with `crate`, `self` or `super`, in macros too; every `use`
/// counts, as it may give a child's item another place.
///
/// # Errors
/// It is no Rust.
pub(super) fn read(text: &str) -> Result<Source, String> {
    let mut source = Source::default();
    let stream: TokenStream = text.parse().map_err(|error| format!("{error}"))?;
    source.walk(stream, &[]);
    Ok(source)
}

impl Source {
    /// Takes attributes, `use`s, modules and paths out of a module in braces, or any other group of tokens.
    fn walk(&mut self, stream: TokenStream, inside: &[String]) {
        let tokens: Vec<TokenTree> = stream.into_iter().collect();
        let mut rest = &tokens[..];
        while let [first, after @ ..] = rest {
            rest = after;
            match (first.to_string().as_str(), first, after) {
                ("#", _, [TokenTree::Group(attribute), after @ ..]) => {
                    rest = if is_of_tests(attribute) { self.skip_item(after) } else { after };
                }
                ("use", _, [next, ..]) if next.to_string() != "<" => {
                    let end = after.iter().position(|token| token.to_string() == ";");
                    let (tree, behind) = after.split_at(end.unwrap_or(after.len()));
                    self.branches(tree, &[], inside);
                    rest = behind;
                }
                ("mod", _, [name, TokenTree::Group(body), after @ ..]) => {
                    self.walk(body.stream(), &[inside, &[name.to_string()]].concat());
                    rest = after;
                }
                ("crate" | "self" | "super", _, [colon, ..]) if colon.to_string() == ":" => {
                    rest = self.path(first, after, inside);
                }
                (_, TokenTree::Group(group), _) => self.walk(group.stream(), inside),
                _ => {}
            }
        }
    }

    /// Skips an item of tests; if it is a module in a file, notes its name.
    fn skip_item<'a>(&mut self, tokens: &'a [TokenTree]) -> &'a [TokenTree] {
        let is_end = |token: &TokenTree| match token {
            TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
            other => other.to_string() == ";",
        };
        let end = tokens.iter().position(is_end).map_or(tokens.len(), |end| end + 1);
        let (item, rest) = tokens.split_at(end);
        let words: Vec<String> = item.iter().map(ToString::to_string).collect();
        if let [.., word, name, _] = &words[..]
            && word == "mod"
        {
            self.test_modules.push(name.clone());
        }
        rest
    }

    /// The branches of a `use` behind `before`, with commas between them.
    fn branches(&mut self, tree: &[TokenTree], before: &[String], inside: &[String]) {
        for branch in tree.split(|token| token.to_string() == ",").filter(|one| !one.is_empty()) {
            let mut path = before.to_vec();
            let (mut line, mut name) = (0, None);
            let mut words = branch.iter();
            while let Some(token) = words.next() {
                line = token.span().start().line;
                match (token.to_string().as_str(), token) {
                    (_, TokenTree::Group(group)) => {
                        let inner: Vec<TokenTree> = group.stream().into_iter().collect();
                        self.branches(&inner, &path, inside);
                        path.clear();
                    }
                    ("as", _) => name = words.next().map(ToString::to_string),
                    ("*", _) => name = None,
                    (":", _) => {}
                    (word, _) => {
                        if word != "self" || path.is_empty() {
                            path.push(word.to_owned());
                        }
                        name = path.last().cloned();
                    }
                }
            }
            if !path.is_empty() {
                self.imports.push(Import { line, inside: inside.to_vec(), path, name });
            }
        }
    }

    /// A path in other code than a `use`, and what is behind it.
    fn path<'a>(
        &mut self,
        first: &TokenTree,
        mut rest: &'a [TokenTree],
        inside: &[String],
    ) -> &'a [TokenTree] {
        let mut path = vec![first.to_string()];
        while let [TokenTree::Punct(a), TokenTree::Punct(b), TokenTree::Ident(name), after @ ..] =
            rest
            && (a.as_char(), b.as_char()) == (':', ':')
        {
            path.push(name.to_string());
            rest = after;
        }
        let line = first.span().start().line;
        self.imports.push(Import { line, inside: inside.to_vec(), path, name: None });
        rest
    }
}

/// Whether an attribute is `cfg(test)` or `cfg(all(test, ..))`.
fn is_of_tests(attribute: &Group) -> bool {
    let text = attribute.stream().to_string().replace(' ', "");
    text == "cfg(test)" || text.starts_with("cfg(all(test")
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
        read(text).expect("Rust").imports.iter().map(show).collect()
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
        assert_eq!(read(text).expect("Rust").test_modules, ["e", "g"], "modules of tests");
    }
}
