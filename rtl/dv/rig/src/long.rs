//! Comparisons that run for hours, in shards. A finished shard is repeated only after a source of
//! the circuit changes.

use crate::bench::{self, Variant, stimuli};
use crate::stages::{self, Inputs, Stages};
use crate::tools::sources;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Instant;
use tess_commands::command::in_file;
use tess_verify::Case;
use tess_verify::generate::{GenLevel, Selection, SplitMix64, configurations, random_patch};
use tess_verify::vectors::Fnv1a;

/// The number of patches in a shard.
const PATCHES: u64 = 10_000;
/// The number of shards of small random patches, which come first.
const SMALL: u64 = 900;
/// The number of shards of random patches of level 3; with the small ones, 10 million patches.
const LEVEL_3: u64 = 100;

/// A part of the work.
enum Shard {
    /// Patches of level 2, starting with this number.
    Level2(usize),
    /// Random patches whose output is usually small, by seed.
    Small(u64),
    /// Random patches of level 3, by seed.
    Level3(u64),
    /// Single stages.
    Stages(Inputs),
}

/// Runs all shards, one per core at a time.
///
/// # Errors
/// Something differs: the shard's name and what the bench printed. The shards in work are ended
/// first.
pub(crate) fn run() -> Result<(), String> {
    let bench = &bench::bench(Variant::Plain)?;
    let level_2: Vec<Case> = Selection::level(GenLevel::Two, 1).cases().collect();
    let (stages, shards) = (Stages::built(&bench::folder())?, shards(level_2.len()));
    let done = bench::folder().join("long").join(format!("{:016x}", digest()?));
    fs::create_dir_all(&done).map_err(|error| in_file(&done, &error))?;
    println!("\n{} shards; those that are done are noted in {}", shards.len(), done.display());
    let work = Work { bench, stages, level_2, shards, done, next: AtomicUsize::new(0) };
    let cores = std::thread::available_parallelism().map_or(1, usize::from);
    std::thread::scope(|scope| {
        let workers: Vec<_> =
            (0..cores).map(|_| scope.spawn(|| work.until_none_is_left())).collect();
        let results =
            workers.into_iter().map(|worker| worker.join().map_err(|_| "a worker panicked")?);
        results.collect::<Result<Vec<()>, String>>().map(|_| ())
    })?;
    println!("all {} shards are equal", work.shards.len());
    Ok(())
}

/// All shards, the quick ones first.
fn shards(level_2: usize) -> Vec<Shard> {
    let size = usize::try_from(PATCHES).unwrap_or(usize::MAX);
    let small = (1..=SMALL).map(Shard::Small);
    let systematic = (0..level_2).step_by(size).map(Shard::Level2);
    let stages = stages::all().into_iter().map(Shard::Stages);
    small.chain(stages).chain(systematic).chain((1..=LEVEL_3).map(Shard::Level3)).collect()
}

/// A digest of the design and of its benches.
fn digest() -> Result<u64, String> {
    let mut files = Vec::new();
    for folder in [sources(), sources().join("dv/tb")] {
        let entries = fs::read_dir(&folder).map_err(|error| in_file(&folder, &error))?;
        let paths = entries.filter_map(|entry| Some(entry.ok()?.path()));
        let is_source = |path: &PathBuf| path.extension().is_some_and(|e| e == "sv" || e == "svh");
        files.extend(paths.filter(is_source));
    }
    files.sort();
    let mut digest = Fnv1a::default();
    for file in files {
        let bytes = fs::read(&file).map_err(|error| in_file(&file, &error))?;
        digest.words(bytes.into_iter().map(u32::from));
    }
    Ok(digest.finish())
}

/// State that the workers share.
struct Work<'a> {
    bench: &'a Path,
    stages: Stages,
    level_2: Vec<Case>,
    shards: Vec<Shard>,
    done: PathBuf,
    next: AtomicUsize,
}

impl Work<'_> {
    fn until_none_is_left(&self) -> Result<(), String> {
        loop {
            let number = self.next.fetch_add(1, Ordering::Relaxed);
            let Some(shard) = self.shards.get(number) else { return Ok(()) };
            self.unless_done(number, shard).inspect_err(|_| {
                self.next.store(self.shards.len(), Ordering::Relaxed);
            })?;
        }
    }

    fn unless_done(&self, number: usize, shard: &Shard) -> Result<(), String> {
        let name = shard.name();
        let note = self.done.join(&name);
        if note.exists() {
            return Ok(());
        }
        let began = Instant::now();
        let said = self.compare(number, shard).map_err(|error| format!("shard {name}: {error}"))?;
        let seconds = began.elapsed().as_secs_f32();
        println!("[{} of {}] {name}: {said}, {seconds:.1} s", number + 1, self.shards.len());
        fs::write(&note, said).map_err(|error| in_file(&note, &error))
    }

    fn compare(&self, number: usize, shard: &Shard) -> Result<String, String> {
        let cases = match *shard {
            Shard::Stages(inputs) => return self.stages.compare(inputs),
            Shard::Level2(first) => self.level_2.iter().skip(first).take(10_000).copied().collect(),
            Shard::Small(seed) => small(seed),
            Shard::Level3(seed) => {
                let level = Selection::level(GenLevel::Three, seed);
                Selection { random: Some(PATCHES), ..level }.cases().collect::<Vec<_>>()
            }
        };
        let stimuli = stimuli(&shard.name(), &cases)?;
        let seed = seed(number);
        let arguments = [&stimuli, &seed, "+gaps", "+resets=10"];
        let (verdict, _) = bench::compare(self.bench, &arguments, cases.len())?;
        // If a shard differs, its patches are kept.
        let file = Path::new(stimuli.trim_start_matches("+stimuli="));
        fs::remove_file(file).map_err(|error| in_file(file, &error))?;
        Ok(verdict.to_string())
    }
}

/// The argument that seeds a shard's stalls and resets: one of its own for each shard.
fn seed(number: usize) -> String {
    format!("+seed={}", 1 + number)
}

impl Shard {
    fn name(&self) -> String {
        match *self {
            Self::Level2(first) => format!("level-2-{first}"),
            Self::Small(seed) => format!("small-{seed}"),
            Self::Level3(seed) => format!("level-3-{seed}"),
            Self::Stages(Inputs::Factors(first, _)) => format!("factors-{first:06x}"),
            Self::Stages(Inputs::Words(first, _)) => format!("words-{first:08x}"),
        }
    }
}

/// Random patches of every configuration in turn, usually with few elements.
fn small(seed: u64) -> Vec<Case> {
    let mut random = SplitMix64::new(seed);
    let configurations: Vec<_> = configurations().collect();
    let chosen = configurations.iter().cycle().take(10_000);
    let case = |&(domain, config)| Case { config, factors: random_patch(domain, &mut random) };
    chosen.map(case).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::BTreeSet;

    #[test]
    fn shards_have_ten_million_random_patches_and_names_of_their_own() {
        let shards = shards(25_000);
        let names: BTreeSet<String> = shards.iter().map(Shard::name).collect();
        assert_eq!(names.len(), shards.len(), "a note each");
        assert_eq!((SMALL + LEVEL_3) * PATCHES, 10_000_000, "patches");
        assert_ne!(small(1), small(2), "a seed's own patches");
        let seeds: BTreeSet<String> = (0..shards.len()).map(seed).collect();
        assert_eq!(seeds.len(), shards.len(), "stalls of their own");
    }
}
