//! The run: its words, the options that decide what is compared, and the program itself.

use super::cases::hash;
use clap::{ArgMatches, Command};
use std::collections::BTreeMap;

/// The options that select a shard, or name its files. They differ between the shards of one
/// campaign. The baseline is compared by its cases.
const PLACES: [&str; 11] = [
    "shard", "given", "report", "junit", "file", "cases", "failures", "coverage", "picture",
    "json", "known",
];

/// One run of the program, from its command line.
#[derive(Clone, Debug, Default)]
pub(crate) struct Invocation {
    /// The words of the command line; the first is the program's name.
    pub(crate) words: Vec<String>,
    /// The name of the command, such as `verify`.
    pub(crate) command: String,
    /// The values of every option that decides what is compared, including defaults; `true` for a
    /// flag.
    pub(crate) options: BTreeMap<String, Vec<String>>,
}

impl Invocation {
    /// The run of these words, which `program` has parsed into `matches`.
    pub(crate) fn new(words: Vec<String>, program: &Command, matches: &ArgMatches) -> Self {
        let Some((name, matches)) = matches.subcommand() else { return Self::default() };
        let command = program.find_subcommand(name);
        let arguments = command.into_iter().flat_map(Command::get_arguments);
        let ids = arguments.map(|argument| argument.get_id().as_str());
        let options = ids.filter(|id| !PLACES.contains(id)).filter_map(|id| {
            let values = matches.try_get_raw(id).ok()??;
            let values: Vec<String> =
                values.map(|value| value.to_string_lossy().into_owned()).collect();
            (values != ["false"]).then(|| (id.to_owned(), values))
        });
        Self { words, command: name.to_owned(), options: options.collect() }
    }
}

/// The commit from which the program was built: its hash, with `+changes` if a source file differed
/// from it, or `unknown`.
pub(crate) const fn commit() -> &'static str {
    env!("TESS_COMMIT")
}

/// The digest of the program's own file; `None` if it cannot be read.
pub(crate) fn executable() -> Option<String> {
    Some(digest(&std::fs::read(std::env::current_exe().ok()?).ok()?))
}

/// A digest that distinguishes programs and baselines: the first half of their SHA-256.
pub(super) fn digest(bytes: &[u8]) -> String {
    format!("{:032x}", hash(bytes))
}
