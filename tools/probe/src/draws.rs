//! Patches as a device receives them: cut into draws, with factors as words.

use tess_core::{Config, Partitioning, PatchFactors};
use tess_verify::Case;

/// The patches of a draw: the first one, and their number.
pub(crate) type DrawRange = (u32, u32);

/// The number of words per patch in the buffer of factors.
const FACTOR_WORDS: usize = 6;

/// The default for the largest number of vertices in a draw, as the model predicts it. Vertex
/// numbers of lavapipe wrap after 65536.
pub const DRAW_VERTICES: usize = 49152;

/// Cuts patches into draws of at most `most` vertices, or of a single patch.
pub(crate) fn draws(expected: &[usize], most: usize) -> Vec<DrawRange> {
    let mut draws: Vec<DrawRange> = Vec::new();
    let mut vertices = 0;
    for (number, &own) in (0..).zip(expected) {
        vertices += own;
        match draws.last_mut() {
            Some((_, count)) if vertices <= most => *count += 1,
            _ => {
                draws.push((number, 1));
                vertices = own;
            }
        }
    }
    draws
}

/// The words of a patch in the buffer of factors: four outer and two inside.
///
/// Vulkan lacks `pow2`, so its factors are rounded to powers of two here. A culled patch is left
/// unchanged.
pub(crate) fn words_of(config: Config, factors: PatchFactors) -> [u32; FACTOR_WORDS] {
    let case = Case { config, factors };
    let rounded = match (config.partitioning, case.patch().processed().factors()) {
        (Partitioning::Pow2, Some(factors)) => factors.map(|f| f32::from_bits(f.rounded)),
        _ => factors,
    };
    let mut words = [0; FACTOR_WORDS];
    let bits = |factor: f32| factor.to_bits();
    words.iter_mut().zip(rounded.outer().map(bits)).for_each(|(word, bits)| *word = bits);
    words[4..].iter_mut().zip(rounded.inside().map(bits)).for_each(|(word, bits)| *word = bits);
    words
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn draws_have_as_many_vertices_as_they_may() {
        let expected = [40, 60, 1, 0, 200, 30];
        assert_eq!(draws(&expected, 100), [(0, 2), (2, 2), (4, 1), (5, 1)], "one patch has more");
        assert_eq!(draws(&expected, 1000), [(0, 6)], "all in one");
        assert_eq!(draws(&[], 100), [], "no patches, no draws");
    }
}
