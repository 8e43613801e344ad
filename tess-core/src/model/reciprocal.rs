//! Reciprocals of 1..=64, the only table of point placement (spec section 2).

use crate::model::fixed_point::ONE;

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

/// 1/n with 16 fraction bits, rounded half up, for `n` in 1..=64; `None` for any other `n`, which
/// the hardware's table does not have.
#[must_use]
pub const fn reciprocal(n: u32) -> Option<u32> {
    if n >= 1 && n <= 64 { Some(TABLE[n as usize - 1]) } else { None }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_outside_the_table_have_no_reciprocal() {
        assert_eq!([1, 3, 64].map(reciprocal), [Some(65536), Some(21845), Some(1024)], "inside");
        assert_eq!([0, 65, u32::MAX].map(reciprocal), [None; 3], "outside");
    }
}
