//! Rows of vertex indices, the two sides of a stitch (spec section 7.1).

/// A list of vertex indices that run up or down by one, with at most one entry replaced.
///
/// The replaced entry is where a ring closes: its last edge ends on the ring's first point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Row {
    first: u32,
    descending: bool,
    replaced: Option<(u32, u32)>,
}

impl Row {
    /// `first, first + 1, ...`
    #[must_use]
    pub const fn ascending(first: u32) -> Self {
        Self { first, descending: false, replaced: None }
    }

    /// `first, first - 1, ...`
    #[must_use]
    pub const fn descending(first: u32) -> Self {
        Self { first, descending: true, replaced: None }
    }

    /// The same row with entry `k` replaced by `index`.
    #[must_use]
    pub const fn with(self, k: u32, index: u32) -> Self {
        Self { replaced: Some((k, index)), ..self }
    }

    /// Entry `k`, modulo 2^32: on a descending row, entries beyond 0 wrap around.
    #[must_use]
    pub const fn index(&self, k: u32) -> u32 {
        match self.replaced {
            Some((at, index)) if at == k => index,
            _ if self.descending => self.first.wrapping_sub(k),
            _ => self.first.wrapping_add(k),
        }
    }
}
