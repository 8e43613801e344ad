//! Writes the report of a run when the run ends, in whatever way.

use super::invocation::{Invocation, commit, executable};
use super::junit::JunitSuite;
use super::report::{FORMAT, Report, RunState};
use super::shard::Placed;
use crate::failure::{Exit, Failure};
use crate::output::ending::{self, Guard};
use crate::output::{OutputArgs, OutputFile, Role};
use std::fmt;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Instant;

/// The options that request a report.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct ReportArgs {
    /// Write a report of the run to this file: a line of JSON that `tess merge` reads
    ///
    /// It is written on exit, also when a signal ends the run. The report of an earlier run is
    /// removed before anything else is done; a file that is not a report is kept, and is an error.
    /// docs/campaigns.md explains the entries.
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

    /// Begins to record a run. Errors: a place that cannot be written or is not a file.
    pub(crate) fn begin(
        &self,
        invocation: &Invocation,
        placed: Placed,
    ) -> Result<Recorder, Failure> {
        for (option, path) in self.places() {
            if !OutputFile::would_be_file(path) {
                let message = format!(
                    "{option} {} is not a regular file; give the path of a file",
                    path.display()
                );
                return Err(Failure::bad_input(message));
            }
            OutputArgs { file: path.to_owned() }.require_writable()?;
        }
        let files = self.clone();
        if self.places().next().is_none() {
            let live = Arc::new(Mutex::new(None));
            return Ok(Recorder { files, live, _guard: None });
        }
        let live = Live { report: begun(invocation, placed), since: Instant::now() };
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

    fn interrupt(&self, live: Live) {
        let report = live.ended(RunState::Interrupted);
        for (path, text) in self.contents(&report) {
            // There is nobody to tell; `tess merge` reports that the file is missing.
            _ = OutputArgs { file: path.to_owned() }.write(text.as_bytes());
        }
    }
}

fn begun(invocation: &Invocation, placed: Placed) -> Report {
    Report {
        format: FORMAT.to_owned(),
        version: env!("CARGO_PKG_VERSION").to_owned(),
        commit: commit().to_owned(),
        executable: executable(),
        command: invocation.command.clone(),
        words: invocation.words.clone(),
        options: invocation.options.clone(),
        seed: invocation.seed(),
        shard: placed.shard.part + 1,
        shards: placed.shard.of,
        shard_from: placed.source.map(str::to_owned),
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

    /// Writes the report of a run that has ended, and passes on how it ended. Errors: those of the
    /// run, and a file that cannot be written.
    pub(crate) fn finish(self, ended: Result<Exit, Failure>) -> Result<Exit, Failure> {
        let Some(live) = lock(&self.live).take() else { return ended };
        let state = match &ended {
            Ok(_) => RunState::Done,
            Err(failure) if failure.exit == Exit::ReaderLeft => RunState::Interrupted,
            Err(_) => RunState::Failed,
        };
        let message = ended.as_ref().err().map(ToString::to_string);
        let report = Report { message, ..live.ended(state) };
        let mut written = Ok(());
        for (path, text) in self.files.contents(&report) {
            written = written.and(OutputArgs { file: path.to_owned() }.write(text.as_bytes()));
        }
        let exit = ended?;
        written.map(|()| exit)
    }
}
