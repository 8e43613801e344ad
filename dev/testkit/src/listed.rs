//! Lists of faults: a text of a source, and a wrong text to put in its place.
//!
//! ```text
//! in tess-gpu/shaders                        the folder of the sources, or a file
//! seen by tess-wgpu/tests/batches exact::    a file of tests, and words that select some of them
//!
//! fault half factors are rounded down
//! equivalent: REASON                         only where no test can see the fault
//! <<<
//! (factor + 1u) >> 1u
//! ===
//! factor >> 1u
//! >>>
//! ```
//!
//! `in` and `seen by` apply until the next one, and a `seen by` has at least one fault. With
//! `planted by` in its place, these tests plant the faults themselves, on every run; the others are
//! planted by `cargo xtask mutants planted` or, in the circuit, by its benches. Both texts may have
//! several lines, and the new one may be empty. A line that starts with `#` is a comment.

/// A fault of a list.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct ListedFault {
    /// Its name.
    pub name: String,
    /// The folder of the source, or the source itself, from the root of the repository.
    pub folder: String,
    /// The file of the tests that must see it.
    pub tests: String,
    /// Words that select some of these tests; without words, all of them.
    pub filters: Vec<String>,
    /// Whether these tests plant it themselves.
    pub is_planted_by_tests: bool,
    /// The reason why no test can see it.
    pub equivalent: Option<String>,
    /// The text of the source.
    pub right: String,
    /// The text in its place.
    pub wrong: String,
}

impl ListedFault {
    /// The number of times that the text occurs in `source`.
    #[must_use]
    pub fn places(&self, source: &str) -> usize {
        source.matches(&self.right).count()
    }

    /// `source` with the fault wherever the text occurs; `None` if it does not occur.
    #[must_use]
    pub fn planted(&self, source: &str) -> Option<String> {
        source.contains(&self.right).then(|| source.replace(&self.right, &self.wrong))
    }
}

/// The faults of a list.
///
/// # Errors
/// The number of the first line that does not have the form.
pub fn parse(list: &str) -> Result<Vec<ListedFault>, String> {
    let (mut folder, mut seen_by, mut faults) = (None, None, Vec::new());
    // The line of a `seen by` that has no fault yet.
    let mut unused = None;
    let is_used = |unused: Option<u32>| {
        unused.map_or(Ok(()), |line| Err(format!("line {line}: no fault follows it")))
    };
    let mut lines = (1..).zip(list.lines()).peekable();
    while let Some((number, line)) = lines.next() {
        let wrong = |what: &str| format!("line {number}: {what}");
        if let Some(path) = line.strip_prefix("in ") {
            folder = Some(path.to_owned());
        } else if let Some((words, is_planted_by_tests)) = tests_of(line) {
            is_used(unused.replace(number))?;
            let mut words = words.split(' ').map(str::to_owned);
            let tests = words.next();
            seen_by = tests.map(|tests| (tests, words.collect::<Vec<_>>(), is_planted_by_tests));
        } else if let Some(fault) = line.strip_prefix("fault ") {
            unused = None;
            let reason = lines.next_if(|(_, line)| line.starts_with("equivalent: "));
            let block = lines.by_ref().map(|(_, line)| line);
            let (right, new) =
                texts(block).ok_or(wrong("`fault` goes on with `<<<`, `===`, `>>>`"))?;
            let (tests, filters, is_planted_by_tests) =
                seen_by.clone().ok_or(wrong("no `seen by` or `planted by` before it"))?;
            faults.push(ListedFault {
                name: fault.to_owned(),
                folder: folder.clone().ok_or(wrong("no `in` before it"))?,
                tests,
                filters,
                is_planted_by_tests,
                equivalent: reason.map(|(_, line)| line["equivalent: ".len()..].to_owned()),
                right,
                wrong: new,
            });
        } else if !line.is_empty() && !line.starts_with('#') {
            return Err(wrong(&format!(
                "`{line}` is none of `in`, `seen by`, `planted by`, `fault`"
            )));
        }
    }
    is_used(unused).map(|()| faults)
}

/// The tests that a line names, and whether they plant the faults themselves.
fn tests_of(line: &str) -> Option<(&str, bool)> {
    let seen = line.strip_prefix("seen by ").map(|words| (words, false));
    seen.or_else(|| line.strip_prefix("planted by ").map(|words| (words, true)))
}

/// The two texts of a block, which ends with `>>>`.
fn texts<'a>(mut lines: impl Iterator<Item = &'a str>) -> Option<(String, String)> {
    lines.next().filter(|line| *line == "<<<")?;
    let block: Vec<&str> = lines.take_while(|line| *line != ">>>").collect();
    let middle = block.iter().position(|line| *line == "===")?;
    Some((block[..middle].join("\n"), block[middle + 1..].join("\n")))
}
