//! Reciprocals of 1..=64, the one table of point placement (spec section 2).

use crate::fixed_point::ONE;

/// `reciprocal(n)` at index `n - 1`.
const TABLE: [u32; 64] = {
    let mut table = [0; 64];
    let mut n = 1;
    while n <= 64 {
        table[n as usize - 1] = (ONE + n / 2) / n;
        n += 1;
    }
    table
};

/// 1/n with 16 fraction bits, rounded half up, for `n` in 1..=64; `None` for any other `n`, of
/// which the hardware's table has none.
#[must_use]
pub const fn reciprocal(n: u32) -> Option<u32> {
    if n >= 1 && n <= 64 { Some(TABLE[n as usize - 1]) } else { None }
}
