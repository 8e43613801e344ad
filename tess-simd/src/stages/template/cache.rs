//! The search for templates: sets of four topologies, with the places of their indices and points.
//!
//! `template.rs` has the picture and the worked patch.

use super::room::TemplateRoom;
use alloc::vec::Vec;

/// The first number of sets, and the factor by which it grows.
const FIRST_SETS: usize = 32;
const MORE_SETS: usize = 8;
/// Slots of a set. A topology that finds no free slot replaces another.
const WAYS: usize = 4;

/// At most `SETS` sets of topologies, with room for `INDICES` indices and `POINTS` points of their
/// templates.
#[derive(Clone, Debug)]
pub(super) struct Cache<I, P, const SETS: usize, const INDICES: usize, const POINTS: usize> {
    /// Empty before the first template; afterwards a power of two of sets.
    sets: Vec<Set>,
    /// The number of low bits of [`number`] that are not part of the set's number.
    other_bits: u32,
    /// The slot that is replaced next if a set is full.
    way: usize,
    pub(super) indices: TemplateRoom<I, INDICES>,
    pub(super) points: TemplateRoom<P, POINTS>,
}

/// The starts of up to four topologies' templates.
#[derive(Clone, Copy, Debug)]
struct Set {
    /// See [`PacketPatch::topology`](crate::stages::packet::PacketPatch::topology); 0 if the slot
    /// is free.
    topologies: [u64; WAYS],
    starts: [Start; WAYS],
}

/// The place where a template begins.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(crate) struct Start {
    point: u16,
    /// In steps of [`INDEX_STEP`].
    index: u16,
}

/// Indices of templates begin at multiples of this, so that their places fit 16 bits.
pub(super) const INDEX_STEP: usize = 4;

impl Start {
    /// The start of no template.
    pub(super) const NONE: Self = Self { point: u16::MAX, index: u16::MAX };
}

/// One patch's template.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Template<'a, I, P> {
    /// Indices counted from the patch's first point, followed by unspecified elements.
    pub(crate) indices: &'a [I],
    /// Points, followed by unspecified elements.
    pub(crate) points: &'a [P],
}

impl Set {
    const EMPTY: Self =
        Self { topologies: [0; WAYS], starts: [Start { point: 0, index: 0 }; WAYS] };

    /// The slot of a topology; [`WAYS`] or more if it has none.
    #[inline(always)]
    fn find(&self, topology: u64) -> usize {
        // All four are compared without a branch: which of them matches cannot be predicted. If
        // none does, `found` is 0 and has 32 trailing zeros, which is no way.
        let mut found = 0_u32;
        for (way, &other) in self.topologies.iter().enumerate() {
            found |= u32::from(other == topology) << way;
        }
        found.trailing_zeros() as usize
    }

    /// The first slot that no topology has.
    fn free(&self) -> Option<usize> {
        self.topologies.iter().position(|&topology| topology == 0)
    }
}

impl<I, P, const SETS: usize, const INDICES: usize, const POINTS: usize>
    Cache<I, P, SETS, INDICES, POINTS>
where
    I: Copy + Default,
    P: Copy + Default,
{
    /// No templates, and no memory for any.
    pub(super) const fn new() -> Self {
        let other_bits = u64::BITS - FIRST_SETS.ilog2();
        Self {
            sets: Vec::new(),
            other_bits,
            way: 0,
            indices: TemplateRoom::new(),
            points: TemplateRoom::new(),
        }
    }

    /// Bytes of heap memory.
    pub(super) const fn bytes(&self) -> usize {
        self.sets.capacity() * size_of::<Set>() + self.indices.bytes() + self.points.bytes()
    }

    /// Allocates all the memory that the cache may ever need.
    pub(super) fn reserve(&mut self) {
        while self.sets.len() < SETS {
            self.make_sets();
        }
        self.indices.reserve();
        self.points.reserve();
    }

    /// Makes room for templates of these sizes. If there is none, all templates are forgotten.
    /// Returns whether they were.
    #[inline(always)]
    pub(super) fn make_room(&mut self, points: usize, indices: usize) -> bool {
        let full = !(self.indices.fits(indices) && self.points.fits(points));
        if full {
            self.forget();
        }
        full
    }

    /// Whether the number of sets has grown.
    pub(super) const fn has_many(&self) -> bool {
        self.sets.len() > FIRST_SETS
    }

    #[cold]
    fn forget(&mut self) {
        self.sets.fill(Set::EMPTY);
        self.indices.clear();
        self.points.clear();
    }

    /// The start of a topology's template, if it has one.
    #[inline(always)]
    pub(super) fn find(&self, topology: u64) -> Option<Start> {
        let set = self.sets.get(self.set(topology))?;
        set.starts.get(set.find(topology)).copied()
    }

    /// The number of a topology's set.
    #[inline(always)]
    #[expect(clippy::cast_possible_truncation, reason = "the upper eleven bits at most")]
    const fn set(&self, topology: u64) -> usize {
        (number(topology) >> self.other_bits) as usize
    }

    /// The template at a start that was found after the last `make_room`.
    #[inline(always)]
    pub(super) fn get(&self, Start { point, index }: Start) -> Template<'_, I, P> {
        Template {
            indices: self.indices.from(INDEX_STEP * usize::from(index)),
            points: self.points.from(point.into()),
        }
    }

    /// Makes the first free points and indices the template of a topology that has none.
    #[expect(clippy::cast_possible_truncation, reason = "at most 64 Ki places of either kind")]
    pub(super) fn add(&mut self, topology: u64, points: usize, indices: usize) -> Start {
        let index = self.indices.take(indices.next_multiple_of(INDEX_STEP)) / INDEX_STEP;
        let start = Start { point: self.points.take(points) as u16, index: index as u16 };
        self.enter(topology, start);
        start
    }

    /// Enters a topology that has no slot. If its set is full, adds sets, up to the most.
    fn enter(&mut self, topology: u64, start: Start) {
        // A set that is full is rarely full of topologies that will all be used again, so more sets
        // are tried first. This ends: after 2048 sets a slot is taken from another topology.
        let free = loop {
            let set = self.sets.get(self.set(topology));
            let free = set.and_then(|set| set.free());
            if free.is_some() || self.sets.len() == SETS {
                break free;
            }
            self.make_sets();
        };
        // The slots of all sets are replaced in turn, which needs no clock per set.
        let way = free.unwrap_or(self.way);
        self.way = (way + 1) % WAYS;
        let set = self.set(topology);
        self.sets[set].topologies[way] = topology;
        self.sets[set].starts[way] = start;
    }

    /// Makes the first sets, or more of them, and enters the existing topologies again.
    fn make_sets(&mut self) {
        let sets = (self.sets.len() * MORE_SETS).max(FIRST_SETS);
        let before = core::mem::replace(&mut self.sets, alloc::vec![Set::EMPTY; sets]);
        self.other_bits = u64::BITS - sets.ilog2();
        // Starts stay valid, because the rooms do not move their elements. Each new set gets
        // topologies of one old set, at most four: none is lost here.
        for Set { topologies, starts } in before {
            for (topology, start) in topologies.into_iter().zip(starts).filter(|entry| entry.0 != 0)
            {
                self.enter(topology, start);
            }
        }
    }
}

/// The number whose upper bits are a topology's set. The bits of the outer factors are folded down,
/// then the result is multiplied by 2^64 over the golden ratio. Of folds by 14 to 43 bits, a fold
/// by 24 leaves the fewest topologies without a slot: at most 61 of 4096 quads or triangles with
/// small factors, where 21 bits left 481.
#[inline(always)]
const fn number(topology: u64) -> u64 {
    (topology ^ (topology >> 24)).wrapping_mul(0x9E37_79B9_7F4A_7C15)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tour;

    /// The sets in the head of `template.rs`.
    #[test]
    fn the_worked_patch() {
        let topology = tour::packet().patch(0).topology();
        let mut cache = Cache::<u8, u8, 2048, 1000, 1000>::new();
        cache.add(topology, 43, 186);
        for (set, sets) in [(0, 32), (1, 256), (8, 2048)] {
            assert_eq!(cache.sets.len(), sets, "sets");
            assert_eq!(cache.set(topology), set, "its set");
            assert_eq!(cache.sets[set].find(topology), 0, "its slot");
            if sets < 2048 {
                cache.make_sets();
            }
        }
        assert_eq!((cache.points.used(), cache.indices.used()), (43, 188), "room that is used");
        cache.forget();
        assert!(cache.find(topology).is_none(), "forgotten");
    }
}
