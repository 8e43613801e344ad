//! The `--known` option: cases that may differ, as a documented deviation of a device does.

use super::invocation::digest;
use super::recorder::Recorder;
use super::report::KnownCases;
use crate::failure::Failure;
use crate::output::{Role, counted, note};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use tess_verify::Case;
use tess_verify::check::Known;

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

/// The cases that may differ, and the file that they stand in.
#[derive(Debug, Default)]
pub(crate) struct Baseline {
    pub(crate) cases: Arc<Known>,
    /// The report's entry of the file, before anything is compared.
    file: Option<KnownCases>,
}

impl KnownArgs {
    /// The file of the option.
    pub(crate) fn role(&self) -> Option<Role<'_>> {
        self.known.as_deref().map(|path| Role::input("--known", path))
    }

    /// Refuses a baseline that is the very file which it is to judge.
    ///
    /// # Errors
    /// It is.
    pub(crate) fn refuse_judged(&self, what: &str, judged: &Role<'_>) -> Result<(), Failure> {
        if self.role().is_some_and(|known| known.is_same_file(judged)) {
            let message = format!("--known is {what} itself: every difference would be known");
            return Err(Failure::bad_input(message));
        }
        Ok(())
    }

    /// The baseline, of no cases without the option.
    ///
    /// # Errors
    /// Those of `read`.
    pub(crate) fn read<I, E>(
        &self,
        read: impl FnOnce(&Path) -> Result<I, Failure>,
    ) -> Result<Baseline, Failure>
    where
        I: IntoIterator<Item = Result<Case, E>>,
        E: ToString,
    {
        let Some(path) = &self.known else { return Ok(Baseline::default()) };
        if path.as_os_str() == "-" {
            return Err(Failure::bad_input("--known is kept from run to run: give a file"));
        }
        let cases: Result<Vec<Case>, E> = read(path)?.into_iter().collect();
        let cases = cases.map_err(|error| Failure::bad_input(error.to_string()))?;
        let digest = Some(digest_of(&cases));
        let cases = Arc::new(Known::from_iter(cases));
        let (file, entries) = (Some(path.to_string_lossy().into_owned()), cases.entries() as u64);
        let file = Some(KnownCases { file, digest, entries, ..KnownCases::default() });
        Ok(Baseline { cases, file })
    }
}

/// Digest of the set of these cases: neither order nor remarks change it.
fn digest_of(cases: &[Case]) -> String {
    let mut lines: Vec<String> = cases.iter().map(|case| format!("{case}\n")).collect();
    lines.sort_unstable();
    lines.dedup();
    digest(lines.concat().as_bytes())
}

impl Baseline {
    /// Puts into the report which baseline there is, so that a run that ends early says it too.
    pub(crate) fn note(&self, recorder: &Recorder) {
        recorder.update(|report| report.known.clone_from(&self.file));
    }

    /// Says which cases no longer differ, and puts what became of the baseline into the report.
    pub(crate) fn conclude(&self, recorder: &Recorder) {
        let gone: Vec<String> = self.cases.gone().iter().map(ToString::to_string).collect();
        if !gone.is_empty() {
            let lines: String = gone.iter().map(|line| format!("\n  {line}")).collect();
            let number = counted(gone.len() as u64, "case");
            note(&format!("no longer different, though known: {number}{lines}"));
        }
        recorder.update(|report| {
            if let Some(known) = &mut report.known {
                (known.different, known.gone) = (self.cases.different() as u64, gone);
            }
        });
    }
}
