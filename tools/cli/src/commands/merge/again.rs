//! The commands that run shards again.
//!
//! The command lines of a campaign are one line with a number in it. `Pattern` finds where that number stands, from
//! the lines that are there, and tries it on all of them: it must give each report's line for that report's
//! shard. Then it gives the line of any other shard too. One line alone does not show its number: a 1 in it may be
//! the shard's or the level's. Then there is no pattern, as a wrong line would replace the file of another shard.

use crate::campaign::report::Report;

/// How many reports are tried as the line to change: the first may have a number with more digits than others.
const TRIED: usize = 4;

/// A command line, and what its numbers count.
pub(super) struct Pattern<'a> {
    sample: &'a Report,
    /// The places of the words that have the shard in them.
    numbered: Vec<usize>,
    /// The shard minus the number in the words: 1 where they are counted from 0.
    less: u64,
}

impl<'a> Pattern<'a> {
    /// The pattern of these reports' lines; `None` if they are too few, or have none.
    pub(super) fn of(reports: &[&'a Report]) -> Option<Self> {
        let [first, others @ ..] = reports else { return None };
        if others.iter().all(|other| other.shard == first.shard) {
            return None;
        }
        let differs =
            |at: &usize| others.iter().any(|one| one.words.get(*at) != first.words.get(*at));
        let numbered: Vec<usize> = (0..first.words.len()).filter(differs).collect();
        let tried = reports.iter().take(TRIED).flat_map(|sample| [(*sample, 0), (*sample, 1)]);
        for (sample, less) in tried {
            let pattern = Pattern { sample, numbered: numbered.clone(), less };
            if reports.iter().all(|report| pattern.words(report.shard) == report.words) {
                return Some(pattern);
            }
        }
        None
    }

    /// The command of a shard, for a shell.
    pub(super) fn command(&self, shard: u64) -> String {
        command(self.words(shard), shard, self.sample.shards)
    }

    fn words(&self, shard: u64) -> Vec<String> {
        let (from, of) = (self.sample.shard, self.sample.shards);
        let word = |(at, word): (usize, &String)| {
            let old = format!("{from}/{of}");
            match word.strip_suffix(&old) {
                Some(before) if before.is_empty() || before == "--shard=" => {
                    format!("{before}{shard}/{of}")
                }
                _ if self.numbered.contains(&at) => {
                    renumbered(word, from - self.less, shard - self.less)
                }
                _ => word.clone(),
            }
        };
        self.sample.words.iter().enumerate().map(word).collect()
    }
}

/// The command that a report is of, for a shell.
pub(super) fn command_of(report: &Report) -> String {
    command(report.words.clone(), report.shard, report.shards)
}

/// Words for a shell, with the shard if they do not have it.
fn command(mut words: Vec<String>, shard: u64, of: u64) -> String {
    // Behind `--` stand files alone.
    let end = words.iter().position(|word| word == "--").unwrap_or(words.len());
    let options = &words[..end];
    if !options.iter().any(|word| word == "--shard" || word.starts_with("--shard=")) {
        words.splice(end..end, ["--shard".to_owned(), format!("{shard}/{of}")]);
    }
    let line = words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ");
    let reads_stdin = words.iter().skip(1).any(|word| word == "-");
    let pipe = format!("  # with the input of shard {shard} on stdin");
    line + if reads_stdin { &pipe } else { "" }
}

/// The word with every number `from` made `to`; a number with zeros in front keeps its width.
fn renumbered(word: &str, from: u64, to: u64) -> String {
    let mut new = String::new();
    let mut rest = word;
    while let Some(begin) = rest.find(|c: char| c.is_ascii_digit()) {
        let digits = &rest[begin..];
        let end = digits.find(|c: char| !c.is_ascii_digit()).unwrap_or(digits.len());
        let (number, after) = digits.split_at(end);
        new.push_str(&rest[..begin]);
        if number.parse() == Ok(from) {
            let width = if number.starts_with('0') { number.len() } else { 0 };
            new.push_str(&format!("{to:0width$}"));
        } else {
            new.push_str(number);
        }
        rest = after;
    }
    new + rest
}

/// A word as a shell takes it.
pub(super) fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "_-./,:=+@%".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn report(shard: u64, shards: u64, line: &str) -> Report {
        let words = line.split(' ').map(str::to_owned).collect();
        Report { words, shard, shards, ..Report::default() }
    }

    fn command(shard: u64, reports: &[Report]) -> Option<String> {
        let reports: Vec<&Report> = reports.iter().collect();
        Pattern::of(&reports).map(|pattern| pattern.command(shard))
    }

    /// The number of one line may be anything's, as may one that does not fit all lines.
    #[test]
    fn what_is_not_certain_is_not_guessed() {
        for lines in [
            &[(3, "tess gen --level 3 --shard 3/8 -o v3.csv --report r-3.jsonl")][..],
            &[(1, "tess check level1/d.txt --report r1.jsonl")],
            &[(1, "tess verify --report r"), (1, "tess verify --report s")],
            &[(1, "tess verify --report r007"), (3, "tess verify --report r009")],
        ] {
            let reports: Vec<Report> = lines.iter().map(|(i, line)| report(*i, 8, line)).collect();
            assert_eq!(command(5, &reports), None, "{lines:?}");
        }
    }

    #[test]
    fn the_line_of_another_shard() {
        for (lines, shard, expected) in [
            (
                vec![
                    (3, "tess gen --level 3 --shard 3/8 -o v3.csv --report r-3.jsonl"),
                    (1, "tess gen --level 3 --shard 1/8 -o v1.csv --report r-1.jsonl"),
                ],
                5,
                "tess gen --level 3 --shard 5/8 -o v5.csv --report r-5.jsonl",
            ),
            (
                vec![
                    (1, "tess check --report r1.jsonl -- level1/d1.txt"),
                    (2, "tess check --report r2.jsonl -- level1/d2.txt"),
                ],
                3,
                "tess check --report r3.jsonl --shard 3/8 -- level1/d3.txt",
            ),
            (
                vec![
                    (8, "tess gen --shard=8/8 --report r-8-of-8"),
                    (2, "tess gen --shard=2/8 --report r-2-of-8"),
                ],
                5,
                "tess gen --shard=5/8 --report r-5-of-8",
            ),
            (
                vec![
                    (1, "tess verify --report out/r000.jsonl"),
                    (4, "tess verify --report out/r003.jsonl"),
                ],
                2,
                "tess verify --report out/r001.jsonl --shard 2/8",
            ),
            (
                vec![
                    (1, "tess check - --report a'1.jsonl"),
                    (4, "tess check - --report a'4.jsonl"),
                ],
                2,
                r"tess check - --report 'a'\''2.jsonl' --shard 2/8  # with the input of shard 2 on stdin",
            ),
        ] {
            let reports: Vec<Report> = lines.iter().map(|(i, line)| report(*i, 8, line)).collect();
            assert_eq!(command(shard, &reports).as_deref(), Some(expected), "{lines:?}");
        }
    }

    #[test]
    fn numbers_in_words() {
        for (word, new) in [
            ("a12b2", "a12b15"),
            ("2", "15"),
            ("v002-2", "v015-15"),
            ("none", "none"),
            ("99999999999999999999", "99999999999999999999"),
        ] {
            assert_eq!(renumbered(word, 2, 15), new, "{word}");
        }
    }
}
