//! Coverage as a file: UCIS XML (Accellera's Unified Coverage Interoperability Standard 1.0).
//!
//! A group is a coverpoint, a bin a bin of it. Everything but the hits is the same in every file, so
//! that equal coverage gives equal bytes; the required date is a constant. The reader takes what the
//! writer writes and nothing else: it compares line by line, and a file with other bins is an error.

use super::Coverage;
use crate::quote::quoted;
use std::fmt::{self, Write};
use std::io::{self, Read};

/// A line of the file: the text around a bin's hits, or a whole line.
enum UcisLine<'a> {
    Fixed(String),
    Bin { bin: &'a str, before: String, after: &'static str },
}

const HEAD: &str = r#"<?xml version="1.0" encoding="UTF-8"?>
<UCIS ucisVersion="1.0" writtenBy="tess" writtenTime="2000-01-01T00:00:00">
<sourceFiles fileName="docs/specification.md" id="1"/>
<historyNodes historyNodeId="0" logicalName="tess" testStatus="true" date="2000-01-01T00:00:00" toolCategory="UCIS:Simulator" ucisVersion="1.0" vendorId="tess" vendorTool="tess" vendorToolVersion="1"/>
<instanceCoverages name="tess" key="0" instanceId="0" moduleName="tess">
<id file="1" line="1" inlineCount="1"/>
<covergroupCoverage>
<cgInstance name="specification" key="0">
<options/>
<cgId cgName="specification" moduleName="tess">
<cginstSourceId file="1" line="1" inlineCount="1"/>
<cgSourceId file="1" line="1" inlineCount="1"/>
</cgId>"#;
const TAIL: &str = "</cgInstance>\n</covergroupCoverage>\n</instanceCoverages>\n</UCIS>";
const AFTER_HITS: &str = r#""/></range></coverpointBin>"#;

fn lines<'a>(coverage: &'a Coverage) -> Vec<UcisLine<'a>> {
    let fixed =
        |text: &str| text.lines().map(|line| UcisLine::Fixed(line.into())).collect::<Vec<_>>();
    let mut lines = fixed(HEAD);
    let mut of_group: Option<(&'a str, usize)> = None;
    for (bin, _) in coverage.bins() {
        let (group, name) = bin.split_once('/').unwrap_or((bin, bin));
        let number = match of_group {
            Some((last, number)) if last == group => number + 1,
            last => {
                lines.extend(last.map(|_| UcisLine::Fixed("</coverpoint>".into())));
                lines.push(UcisLine::Fixed(format!(r#"<coverpoint name="{group}" key="0">"#)));
                lines.push(UcisLine::Fixed("<options/>".into()));
                0
            }
        };
        of_group = Some((group, number));
        let before = format!(
            r#"<coverpointBin name="{name}" type="bins" key="0"><range from="{number}" to="{number}"><contents coverageCount=""#
        );
        lines.push(UcisLine::Bin { bin, before, after: AFTER_HITS });
    }
    lines.push(UcisLine::Fixed("</coverpoint>".into()));
    lines.extend(fixed(TAIL));
    lines
}

/// The file.
pub(super) fn write(coverage: &Coverage) -> String {
    let mut text = String::new();
    for line in lines(coverage) {
        // Writing to a String does not fail.
        _ = match line {
            UcisLine::Fixed(line) => writeln!(text, "{line}"),
            UcisLine::Bin { bin, before, after } => {
                writeln!(text, "{before}{}{after}", coverage.hits(bin).unwrap_or(0))
            }
        };
    }
    text
}

/// More bytes than any file has.
const MOST_BYTES: u64 = 1 << 20;

/// Reads a file that [`write`] wrote. Of a longer one, which is wrong in its first [`MOST_BYTES`], the
/// rest is left.
pub(super) fn read_bounded(reader: impl Read) -> io::Result<Coverage> {
    let mut bytes = Vec::new();
    reader.take(MOST_BYTES).read_to_end(&mut bytes)?;
    let text = String::from_utf8_lossy(&bytes);
    read(&text).map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error))
}

/// Reads a file that [`write`] wrote.
fn read(text: &str) -> Result<Coverage, UcisError> {
    let mut coverage = Coverage::default();
    let empty = coverage.clone();
    let mut found = text.lines();
    let mut number = 0;
    for line in lines(&empty) {
        number += 1;
        let error = |expected: String| UcisError { line: number, expected };
        let Some(text) = found.next() else {
            return Err(error("the file goes on: it is truncated".into()));
        };
        match line {
            UcisLine::Fixed(line) if line == text => {}
            UcisLine::Fixed(line) => {
                return Err(error(format!("expected {}, not {}", quoted(&line), quoted(text))));
            }
            UcisLine::Bin { bin, before, after } => {
                let hits = text.strip_prefix(&before).and_then(|rest| rest.strip_suffix(after));
                let digits = hits.filter(|hits| hits.bytes().all(|byte| byte.is_ascii_digit()));
                let hits = digits.and_then(|hits| hits.parse().ok());
                coverage.add(
                    bin,
                    hits.ok_or_else(|| {
                        error(format!("expected the hits of the bin {bin}, not {}", quoted(text)))
                    })?,
                );
            }
        }
    }
    match found.next() {
        None => Ok(coverage),
        Some(text) => {
            let expected = format!("expected the end of the file, not {}", quoted(text));
            Err(UcisError { line: number + 1, expected })
        }
    }
}

/// A text is no coverage file of this program, or one of a version with other bins.
#[derive(Clone, Debug, PartialEq, Eq)]
struct UcisError {
    /// UcisLine, from 1.
    line: usize,
    /// What was expected there.
    expected: String,
}

impl fmt::Display for UcisError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { line, expected } = self;
        write!(f, "line {line}: no coverage file of tess with the bins of this version: {expected}")
    }
}

impl std::error::Error for UcisError {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{GenLevel, Selection};

    fn some(seed: u64) -> Coverage {
        let mut coverage = Coverage::default();
        let selection = Selection { random: Some(200), ..Selection::level(GenLevel::Three, seed) };
        coverage.record_stream(None, selection.cases());
        coverage
    }

    /// A file with the largest hits fits the bound, and what is endless ends there.
    #[test]
    fn files_are_bounded() {
        let mut full = Coverage::default();
        let bins: Vec<String> = full.bins().map(|(bin, _)| bin.to_owned()).collect();
        bins.iter().for_each(|bin| assert!(full.add(bin, u64::MAX), "{bin}"));
        let text = write(&full);
        assert!((text.len() as u64) < MOST_BYTES, "{} bytes", text.len());
        assert_eq!(read_bounded(text.as_bytes()).expect("it is right"), full);
        let endless = read_bounded(text.as_bytes().chain(io::repeat(b'x'))).expect_err("too long");
        assert!(endless.to_string().contains("expected the end of the file"), "{endless}");
        let wrong = read_bounded(io::repeat(0xFF)).expect_err("no text");
        assert_eq!(wrong.kind(), io::ErrorKind::InvalidData, "{wrong}");
    }

    #[test]
    fn files_round_trip() {
        for coverage in [Coverage::default(), some(1)] {
            assert_eq!(read(&write(&coverage)), Ok(coverage), "the same hits");
        }
    }

    #[test]
    fn shards_merge_to_the_whole() {
        let (mut one, other) = (some(1), some(2));
        let sum: Vec<u64> = one.bins().zip(other.bins()).map(|((_, a), (_, b))| a + b).collect();
        one.merge(&other);
        assert_eq!(one.bins().map(|(_, hits)| hits).collect::<Vec<_>>(), sum, "bin by bin");
    }

    #[test]
    fn other_files_are_refused() {
        let text = write(&some(1));
        let refused = |text: &str| read(text).expect_err("another file").to_string();
        assert!(refused("").starts_with("line 1: "), "empty");
        let cut = &text[..text.rfind("</UCIS>").expect("the end")];
        assert!(refused(cut).contains("truncated"), "{}", refused(cut));
        assert!(refused(&format!("{text}x")).contains("the end of the file"), "a tail");
        let other_bin = text.replace("\"quad/point\"", "\"quad/points\"");
        assert!(refused(&other_bin).contains("of the bin centre/quad/point, not"), "another bin");
        for hits in ["-1", "", "18446744073709551616", "1e3", "+1"] {
            let bin = "name=\"quad/point\" type=\"bins\" key=\"0\"><range from=\"0\" to=\"0\">\
                       <contents coverageCount=\"";
            let at = text.find(bin).expect("the bin") + bin.len();
            let end = at + text[at..].find('"').expect("a quote");
            let text = format!("{}{hits}{}", &text[..at], &text[end..]);
            assert!(refused(&text).contains("centre/quad/point"), "{hits}");
        }
    }

    /// The bins of a coverpoint are numbered from 0, and each group is one coverpoint.
    #[test]
    fn bins_are_numbered_within_their_coverpoint() {
        let text = write(&Coverage::default());
        let (mut next, mut coverpoints) = (0, 0);
        for line in text.lines() {
            if line.starts_with("<coverpoint ") {
                (next, coverpoints) = (0, coverpoints + 1);
            } else if line.starts_with("<coverpointBin ") {
                let range = format!("<range from=\"{next}\" to=\"{next}\">");
                assert!(line.contains(&range), "{line}");
                next += 1;
            }
        }
        assert_eq!(coverpoints, Coverage::default().groups().len());
        assert_eq!(text.matches("</coverpoint>").count(), coverpoints, "each ends");
        let error = read(&format!("{text}x")).expect_err("a tail");
        assert_eq!(error.line, text.lines().count() + 1, "{error}");
    }
}
