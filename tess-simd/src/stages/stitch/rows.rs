//! Stitches between two rows of vertices (spec section 7.1).

use super::step_code::{self, NOWHERE};
use crate::data::format::IndexFormat;
use crate::data::writer::Writer;
use core::ops::Range;

/// The codes of one stitch, padded so that whole blocks of them can be read, and their number
/// without the padding.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Codes<'a> {
    pub(crate) codes: &'a [i8],
    pub(crate) length: usize,
}

/// The two sides of a stitch. Entry `k` of a row is its first index plus `k`, modulo 2^32. The
/// inner row may run down instead, and one entry of each row may be replaced by another index.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Rows {
    /// First index of the outer row.
    pub(crate) outer: u32,
    /// First index of the inner row.
    pub(crate) inner: u32,
    /// Whether the inner row runs down.
    pub(crate) descending: bool,
    /// The entry of the outer row that is replaced.
    pub(crate) outer_replaced: Option<Replaced>,
    /// The entry of the inner row that is replaced.
    pub(crate) inner_replaced: Option<Replaced>,
}

/// A replaced entry: entry `at` of a row is `index`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Replaced {
    pub(crate) at: u32,
    pub(crate) index: u32,
}

impl Codes<'_> {
    /// No triangles.
    pub(crate) const NONE: Self = Self { codes: &[], length: 0 };

    /// The triangles of these steps.
    #[inline(always)]
    pub(crate) fn of_steps(self, steps: Range<u32>) -> Self {
        Self {
            codes: self.codes.get(3 * steps.start as usize..).unwrap_or_default(),
            length: 3 * steps.len(),
        }
    }

    /// Emits the stitch between rows that run up by one from these first indices, in blocks of `N`.
    #[inline(always)]
    pub(crate) fn emit_ascending<I: IndexFormat, const N: usize>(
        self,
        outer: u32,
        inner: u32,
        out: &mut Writer<'_, I>,
    ) {
        let outer = I::wrapping_from(outer);
        let inner = I::wrapping_from(inner.wrapping_add(128));
        out.map::<_, N>(self.length, self.codes, |code: i8| {
            I::from_code(code).wrapping_add(if code < 0 { inner } else { outer })
        });
    }

    /// Emits the stitch between any two rows, in blocks of `N`.
    #[inline(always)]
    pub(crate) fn emit<I: IndexFormat, const N: usize>(self, rows: &Rows, out: &mut Writer<'_, I>) {
        // In a row that runs down, entry k is first - k = first + 1 + !k = (first - 127) + !code,
        // because !k = !(code + 128) = !code - 128.
        let (flip, inner) = if rows.descending {
            (I::from_code(-1), rows.inner.wrapping_sub(127))
        } else {
            (I::from_code(0), rows.inner.wrapping_add(128))
        };
        let outer = I::wrapping_from(rows.outer);
        let inner = I::wrapping_from(inner);
        let (outer_at, outer_index) = match rows.outer_replaced {
            Some(Replaced { at, index }) => (step_code::outer(at), index),
            None => (NOWHERE, 0),
        };
        let (inner_at, inner_index) = match rows.inner_replaced {
            Some(Replaced { at, index }) => (step_code::inner(at), index),
            None => (NOWHERE, 0),
        };
        let (outer_index, inner_index) =
            (I::wrapping_from(outer_index), I::wrapping_from(inner_index));
        // Every code is compared with both replaced entries. `NOWHERE` is none's code, so a row
        // without a replaced entry needs no branch of its own.
        out.map::<_, N>(self.length, self.codes, |code: i8| {
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
}
