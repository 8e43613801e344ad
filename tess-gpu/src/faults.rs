//! The faults that tests plant in the shaders: a comparison counts only after it was seen to fail.

/// A line of `src/faults.txt` for each fault: its name, a colon and a space, and the wrong line.
const LIST: &str = include_str!("faults.txt");

/// A fault that a test plants in the shaders.
///
/// A line that ends with `// mark: NAME` is where the fault of that name goes; one line can have several marks, with
/// commas between them, and several lines one. So a test names a fault, and no text of a shader stands in a test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Fault {
    name: &'static str,
    line: &'static str,
}

impl Fault {
    /// Every fault of the list.
    pub fn all() -> impl Iterator<Item = Self> {
        LIST.lines().filter_map(|fault| {
            let (name, line) = fault.split_once(": ").or(fault.strip_suffix(':').zip(Some("")))?;
            Some(Self { name, line })
        })
    }

    /// The fault of this name.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::all().find(|fault| fault.name == name)
    }

    /// Its name.
    #[must_use]
    pub const fn name(self) -> &'static str {
        self.name
    }

    /// The shader with the wrong line instead of each marked one; `None` if no line has the mark.
    #[must_use]
    pub fn planted(self, source: &str) -> Option<String> {
        let is_marked = |line: &str| marks(line).any(|mark| mark == self.name);
        if !source.lines().any(is_marked) {
            return None;
        }
        let lines = source.lines().map(|line| if is_marked(line) { self.line } else { line });
        Some(lines.flat_map(|line| [line, "\n"]).collect())
    }
}

/// The marks of a line of a shader.
fn marks(line: &str) -> impl Iterator<Item = &str> {
    let names = line.split_once("// mark: ").map(|(_, names)| names);
    names.into_iter().flat_map(|names| names.split(", "))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::texts;
    use std::collections::BTreeSet;

    #[test]
    fn every_mark_has_a_fault_and_every_fault_a_mark() {
        let listed: BTreeSet<&str> = Fault::all().map(Fault::name).collect();
        assert_eq!(
            listed.len(),
            LIST.lines().count(),
            "each name stands once, each line is a fault"
        );
        let marked: BTreeSet<&str> =
            texts().flat_map(|text| text.lines().flat_map(marks)).collect();
        assert_eq!(marked, listed, "the marks of shaders/ and faults.txt");
    }

    #[test]
    fn faults_differ_from_what_they_replace() {
        for fault in Fault::all() {
            let marked =
                texts().flat_map(str::lines).filter(|line| marks(line).any(|it| it == fault.name));
            for line in marked {
                let code = line.split(" // mark: ").next().unwrap_or_default().trim();
                assert_ne!(code, fault.line, "{}", fault.name);
            }
        }
    }

    #[test]
    fn a_fault_replaces_its_lines_alone() {
        let fault = Fault::named("has_key").expect("it is listed");
        let source = "a\n    b // mark: other, has_key\nc\n";
        assert_eq!(fault.planted(source), Some(format!("a\n{}\nc\n", fault.line)), "one line");
        assert_eq!(fault.planted("a\nb // mark: has_keys\n"), None, "no mark");
    }
}
