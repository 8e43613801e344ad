//! The memory that one file may take.
//!
//! A file can repeat what it has: nodes repeat meshes, accessors without a buffer view have any
//! number of elements, and skins have joints times nodes. Whatever a file can repeat is charged
//! here before it is made.

use std::cell::Cell;

/// The default of [`LoadOptions::max_memory`](crate::LoadOptions::max_memory): 4 GiB.
pub const MAX_MEMORY: u64 = 1 << 32;

/// The bytes charged for a face: its indices, its place, its edges and their neighbours.
pub(crate) const FACE: u64 = 192;

/// The bytes charged for a vertex: its position, normal and texture coordinates, and the table that
/// finds equal positions.
pub(crate) const VERTEX: u64 = 64;

/// The bytes that are left for one file.
#[derive(Debug)]
pub(crate) struct Budget {
    limit: u64,
    used: Cell<u64>,
    is_exceeded: Cell<bool>,
}

impl Budget {
    pub(crate) const fn new(limit: u64) -> Self {
        Self { limit, used: Cell::new(0), is_exceeded: Cell::new(false) }
    }

    /// Whether a charge was refused.
    pub(crate) const fn is_exceeded(&self) -> bool {
        self.is_exceeded.get()
    }

    /// Takes the bytes of `count` elements, which are called `noun`, of `size` bytes each. Errors:
    /// fewer bytes are left.
    pub(crate) fn charge(&self, count: u64, size: u64, noun: &str) -> Result<(), String> {
        let used = count.checked_mul(size).and_then(|bytes| bytes.checked_add(self.used.get()));
        match used.filter(|&used| used <= self.limit) {
            Some(used) => {
                self.used.set(used);
                Ok(())
            }
            None => {
                self.is_exceeded.set(true);
                let limit = self.limit;
                Err(format!(
                    "{count} {noun} of {size} bytes each, with what the file has before them, are \
                     more than the limit of {limit} bytes"
                ))
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Budget;

    #[test]
    fn the_last_byte_and_the_next() {
        let budget = Budget::new(100);
        assert_eq!(budget.charge(10, 9, "things"), Ok(()), "90 bytes");
        assert_eq!(budget.charge(10, 1, "things"), Ok(()), "all 100");
        assert!(!budget.is_exceeded(), "nothing was refused");
        let message = budget.charge(1, 1, "things").expect_err("one too many");
        assert!(message.starts_with("1 things of 1 bytes each"), "{message}");
        assert!(message.ends_with("the limit of 100 bytes"), "{message}");
        assert!(budget.is_exceeded(), "it was refused");
        assert!(Budget::new(u64::MAX).charge(u64::MAX, 2, "things").is_err(), "an overflow");
    }
}
