//! The cases that a file must answer: those of `--cases`, or those that the notes in the file's
//! first line describe.

use crate::campaign::Recorder;
use crate::campaign::cases::CaseSet;
use crate::input::Reader;
use crate::output::note;
use tess_verify::Case;
use tess_verify::check::{Checked, Report, SpecStage};
use tess_verify::generate::Shard;
use tess_verify::vectors::{Cases, Header, Record, VectorError};

/// The asked cases, in order. Each is added to the report of the run when it is its turn.
pub(super) type AskedCases<'a> = Box<dyn Iterator<Item = Result<Case, VectorError>> + Send + 'a>;

/// What says which cases were asked.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Source {
    /// `--cases`.
    Given,
    /// The notes in the first line of the file.
    Notes,
    /// Nothing: the records count by their own cases.
    Nothing,
}

/// The asked cases of a file, or `None` if nothing says which they are.
///
/// `given` are those of `--cases`, `header` is that of the file, which is this shard of a campaign.
pub(super) fn asked<'a>(
    given: Option<Cases<Reader>>,
    header: &Header,
    shard: Shard,
    recorder: &'a Recorder,
) -> (Option<AskedCases<'a>>, Source) {
    if !header.kind.has_cases() {
        return (None, Source::Nothing);
    }
    let described = given.as_ref().and_then(Cases::header).unwrap_or(header);
    let set = CaseSet::of_notes(&described.notes);
    let (cases, source) = match (given, &set) {
        (Some(given), _) => (Some(Box::new(given) as AskedCases<'a>), Source::Given),
        (None, Some(set)) => (of_notes(set, shard), Source::Notes),
        (None, None) => (None, Source::Nothing),
    };
    recorder.asks(set);
    match cases {
        Some(cases) => (Some(Box::new(cases.inspect(|case| recorder.saw(case)))), source),
        None => (None, Source::Nothing),
    }
}

/// The cases of a shard; `None` if this program cannot make them, which is said on stderr.
fn of_notes<'a>(set: &CaseSet, shard: Shard) -> Option<AskedCases<'a>> {
    let whole = set.cases().inspect_err(|why| {
        note(&format!("{why}, so the answers are not compared with what was asked; give --cases"));
    });
    let numbered = (0..).zip(whole.ok()?);
    Some(Box::new(numbered.filter(move |(i, _)| shard.has(*i)).map(|(_, case)| Ok(case))))
}

impl Source {
    /// Adds records to the report of the run by their own cases, if nothing else says which cases
    /// it accounts for.
    pub(super) fn see(self, checked: Checked<'_>, recorder: &Recorder) {
        if self == Self::Nothing {
            recorder.saw(checked.records.iter().filter_map(Record::case));
        }
    }

    /// Says on stderr that the notes of a file decide what was asked, if it has other answers.
    pub(super) fn explain(self, report: &Report) {
        let is_astray = |stage| stage == SpecStage::Answer;
        if self == Self::Notes && report.groups().iter().any(|group| is_astray(group.stage)) {
            note(
                "the notes in the file's first line say which cases were asked; give --cases if others were",
            );
        }
    }
}
