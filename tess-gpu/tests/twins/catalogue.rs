//! shared/catalogue.wgsl and variants/listing.wgsl: keys of topologies and their slots.

use super::block::topology;
use super::buffers::{Bound, constant};
use tess_core::{Domain, Patch, PatchFactors};
use tess_gpu::Resource::Catalogue as Words;
use tess_gpu::layout::Topology;
use tess_gpu::{Copies, Setup};

/// The number of slots that are tried for a key, starting at its hash.
const PROBES: u32 = 16;

/// The layout of the catalogue.
#[derive(Debug)]
pub(crate) struct Catalogue {
    pub(crate) setup: Setup,
    pub(crate) slots: u32,
    pub(crate) used_at: u32,
    pub(crate) places_at: u32,
    /// The first word of points and of triangles, the room for them, and the words of each.
    pub(crate) elements: [(u32, u32, u32); 2],
    most: [u32; 2],
}

impl Catalogue {
    pub(crate) fn new(setup: Setup) -> Self {
        let of = |name| constant(setup, name);
        let point_words = if setup.has_integer_factors() { 2 } else { 1 };
        Self {
            setup,
            slots: of("SLOTS"),
            used_at: of("USED_AT"),
            places_at: of("PLACES_AT"),
            elements: [
                (of("POINTS_AT"), of("CATALOGUE_POINTS"), point_words),
                (of("TRIANGLES_AT"), of("CATALOGUE_TRIANGLES"), 1),
            ],
            most: [of("LISTED_POINTS"), of("LISTED_PRIMITIVES")],
        }
    }

    /// The slot of a topology, counted from 1, which must hold its key; 0 if it has none.
    ///
    /// It is not defined which of two colliding keys gets the first slot. It is defined that each
    /// key occurs once, in one of the 16 slots that start at its hash, after taken ones, and that
    /// it has none only if other keys have all 16.
    pub(crate) fn slot_of(&self, topology: [u32; 2], counts: [u32; 2], b: &mut Bound<'_>) -> u32 {
        let is_small = (0..2).all(|kind| counts[kind] <= self.most[kind]);
        let Some(key) = key_of(self.setup.domain, topology).filter(|_| is_small) else { return 0 };
        let first = key.wrapping_mul(0x9E37_79B9) >> (32 - self.slots.ilog2());
        let mut tried = (0..PROBES).map(|probe| (first + probe) % self.slots);
        let slot = tried.find(|&slot| [0, key].contains(&b.left(Words, slot)));
        slot.map_or(0, |slot| {
            b.set(Words, slot, key);
            slot + 1
        })
    }
}

/// Whether blocks of equal patches are copied, points too: then they need no slot.
pub(crate) fn has_copied_points(setup: Setup) -> bool {
    setup.copies == Copies::WhereAlike && setup.has_integer_factors()
}

/// The key of a topology, or `None` if it is culled or has more than 33 points along an edge or
/// axis.
pub(crate) fn key_of(domain: Domain, topology: [u32; 2]) -> Option<u32> {
    let topology = Topology(topology);
    let edges = u32::try_from(domain.outer_factors()).expect("at most 4");
    let outer = (0..edges).map(|edge| (5 * edge, topology.outer_points(edge)));
    let [u, v] = topology.inside_points();
    let mut along = outer.chain([(20, u), (25, v)]);
    let has_room = topology.state() != 0 && along.clone().all(|(_, points)| points <= 33);
    let keyed = |key, (at, points): (u32, u32)| key | (points - 2) << at;
    has_room.then(|| along.by_ref().fold(topology.state() << 30, keyed))
}

/// A patch of the topology that has this key: each factor has one segment less than points.
pub(crate) fn patch_of(setup: Setup, key: u32) -> Patch {
    let field = |at: u32| f32::from(u8::try_from((key >> at & 31) + 1).expect("6 bits"));
    let edges = setup.domain.outer_factors();
    let factors = PatchFactors::from_fn(setup.domain, |factor| match factor.checked_sub(edges) {
        _ if key >> 30 == 1 => 1.0,
        None => field(5 * u32::try_from(factor).expect("at most 5")),
        Some(0) => field(20),
        Some(_) => field(25),
    });
    let patch = Patch::new(setup.config, factors);
    assert_eq!(key_of(setup.domain, topology(&patch)), Some(key), "no topology has this key");
    patch
}
