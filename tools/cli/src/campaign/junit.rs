//! `JUnit` XML, in the form that Jenkins, GitLab and similar tools read.

use super::report::{First, Report, ReportPart, RunState, period_text};
use std::fmt::Write;

/// A named group of test cases.
#[derive(Clone, Debug)]
pub(crate) struct JunitSuite {
    pub(crate) name: String,
    pub(crate) milliseconds: u64,
    pub(crate) tests: Vec<JunitCase>,
}

/// A test case. Its class and name stay the same from build to build, so that tools can show its
/// history.
#[derive(Clone, Debug)]
pub(crate) struct JunitCase {
    pub(crate) class: String,
    pub(crate) name: String,
    pub(crate) milliseconds: Option<u64>,
    pub(crate) outcome: Outcome,
}

/// The result of a test case; a fault comes as one line and in full.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) enum Outcome {
    Passed,
    /// Something differs.
    Failed(String, String),
    /// The test case could not be run.
    Error(String, String),
}

impl JunitSuite {
    /// A run as a suite: a test case for each part, and one for the run itself if it ended early.
    pub(crate) fn of_run(report: &Report) -> Self {
        let name = format!("tess {}", report.command);
        let class = name.replace(' ', ".");
        let shard = match report.shards {
            1 => String::new(),
            of => format!(" (shard {}/{of})", report.shard),
        };
        let test = |name: &str, outcome| JunitCase {
            class: class.clone(),
            name: format!("{name}{shard}"),
            milliseconds: None,
            outcome,
        };
        let outcome = |part: &ReportPart| {
            Outcome::of((part.mismatches, part.cases), part.first.as_ref(), report.period)
        };
        let mut tests: Vec<JunitCase> =
            report.parts.iter().map(|part| test(&part.name, outcome(part))).collect();
        if report.state != RunState::Done || tests.is_empty() {
            tests.push(test("run", of_end(report)));
        }
        Self { name, milliseconds: report.milliseconds, tests }
    }

    /// The suite as a document.
    pub(crate) fn to_xml(&self) -> String {
        let count =
            |is: fn(&Outcome) -> bool| self.tests.iter().filter(|test| is(&test.outcome)).count();
        let totals = format!(
            "tests=\"{}\" failures=\"{}\" errors=\"{}\" skipped=\"0\" time=\"{}\"",
            self.tests.len(),
            count(|outcome| matches!(outcome, Outcome::Failed(..))),
            count(|outcome| matches!(outcome, Outcome::Error(..))),
            seconds(self.milliseconds)
        );
        let name = escaped(&self.name);
        let mut text = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"tess\" {totals}>\n  \
             <testsuite name=\"{name}\" {totals}>\n"
        );
        self.tests.iter().for_each(|test| test.write(&mut text));
        text + "  </testsuite>\n</testsuites>\n"
    }
}

impl JunitCase {
    fn write(&self, text: &mut String) {
        let (class, name) = (escaped(&self.class), escaped(&self.name));
        let time = self.milliseconds.map(|time| format!(" time=\"{}\"", seconds(time)));
        let time = time.unwrap_or_default();
        let opening = format!("    <testcase classname=\"{class}\" name=\"{name}\"{time}");
        let (kind, message, full) = match &self.outcome {
            Outcome::Passed => return text.push_str(&(opening + "/>\n")),
            Outcome::Failed(message, full) => ("failure", message, full),
            Outcome::Error(message, full) => ("error", message, full),
        };
        let (message, full) = (escaped(message), escaped(full));
        // Writing to a String does not fail.
        _ = writeln!(
            text,
            "{opening}>\n      <{kind} message=\"{message}\" type=\"{kind}\">{full}</{kind}>\n    </testcase>"
        );
    }
}

impl Outcome {
    /// The outcome of a comparison with this many mismatches among this many cases. The full text
    /// has the first difference and the period of all.
    pub(crate) fn of(
        (mismatches, cases): (u64, u64),
        first: Option<&First>,
        period: Option<u64>,
    ) -> Self {
        if mismatches == 0 {
            return Self::Passed;
        }
        let first = first.map_or_else(
            || "none of the differences that the run kept is of this part".to_owned(),
            |first| format!("first: {}", first.text("\n")),
        );
        let full: Vec<_> = [first].into_iter().chain(period.map(period_text)).collect();
        Self::Failed(format!("{mismatches} of {cases} differ"), full.join("\n"))
    }
}

fn of_end(report: &Report) -> Outcome {
    let (state, usual) = match report.state {
        RunState::Done => return Outcome::Passed,
        RunState::Running => ("running", "it has not ended: it still runs, or was killed"),
        RunState::Interrupted => ("interrupted", "a signal ended it, or the reader of stdout left"),
        RunState::Failed => ("failed", "it does not say why"),
    };
    let message = report.message.clone().filter(|message| !message.is_empty());
    Outcome::Error(state.to_owned(), message.unwrap_or_else(|| usual.to_owned()))
}

/// Seconds in decimal, such as `1.050`.
pub(crate) fn seconds(milliseconds: u64) -> String {
    format!("{}.{:03}", milliseconds / 1000, milliseconds % 1000)
}

/// Text for an attribute or an element. Characters that XML 1.0 cannot represent become U+FFFD.
fn escaped(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => escaped.push_str("&amp;"),
            '<' => escaped.push_str("&lt;"),
            '>' => escaped.push_str("&gt;"),
            '"' => escaped.push_str("&quot;"),
            '\n' | '\t' => _ = write!(escaped, "&#{};", u32::from(c)),
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => escaped.push('\u{fffd}'),
            c => escaped.push(c),
        }
    }
    escaped
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_a_document() {
        let part = |name: &str, mismatches| ReportPart {
            name: name.into(),
            cases: 9,
            mismatches,
            first: None,
        };
        let parts = vec![part("level-1 simd", 0), part("a<b>&\"c\u{1}\"", 2)];
        let (command, message) = ("verify".to_owned(), Some("two\nlines".to_owned()));
        let run = Report { command, parts, message, shard: 3, shards: 8, ..Report::default() };
        let text = JunitSuite::of_run(&Report { milliseconds: 1050, ..run }).to_xml();
        let expected = "\
<?xml version=\"1.0\" encoding=\"UTF-8\"?>
<testsuites name=\"tess\" tests=\"3\" failures=\"1\" errors=\"1\" skipped=\"0\" time=\"1.050\">
  <testsuite name=\"tess verify\" tests=\"3\" failures=\"1\" errors=\"1\" skipped=\"0\" time=\"1.050\">
    <testcase classname=\"tess.verify\" name=\"level-1 simd (shard 3/8)\"/>
    <testcase classname=\"tess.verify\" name=\"a&lt;b&gt;&amp;&quot;c\u{fffd}&quot; (shard 3/8)\">
      <failure message=\"2 of 9 differ\" type=\"failure\">none of the differences that the run kept is of this part</failure>
    </testcase>
    <testcase classname=\"tess.verify\" name=\"run (shard 3/8)\">
      <error message=\"interrupted\" type=\"error\">two&#10;lines</error>
    </testcase>
  </testsuite>
</testsuites>
";
        assert_eq!(text, expected, "escaped, counted");
    }
}
