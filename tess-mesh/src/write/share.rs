//! Vertices that several patches have in common, each written once.
//!
//! Two vertices are one if all their values are equal. Only points on the border of a patch
//! can be those of another patch, so only these are looked up. Where patches disagree about a
//! normal or a texture coordinate, as on a hard edge or at the seam of an image, both vertices
//! stay.

use super::Block;
use rayon::prelude::*;
use std::collections::HashMap;

/// The vertices on borders that have been written.
#[derive(Debug, Default)]
pub(crate) struct Sharing {
    /// The number of each vertex, by 96 bits of a hash of its values. Among 2^32 vertices, two with
    /// one hash are expected once in 2^33 files.
    known: HashMap<[u32; 3], u32>,
    /// The number of vertices written so far.
    count: u32,
}

/// The vertices of a block that are written, and the numbers of all.
#[derive(Debug, Default)]
pub(crate) struct Shared {
    /// The places in the block of the vertices that are new.
    pub(crate) new: Vec<u32>,
    /// The number of each vertex of the block among all that are written.
    pub(crate) numbers: Vec<u32>,
}

impl Sharing {
    /// The number of vertices written so far.
    pub(crate) const fn count(&self) -> u32 {
        self.count
    }

    /// Numbers the vertices of a block.
    pub(crate) fn number(&mut self, block: &Block<'_>) -> Shared {
        let hashes = (0..block.vertices.len()).into_par_iter().with_min_len(1 << 12);
        let hashes: Vec<Option<[u32; 3]>> =
            hashes.map(|at| block.is_border[at].then(|| hash(block, at))).collect();
        let mut shared = Shared {
            new: Vec::with_capacity(hashes.len()),
            numbers: Vec::with_capacity(hashes.len()),
        };
        for (at, hash) in (0u32..).zip(hashes) {
            let next = self.count;
            let number = match hash {
                Some(hash) => *self.known.entry(hash).or_insert(next),
                None => next,
            };
            if number == next {
                self.count += 1;
                shared.new.push(at);
            }
            shared.numbers.push(number);
        }
        shared
    }
}

/// 96 bits that depend on every bit of a vertex's values.
fn hash(block: &Block<'_>, at: usize) -> [u32; 3] {
    let vertex = &block.vertices[at];
    let mut mix = [0x9E37_79B9_7F4A_7C15u64, 0xC2B2_AE3D_27D4_EB4F];
    let mut add = |value: f32| {
        // Zeros of either sign are one number.
        let word = u64::from((value + 0.0).to_bits());
        mix[0] = (mix[0] ^ word).wrapping_mul(0xFF51_AFD7_ED55_8CCD);
        mix[0] ^= mix[0] >> 32;
        mix[1] = (mix[1].rotate_left(29) ^ word).wrapping_mul(0xC4CE_B9FE_1A85_EC53);
        mix[1] ^= mix[1] >> 31;
    };
    vertex.position.to_array().into_iter().for_each(&mut add);
    vertex.normal.to_array().into_iter().for_each(&mut add);
    // Otherwise they are places in the patch, and are not written.
    if block.has_texcoords {
        vertex.texcoord.to_array().into_iter().for_each(&mut add);
    }
    for values in block.channels {
        values[at].into_iter().for_each(&mut add);
    }
    let [a, b] = mix.map(|mix| mix.wrapping_mul(0x9FB2_1C65_1E98_DF25));
    let halves = |mix: u64| {
        let [a, b, c, d, rest @ ..] = mix.to_le_bytes();
        [u32::from_le_bytes([a, b, c, d]), u32::from_le_bytes(rest)]
    };
    let [[low, high], [_, other]] = [halves(a), halves(b)];
    [low, high, other]
}
