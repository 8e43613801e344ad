//! The words of a batch's buffers, and those that a pass binds.

use tess_core::Patch;
use tess_gpu::layout::Job;
use tess_gpu::{Dispatch, Resource, Setup, Span, Stage};

/// The words of each resource's whole buffer, in the order of [`Resource::ALL`].
pub(crate) type Words = [Vec<u32>; Resource::ALL.len()];

/// The entries of an element of the output in pairs of numbers.
pub(crate) const POINTS: usize = 0;
pub(crate) const PRIMITIVES: usize = 1;

/// The arguments of a pass, and the patches of its portion in the model.
#[derive(Debug)]
pub(crate) struct Pass<'a> {
    pub(crate) setup: Setup,
    pub(crate) stage: Stage,
    pub(crate) job: Job,
    pub(crate) patches: &'a [Patch],
}

/// The buffers as a pass binds them: words are numbered from the beginning of the binding. A twin
/// reads their contents and writes the expected ones.
#[derive(Debug)]
pub(crate) struct Bound<'a> {
    words: &'a mut Words,
    /// The device's words in the buffers that the pass writes.
    left: &'a Words,
    spans: [Option<Span>; Resource::ALL.len()],
    /// A choice of the device that the pass may not make: the word, and the fault.
    pub(crate) refused: Option<(Resource, u32, String)>,
}

impl<'a> Bound<'a> {
    pub(crate) fn new(dispatch: &Dispatch, words: &'a mut Words, left: &'a Words) -> Self {
        let mut spans = [None; Resource::ALL.len()];
        dispatch.bindings().for_each(|(resource, span)| spans[resource as usize] = Some(span));
        Self { words, left, spans, refused: None }
    }

    fn at(&self, resource: Resource, word: u32) -> usize {
        let span = self.spans[resource as usize];
        let span = span.unwrap_or_else(|| panic!("the pass binds no {resource:?}"));
        assert!(4 * u64::from(word) < span.size, "word {word} of {resource:?} is not bound");
        usize::try_from(span.offset / 4).expect("in memory") + word as usize
    }

    pub(crate) fn word(&self, resource: Resource, word: u32) -> u32 {
        self.words[resource as usize][self.at(resource, word)]
    }

    pub(crate) fn set(&mut self, resource: Resource, word: u32, value: u32) {
        let at = self.at(resource, word);
        self.words[resource as usize][at] = value;
    }

    /// The device's words. A twin reads them only where the pass may choose: slots and places of
    /// the catalogue, and the unused bits of culled topologies.
    pub(crate) fn left(&self, resource: Resource, word: u32) -> u32 {
        self.left[resource as usize][self.at(resource, word)]
    }

    /// Entry `entry` of a buffer of pairs.
    pub(crate) fn pair(&self, resource: Resource, entry: u32) -> [u32; 2] {
        [self.word(resource, 2 * entry), self.word(resource, 2 * entry + 1)]
    }

    pub(crate) fn set_pair(&mut self, resource: Resource, entry: u32, [first, second]: [u32; 2]) {
        self.set(resource, 2 * entry, first);
        self.set(resource, 2 * entry + 1, second);
    }

    /// The number of words of the whole binding.
    pub(crate) fn size(&self, resource: Resource) -> u32 {
        let span = self.spans[resource as usize].map_or(0, |span| span.size / 4);
        u32::try_from(span).expect("below 2^32")
    }

    /// The place of a patch of the portion in the batch's output (shared/offsets.wgsl): the sum of
    /// its own entry, its block's and its section's.
    pub(crate) fn patch_offset(&self, job: &Job, patch: u32) -> [u32; 2] {
        let entries = [patch, job.blocks_at + patch / 256, job.sections_at + patch / 65536];
        entries.map(|entry| self.pair(Resource::Offsets, entry)).into_iter().fold([0; 2], sum)
    }

    /// The ranges of the portion's elements: `[begin, end]` of points and of primitives.
    pub(crate) fn ranges(&self, job: &Job) -> [[u32; 2]; 2] {
        let at = STATUS_RANGES + 4 * job.portion;
        let word = |word| self.word(Resource::Status, at + word);
        [[word(0), word(1)], [word(2), word(3)]]
    }

    /// Whether the output does not fit, so that none of it is written.
    pub(crate) fn is_overflow(&self) -> bool {
        self.word(Resource::Status, STATUS_OVERFLOW) != 0
    }
}

/// Words of the status: four of totals, then these.
pub(crate) const STATUS_OVERFLOW: u32 = 4;
pub(crate) const STATUS_RANGES: u32 = 8;

/// The sum of two pairs, modulo 2^32.
pub(crate) fn sum(a: [u32; 2], b: [u32; 2]) -> [u32; 2] {
    [a[0].wrapping_add(b[0]), a[1].wrapping_add(b[1])]
}

/// Points and primitives of a patch.
pub(crate) fn counts(patch: &Patch) -> [u32; 2] {
    [patch.counts().points, patch.counts().primitives]
}

/// The value of a constant in the prelude of `layout/setup.wgsl`, which host and shaders share.
pub(crate) fn constant(setup: Setup, name: &str) -> u32 {
    let source = Stage::List.source(setup);
    let line = format!("const {name} = ");
    let found = source.lines().find_map(|it| it.strip_prefix(&line)?.strip_suffix("u;"));
    found.and_then(|number| number.parse().ok()).unwrap_or_else(|| panic!("no constant {name}"))
}
