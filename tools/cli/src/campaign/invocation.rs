//! What was run: the words, the options that decide what is compared, and the program itself.

use clap::{ArgMatches, Command};
use std::collections::BTreeMap;
use tess_verify::digest::Fnv1a;

/// The options that say where a shard's files lie, or which shard it is. Shards of one campaign differ in them.
/// The baseline is compared by its cases.
const PLACES: [&str; 11] = [
    "shard", "given", "report", "junit", "file", "cases", "failures", "coverage", "picture",
    "json", "known",
];

/// One run of the program, as its command line says it.
#[derive(Clone, Debug, Default)]
pub(crate) struct Invocation {
    /// The words of the command line, the program's name first.
    pub(crate) words: Vec<String>,
    /// Name of the command, such as `verify`.
    pub(crate) command: String,
    /// The values of every option that decides what is compared, defaults too; `true` for a flag.
    pub(crate) options: BTreeMap<String, Vec<String>>,
}

impl Invocation {
    /// The run of these words, which `program` has taken to be `matches`.
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

    /// The seed, if the command has one.
    pub(crate) fn seed(&self) -> Option<u64> {
        self.options.get("seed")?.first()?.parse().ok()
    }
}

/// The commit that the program was built from: its number, with `+changes` if a source file differed from it, or
/// `unknown`.
pub(crate) const fn commit() -> &'static str {
    env!("TESS_COMMIT")
}

/// Digest of the program's own file; `None` if it cannot be read.
pub(crate) fn executable() -> Option<String> {
    Some(digest(&std::fs::read(std::env::current_exe().ok()?).ok()?))
}

/// FNV-1a of 64 bits over little-endian words of 32 bits.
pub(super) fn digest(bytes: &[u8]) -> String {
    let word = |chunk: &[u8]| chunk.iter().rev().fold(0, |word, byte| word << 8 | u32::from(*byte));
    let mut digest = Fnv1a::new();
    digest.words(bytes.chunks(4).map(word));
    format!("{:016x}", digest.finish())
}
