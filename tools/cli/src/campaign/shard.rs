//! Selects the part of the work that a command does: by `--shard`, or by a batch system's
//! environment variables.

use crate::failure::Failure;
use crate::output::note;
use std::fmt;
use std::fs::File;
use std::path::Path;
use tess_verify::generate::Shard;

/// The `--shard` option.
#[derive(Clone, Copy, Debug, clap::Args)]
pub(crate) struct ShardArgs {
    /// One of N disjoint parts, counted from 1 [default: from the batch system, or 1/1]
    ///
    /// Without it, the part is taken from the environment: `TEST_SHARD_INDEX` and
    /// `TEST_TOTAL_SHARDS` (Bazel, googletest), `SLURM_ARRAY_TASK_ID` (Slurm arrays that begin with
    /// 0 or 1), `JOB_COMPLETION_INDEX` with `TESS_SHARDS` (Kubernetes). --shard 1/1 does
    /// everything, whatever the environment says.
    #[arg(long = "shard", value_name = "I/N", value_parser = shard)]
    given: Option<Shard>,
}

/// A part of the work, and what selected it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Placed {
    pub(crate) shard: Shard,
    /// `--shard`, or the variable that numbers the part; `None` if nothing selected a part and all
    /// the work is done.
    pub(crate) source: Option<&'static str>,
}

impl Placed {
    /// All of the work, for work that cannot be cut.
    pub(crate) const WHOLE: Self = Self { shard: Shard::WHOLE, source: None };
}

const OPTION: &str = "--shard";

/// For example `3/8`, or `3/8 (from SLURM_ARRAY_TASK_ID)` if a variable selected it.
impl fmt::Display for Placed {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.shard.part + 1, self.shard.of)?;
        let source = self.source.filter(|source| *source != OPTION);
        source.map_or(Ok(()), |source| write!(f, " (from {source})"))
    }
}

impl ShardArgs {
    /// The part to do. Errors: a batch system's variables contradict each other or do not determine
    /// a part; a status file cannot be touched.
    pub(crate) fn place(self) -> Result<Placed, Failure> {
        if let Some(shard) = self.given {
            return Ok(Placed { shard, source: Some(OPTION) });
        }
        let given = |name: &str| std::env::var_os(name).filter(|value| !value.is_empty());
        // Text that is not UTF-8 is not a number; the error shows it as far as possible.
        let value = |name: &str| given(name).map(|value| value.to_string_lossy().into_owned());
        let placed = from_environment(&value).map_err(|message| {
            Failure::bad_input(format!(
                "{message}; or give --shard I/N, --shard 1/1 for everything"
            ))
        })?;
        if let (Some(BAZEL), Some(file)) = (placed.source, given("TEST_SHARD_STATUS_FILE")) {
            // By touching this file, a test tells its runner that it supports shards.
            let path = Path::new(&file);
            let touched = File::options().append(true).create(true).open(path);
            touched.map_err(|error| Failure::file("touch", path, &error))?;
        }
        if placed.source.is_some() {
            note(&format!("shard {placed}"));
        }
        Ok(placed)
    }

    /// All of the work, for work that cannot be cut. Errors: a batch system selects a part, so
    /// everything would be done several times.
    pub(crate) fn whole(self, what: &str) -> Result<Placed, Failure> {
        let placed = self.place()?;
        if placed.shard == Shard::WHOLE {
            return Ok(Placed::WHOLE);
        }
        Err(Failure::bad_input(format!(
            "{what} cannot be cut into shards, and this is shard {placed}: run it once, with --shard 1/1"
        )))
    }
}

const BAZEL: &str = "TEST_SHARD_INDEX";
const SLURM: &str = "SLURM_ARRAY_TASK_ID";
const KUBERNETES: &str = "JOB_COMPLETION_INDEX";

/// The values of environment variables that are set and not empty.
type Environment<'a> = &'a dyn Fn(&str) -> Option<String>;

fn from_environment(value: Environment<'_>) -> Result<Placed, String> {
    let systems =
        [(BAZEL, bazel(value)?), (SLURM, slurm(value)?), (KUBERNETES, kubernetes(value)?)];
    let mut found = systems
        .into_iter()
        .filter_map(|(source, shard)| Some(Placed { shard: shard?, source: Some(source) }));
    let Some(first) = found.next() else { return Ok(Placed::WHOLE) };
    match found.find(|other| other.shard != first.shard) {
        Some(other) => Err(format!("two batch systems disagree: shard {first}, shard {other}")),
        None => Ok(first),
    }
}

/// The part from Bazel or googletest, which count from 0.
fn bazel(value: Environment<'_>) -> Result<Option<Shard>, String> {
    const OF: &str = "TEST_TOTAL_SHARDS";
    if number(value, OF)?.is_some() {
        other(value, OF, BAZEL)?;
    }
    from_zero(value, BAZEL, OF)
}

/// The part from Kubernetes, which counts from 0. The manifest has to set the number of parts.
fn kubernetes(value: Environment<'_>) -> Result<Option<Shard>, String> {
    from_zero(value, KUBERNETES, "TESS_SHARDS")
        .map_err(|why| format!("{why}; set TESS_SHARDS to the completions of the Job"))
}

fn from_zero(value: Environment<'_>, index: &str, total: &str) -> Result<Option<Shard>, String> {
    let Some(part) = number(value, index)? else { return Ok(None) };
    part_of(index, part, total, other(value, index, total)?).map(Some)
}

/// The value of a variable that must be set together with another one.
fn other(value: Environment<'_>, set: &str, name: &str) -> Result<u64, String> {
    number(value, name)?.ok_or_else(|| format!("{set} is set, but {name} is not"))
}

/// The part from Slurm, which counts from the first index of the array. Only an array that begins
/// with 0 or 1 and has no gaps determines a task's part of the whole.
fn slurm(value: Environment<'_>) -> Result<Option<Shard>, String> {
    let Some(task) = number(value, SLURM)? else { return Ok(None) };
    let other = |name| other(value, SLURM, name);
    let (first, last) = (other("SLURM_ARRAY_TASK_MIN")?, other("SLURM_ARRAY_TASK_MAX")?);
    let count = other("SLURM_ARRAY_TASK_COUNT")?;
    if first > 1 || last < first || last - first != count.wrapping_sub(1) {
        return Err(format!(
            "the Slurm array has {count} tasks from {first} to {last}: a campaign's begins with 0 or 1 and \
             leaves no number out"
        ));
    }
    let part =
        task.checked_sub(first).ok_or_else(|| format!("{SLURM} is {task}, less than {first}"))?;
    part_of(SLURM, part, "SLURM_ARRAY_TASK_COUNT", count).map(Some)
}

fn part_of(index: &str, part: u64, total: &str, of: u64) -> Result<Shard, String> {
    if part < of {
        return Ok(Shard { part, of });
    }
    Err(format!("{index} selects part {part}, counted from 0, but {total} is {of}"))
}

fn number(value: Environment<'_>, name: &str) -> Result<Option<u64>, String> {
    let Some(text) = value(name) else { return Ok(None) };
    text.parse().map(Some).map_err(|_| format!("{name} is `{text}`, which is not a number"))
}

/// Parses `I/N`, with I in 1..=N.
pub(crate) fn shard(text: &str) -> Result<Shard, String> {
    let parts = text.split_once('/');
    let numbers = parts.and_then(|(i, n)| Some((i.parse::<u64>().ok()?, n.parse::<u64>().ok()?)));
    match numbers {
        Some((i, n)) if (1..=n).contains(&i) => Ok(Shard { part: i - 1, of: n }),
        _ => Err("a shard is I/N with I from 1 to N, such as 3/8".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(variables: &str) -> Result<String, String> {
        let value = |name: &str| {
            let mut pairs = variables.split(' ').filter_map(|pair| pair.split_once('='));
            pairs.find(|(known, _)| *known == name).map(|(_, value)| value.to_owned())
        };
        from_environment(&value).map(|placed| placed.to_string())
    }

    const ARRAY: &str = "SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_MAX=8 SLURM_ARRAY_TASK_COUNT=8";

    #[test]
    fn each_system_counts_as_it_does() {
        for (variables, placed) in [
            ("", "1/1"),
            ("TESS_SHARDS=4", "1/1"),
            ("TEST_TOTAL_SHARDS=8 TEST_SHARD_INDEX=0", "1/8 (from TEST_SHARD_INDEX)"),
            ("TEST_TOTAL_SHARDS=8 TEST_SHARD_INDEX=7", "8/8 (from TEST_SHARD_INDEX)"),
            ("JOB_COMPLETION_INDEX=2 TESS_SHARDS=3", "3/3 (from JOB_COMPLETION_INDEX)"),
            (&format!("SLURM_ARRAY_TASK_ID=8 {ARRAY}"), "8/8 (from SLURM_ARRAY_TASK_ID)"),
            (
                "SLURM_ARRAY_TASK_ID=0 SLURM_ARRAY_TASK_MIN=0 SLURM_ARRAY_TASK_MAX=3 \
                 SLURM_ARRAY_TASK_COUNT=4",
                "1/4 (from SLURM_ARRAY_TASK_ID)",
            ),
            (
                "TEST_TOTAL_SHARDS=2 TEST_SHARD_INDEX=1 JOB_COMPLETION_INDEX=1 TESS_SHARDS=2",
                "2/2 (from TEST_SHARD_INDEX)",
            ),
        ] {
            assert_eq!(of(variables).as_deref(), Ok(placed), "{variables}");
        }
    }

    #[test]
    fn what_gives_no_part_is_an_error() {
        for (variables, why) in [
            ("TEST_SHARD_INDEX=0", "TEST_TOTAL_SHARDS is not"),
            ("TEST_TOTAL_SHARDS=8", "TEST_SHARD_INDEX is not"),
            ("TEST_TOTAL_SHARDS=8 TEST_SHARD_INDEX=8", "selects part 8, counted from 0"),
            ("TEST_TOTAL_SHARDS=8 TEST_SHARD_INDEX=-1", "which is not a number"),
            ("JOB_COMPLETION_INDEX=0", "set TESS_SHARDS to the completions of the Job"),
            ("JOB_COMPLETION_INDEX=3 TESS_SHARDS=3", "selects part 3, counted from 0"),
            ("SLURM_ARRAY_TASK_ID=3", "SLURM_ARRAY_TASK_MIN is not"),
            (
                "SLURM_ARRAY_TASK_ID=3 SLURM_ARRAY_TASK_MIN=3 SLURM_ARRAY_TASK_MAX=3 \
                 SLURM_ARRAY_TASK_COUNT=1",
                "begins with 0 or 1",
            ),
            (
                "SLURM_ARRAY_TASK_ID=3 SLURM_ARRAY_TASK_MIN=1 SLURM_ARRAY_TASK_MAX=5 \
                 SLURM_ARRAY_TASK_COUNT=2",
                "leaves no number out",
            ),
            (&format!("SLURM_ARRAY_TASK_ID=9 {ARRAY}"), "selects part 8, counted from 0"),
            (&format!("SLURM_ARRAY_TASK_ID=0 {ARRAY}"), "less than 1"),
            (
                "TEST_TOTAL_SHARDS=8 TEST_SHARD_INDEX=0 JOB_COMPLETION_INDEX=1 TESS_SHARDS=8",
                "two batch systems disagree",
            ),
        ] {
            let found = of(variables);
            assert!(found.as_ref().is_err_and(|e| e.contains(why)), "{variables}: {found:?}");
        }
    }
}
