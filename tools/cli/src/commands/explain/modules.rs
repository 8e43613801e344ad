//! The modules of a circuit, from the file of `--signals`.

use crate::failure::Failure;
use crate::input;
use std::path::Path;
use tess_show::{Part, Signal};

/// The most bytes of a list; a row has some fifty.
const MAX_BYTES: u64 = 1 << 20;

/// A part of each kind, with the word that the first column has for it.
const PARTS: [(&str, Part); 4] = [
    ("patch", Part::Patch),
    ("factor", Part::Factor(0)),
    ("point", Part::Point(0)),
    ("primitive", Part::Primitive(0)),
];

/// The module that drives each signal of a circuit.
#[derive(Debug)]
pub(super) struct Modules(Vec<Row>);

#[derive(Debug)]
struct Row {
    /// The first column: the kind of part that has the signal.
    part: &'static str,
    signal: Signal,
    module: String,
}

impl Modules {
    /// Reads a list: a row for each signal, with the columns part, stage, signal and module, which
    /// tabs separate. Lines that start with `#` are comments. Errors: a list that cannot be read; a
    /// row without these columns, of a signal that the model does not have, or of one that an
    /// earlier row has; no row at all.
    pub(super) fn read(path: &Path) -> Result<Self, Failure> {
        let text =
            input::text(path, MAX_BYTES).map_err(|error| Failure::file("read", path, &error))?;
        Self::parse(&text)
            .map_err(|error| Failure::bad_input(format!("--signals {}{error}", input::name(path))))
    }

    fn parse(text: &str) -> Result<Self, String> {
        let mut rows: Vec<Row> = Vec::new();
        for (number, line) in (1..).zip(text.lines()) {
            if line.trim().is_empty() || line.starts_with('#') {
                continue;
            }
            let row = Row::parse(line).map_err(|error| format!(", line {number}: {error}"))?;
            if rows.iter().any(|earlier| (earlier.part, earlier.signal) == (row.part, row.signal)) {
                let Signal { stage, name, .. } = row.signal;
                return Err(format!(
                    ", line {number}: an earlier line has {name} of stage {stage}; remove one"
                ));
            }
            rows.push(row);
        }
        if rows.is_empty() { Err(" has no signal".to_owned()) } else { Ok(Self(rows)) }
    }

    /// The module that drives a signal of a part; `None` if the list does not have it.
    pub(super) fn of(&self, part: Part, signal: Signal) -> Option<&str> {
        let is_it = |row: &&Row| row.part == word(part) && row.signal == signal;
        self.0.iter().find(is_it).map(|row| row.module.as_str())
    }
}

/// The word for a part's kind.
const fn word(part: Part) -> &'static str {
    match part {
        Part::Factor(_) => "factor",
        Part::Point(_) => "point",
        Part::Primitive(_) => "primitive",
        _ => "patch",
    }
}

impl Row {
    fn parse(line: &str) -> Result<Self, String> {
        let columns: Vec<&str> = line.split('\t').map(str::trim).collect();
        let [part, stage, signal, module] = columns[..] else {
            return Err(format!(
                "{} columns, expected part, stage, signal and module, with tabs between them",
                columns.len()
            ));
        };
        if module.is_empty() {
            return Err("the last column is empty, expected the name of a module".to_owned());
        }
        let Some(&(part, of_part)) = PARTS.iter().find(|(word, _)| *word == part) else {
            return Err(format!(
                "there is no part `{part}`, expected one of: {}",
                PARTS.map(|(word, _)| word).join(", ")
            ));
        };
        let signals = of_part.signals();
        let found = signals.iter().find(|own| (own.stage, own.name) == (stage, signal));
        let signal = *found.ok_or_else(|| {
            let there: Vec<_> =
                signals.iter().map(|own| format!("{} {}", own.stage, own.name)).collect();
            format!(
                "a {part} has no signal `{stage} {signal}`, expected one of: {}",
                there.join(", ")
            )
        })?;
        Ok(Self { part, signal, module: module.to_owned() })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIST: &str =
        "# a comment\npoint\tpoints\tu\tcoordinates\n\npatch\tcounts\tpoints\tcounter\r\n";

    #[test]
    fn rows_are_found_by_their_part_and_signal() {
        let modules = Modules::parse(LIST).expect("a list");
        let of = |part: Part, number: usize| modules.of(part, part.signals()[number]);
        assert_eq!(of(Part::Point(7), 1), Some("coordinates"), "u of any point");
        assert_eq!(of(Part::Patch, 0), Some("counter"), "points of the patch");
        assert_eq!(of(Part::Point(7), 2), None, "v, which is not listed");
        assert_eq!(of(Part::Factor(0), 5), None, "points of a factor");
    }

    #[test]
    fn each_kind_of_part_has_its_word() {
        assert!(PARTS.iter().all(|&(own, part)| own == word(part)), "{PARTS:?}");
    }

    #[test]
    fn wrong_lists_are_refused() {
        for (row, expected) in [
            ("point\tpoints\tu", ", line 1: 3 columns, expected part, stage, signal and module"),
            ("point\tpoints\tu\t", ", line 1: the last column is empty"),
            ("edge\tpoints\tu\tm", "no part `edge`, expected one of: patch, factor"),
            (
                "point\tpoints\tw\tm",
                "a point has no signal `points w`, expected one of: points valid",
            ),
            ("patch\tpoints\tu\tm", "a patch has no signal `points u`"),
            (
                "point\tpoints\tu\tm\npoint\tpoints\tu\tn",
                ", line 2: an earlier line has u of stage points",
            ),
            ("# only a comment", " has no signal"),
            ("", " has no signal"),
        ] {
            let error = Modules::parse(row).expect_err(row);
            assert!(error.contains(expected), "{row}: {error}");
        }
    }
}
