//! FNV-1a digests of outputs, as `golden/README.md` defines them.

use tess_core::{DomainPoint, FactorContext, Tessellation};

/// FNV-1a with 64 bits over little-endian 32-bit words.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fnv1a(u64);

/// The digest of no data: the offset basis.
impl Default for Fnv1a {
    fn default() -> Self {
        Self(0xCBF2_9CE4_8422_2325)
    }
}

impl Fnv1a {
    /// Continues over one word.
    const fn word(&mut self, word: u32) {
        let [a, b, c, d] = word.to_le_bytes();
        self.byte(a);
        self.byte(b);
        self.byte(c);
        self.byte(d);
    }

    const fn byte(&mut self, byte: u8) {
        self.0 = (self.0 ^ byte as u64).wrapping_mul(0x100_0000_01B3);
    }

    /// Continues over words.
    pub fn words(&mut self, words: impl IntoIterator<Item = u32>) {
        words.into_iter().for_each(|word| self.word(word));
    }

    /// Continues over points: u, then v of each.
    pub fn points(&mut self, points: &[DomainPoint]) {
        self.words(points.iter().flat_map(|point| [point.u.to_bits(), point.v.to_bits()]));
    }

    /// Continues over a whole patch, as chained rows do: point count, index count, points, indices.
    pub fn patch(&mut self, patch: &Tessellation) {
        self.word(count(&patch.points));
        self.word(count(&patch.indices));
        self.points(&patch.points);
        self.words(patch.indices.iter().copied());
    }

    /// Continues over the six numbers of a context, in the order of spec section 4's list.
    pub(crate) fn context(&mut self, context: &FactorContext) {
        self.words([
            context.inv_floor,
            context.inv_ceil,
            context.fraction,
            context.half_points,
            context.split,
            context.points,
        ]);
    }

    /// The digest so far.
    #[must_use]
    pub const fn finish(self) -> u64 {
        self.0
    }
}

/// The digest of points alone.
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

/// A length as a word of a digest. An implementation under test may return more than a patch has,
/// never 2^32 elements.
fn count<T>(elements: &[T]) -> u32 {
    u32::try_from(elements.len()).unwrap_or(u32::MAX)
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
