//! Coverage as a file: UCIS XML (Accellera's Unified Coverage Interoperability Standard 1.0).
//!
//! A group is a coverpoint, and a bin is a bin of it. Apart from the hits, all files are the same,
//! so equal coverage gives equal bytes; the required date is a constant. The reader accepts only
//! what the writer writes: it compares line by line, and a file with other bins is an error.

use super::Coverage;
use crate::quote::quoted;
use std::fmt::Write;
use std::io::{self, Read};

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
/// The text before the hits of a bin.
const HITS: &str = "<contents coverageCount=\"";

impl Coverage {
    /// The coverage as UCIS XML, a format of verification tools. Equal coverage gives equal bytes.
    #[must_use]
    pub fn to_ucis(&self) -> String {
        let mut text = format!("{HEAD}\n");
        let mut of_group = "";
        let mut number = 0;
        // Writing to a String does not fail.
        for (bin, hits) in self.bins() {
            let (group, name) = bin.split_once('/').unwrap_or((bin, bin));
            if group != of_group {
                let end = if of_group.is_empty() { "" } else { "</coverpoint>\n" };
                _ = writeln!(text, "{end}<coverpoint name=\"{group}\" key=\"0\">\n<options/>");
                (of_group, number) = (group, 0);
            }
            _ = writeln!(
                text,
                r#"<coverpointBin name="{name}" type="bins" key="0"><range from="{number}" to="{number}">{HITS}{hits}"/></range></coverpointBin>"#
            );
            number += 1;
        }
        text + "</coverpoint>\n" + TAIL + "\n"
    }

    /// Reads the output of [`Coverage::to_ucis`]. It stops at a bound; a file that goes on beyond
    /// it is an error.
    ///
    /// # Errors
    /// Those of the reader; [`io::ErrorKind::InvalidData`], with the line, for any other text and
    /// for files of a version with other bins.
    pub fn read_ucis(reader: impl Read) -> io::Result<Self> {
        let mut bytes = Vec::new();
        reader.take(MOST_BYTES).read_to_end(&mut bytes)?;
        let text = String::from_utf8_lossy(&bytes);
        read(&text).map_err(|error| io::Error::new(io::ErrorKind::InvalidData, error))
    }
}

/// A bound above the size of any correct file: a longer one has its fault before this.
const MOST_BYTES: u64 = 1 << 21;

/// Reads a file by comparing it with a file without hits, except for the numbers.
fn read(text: &str) -> Result<Coverage, String> {
    const NONE: &str = "not a coverage file of tess with the bins of this version";
    let mut coverage = Coverage::default();
    let (empty, none) = (coverage.to_ucis(), coverage.clone());
    let (mut bins, mut found) = (none.bins(), text.lines());
    let mut line = 0;
    for expected in empty.lines() {
        line += 1;
        let error = |expected: String| format!("line {line}: {NONE}: {expected}");
        let Some(text) = found.next() else {
            return Err(error("the file ends early; it is truncated".into()));
        };
        let Some((before, after)) = expected.split_once(HITS) else {
            if expected != text {
                return Err(error(format!("expected {}, not {}", quoted(expected), quoted(text))));
            }
            continue;
        };
        let bin = bins.next().map_or("", |(bin, _)| bin);
        let hits = text.strip_prefix(before).and_then(|rest| rest.strip_prefix(HITS));
        let hits = hits.and_then(|rest| rest.strip_suffix(&after[1..]));
        let digits = hits.filter(|hits| hits.bytes().all(|byte| byte.is_ascii_digit()));
        let Some(hits) = digits.and_then(|hits| hits.parse().ok()) else {
            let expected = format!("expected the hits of the bin {bin}, not {}", quoted(text));
            return Err(error(expected));
        };
        coverage.add(bin, hits);
    }
    match found.next() {
        None => Ok(coverage),
        Some(text) => {
            let text = quoted(text);
            Err(format!("line {}: {NONE}: expected the end of the file, not {text}", line + 1))
        }
    }
}

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

    /// A file with the largest hits is within the bound, and an endless one is read only up to it.
    #[test]
    fn files_are_bounded() {
        let mut full = Coverage::default();
        let bins: Vec<String> = full.bins().map(|(bin, _)| bin.to_owned()).collect();
        bins.iter().for_each(|bin| assert!(full.add(bin, u64::MAX), "{bin}"));
        let text = full.to_ucis();
        assert!((text.len() as u64) < MOST_BYTES, "{} bytes", text.len());
        assert_eq!(Coverage::read_ucis(text.as_bytes()).expect("it is right"), full);
        let endless =
            Coverage::read_ucis(text.as_bytes().chain(io::repeat(b'x'))).expect_err("too long");
        assert!(endless.to_string().contains("expected the end of the file"), "{endless}");
        let wrong = Coverage::read_ucis(io::repeat(0xFF)).expect_err("no text");
        assert_eq!(wrong.kind(), io::ErrorKind::InvalidData, "{wrong}");
    }

    #[test]
    fn files_round_trip() {
        for coverage in [Coverage::default(), some(1)] {
            assert_eq!(read(&coverage.to_ucis()), Ok(coverage), "the same hits");
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
        let text = some(1).to_ucis();
        let refused = |text: &str| read(text).expect_err("another file");
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

    /// Each group is one coverpoint, whose bins are numbered from 0.
    #[test]
    fn bins_are_numbered_within_their_coverpoint() {
        let text = Coverage::default().to_ucis();
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
        assert!(error.starts_with(&format!("line {}: ", text.lines().count() + 1)), "{error}");
    }
}
