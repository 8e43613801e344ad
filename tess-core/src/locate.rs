//! The random-access formulation: any point or primitive from its number alone, in constant time.
//!
//! It is written from closed forms, not from the sequential walks, and a test compares the two on
//! every topology. Everything parallel is built on it.

mod centre_strip;
pub(crate) mod origin;
pub(crate) mod point;
pub(crate) mod primitive;
mod rings;
mod stitch;

/// The largest `ring` in `1..end` with `first(ring) <= target`, found bit by bit: five steps for
/// the at most 32 rings of a patch. `first` grows with the ring and `first(1) <= target`.
fn last_ring_at_or_before(target: u32, end: u32, first: impl Fn(u32) -> u32) -> u32 {
    let mut ring = 1;
    for step in [16, 8, 4, 2, 1] {
        if ring + step < end && first(ring + step) <= target {
            ring += step;
        }
    }
    ring
}

/// Splits `target` into the slot it falls into and the place within it, for slots of these sizes;
/// the last slot takes what is left.
fn slot_of<const N: usize>(target: u32, sizes: [u32; N]) -> (u32, u32) {
    let mut slot = 0;
    let mut place = target;
    for &size in &sizes[..N - 1] {
        if place < size {
            break;
        }
        place -= size;
        slot += 1;
    }
    (slot, place)
}
