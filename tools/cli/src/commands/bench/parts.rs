//! Cuts a workload into parts on a CPU.

use std::ops::Range;

/// The smallest output of a part in bytes, unless there is less.
const MIB: u64 = 1 << 20;

/// Consecutive batches that together have about a mebibyte of output, from the bytes of each.
///
/// A batch of a single patch is too short to be timed; larger ones are parts by themselves.
pub(crate) fn parts(batch_bytes: &[u64]) -> Vec<Range<usize>> {
    let mut parts = Vec::new();
    let (mut start, mut bytes) = (0, 0);
    for (batch, more) in batch_bytes.iter().enumerate() {
        bytes += more;
        if bytes >= MIB {
            parts.push(start..batch + 1);
            (start, bytes) = (batch + 1, 0);
        }
    }
    if start < batch_bytes.len() {
        parts.push(start..batch_bytes.len());
    }
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_cover_all_batches() {
        assert_eq!(parts(&[]), [], "nothing");
        assert_eq!(parts(&[1, 2]).len(), 1, "small ones together");
        assert_eq!(parts(&[MIB, MIB + 1]), [0..1, 1..2], "large ones alone");
        assert_eq!(parts(&[MIB - 1, 1, MIB, 5]), [0..2, 2..3, 3..4], "a rest at the end");
    }
}
