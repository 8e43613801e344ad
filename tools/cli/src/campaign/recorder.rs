//! Writes the report of a run: `running` when it begins, and how it went when it ends.
//!
//! ```text
//! command line understood       files distinct and writable     run ends, or a signal ends it
//! |                             |                               |
//! nothing is touched before     r.jsonl says `running`          r.jsonl says `done`, `failed`, `interrupted`
//! ```
//!
//! Each is moved into its place when it is whole. So a report says `done` only if its run ended,
//! even if the process is killed; and while a run goes on, no earlier report is in its place.

use super::cases::{CaseSet, CaseSum};
use super::invocation::{Invocation, commit, executable};
use super::junit::JunitSuite;
use super::report::{FORMAT, Report, RunState};
use super::shard::Placed;
use crate::failure::{Exit, Failure};
use crate::output::ending::{self, Guard};
use crate::output::{self, OutputArgs, OutputFile, Role, Trusted};
use std::fmt::{self, Display};
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// The options that request a report.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct ReportArgs {
    /// Write a report of the run to this file: a line of JSON that `tess merge` reads
    ///
    /// It says `running` until the run ends, also when a signal ends it. An earlier report is
    /// replaced once the command line is understood; a file that is not a report is kept, and is
    /// an error. docs/campaigns.md explains the entries.
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// Write the result to this file as JUnit XML, for Jenkins and similar tools
    #[arg(long, value_name = "FILE")]
    junit: Option<PathBuf>,
}

impl ReportArgs {
    /// The files of the options.
    pub(crate) fn roles(&self) -> impl Iterator<Item = Role<'_>> {
        self.places().map(|(option, path)| Role::output(option, path))
    }

    fn places(&self) -> impl Iterator<Item = (&'static str, &Path)> {
        let places = [("--report", &self.report), ("--junit", &self.junit)];
        places.into_iter().filter_map(|(option, path)| Some((option, path.as_deref()?)))
    }

    /// Runs a command and records it from beginning to end. Call this once the command line is
    /// understood and its files are known to be distinct. `others` are the command's other outputs
    /// that are trusted.
    ///
    /// # Errors
    /// A place that cannot be written or has a file of another kind; then nothing is replaced.
    /// Those of the run, and a report that cannot be written.
    pub(crate) fn record(
        &self,
        invocation: &Invocation,
        others: &[Trusted<'_>],
        run: impl FnOnce(&Recorder) -> Result<Exit, Failure>,
    ) -> Result<Exit, Failure> {
        let recorder = self.begin(invocation, others)?;
        let ended = run(&recorder);
        recorder.finish(ended)
    }

    fn begin(&self, invocation: &Invocation, others: &[Trusted<'_>]) -> Result<Recorder, Failure> {
        for (option, path) in self.places() {
            if !OutputFile::would_be_file(path) {
                let message = format!(
                    "{option} {} is not a regular file; give the path of a file",
                    path.display()
                );
                return Err(Failure::bad_input(message));
            }
        }
        let own = self.report.as_deref().map(Trusted::report).into_iter();
        let own = own.chain(self.junit.as_deref().map(Trusted::junit));
        output::begin(&own.chain(others.iter().copied()).collect::<Vec<_>>())?;
        let files = self.clone();
        if self.places().next().is_none() {
            let live = Arc::new(Mutex::new(None));
            return Ok(Recorder { files, live, _guard: None });
        }
        let live = Live { report: begun(invocation), since: Instant::now() };
        self.write(&live.report)?;
        let (live, guard) = ending::guarded(|| {
            let live = Arc::new(Mutex::new(Some(live)));
            let (at_end, files) = (Arc::clone(&live), files.clone());
            let interrupted = move || {
                let live = lock(&at_end).take();
                live.into_iter().for_each(|live| files.interrupt(live));
            };
            Ok((live, Box::new(interrupted)))
        })
        .map_err(Failure::bad_input)?;
        Ok(Recorder { files, live, _guard: Some(guard) })
    }

    /// Each file with its content.
    fn contents(&self, report: &Report) -> impl Iterator<Item = (&Path, String)> {
        let line = self.report.as_deref().map(|path| (path, report.line()));
        let xml = self.junit.as_deref().map(|path| (path, JunitSuite::of_run(report).to_xml()));
        line.into_iter().chain(xml)
    }

    /// Writes each file, even if another cannot be written. Errors: the first of those.
    fn write(&self, report: &Report) -> Result<(), Failure> {
        let write = |(path, text): (&Path, String)| {
            OutputArgs { file: path.to_owned() }.write(text.as_bytes())
        };
        self.contents(report).map(write).fold(Ok(()), Result::and)
    }

    fn interrupt(&self, live: Live) {
        // There is nobody to tell of an error; the files still say that the run has not ended.
        _ = self.write(&live.ended(RunState::Interrupted));
    }
}

fn begun(invocation: &Invocation) -> Report {
    Report {
        format: FORMAT.to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        commit: commit().to_owned(),
        executable: executable(),
        command: invocation.command.clone(),
        words: invocation.words.clone(),
        options: invocation.options.clone(),
        shard: 1,
        shards: 1,
        state: RunState::Running,
        ..Report::default()
    }
}

/// A run in progress.
struct Live {
    report: Report,
    since: Instant,
}

impl Live {
    fn ended(self, state: RunState) -> Report {
        let time = self.since.elapsed().as_millis();
        Report { state, milliseconds: u64::try_from(time).unwrap_or(u64::MAX), ..self.report }
    }
}

/// The record of one run.
pub(crate) struct Recorder {
    files: ReportArgs,
    /// `None` if no report was requested, or once it is written.
    live: Arc<Mutex<Option<Live>>>,
    _guard: Option<Guard>,
}

impl fmt::Debug for Recorder {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Recorder").field("files", &self.files).finish_non_exhaustive()
    }
}

fn lock(live: &Mutex<Option<Live>>) -> MutexGuard<'_, Option<Live>> {
    live.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Recorder {
    /// Adds results so far, from any thread. Does nothing if no report is to be written.
    pub(crate) fn update(&self, add: impl FnOnce(&mut Report)) {
        if let Some(live) = lock(&self.live).as_mut() {
            add(&mut live.report);
        }
    }

    /// Adds which shard the run does.
    pub(crate) fn place(&self, placed: Placed) {
        self.update(|report| {
            (report.shard, report.shards) = (placed.shard.part + 1, placed.shard.of);
            report.shard_from = placed.source.map(str::to_owned);
        });
    }

    /// Adds how the cases of all shards are made, if that is known. [`Self::saw`] adds the cases
    /// of this run.
    pub(crate) fn asks(&self, set: Option<CaseSet>) {
        self.update(|report| (report.set, report.asked) = (set, Some(CaseSum::default())));
    }

    /// Adds cases that this run accounts for, by their lines, from any thread.
    pub(crate) fn saw<T: Display>(&self, cases: impl IntoIterator<Item = T>) {
        if self.files.places().next().is_some() {
            let sum = CaseSum::of(cases);
            self.update(|report| report.asked.iter_mut().for_each(|asked| asked.join(sum)));
        }
    }

    /// Writes the report of a run that has ended, and passes on how it ended. Errors: those of the
    /// run, and a file that cannot be written.
    fn finish(self, ended: Result<Exit, Failure>) -> Result<Exit, Failure> {
        let Some(live) = lock(&self.live).take() else { return ended };
        let state = match &ended {
            Ok(_) => RunState::Done,
            Err(failure) if failure.exit == Exit::ReaderLeft => RunState::Interrupted,
            Err(_) => RunState::Failed,
        };
        let message = ended.as_ref().err().map(ToString::to_string);
        let report = Report { message, ..live.ended(state) };
        let written = self.files.write(&report);
        let exit = ended?;
        written.map(|()| exit)
    }
}
