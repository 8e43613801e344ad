//! The lengths of a divided line's segments.

use super::answer::TOLERANCE;
use super::levels::TessellationLevel;
use tess_core::fixed_point::ONE;

/// A level up to this many units of 2^-16 above a number of segments counts as just above it: the
/// shorter segments are then at most 1/[`VANISHING`] of a longer one.
const JUST_ABOVE: u32 = 256;
/// The divisor that bounds a shorter segment just above a number of segments. A length proportional
/// to the level's excess is at most 1/512 of a longer one there.
pub(super) const VANISHING: u32 = 16;

/// The fault in a line's lengths, if there is one.
#[expect(clippy::float_cmp, reason = "a level is the integer itself, or is not")]
#[expect(clippy::cast_precision_loss, reason = "at most 64")]
pub(super) fn unequal(along: &[u32], level: TessellationLevel) -> Option<String> {
    let is_integer = level.clamped() == level.segments() as f32;
    if !level.is_fractional() || is_integer {
        return equally_spaced(along);
    }
    let lengths: Vec<u32> = along.windows(2).map(|pair| pair[1] - pair[0]).collect();
    two_lengths(&lengths).or_else(|| not_vanishing(&lengths, level))
}

/// The first vertex that is too far from its place k/n.
fn equally_spaced(along: &[u32]) -> Option<String> {
    let n = u64::try_from(along.len().checked_sub(1)?).ok()?;
    (0..).zip(along).find_map(|(k, &x)| {
        // Multiplied by n, so that nothing is rounded.
        let off = (u64::from(x) * n).abs_diff(k * u64::from(ONE));
        (off > u64::from(TOLERANCE) * n)
            .then(|| format!("vertex {k} of {n} is at {x:05x}, more than 16 units from {k}/{n}"))
    })
}

/// The fault of a fractional division whose segments are not all of one length, except for a
/// mirrored pair of shorter ones.
fn two_lengths(lengths: &[u32]) -> Option<String> {
    let longest = *lengths.iter().max()?;
    let short: Vec<usize> =
        (0..lengths.len()).filter(|&k| lengths[k] + 2 * TOLERANCE < longest).collect();
    match short[..] {
        [] => None,
        [a, b]
            if a + b == lengths.len() - 1 && lengths[a].abs_diff(lengths[b]) <= 2 * TOLERANCE =>
        {
            None
        }
        [a, b] => Some(format!("segments {a} and {b} are shorter, and are not a mirrored pair")),
        _ => Some(format!("{} of {} segments are shorter, not two", short.len(), lengths.len())),
    }
}

/// The fault of shorter segments that are too long for a level just above the next lower number of
/// segments.
fn not_vanishing(lengths: &[u32], level: TessellationLevel) -> Option<String> {
    let excess = level.fixed().checked_sub((level.segments().checked_sub(2)?) << 16)?;
    let (short, long) = (*lengths.iter().min()?, *lengths.iter().max()?);
    (lengths.len() > 2 && excess <= JUST_ABOVE && short > long / VANISHING + TOLERANCE).then(|| {
        let fewer = level.segments() - 2;
        let level = level.raw;
        format!(
            "its level {level} is just above {fewer}, and its shorter segments are {short:05x} of {long:05x}"
        )
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers in `docs/rules.md` are those of the code.
    #[test]
    fn the_tolerance_is_the_documented_one() {
        let page = include_str!("../../../docs/rules.md");
        assert!(page.contains(&format!("{TOLERANCE}/65536 from its place")));
        assert!(page.contains(&format!("off by {}/65536", 2 * TOLERANCE)));
        assert!(page.contains(&format!("up to {JUST_ABOVE}/65536 above")));
        assert!(page.contains(&format!("1/{VANISHING} of")));
    }
}
