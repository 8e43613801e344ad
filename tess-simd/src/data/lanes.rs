//! Sixteen patches side by side.
//!
//! A *lane* is one patch of a packet. The sixteen lanes of a packet fill one vector of AVX-512, two
//! of AVX2 or four of SSE. A *column* is one quantity of all factors of a packet, factor by factor.
//! Stages are branch-free functions of one element, mapped over a column: plain loops over arrays
//! of a fixed size, which the compiler turns into vectors of the CPU level's width.

use tess_core::Domain;

/// Patches in a packet.
pub(crate) const LANES: usize = 16;

/// The most factors that a patch can have: those of a quad.
pub(crate) const MAX_FACTORS: usize = Domain::Quad.factors();

/// One quantity of the patches of a packet.
pub(crate) type Lanes<T = u32> = [T; LANES];

/// One quantity of all factors of a packet: element `[factor][lane]`.
pub(crate) type Column<T = u32> = [Lanes<T>; MAX_FACTORS];

/// Point counts of a patch's edges and inside axes, in the order of its factors.
pub(crate) type EdgePoints = [u32; MAX_FACTORS];

/// Whether an edge with this many points has odd parity: it has one segment fewer than points.
#[inline(always)]
pub(crate) const fn is_odd(points: u32) -> bool {
    points.is_multiple_of(2)
}

/// Sets `L` lanes: all of them, or only the lane with this number if `L` is 1.
#[inline(always)]
pub(crate) fn set<T: Copy, const L: usize>(lanes: &mut Lanes<T>, lane: usize, values: [T; L]) {
    if L == LANES {
        lanes.copy_from_slice(&values);
    } else {
        lanes[lane % LANES] = values[0];
    }
}

/// [`set`] for each of a column's first rows.
#[inline(always)]
pub(crate) fn set_rows<const L: usize>(column: &mut Column, lane: usize, rows: &[[u32; L]]) {
    for (lanes, row) in column.iter_mut().zip(rows) {
        set(lanes, lane, *row);
    }
}

/// Element `i` of all rows, counted through them. The compiler turns loops over `i` into vectors,
/// which may span several rows; it would unroll a loop over the sixteen elements of a row.
#[inline(always)]
pub(crate) const fn at<T: Copy, const L: usize, const F: usize>(rows: &[[T; L]; F], i: usize) -> T {
    if L == 1 { rows[i][0] } else { rows.as_flattened()[i] }
}

/// [`at`], as a mutable reference.
#[inline(always)]
pub(crate) const fn at_mut<T, const L: usize, const F: usize>(
    rows: &mut [[T; L]; F],
    i: usize,
) -> &mut T {
    if L == 1 { &mut rows[i][0] } else { &mut rows.as_flattened_mut()[i] }
}
