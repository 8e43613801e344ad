//! FNV-1a digests of outputs, as `golden/README.md` defines them.

use tess_core::{DomainPoint, FactorContext, Tessellation};

/// A 64-bit FNV-1a digest of little-endian 32-bit words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fnv1a(u64);

/// The digest of no data: the offset basis.
impl Default for Fnv1a {
    fn default() -> Self {
        Self(0xCBF2_9CE4_8422_2325)
    }
}

impl Fnv1a {
    /// Adds words to the digest.
    pub fn words(&mut self, words: impl IntoIterator<Item = u32>) {
        let step = |digest: u64, byte| (digest ^ u64::from(byte)).wrapping_mul(0x100_0000_01B3);
        self.0 = words
            .into_iter()
            .fold(self.0, |digest, word| word.to_le_bytes().into_iter().fold(digest, step));
    }

    /// Adds points to the digest: u, then v of each.
    fn points(&mut self, points: &[DomainPoint]) {
        self.words(points.iter().flat_map(|point| [point.u.to_bits(), point.v.to_bits()]));
    }

    /// Adds a whole patch to the digest, as chained rows do: the point count, the index count, the
    /// points and the indices. An implementation under test may return more elements than a patch
    /// has, but never 2^32.
    pub fn patch(&mut self, patch: &Tessellation) {
        let count = |elements| u32::try_from(elements).unwrap_or(u32::MAX);
        self.words([patch.points.len(), patch.indices.len()].map(count));
        self.points(&patch.points);
        self.words(patch.indices.iter().copied());
    }

    /// Adds the six numbers of a context to the digest, in the order of the list in spec section 4.
    pub(crate) fn context(&mut self, context: &FactorContext) {
        self.words([
            context.inv_floor,
            context.inv_ceil,
            context.fraction,
            context.half_points,
            context.split_position,
            context.points,
        ]);
    }

    /// The digest so far.
    #[must_use]
    pub const fn finish(self) -> u64 {
        self.0
    }
}

/// The digest of points without a count.
pub(crate) fn points_digest(points: &[DomainPoint]) -> u64 {
    let mut digest = Fnv1a::default();
    digest.points(points);
    digest.finish()
}

/// The digest of indices, or of any words.
pub(crate) fn words_digest(words: &[u32]) -> u64 {
    let mut digest = Fnv1a::default();
    digest.words(words.iter().copied());
    digest.finish()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Published values: the empty string, and the bytes "foob" as one little-endian word.
    #[test]
    fn published_values() {
        assert_eq!(Fnv1a::default().finish(), 0xCBF2_9CE4_8422_2325, "offset basis");
        let foob = words_digest(&[u32::from_le_bytes(*b"foob")]);
        assert_eq!(foob, 0xDD12_0E79_0C25_12AF, "foob: {foob:#x}");
    }
}
