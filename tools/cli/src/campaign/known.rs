//! The `--known` option: known differences, such as documented deviations of a device.

use super::Placed;
use super::invocation::digest;
use super::recorder::Recorder;
use super::report::{First, KnownCases, ReportPart};
use crate::failure::{Exit, Failure};
use crate::input;
use crate::output::{Role, counted, note};
use std::path::PathBuf;
use std::sync::Arc;
use std::time::{SystemTime, UNIX_EPOCH};
use tess_verify::check::{Known, KnownOutcome};
use tess_verify::generate::Shard;
use tess_verify::rules::Specification;

/// The `--known` option.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct KnownArgs {
    /// Known differences: lines that begin with `case` or `rule`, or a vector file as --failures
    /// writes it
    ///
    /// They are counted as known, not as mismatches. A case or rule may be followed by ` |
    /// EXPECTED | OWNER | UNTIL | REASON` (docs/campaigns.md): a line that has expired or is not
    /// met gives exit code 1. Cases without these terms that no longer differ are named on stderr.
    /// A file with only a header or only remarks is a baseline of nothing; an empty file is
    /// refused.
    #[arg(long, value_name = "FILE")]
    known: Option<PathBuf>,
}

/// The known differences, and the file from which they were read.
#[derive(Debug, Default)]
pub(crate) struct Baseline {
    pub(crate) known: Arc<Known>,
    /// The report's entry about the file, before anything has been compared.
    file: Option<KnownCases>,
}

impl KnownArgs {
    /// The file of the option.
    pub(crate) fn role(&self) -> Option<Role<'_>> {
        self.known.as_deref().map(|path| Role::input("--known", path))
    }

    /// Refuses a baseline that is the file under test itself. Errors: it is that file.
    pub(crate) fn refuse_judged(&self, what: &str, judged: &Role<'_>) -> Result<(), Failure> {
        if self.role().is_some_and(|known| known.is_same_file(judged)) {
            let message = format!("--known is {what} itself: every difference would be known");
            return Err(Failure::bad_input(message));
        }
        Ok(())
    }

    /// Reads the baseline for a comparison, or for judging by rules; it is empty without the
    /// option.
    ///
    /// # Errors
    /// The file cannot be read or is malformed.
    pub(crate) fn read(&self, rules: Option<Specification>) -> Result<Baseline, Failure> {
        let Some(path) = &self.known else { return Ok(Baseline::default()) };
        if path.as_os_str() == "-" {
            return Err(Failure::bad_input("--known is kept from run to run: give a file"));
        }
        let reader = input::open(path).map_err(|error| Failure::file("read", path, &error))?;
        let known =
            Known::read(&input::name(path), reader, rules, &today()).map_err(Failure::bad_input)?;
        let mut lines: Vec<String> = known.lines().map(|line| line + "\n").collect();
        let entries = lines.len() as u64;
        // The digest is that of a set of lines: their order and remarks do not matter.
        lines.sort_unstable();
        let digest = Some(digest(lines.concat().as_bytes()));
        let file = Some(path.to_string_lossy().into_owned());
        let file = Some(KnownCases { file, digest, entries, ..KnownCases::default() });
        Ok(Baseline { known: Arc::new(known), file })
    }
}

#[expect(clippy::disallowed_methods, reason = "lines of a baseline end on a day")]
fn today() -> String {
    let since = SystemTime::now().duration_since(UNIX_EPOCH);
    date(since.map_or(0, |since| since.as_secs()) / 86_400)
}

/// The date of a day, counted from 1970-01-01, such as 2027-06-30.
fn date(day: u64) -> String {
    // Years begin in March here, so that the leap day is the last day of a year.
    let day = day + 719_468;
    let (era, day) = (day / 146_097, day % 146_097);
    let year = (day - day / 1460 + day / 36_524 - day / 146_096) / 365;
    let day = day - (365 * year + year / 4 - year / 100);
    let month = (5 * day + 2) / 153;
    let day = day - (153 * month + 2) / 5 + 1;
    let (next, month) = if month < 10 { (0, month + 3) } else { (1, month - 9) };
    format!("{:04}-{month:02}-{day:02}", 400 * era + year + next)
}

impl Baseline {
    /// Adds the baseline to the report, so that the report of a run that ends early names it too.
    pub(crate) fn note(&self, recorder: &Recorder) {
        recorder.update(|report| report.known.clone_from(&self.file));
    }

    /// Adds the outcome of the baseline to the report of a run that was complete. An expired or
    /// unmet line counts as a difference.
    pub(crate) fn conclude(&self, recorder: &Recorder, placed: Placed, exit: Exit) -> Exit {
        let KnownOutcome { met, gone, faults, .. } =
            self.known.outcome(placed.shard == Shard::WHOLE);
        if !gone.is_empty() {
            let lines: String = gone.iter().map(|line| format!("\n  {line}")).collect();
            let number = counted(gone.len() as u64, "case");
            note(&format!("no longer different, though known: {number}{lines}"));
        }
        faults.iter().for_each(|fault| note(fault));
        recorder.update(|report| {
            if let Some(known) = &mut report.known {
                (known.different, known.gone) = (met, gone);
            }
            if let Some(fault) = faults.first() {
                let number = faults.len() as u64;
                let first =
                    Some(First { case: None, difference: fault.clone(), ..First::default() });
                let name = "baseline".to_owned();
                report.add_part(ReportPart { name, cases: number, mismatches: number, first });
            }
        });
        if faults.is_empty() || exit != Exit::Done { exit } else { Exit::Different }
    }
}

#[cfg(test)]
mod tests {
    use super::date;

    /// Dates around leap days; 2100 has none.
    #[test]
    fn days_have_dates() {
        for (day, expected) in [
            (0, "1970-01-01"),
            (11_015, "2000-02-28"),
            (11_016, "2000-02-29"),
            (11_017, "2000-03-01"),
            (20_999, "2027-06-30"),
            (47_540, "2100-02-28"),
            (47_541, "2100-03-01"),
            (47_846, "2100-12-31"),
        ] {
            assert_eq!(date(day), expected, "day {day}");
        }
    }
}
