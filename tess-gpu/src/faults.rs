//! The faults that tests plant in the shaders: a comparison counts only after it was seen to fail.

/// A line of `src/faults.txt` for each fault: `NAME: RIGHT => WRONG`. A line of the shaders that is RIGHT, but for spaces
/// around it, becomes WRONG, which may be nothing.
const LIST: &str = include_str!("faults.txt");

/// A fault that a test plants in the shaders. A test names it, so that no text of a shader stands in a test.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Fault {
    name: &'static str,
    right: &'static str,
    wrong: &'static str,
}

impl Fault {
    /// Every fault of the list.
    pub fn all() -> impl Iterator<Item = Self> {
        LIST.lines().filter_map(|fault| {
            let (name, lines) = fault.split_once(": ")?;
            let (right, wrong) = lines.split_once(" =>")?;
            Some(Self { name, right, wrong: wrong.trim_start() })
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

    /// The shader with the wrong line instead of each right one; `None` if it has none.
    #[must_use]
    pub fn planted(self, source: &str) -> Option<String> {
        let is_right = |line: &str| line.trim() == self.right;
        if !source.lines().any(is_right) {
            return None;
        }
        let lines = source.lines().map(|line| if is_right(line) { self.wrong } else { line });
        Some(lines.flat_map(|line| [line, "\n"]).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shaders::texts;
    use std::collections::BTreeSet;

    #[test]
    fn every_line_is_a_fault_and_every_fault_has_its_place() {
        let names: BTreeSet<&str> = Fault::all().map(Fault::name).collect();
        assert_eq!(
            names.len(),
            LIST.lines().count(),
            "each name stands once, each line is a fault"
        );
        for fault in Fault::all() {
            assert_ne!(fault.right, fault.wrong, "{}", fault.name);
            let in_file =
                |text: &str| text.lines().filter(|line| line.trim() == fault.right).count();
            let most = texts().map(in_file).max();
            assert_eq!(most, Some(1), "{}: one line of a file is `{}`", fault.name, fault.right);
        }
    }

    #[test]
    fn a_fault_replaces_its_lines_alone() {
        let fault = Fault { name: "b", right: "b;", wrong: "c;" };
        assert_eq!(fault.planted("a\n    b;\nbb;\n").as_deref(), Some("a\nc;\nbb;\n"), "one line");
        assert_eq!(fault.planted("a\nbb;\n"), None, "no such line");
    }
}
