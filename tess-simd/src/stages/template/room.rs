//! The memory of templates: one after another, growing with them.

use alloc::vec::Vec;

/// Elements that can be read after the last template, so that whole blocks are copied.
pub(super) const PADDING: usize = 128;

/// Elements that are allocated for the first template. Later the memory doubles.
const LEAST: usize = 1024;

/// The indices or the points of all templates, at most `MOST` elements with the padding.
#[derive(Clone, Debug)]
pub(super) struct TemplateRoom<T, const MOST: usize> {
    all: Vec<T>,
    used: usize,
}

impl<T: Copy + Default, const MOST: usize> TemplateRoom<T, MOST> {
    /// No elements, and no memory for any.
    pub(super) const fn new() -> Self {
        Self { all: Vec::new(), used: 0 }
    }

    /// Bytes of heap memory.
    pub(super) const fn bytes(&self) -> usize {
        self.all.capacity() * size_of::<T>()
    }

    /// Allocates the memory of all elements.
    pub(super) fn reserve(&mut self) {
        self.grow(MOST);
    }

    /// Elements that are used by templates.
    #[cfg(test)]
    pub(super) const fn used(&self) -> usize {
        self.used
    }

    /// Whether this many more elements fit.
    #[inline(always)]
    pub(super) const fn fits(&self, more: usize) -> bool {
        self.used + more + PADDING <= MOST
    }

    /// Forgets all elements; keeps their memory.
    pub(super) const fn clear(&mut self) {
        self.used = 0;
    }

    /// The free elements: at least this many, plus the padding. They must fit ([`Self::fits`]).
    pub(super) fn free(&mut self, elements: usize) -> &mut [T] {
        let needed = self.used + elements + PADDING;
        debug_assert!(needed <= MOST, "{needed} elements do not fit");
        if self.all.len() < needed {
            self.grow(needed.max(LEAST).max(2 * self.all.len()).min(MOST));
        }
        &mut self.all[self.used..]
    }

    /// Marks the first `elements` free elements as used; returns the place of the first.
    pub(super) const fn take(&mut self, elements: usize) -> usize {
        let first = self.used;
        self.used += elements;
        first
    }

    /// The elements that begin at a place.
    #[inline(always)]
    pub(super) fn from(&self, place: usize) -> &[T] {
        self.all.get(place..).unwrap_or_default()
    }

    fn grow(&mut self, elements: usize) {
        self.all.reserve_exact(elements - self.all.len());
        self.all.resize(elements, T::default());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Memory is allocated with the first elements, doubles, and stops at the room's limit.
    #[test]
    fn memory_follows_the_elements() {
        let mut room = TemplateRoom::<u16, 4000>::new();
        assert_eq!(room.bytes(), 0, "at first");
        let mut lengths = Vec::new();
        while room.fits(500) {
            let free = room.free(500);
            assert!(free.len() >= 500 + PADDING, "{} free elements", free.len());
            free[0] = 7;
            let first = room.take(500);
            assert_eq!(room.from(first)[0], 7, "the elements that were free");
            lengths.push(room.bytes() / 2);
        }
        assert_eq!(lengths, [1024, 2048, 2048, 4000, 4000, 4000, 4000], "elements");
        room.clear();
        assert_eq!((room.take(1), room.bytes()), (0, 8000), "from the front, in the same memory");
    }
}
