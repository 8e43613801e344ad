//! The search for edges that several patches of a model share.

use crate::error::MeshError;
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

/// The other sides of every edge of every patch.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(crate) struct Topology {
    /// The slot of each half-edge's other side, indexed by slot; `ALONE` for edges of the model's
    /// border, seams and collapsed edges.
    twins: Vec<u32>,
    /// One side of each edge that has more than two sides, all of them paired; in the order of
    /// slots.
    pub(crate) crowded: Vec<HalfEdge>,
    /// All sides of each edge that has more than two sides, which are not paired; in the order of
    /// slots.
    pub(crate) seams: Vec<Vec<HalfEdge>>,
    /// The slot of each side of a seam and the seam's number, in the order of slots.
    seam_of_slot: Vec<(u32, u32)>,
}

const ALONE: u32 = u32::MAX;

/// One more than the largest number of patches, so that slots fit 32 bits.
const MAX_PATCHES: usize = 1 << 30;

/// Checks that there is at least one face, and not too many to be numbered.
pub(crate) const fn check_count(faces: usize) -> Result<(), MeshError> {
    match faces {
        0 => Err(MeshError::Empty),
        1..MAX_PATCHES => Ok(()),
        faces => Err(MeshError::TooMany { faces }),
    }
}

impl HalfEdge {
    /// The number of the half-edge among all possible ones, four per patch.
    #[expect(clippy::cast_possible_truncation, reason = "there are less than 2^30 patches")]
    pub(crate) const fn slot(self) -> u32 {
        (self.patch * 4 + self.edge) as u32
    }

    pub(crate) const fn of_slot(slot: u32) -> Self {
        Self { patch: (slot / 4) as usize, edge: (slot % 4) as usize }
    }
}

/// The questions about half-edges that [`Topology::pair`] needs answered.
pub(crate) trait HalfEdges {
    /// Whether two half-edges with equal hashes are sides of one edge.
    fn same(&self, one: HalfEdge, other: HalfEdge) -> bool;

    /// Whether the patch runs forward along the edge. The forward direction is the same for all
    /// sides of the edge.
    fn is_forward(&self, half: HalfEdge) -> bool;

    /// The patch's unit normal near the edge, or zero.
    fn normal(&self, half: HalfEdge) -> Vec3;
}

impl Topology {
    /// Pairs the half-edges that are equal. `hashes` has the hash and the slot of each.
    ///
    /// More than two sides are paired if as many run one way as the other: sheets that touch, for
    /// example where two cubes meet at an edge, or the two sides of a sheet that has a face for
    /// each side (A. Guéziec et al., *Cutting and Stitching*, IEEE TVCG 7(2), 2001). The sides with
    /// the least bend between them become pairs. If the numbers differ, there is no single
    /// neighbour and the edge is a seam.
    pub(crate) fn pair(
        patches: usize,
        mut hashes: Vec<(u64, u32)>,
        edges: &impl HalfEdges,
    ) -> Self {
        if !hashes.is_empty() {
            sort(&mut hashes);
        }
        let (crowded, seams, seam_of_slot) = (Vec::new(), Vec::new(), Vec::new());
        let mut topology = Self { twins: vec![ALONE; patches * 4], crowded, seams, seam_of_slot };
        let mut sides: Vec<HalfEdge> = Vec::new();
        let mut others: Vec<HalfEdge> = Vec::new();
        for run in hashes.chunk_by(|a, b| a.0 == b.0) {
            // Equal hashes may belong to several edges; each round takes the sides of one.
            others.extend(run.iter().map(|&(_, slot)| HalfEdge::of_slot(slot)));
            while let Some(&first) = others.first() {
                let is_side = |half: &mut HalfEdge| *half == first || edges.same(*half, first);
                sides.extend(others.extract_if(.., is_side));
                topology.join(&sides, edges);
                sides.clear();
            }
        }
        topology.number_seams();
        topology
    }

    /// Pairs all sides of one edge, which are in the order of slots.
    fn join(&mut self, sides: &[HalfEdge], edges: &impl HalfEdges) {
        // Nearly every edge has two sides, and these are neighbours whichever way they run.
        let [first, _, _, ..] = *sides else {
            if let [one, other] = *sides {
                self.connect(one, other);
            }
            return;
        };
        let (forward, backward): (Vec<_>, Vec<_>) =
            sides.iter().partition(|&&half| edges.is_forward(half));
        if forward.len() != backward.len() {
            self.seams.push(sides.to_vec());
            return;
        }
        self.crowded.push(first);
        let mut pairs = Vec::with_capacity(forward.len() * backward.len());
        for &one in &forward {
            let normal = edges.normal(one);
            pairs.extend(
                backward.iter().map(|&other| (normal.dot(edges.normal(other)), one, other)),
            );
        }
        // A stable sort, so that slots decide between equal bends.
        pairs.sort_by(|a, b| b.0.total_cmp(&a.0));
        // The flattest pair first. Every side finds a partner, because as many run each way.
        for (_, one, other) in pairs {
            if self.twin(one).is_none() && self.twin(other).is_none() {
                self.connect(one, other);
            }
        }
    }

    fn number_seams(&mut self) {
        self.crowded.sort_unstable();
        self.seams.sort_unstable();
        let numbered = (0u32..).zip(&self.seams);
        let slots =
            numbered.flat_map(|(seam, sides)| sides.iter().map(move |half| (half.slot(), seam)));
        self.seam_of_slot = slots.collect();
        self.seam_of_slot.sort_unstable();
    }

    fn connect(&mut self, one: HalfEdge, other: HalfEdge) {
        self.twins[one.slot() as usize] = other.slot();
        self.twins[other.slot() as usize] = one.slot();
    }

    /// All sides of a seam, in the order of slots; none for other edges.
    pub(crate) fn seam(&self, half: HalfEdge) -> &[HalfEdge] {
        let found = self.seam_of_slot.binary_search_by_key(&half.slot(), |&(slot, _)| slot);
        found.map_or(&[], |at| &self.seams[self.seam_of_slot[at].1 as usize])
    }

    /// The other sides of an edge: the twin, or the other sides of a seam.
    pub(crate) fn others(&self, half: HalfEdge) -> impl Iterator<Item = HalfEdge> {
        let of_seam = self.seam(half).iter().copied().filter(move |&other| other != half);
        self.twin(half).into_iter().chain(of_seam)
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

/// For each point, the number of the first point with the same coordinates.
#[expect(clippy::cast_possible_truncation, reason = "faces index points with 32 bits")]
pub(crate) fn weld(points: &[Vec3]) -> Vec<u32> {
    const NONE: u32 = u32::MAX;
    // Adding zero turns -0 into 0, which is the same place.
    let key = |point: &Vec3| (*point + Vec3::ZERO).to_array().map(f32::to_bits);
    // At least half of the places stay empty.
    let bits = (points.len() * 2).next_power_of_two().trailing_zeros();
    let mut firsts = vec![NONE; 1 << bits];
    let find = |(number, point): (usize, &Vec3)| {
        let key_of_point = key(point);
        let mut place = place(hash(key_of_point.map(u32::cast_signed).into_iter()), bits);
        loop {
            match firsts[place] {
                NONE => {
                    firsts[place] = number as u32;
                    return number as u32;
                }
                first if key(&points[first as usize]) == key_of_point => return first,
                _ => place = (place + 1) & ((1 << bits) - 1),
            }
        }
    };
    points.iter().enumerate().map(find).collect()
}

/// The place of a hash in a table of 2^`bits`.
#[expect(clippy::cast_possible_truncation, reason = "tables are smaller than the address space")]
fn place(hash: u64, bits: u32) -> usize {
    // Fibonacci hashing: the high bits of a product depend on all bits of the hash.
    let mixed = hash.wrapping_mul(0x9E37_79B9_7F4A_7C15);
    (mixed >> (u64::BITS - bits.max(1))) as usize & ((1 << bits) - 1)
}

/// Sorts pairs by their first element, then by their second: into buckets by the high bits, then
/// within each bucket.
#[expect(clippy::cast_possible_truncation, reason = "there are as many buckets as pairs at most")]
fn sort(pairs: &mut Vec<(u64, u32)>) {
    let largest = pairs.iter().fold(0, |largest, &(hash, _)| largest.max(hash));
    let shift = (u64::BITS - largest.leading_zeros()).saturating_sub(pairs.len().ilog2());
    let bucket = |hash: u64| (hash >> shift.min(63)) as usize;
    let mut ends = vec![0; bucket(largest) + 2];
    pairs.iter().for_each(|&(hash, _)| ends[bucket(hash) + 1] += 1);
    // Counts become beginnings: `ends[b]` is the number of pairs in the buckets before b.
    let mut sum = 0;
    for end in &mut ends {
        sum += *end;
        *end = sum;
    }
    let mut sorted = vec![(0, 0); pairs.len()];
    for &pair in &*pairs {
        let place = &mut ends[bucket(pair.0)];
        sorted[*place] = pair;
        *place += 1;
    }
    // Each pair moved its bucket's beginning on by one, so these are the buckets' ends now.
    let mut start = 0;
    for end in ends {
        sorted[start..end].sort_unstable();
        start = end;
    }
    *pairs = sorted;
}

/// A hash of a curve's or point's bits. Equality is checked, so collisions only cost time.
pub(crate) fn hash(words: impl Iterator<Item = i32>) -> u64 {
    // FNV-1a over words, with a final mix.
    let start = 0xCBF2_9CE4_8422_2325u64;
    let folded = words.fold(start, |hash, word| {
        (hash ^ u64::from(word.cast_unsigned())).wrapping_mul(0x0000_0100_0000_01B3)
    });
    folded ^ (folded >> 32)
}
