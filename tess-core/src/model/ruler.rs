//! The order in which points join a half edge (spec sections 7.2 and 10).

use crate::model::state::SplitOrder;

/// Ruler order: a half edge of `h` points has those positions `k` with `RULER[k] < h`.
const RULER: [u8; 33] = [
    0, 32, 16, 8, 17, 4, 18, 9, 19, 2, 20, 10, 21, 5, 22, 11, 23, //
    1, 24, 12, 25, 6, 26, 13, 27, 3, 28, 14, 29, 7, 30, 15, 31,
];

/// Row `half`: the positions in 1..=32 of ruler order whose rank is below `half`, ascending. Each
/// rank in 1..=32 has one position, so the first `half - 1` entries are used; the rest are 0.
const POSITIONS: [[u8; 32]; 34] = {
    let mut rows = [[0; 32]; 34];
    let mut half = 0;
    while half < 34 {
        let (mut k, mut found) = (1, 0);
        while k <= 32 {
            if RULER[k as usize] < half {
                rows[half as usize][found] = k;
                found += 1;
            }
            k += 1;
        }
        half += 1;
    }
    rows
};

/// The rank at which position `k` of a half edge receives its point, for `k` in 0..=32; `None` for
/// larger `k`, which no half edge has.
#[must_use]
pub const fn rank(split: SplitOrder, k: u32) -> Option<u32> {
    if k > 32 {
        return None;
    }
    Some(match split {
        SplitOrder::Ruler => RULER[k as usize] as u32,
        SplitOrder::Centre => k,
    })
}

/// Whether a half edge of `half` points has a point at position `k`. False if `k` is above 32.
#[must_use]
pub const fn has_point(split: SplitOrder, k: u32, half: u32) -> bool {
    k <= 32
        && match split {
            SplitOrder::Ruler => (RULER[k as usize] as u32) < half,
            SplitOrder::Centre => k < half,
        }
}

/// The positions in 1..=32 at which a half edge of `half` points has one, ascending.
#[must_use]
pub fn positions(split: SplitOrder, half: u32) -> &'static [u8] {
    let half = half.min(33) as usize;
    let row = match split {
        SplitOrder::Ruler => half,
        SplitOrder::Centre => 33, // all positions
    };
    &POSITIONS[row][..half.saturating_sub(1)]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_where_a_half_edge_has_points() {
        for split in SplitOrder::ALL {
            for half in (0..40).chain([u32::MAX]) {
                let expected = (1..=32).filter(|&k| has_point(split, k.into(), half));
                let positions = positions(split, half).iter().copied();
                assert!(positions.eq(expected), "{split:?}, half {half}");
            }
        }
    }

    /// Apart from positions 0 and 1, the table is a breadth-first walk of a balanced binary tree.
    #[test]
    fn ruler_is_breadth_first_order() {
        let mut expected = [0u32; 33];
        let mut next = 1;
        for level in 0..5 {
            let step = 32 >> level;
            for node in 0..(1 << level) {
                expected[step / 2 + 1 + node * step] = next;
                next += 1;
            }
        }
        expected[1] = 32;
        for (k, &rank_expected) in (0..).zip(&expected) {
            assert_eq!(rank(SplitOrder::Ruler, k), Some(rank_expected), "position {k}");
        }
    }

    #[test]
    fn no_half_edge_has_a_position_beyond_32() {
        for split in SplitOrder::ALL {
            for k in [33, 34, u32::MAX] {
                assert_eq!(rank(split, k), None, "rank of {k}");
                assert!(!has_point(split, k, u32::MAX), "position {k}");
            }
        }
    }
}
