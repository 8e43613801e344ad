//! The `--known` option: cases that may differ, as a documented deviation of a device does.

use super::recorder::Recorder;
use super::report::Baseline;
use crate::failure::Failure;
use crate::output::{Role, counted, note};
use std::path::{Path, PathBuf};
use tess_verify::case::Case;
use tess_verify::known::Known;

/// The `--known` option.
#[derive(Clone, Debug, clap::Args)]
pub(crate) struct KnownArgs {
    /// Cases that may differ: lines that begin with `case`, or a vector file such as --failures writes
    ///
    /// Their differences are counted as known and are no mismatches. What no longer differs is named on stderr. A
    /// header without records, or remarks alone, are a baseline of no cases; an empty file is refused.
    #[arg(long, value_name = "FILE")]
    known: Option<PathBuf>,
}

impl KnownArgs {
    /// The file of the option.
    pub(crate) fn role(&self) -> Option<Role<'_>> {
        self.known.as_deref().map(|path| Role::input("--known", path))
    }

    /// The cases, none without the option.
    ///
    /// # Errors
    /// What `read` says.
    pub(crate) fn read<I, E>(
        &self,
        read: impl FnOnce(&Path) -> Result<I, Failure>,
    ) -> Result<Known, Failure>
    where
        I: IntoIterator<Item = Result<Case, E>>,
        E: ToString,
    {
        let Some(path) = &self.known else { return Ok(Known::default()) };
        if path.as_os_str() == "-" {
            return Err(Failure::bad_input("--known is kept from run to run: give a file"));
        }
        let cases: Result<Vec<Case>, E> = read(path)?.into_iter().collect();
        cases.map(Known::new).map_err(|error| Failure::bad_input(error.to_string()))
    }
}

/// Says which cases no longer differ, and puts what became of the baseline into the report.
pub(crate) fn conclude(known: &Known, recorder: &Recorder) {
    if known.entries() == 0 {
        return;
    }
    let gone: Vec<String> = known.gone().iter().map(ToString::to_string).collect();
    if !gone.is_empty() {
        let lines: String = gone.iter().map(|line| format!("\n  {line}")).collect();
        let number = counted(gone.len() as u64, "case");
        note(&format!("no longer different, though known: {number}{lines}"));
    }
    recorder.update(|report| {
        let (entries, different) = (known.entries() as u64, known.different() as u64);
        report.known = Some(Baseline { entries, different, gone });
    });
}
