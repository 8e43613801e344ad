//! Stitches as tables (spec sections 7.2 to 7.4).
//!
//! Which entries of its two rows a stitch connects depends on point counts and parities alone. A
//! table holds one *code* for each index: entry `k` of the outer row is `k`, entry `k` of the
//! inner row is `k - 128`. With rows that run up by one, an index is its code plus a constant
//! that its sign chooses. The tables are read off patches that the core tessellated.

mod tables;

pub(crate) use tables::{Stitches, Strip};

use crate::emit::Writer;
use crate::format::IndexFormat;

/// Codes turned into indices at a time; tables are padded to it.
pub(crate) const STEP: usize = 32;

/// What a row position gains as inner row.
pub(crate) const INNER: i8 = i8::MIN;

/// No position of any row.
const NOWHERE: i8 = i8::MAX;

/// The two sides of a stitch. `first + k`, except that the inner row may run down and that an
/// entry of each row may be replaced by another index.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rows {
    /// First index of the outer row.
    pub(crate) outer: u32,
    /// First index of the inner row.
    pub(crate) inner: u32,
    /// Whether the inner row runs down.
    pub(crate) descending: bool,
    /// Entry of the outer row that is replaced, and by what.
    pub(crate) outer_replaced: Option<(u32, u32)>,
    /// Entry of the inner row that is replaced, and by what.
    pub(crate) inner_replaced: Option<(u32, u32)>,
}

/// The code of an entry of the outer row, at most 64.
#[inline(always)]
#[expect(clippy::cast_possible_truncation, reason = "at most 64")]
const fn outer_code(k: u32) -> i8 {
    k as i8
}

/// The code of an entry of the inner row, at most 63.
#[inline(always)]
const fn inner_code(k: u32) -> i8 {
    outer_code(k) + INNER
}

/// Emits a stitch between rows that run up by one.
#[inline(always)]
pub(crate) fn ascending<I: IndexFormat>(
    out: &mut Writer<'_, I>,
    length: usize,
    codes: &[i8],
    outer: u32,
    inner: u32,
) {
    let outer = I::wrapping_from(outer);
    let inner = I::wrapping_from(inner.wrapping_add(128));
    out.map::<_, STEP>(length, codes, |code: i8| {
        I::from_code(code).wrapping_add(if code < 0 { inner } else { outer })
    });
}

/// Emits a stitch between any two rows.
#[inline(always)]
pub(crate) fn general<I: IndexFormat>(
    out: &mut Writer<'_, I>,
    length: usize,
    codes: &[i8],
    rows: &Rows,
) {
    // Running down, entry k is first - k = first + 1 + !k = (first - 127) + !(code), as ~k is
    // ~(code + 128) = ~code - 128.
    let (flip, inner) = if rows.descending {
        (I::from_code(-1), rows.inner.wrapping_sub(127))
    } else {
        (I::from_code(0), rows.inner.wrapping_add(128))
    };
    let outer = I::wrapping_from(rows.outer);
    let inner = I::wrapping_from(inner);
    let (outer_at, outer_index) = match rows.outer_replaced {
        Some((k, index)) => (outer_code(k), index),
        None => (NOWHERE, 0),
    };
    let (inner_at, inner_index) = match rows.inner_replaced {
        Some((k, index)) => (inner_code(k), index),
        None => (NOWHERE, 0),
    };
    let (outer_index, inner_index) = (I::wrapping_from(outer_index), I::wrapping_from(inner_index));
    out.map::<_, STEP>(length, codes, |code: i8| {
        let position = I::from_code(code);
        let index = if code < 0 {
            position.xor(flip).wrapping_add(inner)
        } else {
            position.wrapping_add(outer)
        };
        let index = if code == outer_at { outer_index } else { index };
        if code == inner_at { inner_index } else { index }
    });
}
