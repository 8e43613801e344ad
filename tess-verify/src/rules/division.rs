//! An outer edge's own vertices among those of the inside.
//!
//! With fractional odd spacing, an inner level of 1 counts as just above 1, and vertices of the
//! inside may be on the outline (Vulkan 22.6, 22.7). The edge's own vertices are among those found:
//!
//! ```text
//! level 3      ├─────●───────┬─────●─────┤     ● own: at 1/3 and 2/3
//!              0     1/3    1/2   2/3    1     ┬ a row of the inside, whose column is on the edge
//! ```
//!
//! This finds the sets of vertices that the level allows: as many as it asks for, mirrored about
//! the middle, and spaced as it asks.

use super::answer::TOLERANCE;
use super::lengths::unequal;
use super::levels::TessellationLevel;
use tess_core::fixed_point::ONE;

/// The divisions found so far, and the one under construction.
struct Search<'a> {
    /// The places before the middle whose mirror images are there too, ascending, without the end.
    places: &'a [u32],
    level: TessellationLevel,
    /// The number of segments before the middle one.
    half: usize,
    chosen: Vec<u32>,
    found: Vec<Vec<u32>>,
}

/// The divisions that a level allows among these places, which include both ends: none, one, or the
/// first two. The level's number of segments is odd.
pub(super) fn divisions(along: &[u32], level: TessellationLevel) -> Vec<Vec<u32>> {
    let is_mirrored = |x: &u32| along.binary_search(&(ONE - x)).is_ok();
    let before_middle = along.iter().copied().filter(|x| (1..ONE / 2).contains(x));
    let places: Vec<u32> = before_middle.filter(is_mirrored).collect();
    let half = level.segments() as usize / 2;
    let mut search = Search { places: &places, level, half, chosen: Vec::new(), found: Vec::new() };
    let has_ends = along.first() == Some(&0) && along.last() == Some(&ONE);
    if has_ends {
        search.extend(0);
    }
    search.found
}

impl Search<'_> {
    /// Tries each next place from number `from`.
    fn extend(&mut self, from: usize) {
        if self.chosen.len() == self.half {
            return self.finish();
        }
        for next in from..self.places.len() {
            self.chosen.push(self.places[next]);
            if self.may_go_on() {
                self.extend(next + 1);
            }
            self.chosen.pop();
            if self.found.len() == 2 {
                return;
            }
        }
    }

    /// Whether at most one segment so far is shorter than the others. The other shorter one is its
    /// mirror image.
    fn may_go_on(&self) -> bool {
        let starts = [0].into_iter().chain(self.chosen.iter().copied());
        let lengths: Vec<u32> = starts.zip(&self.chosen).map(|(a, b)| b - a).collect();
        let longest = lengths.iter().max().copied().unwrap_or_default();
        lengths.iter().filter(|length| **length + 2 * TOLERANCE < longest).count() <= 1
    }

    fn finish(&mut self) {
        let mirrored = self.chosen.iter().rev().map(|x| ONE - x);
        let first = [0].into_iter().chain(self.chosen.iter().copied());
        let along: Vec<u32> = first.chain(mirrored).chain([ONE]).collect();
        if unequal(&along, self.level).is_none() {
            self.found.push(along);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use tess_core::Partitioning;

    /// The example at the head of this file, two divisions that cannot be told apart, and places
    /// that no division explains.
    #[test]
    fn own_vertices_are_found() {
        let spacing = Partitioning::FractionalOdd;
        let level = |raw| TessellationLevel { raw, spacing, is_inner: false, position: 0 };
        let third = [0x5555, 0xAAAB];
        let own = vec![0, third[0], third[1], ONE];
        assert_eq!(divisions(&[0, third[0], 0x8000, third[1], ONE], level(3.0)), [own]);
        let near = [0, third[0], third[0] + 1, third[1] - 1, third[1], ONE];
        assert_eq!(divisions(&near, level(3.0)).len(), 2, "both are within the tolerance");
        let sevenths: Vec<u32> = (0..=7).map(|k| (k * ONE).div_ceil(7)).collect();
        assert_eq!(divisions(&sevenths, level(4.5)), [[0; 0]; 0], "seven equal segments");
        assert_eq!(divisions(&[0, 0x4000, 0x8000, ONE], level(1.0)), [[0, ONE]], "one segment");
    }
}
