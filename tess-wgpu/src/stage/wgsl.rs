//! Finds the module-scope declarations of a WGSL text by name and line. No compiler is used,
//! because a browser's reports little and reports it late.

/// Something that a text declares at module scope.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Declaration<'a> {
    pub(super) name: &'a str,
    /// Counted from 1.
    pub(super) line: u32,
    /// `fn`, `override`, ...
    pub(super) keyword: &'a str,
    /// Whether it is a function with the attribute `@fragment`.
    pub(super) is_fragment: bool,
    /// The whole declaration, from the end of the one before it.
    pub(super) text: &'a str,
}

impl<'a> Declaration<'a> {
    pub(super) fn has_no_value(&self) -> bool {
        tokens(self.text).all(|(_, token)| token != "=")
    }

    /// The first word in the parentheses of an attribute.
    pub(super) fn attribute(&self, name: &str) -> Option<&'a str> {
        let words: Vec<_> = tokens(self.text).map(|(_, token)| token).take(16).collect();
        let mut four = words.windows(4);
        four.find(|four| four[..3] == ["@", name, "("]).map(|four| four[3])
    }
}

/// The words and signs of a text without comments, each with its line.
#[derive(Debug)]
pub(super) struct Tokens<'a> {
    rest: &'a str,
    line: u32,
}

pub(super) const fn tokens(text: &str) -> Tokens<'_> {
    Tokens { rest: text, line: 1 }
}

impl<'a> Iterator for Tokens<'a> {
    type Item = (u32, &'a str);

    fn next(&mut self) -> Option<Self::Item> {
        loop {
            let first = self.rest.chars().next()?;
            let length = match first {
                '/' if self.rest.starts_with("//") => until(self.rest, |c| c == '\n'),
                '/' if self.rest.starts_with("/*") => block_comment(self.rest),
                c if is_in_word(c) => until(self.rest, |c| !is_in_word(c)),
                c => c.len_utf8(),
            };
            let (token, rest) = self.rest.split_at(length);
            let line = self.line;
            self.rest = rest;
            self.line += u32::try_from(token.matches('\n').count()).unwrap_or(0);
            let is_comment = token.starts_with("//") || token.starts_with("/*");
            if !is_comment && !first.is_whitespace() {
                return Some((line, token));
            }
        }
    }
}

pub(super) fn is_in_word(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// The bytes before the first such character.
fn until(text: &str, is_end: impl Fn(char) -> bool) -> usize {
    text.find(is_end).unwrap_or(text.len())
}

/// The bytes of the comment that a text begins with; comments nest.
fn block_comment(text: &str) -> usize {
    let (mut at, mut depth) = (2, 1);
    while depth > 0 {
        let (open, close) = (text[at..].find("/*"), text[at..].find("*/"));
        match (open, close) {
            (Some(open), Some(close)) if open < close => (at, depth) = (at + open + 2, depth + 1),
            (_, Some(close)) => (at, depth) = (at + close + 2, depth - 1),
            (_, None) => return text.len(),
        }
    }
    at
}

/// The declarations of a text, in order. Directives and assertions have no name.
pub(super) fn declarations(text: &str) -> Vec<Declaration<'_>> {
    let mut all = Vec::new();
    let (mut depth, mut is_fragment, mut previous) = (0_u32, false, "");
    let (mut begin, mut open) = (0, None);
    let mut tokens = tokens(text);
    while let Some((line, token)) = tokens.next() {
        match token {
            "{" => depth += 1,
            "}" => depth = depth.saturating_sub(1),
            "fragment" if previous == "@" => is_fragment = true,
            "fn" | "const" | "override" | "alias" | "struct" | "var"
                if depth == 0 && open.is_none() =>
            {
                let mut name = tokens.next();
                if name.is_some_and(|(_, word)| word == "<") {
                    tokens.find(|&(_, word)| word == ">");
                    name = tokens.next();
                }
                open = name.map(|(line, name)| (line, name, token));
            }
            _ => {}
        }
        if depth == 0 && [";", "}"].contains(&token) || tokens.rest.is_empty() {
            let end = text.len() - tokens.rest.len();
            let (line, name, keyword) = open.take().unwrap_or((line, "", ""));
            all.push(Declaration { name, line, keyword, is_fragment, text: &text[begin..end] });
            (begin, is_fragment) = (end, false);
        }
        previous = token;
    }
    all
}

/// The declarations that the functions `entries` use, and those without a name, in the order of the
/// text. A name that a local variable hides also counts as used.
pub(super) fn reached<'a>(all: &[Declaration<'a>], entries: &[&'a str]) -> Vec<Declaration<'a>> {
    let mut is_reached = vec![false; all.len()];
    let mut names = [entries, &[""]].concat();
    while let Some(name) = names.pop() {
        for (one, is_reached) in all.iter().zip(&mut is_reached) {
            if one.name == name && !*is_reached {
                *is_reached = true;
                names.extend(tokens(one.text).map(|(_, token)| token));
            }
        }
    }
    all.iter().zip(is_reached).filter(|one| one.1).map(|one| *one.0).collect()
}

/// The built-in types that the stage's text names. It uses no built-in aliases, such as `vec4f`.
const TYPES: &str = "array atomic bitcast bool f32 i32 mat4x4 ptr texture_2d u32 vec2 vec3 vec4";

/// The user's first declaration of a built-in name that the stage's text uses. The stage's text
/// would mean the user's declaration instead.
pub(super) fn shadowed<'a>(user: &'a str, own: &str) -> Option<Declaration<'a>> {
    let declared: Vec<&str> = declarations(own).into_iter().map(|one| one.name).collect();
    let words: Vec<&str> = tokens(own).map(|(_, token)| token).collect();
    let is_used = |name: &str| {
        TYPES.split(' ').any(|own| own == name) && words.contains(&name)
            || words.windows(3).any(|w| w[0] != "@" && w[1] == name && w[2] == "(")
    };
    declarations(user).into_iter().find(|one| {
        let is_the_users = ["hull", "domain", "Vertex"].contains(&one.name);
        !is_the_users && !declared.contains(&one.name) && is_used(one.name)
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn declarations_are_found_with_their_lines() {
        let text = "// fn no() {}\n/* fn no() {} /* nested */ fn no() {} */ const a = 1u;\n\
                    @group(0) @binding(0) var<storage, read_write> b: array<u32>;\nvar<private> c: f32;\n\
                    struct D { e: f32 }\nalias F = vec4<f32>; override g: f32;\n\
                    @must_use fn h(i: u32) -> f32 {\n    const j = 1; var k = 2; return f32(i);\n}\n\
                    @fragment\nfn l() -> @location(0) vec4f { return vec4f(); }\n\
                    @compute @workgroup_size(1) fn m() {}\nconst_assert true;";
        let all = declarations(text);
        let named = all.iter().filter(|one| !one.name.is_empty());
        let found: Vec<_> = named.map(|one| (one.name, one.line)).collect();
        let expected = [
            ("a", 2),
            ("b", 3),
            ("c", 4),
            ("D", 5),
            ("F", 6),
            ("g", 6),
            ("h", 7),
            ("l", 11),
            ("m", 12),
        ];
        assert_eq!(found, expected, "and no others");
        let fragments: Vec<_> = all.iter().filter(|one| one.is_fragment).collect();
        assert_eq!(fragments.len(), 1, "{fragments:?}");
        let whole: String = all.iter().map(|one| one.text).collect();
        assert_eq!(whole, text, "nothing is in no declaration");
        assert_eq!(declarations("/* fn a() {} "), [], "a comment without an end");
        let apart = declarations("/* a */ fn /* ! */ a() {} /* b */ const c = fragment; fn b() {}");
        let found: Vec<_> = apart.iter().map(|one| (one.name, one.is_fragment)).collect();
        assert_eq!(found, [("a", false), ("c", false), ("b", false)], "between comments");
    }

    #[test]
    fn a_function_reaches_what_it_names() {
        let text = "enable f16;\n@group(2) @binding(0) var<uniform> a: A;\nstruct A { b: B }\nalias B = f32;\n\
                    @id(7) override c: u32;\nfn d() -> u32 { return c + e(); }\nfn e() -> u32 { return 1u; }\n\
                    fn hull(n: u32) -> f32 { return a.b; }\n@fragment fn f() { let x = d(); }";
        let all = declarations(text);
        let of = |entry| reached(&all, &[entry]).iter().map(|one| one.name).collect::<Vec<_>>();
        assert_eq!(of("hull"), ["", "a", "A", "B", "hull"]);
        assert_eq!(of("f"), ["", "c", "d", "e", "f"]);
        assert_eq!(of("g"), [""], "nothing of this name");
        let attribute = |at: usize, name| all[at].attribute(name);
        assert_eq!(
            [attribute(1, "group"), attribute(4, "id"), attribute(5, "id")],
            [Some("2"), Some("7"), None]
        );
        assert_eq!(
            all.iter().map(Declaration::has_no_value).filter(|&none| none).count(),
            7,
            "all but two"
        );
    }

    #[test]
    fn names_that_the_stage_uses_are_shadowed() {
        let own = "fn tess_f(at: u32) -> f32 { let place = at; return max(f32(at), helper(1.0)); }\n\
                   fn helper(x: f32) -> f32 { return x; }\n@group(0) @binding(0) var<uniform> y: f32;";
        for (user, expected) in [
            ("fn max(a: f32) {}", Some("max")),
            ("const max = 1;", Some("max")),
            ("alias f32 = u32;", Some("f32")),
            ("fn min(a: f32) {}", None),
            ("fn place(a: f32) {} fn at() {} fn group() {} fn helper() {}", None),
            ("fn hull() { let max = 1; }", None),
        ] {
            assert_eq!(shadowed(user, own).map(|one| one.name), expected, "{user}");
        }
    }
}
