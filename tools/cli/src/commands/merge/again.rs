//! The commands that run shards again.
//!
//! The command lines of a campaign are one line with a number in it. `Pattern` finds where that number stands, from
//! the lines that are there, and tries it on all of them: it must give each report's line for that report's
//! shard. Then it gives the line of any other shard too.

use crate::campaign::report::Report;

/// How many reports are tried as the line to change.
const TRIED: usize = 16;

/// A command line, and what its numbers count.
pub(super) struct Pattern<'a> {
    sample: &'a Report,
    /// The places of the words that have the shard in them.
    numbered: Vec<usize>,
    /// What the numbers in the words are less than the shard: 1 where they are counted from 0.
    less: u64,
    /// Whether it gives the line of every report.
    is_proven: bool,
}

impl<'a> Pattern<'a> {
    /// The pattern of these reports' lines; `None` if there is no line.
    pub(super) fn of(reports: &[&'a Report]) -> Option<Self> {
        let first = *reports.first()?;
        let numbered: Vec<usize> = (0..first.words.len())
            .filter(|&at| match reports {
                [_] => is_place(&first.words, at),
                _ => reports.iter().any(|other| other.words.get(at) != first.words.get(at)),
            })
            .collect();
        let tried = reports.iter().take(TRIED).flat_map(|sample| [(*sample, 0), (*sample, 1)]);
        for (sample, less) in tried {
            let pattern = Pattern { sample, numbered: numbered.clone(), less, is_proven: true };
            let fits = |report: &&Report| pattern.words(report.shard) == report.words;
            let is_moved = pattern.words(sample.shard + 1) != sample.words;
            if reports.iter().all(fits) && (is_moved || numbered.is_empty()) {
                return Some(pattern);
            }
        }
        Some(Pattern { sample: first, numbered, less: 0, is_proven: false })
    }

    /// The command of a shard, for a shell.
    pub(super) fn command(&self, shard: u64) -> String {
        let of = self.sample.shards;
        let mut words = self.words(shard);
        if !words.iter().any(|word| word == "--shard" || word.starts_with("--shard=")) {
            words.extend(["--shard".to_owned(), format!("{shard}/{of}")]);
        }
        let line = words.iter().map(|word| quoted(word)).collect::<Vec<_>>().join(" ");
        let reads_stdin = self.sample.words.iter().skip(1).any(|word| word == "-");
        let pipe = if reads_stdin {
            format!("  # with the input of shard {shard} on stdin")
        } else {
            String::new()
        };
        let doubt = if self.is_proven { "" } else { "  # look at the names of its files first" };
        format!("{line}{pipe}{doubt}")
    }

    fn words(&self, shard: u64) -> Vec<String> {
        let (from, of) = (self.sample.shard, self.sample.shards);
        let word = |(at, word): (usize, &String)| {
            let old = format!("{from}/{of}");
            match word.strip_suffix(&old) {
                Some(before) if before.is_empty() || before == "--shard=" => {
                    format!("{before}{shard}/{of}")
                }
                _ if self.numbered.contains(&at) && from >= self.less => {
                    renumbered(word, from - self.less, shard - self.less)
                }
                _ => word.clone(),
            }
        };
        self.sample.words.iter().enumerate().map(word).collect()
    }
}

/// Whether a word is the file of an option that each shard has its own of.
fn is_place(words: &[String], at: usize) -> bool {
    const OPTIONS: [&str; 8] =
        ["--report", "--junit", "-o", "--out", "--coverage", "--failures", "--cases", "--picture"];
    let option = words[at].split_once('=').map(|(option, _)| option);
    let before = at.checked_sub(1).map(|before| words[before].as_str());
    let is_file =
        words.get(1).is_some_and(|command| command == "check") && !words[at].starts_with('-');
    is_file || [option, before].into_iter().flatten().any(|option| OPTIONS.contains(&option))
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
fn quoted(word: &str) -> String {
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

    fn command(shard: u64, reports: &[Report]) -> String {
        let reports: Vec<&Report> = reports.iter().collect();
        Pattern::of(&reports).expect("there are reports").command(shard)
    }

    #[test]
    fn the_line_of_another_shard() {
        for (lines, shard, expected) in [
            (
                vec![(3, "tess gen --level 3 --shard 3/8 -o v3.csv --report r-3.jsonl")],
                5,
                "tess gen --level 3 --shard 5/8 -o v5.csv --report r-5.jsonl",
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
                vec![(1, "tess verify --report r007"), (3, "tess verify --report r009")],
                2,
                "tess verify --report r007 --shard 2/8  # look at the names of its files first",
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
            assert_eq!(command(shard, &reports), expected, "{lines:?}");
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
