//! Finding which edges of a model's patches are the same edge.

use crate::error::{Fault, MeshError};
use alloc::vec;
use alloc::vec::Vec;
use glam::Vec3;

/// One side of an edge: the edge of one patch.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct HalfEdge {
    /// The number of the patch.
    pub patch: usize,
    /// The number of the edge in the patch, as in [`Sides`](crate::Sides).
    pub edge: usize,
}

/// The other side of every edge of every patch.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Topology {
    /// Indexed by slot; `ALONE` for edges of the model's border and collapsed edges.
    twins: Vec<u32>,
    /// How many edges have more than two sides.
    crowded: usize,
}

const ALONE: u32 = u32::MAX;

/// The largest number of patches, so that slots are numbered in 32 bits.
const MAX_PATCHES: usize = 1 << 30;

/// Refuses no faces, and too many to be numbered.
pub(crate) const fn check_count(faces: usize) -> Result<(), MeshError> {
    match faces {
        0 => Err(MeshError::Empty),
        1..MAX_PATCHES => Ok(()),
        faces => Err(MeshError::TooMany { faces }),
    }
}

impl HalfEdge {
    /// Its number among all possible ones: four per patch.
    #[expect(clippy::cast_possible_truncation, reason = "there are less than 2^30 patches")]
    pub(crate) const fn slot(self) -> u32 {
        (self.patch * 4 + self.edge) as u32
    }

    const fn of_slot(slot: u32) -> Self {
        Self { patch: (slot / 4) as usize, edge: (slot % 4) as usize }
    }
}

impl Topology {
    /// Pairs the half-edges that are equal. `hashes` has each one's hash and slot; `same` decides
    /// about those with equal hashes, and `is_forward` which way one runs along its edge.
    ///
    /// More than two are pairs if as many run one way as the other: sheets that touch, as where two
    /// cubes stand edge to edge. Every sheet keeps its sides together, whichever they are (A. Guéziec
    /// et al., *Cutting and Stitching*, IEEE TVCG 7(2), 2001).
    pub(crate) fn pair(
        patches: usize,
        mut hashes: Vec<(u64, u32)>,
        same: impl Fn(HalfEdge, HalfEdge) -> bool,
        is_forward: impl Fn(HalfEdge) -> bool,
    ) -> Result<Self, MeshError> {
        hashes.sort_unstable();
        let mut topology = Self { twins: vec![ALONE; patches * 4], crowded: 0 };
        let mut sides: Vec<HalfEdge> = Vec::new();
        let mut others: Vec<HalfEdge> = Vec::new();
        for run in hashes.chunk_by(|a, b| a.0 == b.0) {
            others.extend(run.iter().map(|&(_, slot)| HalfEdge::of_slot(slot)));
            while let Some(&first) = others.first() {
                sides.extend(others.extract_if(.., |&mut half| half == first || same(half, first)));
                topology.join(&sides, &is_forward)?;
                sides.clear();
            }
        }
        Ok(topology)
    }

    /// Pairs all sides of one edge.
    fn join(
        &mut self,
        sides: &[HalfEdge],
        is_forward: impl Fn(HalfEdge) -> bool,
    ) -> Result<(), MeshError> {
        let [first, second, third, ..] = *sides else {
            if let [one, other] = *sides {
                self.connect(one, other);
            }
            return Ok(());
        };
        let (forward, backward): (Vec<_>, Vec<_>) =
            sides.iter().partition(|&&half| is_forward(half));
        if forward.len() != backward.len() {
            let fault = Fault::NonManifold { others: [first.patch, second.patch] };
            return Err(MeshError::face(third.patch, fault));
        }
        self.crowded += 1;
        forward.into_iter().zip(backward).for_each(|(one, other)| self.connect(one, other));
        Ok(())
    }

    fn connect(&mut self, one: HalfEdge, other: HalfEdge) {
        self.twins[one.slot() as usize] = other.slot();
        self.twins[other.slot() as usize] = one.slot();
    }

    /// How many edges have more than two sides.
    pub(crate) const fn crowded(&self) -> usize {
        self.crowded
    }

    /// The other side of an edge, if there is one.
    pub(crate) fn twin(&self, half: HalfEdge) -> Option<HalfEdge> {
        if half.edge >= 4 || half.patch >= self.twins.len() / 4 {
            return None;
        }
        let twin = *self.twins.get(half.slot() as usize)?;
        (twin != ALONE).then(|| HalfEdge::of_slot(twin))
    }
}

/// The number of the first point with the same coordinates, for each point.
#[expect(clippy::cast_possible_truncation, reason = "faces index points with 32 bits")]
pub(crate) fn weld(points: &[Vec3]) -> Vec<u32> {
    let key = |i: u32| crate::math::order_key(points[i as usize].extend(0.0));
    let mut order: Vec<u32> = (0..points.len() as u32).collect();
    order.sort_unstable_by_key(|&i| (key(i), i));
    let mut first = vec![0; points.len()];
    for run in order.chunk_by(|&a, &b| key(a) == key(b)) {
        run.iter().for_each(|&i| first[i as usize] = run[0]);
    }
    first
}

/// A hash of a curve's bits. Equality is checked, so collisions only cost time.
pub(crate) fn hash(words: impl Iterator<Item = i32>) -> u64 {
    // FNV-1a over words, with a final mix.
    let start = 0xCBF2_9CE4_8422_2325u64;
    let folded = words.fold(start, |hash, word| {
        (hash ^ u64::from(word.cast_unsigned())).wrapping_mul(0x0000_0100_0000_01B3)
    });
    folded ^ (folded >> 32)
}
