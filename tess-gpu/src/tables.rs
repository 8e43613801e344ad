//! The constants that shaders look up: reciprocals, and the steps of every stitch.

use tess_core::SplitOrder;
use tess_core::reciprocal::reciprocal;
use tess_core::ruler::has_point;

/// Where the reciprocals of 1..=64 are.
pub const RECIPROCALS_AT: u32 = 0;
/// Where the steps are: a block for each stitch that there is, of [`BLOCK_WORDS`] words, each with
/// two steps, the first in its low half. The block `64 * (outer - 2) + inner` is the transition
/// between an outer edge of `outer` points and `inner` points of ring 1.
///
/// A step has in bits 0..=6 the vertex of the outer row that it stands on; its number less that
/// is the vertex of the inner row. Bit 7 says that it advances along the inner row, bit 8 that its
/// triangle begins with the inner row's vertex; else it begins with the outer row's.
pub const STEPS_AT: u32 = 64;
/// Words of a block: 126 steps and 2 unused ones.
pub const BLOCK_WORDS: u32 = 128;
/// The block of triangles around one inner vertex.
pub const FAN_BLOCK: u32 = 64 + 1;
/// The block before those of stitches between interior rings, by the points of the inner row.
pub const RING_BLOCK: u32 = 64 * 64;
/// The block before those of centre strips with a different quad in the middle, by their quads.
pub const MIRRORED_BLOCK: u32 = RING_BLOCK + 64;
/// The block of all other centre strips.
pub const STRIP_BLOCK: u32 = MIRRORED_BLOCK + 64;
/// Words of the whole table.
pub const WORDS: u32 = STEPS_AT + BLOCK_WORDS * (STRIP_BLOCK + 1);

/// All tables of a split order, [`WORDS`] words.
#[must_use]
pub fn tables(split: SplitOrder) -> Vec<u32> {
    let mut words: Vec<u32> = (1..=64).filter_map(reciprocal).collect();
    for outer in 2..=65 {
        add_block(&mut words, &[]);
        (1..=63).for_each(|inner| add_block(&mut words, &transition(split, outer, inner)));
    }
    add_block(&mut words, &[]);
    (1..=63).for_each(|inner| add_block(&mut words, &ring(inner)));
    (0..=63).for_each(|quads| add_block(&mut words, &strip(quads, Some(quads / 2))));
    add_block(&mut words, &strip(63, None));
    words
}

fn add_block(words: &mut Vec<u32>, steps: &[u32]) {
    let step = |number| steps.get(number).copied().unwrap_or(0);
    words.extend((0..128).map(|number| step(number) | step(number + 1) << 16));
}

/// Where a stitch stands on its two rows, and the steps so far.
#[derive(Default)]
struct Walk {
    outer: u32,
    inner: u32,
    steps: Vec<u32>,
}

const ADVANCES_INNER: u32 = 1 << 7;
const BEGINS_INNER: u32 = 1 << 8;

impl Walk {
    /// The triangle (outer, next outer, inner), or the same beginning with the last.
    fn advance_outer(&mut self, begins: u32) {
        self.steps.push(self.outer | begins);
        self.outer += 1;
    }

    /// The triangle (inner, outer, next inner), or (outer, next inner, inner).
    fn advance_inner(&mut self, begins: u32) {
        self.steps.push(self.outer | ADVANCES_INNER | begins);
        self.inner += 1;
    }
}

/// Spec section 7.2.
fn transition(split: SplitOrder, outer_points: u32, inner_points: u32) -> Vec<u32> {
    let (outer_half, inner_half) = ((outer_points - 1) / 2, inner_points.div_ceil(2));
    let mut walk = Walk::default();
    if outer_half > 0 {
        walk.advance_outer(0);
    }
    for k in 1..=32 {
        if has_point(split, k, inner_half) {
            walk.advance_inner(BEGINS_INNER);
        }
        if has_point(split, k, outer_half) {
            walk.advance_outer(0);
        }
    }
    let (inside_is_odd, outer_is_odd) =
        (inner_points.is_multiple_of(2), outer_points.is_multiple_of(2));
    if inside_is_odd {
        walk.advance_inner(BEGINS_INNER);
    }
    if outer_is_odd {
        walk.advance_outer(BEGINS_INNER);
    }
    for k in (1..=32).rev() {
        if has_point(split, k, outer_half) {
            walk.advance_outer(0);
        }
        if has_point(split, k, inner_half) {
            walk.advance_inner(BEGINS_INNER);
        }
    }
    if outer_half > 0 {
        walk.advance_outer(0);
    }
    walk.steps
}

/// Spec section 7.3.
fn ring(inner_points: u32) -> Vec<u32> {
    let mut walk = Walk::default();
    walk.advance_outer(0);
    for p in 0..inner_points - 1 {
        if p < inner_points / 2 {
            walk.advance_inner(0);
            walk.advance_outer(0);
        } else {
            walk.advance_outer(BEGINS_INNER);
            walk.advance_inner(BEGINS_INNER);
        }
    }
    walk.advance_outer(0);
    walk.steps
}

/// Spec section 7.4: quads between two sides of a ring. Their diagonals are mirrored about quad
/// `middle` if there is one, whose own goes the other way.
fn strip(quads: u32, middle: Option<u32>) -> Vec<u32> {
    let mut walk = Walk::default();
    for quad in 0..quads {
        if middle == Some(quad) {
            walk.advance_inner(0);
            walk.advance_outer(0);
        } else {
            walk.advance_outer(if middle.is_some() { 0 } else { BEGINS_INNER });
            walk.advance_inner(BEGINS_INNER);
        }
    }
    walk.steps
}
