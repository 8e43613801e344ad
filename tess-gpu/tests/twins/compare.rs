//! The first word that differs, and its owner.

use super::buffers::Words;
use super::catalogue::Catalogue;
use super::run::Context;
use std::fmt;
use tess_gpu::layout::Job;
use tess_gpu::{Access, Binding, Dispatch, Resource, Setup, Stage};

/// A word for which a pass and its twin differ.
#[derive(Debug)]
pub(crate) struct Difference {
    pub(crate) stage: Stage,
    pub(crate) resource: Resource,
    text: String,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

/// Compares the buffers that a pass writes, `number` passes after the first.
pub(crate) fn first_difference(
    context: &Context<'_>,
    dispatch: &Dispatch,
    (words, left): (&Words, &Words),
    refused: Option<(Resource, u32, String)>,
    number: usize,
) -> Result<(), Difference> {
    let stage = dispatch.stage();
    let job = context.pass(dispatch).job;
    let count = context.plan.dispatches().count();
    let (run, pass) = (number / count + 1, number % count + 1);
    let pass = format!("run {run}, pass {pass} of {count}, `{}`", stage.entry_point());
    let difference = |resource, text| Difference { stage, resource, text };
    if let Some((resource, word, why)) = refused {
        let text = format!("{pass}: {resource:?} word {word}: {why}");
        return Err(difference(resource, text));
    }
    let written = stage.bindings().iter().filter(|it| it.1 == Access::ReadWrite);
    let mut written: Vec<_> = written.map(|&Binding(resource, _)| resource).collect();
    // The catalogue comes first, because other buffers hold numbers of its slots.
    written.sort_by_key(|resource| *resource != Resource::Catalogue);
    for resource in written {
        let (expected, left) = (&words[resource as usize], &left[resource as usize]);
        assert_eq!(expected.len(), left.len(), "the buffer {resource:?}");
        let Some(word) = (0..left.len()).find(|&word| expected[word] != left[word]) else {
            continue;
        };
        let catalogue = &words[Resource::Catalogue as usize];
        let owner = owner(context, dispatch, &job, (resource, word), catalogue);
        let portion = job.portion;
        let text = format!(
            "{pass} of portion {portion}: {resource:?} word {word} ({owner}): {0} {0:#010x} instead of {1} {1:#010x}\n{2:?}",
            left[word], expected[word], context.batch.setup
        );
        return Err(difference(resource, text));
    }
    Ok(())
}

/// The owner of a word of a buffer, if the catalogue is right.
fn owner(
    context: &Context<'_>,
    dispatch: &Dispatch,
    job: &Job,
    (resource, word): (Resource, usize),
    catalogue: &[u32],
) -> String {
    let (_, span) = dispatch.bindings().find(|(it, _)| *it == resource).expect("it is bound");
    let first = usize::try_from(span.offset / 4).expect("in memory");
    let in_span = word.checked_sub(first).filter(|&word| 4 * word as u64 <= span.size);
    let Some(word) = in_span.and_then(|word| u32::try_from(word).ok()) else {
        return "outside of what the pass binds".to_owned();
    };
    let patch = |in_portion: u32| patch(context, job.first_patch + in_portion);
    match resource {
        Resource::Topologies => patch(word / 2),
        Resource::Contexts => {
            format!("factor {}, {}", word / 2 / job.stride, patch(word / 2 % job.stride))
        }
        Resource::Offsets => offset_owner(job, word / 2, patch),
        Resource::Tiles if word < job.primitive_tiles_at => format!("tile {word} of points"),
        Resource::Tiles => format!("tile {} of primitives", word - job.primitive_tiles_at),
        Resource::Status => status_owner(word),
        Resource::Draws => format!("group {}, draw argument {}", word / 5, word % 5),
        Resource::Arguments if word < 5 => format!("draw argument {word}"),
        Resource::Arguments => format!("size of a dispatch, job {}", word.saturating_sub(8) / 3),
        Resource::Points => element_owner(context, 0, first as u64 + u64::from(word), 2),
        Resource::Indices => {
            let per_word = 4 / context.batch.setup.index_type.bytes();
            let at = (first as u64 + u64::from(word)) * u64::from(per_word);
            element_owner(context, 1, at, context.batch.setup.indices_per_primitive())
        }
        Resource::Catalogue => catalogue_owner(context.batch.setup, word, catalogue),
        _ => "of no patch".to_owned(),
    }
}

/// The slot that a word of the catalogue belongs to.
fn catalogue_owner(setup: Setup, word: u32, words: &[u32]) -> String {
    let it = Catalogue::new(setup);
    let [(points_at, _, point_words), (triangles_at, ..)] = it.elements;
    let (kind, each, what) = match word {
        _ if word < it.slots => return format!("key of slot {word}"),
        _ if word < it.places_at => return format!("counter {}", word - it.used_at),
        _ if word < points_at => return format!("places of slot {}", (word - it.places_at) / 2),
        _ if word < triangles_at => (0, point_words, "point"),
        _ => (1, 1, "triangle"),
    };
    let place = |slot: &u32| words[(it.places_at + 2 * slot + kind) as usize];
    match (0..it.slots).filter(|slot| place(slot) <= word && place(slot) > 0).max_by_key(place) {
        Some(slot) => format!("{what} {} of slot {slot}", (word - place(&slot)) / each),
        None => format!("{what} of no slot"),
    }
}

fn patch(context: &Context<'_>, number: u32) -> String {
    match context.batch.patches.get(number as usize) {
        Some(factors) => format!("patch {number}, {factors:?}"),
        None => format!("behind the last patch, {number}"),
    }
}

fn offset_owner(job: &Job, entry: u32, patch: impl Fn(u32) -> String) -> String {
    if entry < job.blocks_at {
        patch(entry)
    } else if entry < job.alike_at {
        format!("block {}", entry - job.blocks_at)
    } else if entry < job.sections_at {
        format!("common topology of block {}", entry - job.alike_at)
    } else {
        format!("section {}", entry - job.sections_at)
    }
}

fn status_owner(word: u32) -> String {
    let fields = ["points", "points_high", "primitives", "primitives_high", "overflow"];
    match (fields.get(word as usize), word.checked_sub(8)) {
        (Some(field), _) => (*field).to_owned(),
        (None, Some(word)) => format!("range of portion {}, word {}", word / 4, word % 4),
        (None, None) => "reserved".to_owned(),
    }
}

/// The element that a word of the output belongs to, with `size` words or indices per element;
/// `kind` 0 is points, 1 primitives.
fn element_owner(context: &Context<'_>, kind: usize, at: u64, size: u32) -> String {
    let element = at / u64::from(size);
    let begins = &context.begins;
    let behind = begins.partition_point(|begin| u64::from(begin[kind]) <= element);
    let number = u32::try_from(behind.saturating_sub(1)).unwrap_or(u32::MAX);
    let begin = begins.get(number as usize).map_or(0, |begin| u64::from(begin[kind]));
    let what = ["point", "primitive"][kind];
    format!("{what} {} of {}", element - begin, patch(context, number))
}
