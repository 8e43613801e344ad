//! The constants that shaders look up: reciprocals, and the steps of half transitions.

use tess_core::SplitOrder;
use tess_core::reciprocal::reciprocal;
use tess_core::ruler::has_point;

/// Where the reciprocals of 1..=64 are.
pub const RECIPROCALS_AT: u32 = 0;
/// Where the steps are: two words for each half edge `outer` and `inner` of 0..=32 points, at
/// `STEPS_AT + 2 * (33 * outer + inner)`.
pub const STEPS_AT: u32 = 64;
/// Words of the whole table.
pub const WORDS: u32 = STEPS_AT + 2 * 33 * 33;

/// All tables of a split order, [`WORDS`] words.
#[must_use]
pub fn tables(split: SplitOrder) -> Vec<u32> {
    let reciprocals = (1..=64).map(reciprocal);
    let pairs = (0..=32).flat_map(|outer| (0..=32).map(move |inner| (outer, inner)));
    let steps = pairs.flat_map(|(outer, inner)| {
        let bits = half_steps(split, outer, inner).to_le_bytes();
        let [a, b, c, d, e, f, g, h] = bits;
        [u32::from_le_bytes([a, b, c, d]), u32::from_le_bytes([e, f, g, h])]
    });
    reciprocals.chain(steps).collect()
}

/// The first half of a transition (spec section 7.2, steps 1 and 2), step by step from bit 0: set
/// if the step advances on the outer row. At most 63 steps.
fn half_steps(split: SplitOrder, outer: u32, inner: u32) -> u64 {
    let mut bits = 0;
    let mut next = 1;
    let mut step = |advances_outer: bool| {
        if advances_outer {
            bits |= next;
        }
        next <<= 1;
    };
    if outer > 0 {
        step(true);
    }
    for k in 1..=32 {
        if has_point(split, k, inner) {
            step(false);
        }
        if has_point(split, k, outer) {
            step(true);
        }
    }
    bits
}
