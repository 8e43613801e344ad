//! Rows of vertex indices, the two sides of a stitch (spec section 7.1).

/// A list of vertex indices that run up or down by one, with at most one entry replaced.
///
/// The replaced entry is where a ring closes: its last edge ends on the ring's first point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    first: u32,
    /// The difference from each entry to the next, modulo 2^32.
    step: u32,
    replaced_at: u32,
    replaced: u32,
}

/// An entry that no row has, because no row is this long.
const NOWHERE: u32 = u32::MAX;

impl Row {
    /// `first, first + 1, ...`
    #[must_use]
    pub const fn ascending(first: u32) -> Self {
        Self { first, step: 1, replaced_at: NOWHERE, replaced: 0 }
    }

    /// `first, first - 1, ...`
    #[must_use]
    pub const fn descending(first: u32) -> Self {
        Self { step: 1u32.wrapping_neg(), ..Self::ascending(first) }
    }

    /// The same row with entry `k` replaced by `index`.
    #[must_use]
    pub const fn with(self, k: u32, index: u32) -> Self {
        Self { replaced_at: k, replaced: index, ..self }
    }

    /// Entry `k`, modulo 2^32.
    #[must_use]
    pub const fn index(&self, k: u32) -> u32 {
        if k == self.replaced_at {
            self.replaced
        } else {
            self.first.wrapping_add(self.step.wrapping_mul(k))
        }
    }
}
