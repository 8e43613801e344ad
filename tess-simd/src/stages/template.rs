//! Templates of patches: output that is kept to be copied, with indices counted from the patch's
//! first point.
//!
//! A patch's topology determines its indices. It also determines its points if factors are
//! integers, and the codes of the points if the patch is compact and factors are fractional.
//! `kernels/emit` looks the topology up and copies its template; the template of a new topology is
//! made once, by the stages that large patches go through. One mechanism ([`Cache`]) keeps two
//! kinds of template:
//!
//! - of all compact patches: thousands of topologies, with indices of one byte;
//! - of other patches up to 289 points, and of larger ones with the same topology as the previous
//!   large patch: hundreds of topologies, with indices of two bytes.
//!
//! # Data
//!
//! ```text
//! sets (32, 256, 2048)  (topology ^ topology >> 24) * 2^64 / golden ratio, upper 5, 8, 11 bits
//!  +--------------------------------+--------------------------------------+
//!  | topologies: 4 x u64, 0 = empty | starts: 4 x (point: u16, index: u16) |
//!  +--------------------------------+--------------|-------------|---------+
//!                                                  v             |
//! points (64 Ki of [u16; 2])  [ ... | coordinates, or codes in CompactPoints' form | ...      ]
//!                                                                v
//! indices (224 Ki of u8)      [ ... | indices from the patch's first point, as written | ... ]
//!
//! small (8192 starts)         by the topology's small number: the start that the sets gave last
//! ```
//!
//! These are the numbers for compact patches; other patches have at most 256 sets, 24 Ki points and
//! 96 Ki indices. Memory is allocated as templates are made. The first template makes 32 sets and
//! rooms of at least 1024 elements; a room that is full doubles. If a topology finds its set full,
//! the number of sets becomes eight times as large, up to the most.
//!
//! Both rooms are filled from front to back. If a template might not fit, all templates of its kind
//! are forgotten. For compact patches this is checked before each packet, for sixteen of the
//! largest ([`Templates::make_room`]); for other patches, when a template is made. Coordinates of
//! integer factors are 16.16 numbers, with 0xFFFF for `ONE` ([`short`], [`long`]).
//!
//! # One patch
//!
//! The quad (3, 4.5, 5, 6; 4, 7) of `docs/tour-cpu.md`, clockwise triangles:
//!
//! ```text
//! topology 0x850_E1C3_8512    set 0 of 32 (1 of 256, 8 of 2048), slot 0
//! 43 codes                    [0000, 8000] [0000, 8020] [0000, 8040] ...
//! 186 indices                 0 1 22  22 1 23  23 1 24 ...
//! ```
//!
//! # What must hold
//!
//! - `make_room` is called before a packet's first [`Templates::find`], and a [`Start`] is used
//!   before the next `make_room`. Otherwise a template is cut off, or read after others have
//!   overwritten it.
//! - [`room::PADDING`] elements after the last template can be read, because whole blocks are
//!   copied.
//! - Sets and rooms are emptied together. If the sets were kept, old topologies would find new
//!   templates.
//! - The number of a set is the upper bits of one number. When the number of sets grows, a new set
//!   therefore gets topologies of only one old set, and all of them find a slot.
//! - Anything that changes templates without changing the topology (the order of triangles,
//!   [`Stored`]) is constant for a tessellator, or `Workspaces::forget` is called when it changes.
//! - An index of a compact patch is below 256, because the patch has at most 16 by 16 points.
//!
//! # The simpler form
//!
//! One kind of template for all patches: with indices of two bytes, `mosaic`'s 4096 topologies do
//! not fit the second-level cache.
//!
//! Templates without codes, whose fractional points are still copied in runs: with AVX2 these were
//! slower than no templates, and `character` took 1.4 times as long (`docs/experiments.md`). The
//! codes limit a compact triangle to 13 points inside, because they have room for only 6 rings.

mod cache;
mod room;

pub(crate) use cache::{Start, Template};

use crate::data::format::OutputPoint;
use crate::data::lanes::LANES;
use crate::data::writer::Writer;
use crate::stages::connect;
use crate::stages::packet::{COMPACT_EDGE, PacketPatch, SMALL_TOPOLOGIES};
use crate::stages::points::{self, LocationTables, corner};
use crate::stages::settings::Settings;
use alloc::vec::Vec;
use cache::{Cache, INDEX_STEP};
use tess_core::fixed_point::ONE;
use tess_core::{Domain, DomainPoint, MAX_INDICES, MAX_POINTS, Patch, PatchFactors};

/// The most points and indices of a compact patch: those of a quad with [`COMPACT_EDGE`] points
/// along each edge.
const POINTS: usize = COMPACT_EDGE * COMPACT_EDGE;
const INDICES: usize = (6 * (COMPACT_EDGE - 1) * (COMPACT_EDGE - 1)).next_multiple_of(INDEX_STEP);

/// The most points of a patch whose template is kept the first time: as many as a quad of factor 16
/// has.
const ALWAYS_KEPT: usize = 17 * 17;

/// The templates of one configuration. Memory is allocated as they are made: at most 1 MiB,
/// including [`MadePatch`].
#[derive(Clone, Debug)]
pub(crate) struct Templates {
    compact: Cache<u8, CompactPoint, 2048, { 224 << 10 }, { 64 << 10 }>,
    /// The starts of compact templates, indexed by [`PacketPatch::small_topology`]; empty until the
    /// number of sets has grown.
    small: Vec<Start>,
    others: Cache<u16, DomainPoint, 256, { 96 << 10 }, { 24 << 10 }>,
    /// Topology of the last large patch that had no template.
    last_large: u64,
    made: MadePatch,
}

/// The output of the patch whose template is being made, as the stages write it.
#[derive(Clone, Debug)]
struct MadePatch {
    points: Vec<DomainPoint>,
    indices: Vec<u16>,
}

/// A point of a compact template: its coordinates if factors are integers ([`short`]), otherwise
/// its code.
pub(crate) type CompactPoint = [u16; 2];

/// Turns a code into the form that a template stores: see [`points::CompactPoints::stored`].
pub(crate) type Stored = fn(Domain, u16) -> u16;

/// The settings and tables that templates are made with.
type Making<'a> = (&'a Settings, &'a mut LocationTables);

impl Templates {
    /// No templates, and no memory for any.
    pub(crate) const fn new() -> Self {
        let made = MadePatch { points: Vec::new(), indices: Vec::new() };
        Self { compact: Cache::new(), small: Vec::new(), others: Cache::new(), last_large: 0, made }
    }

    /// Bytes of heap memory.
    pub(crate) const fn bytes(&self) -> usize {
        let small = self.small.capacity() * size_of::<Start>();
        self.compact.bytes() + small + self.others.bytes() + self.made.bytes()
    }

    /// Allocates all the memory that templates may ever need.
    pub(crate) fn reserve(&mut self) {
        self.compact.reserve();
        self.make_small();
        self.others.reserve();
        self.made.make_room(MAX_POINTS, MAX_INDICES);
    }

    /// Makes room for the templates of a packet of compact patches. If the packet might not fit,
    /// all compact templates are forgotten.
    #[inline(always)]
    pub(crate) fn make_room(&mut self) {
        if self.compact.make_room(LANES * POINTS, LANES * INDICES) {
            self.small.fill(Start::NONE);
        }
    }

    fn make_small(&mut self) {
        self.small.resize(SMALL_TOPOLOGIES, Start::NONE);
    }

    /// The start of the template of a compact patch that is not culled. Makes the template if there
    /// is none.
    #[inline(always)]
    pub(crate) fn find(
        &mut self,
        patch: PacketPatch<'_>,
        with: Making<'_>,
        stored: Stored,
    ) -> Start {
        // One load replaces a product and four comparisons for the smallest topologies. Until there
        // are many templates the table is empty, and `get` gives `None` for every number.
        match self.small.get(patch.small_topology()) {
            Some(&start) if start != Start::NONE => start,
            _ => self.find_in_sets(patch, with, stored),
        }
    }

    #[inline(always)]
    fn find_in_sets(&mut self, patch: PacketPatch<'_>, with: Making<'_>, stored: Stored) -> Start {
        let start = match self.compact.find(patch.topology()) {
            Some(start) => start,
            None => self.make_compact(patch, with, stored),
        };
        // Numbers of larger topologies are out of the table's range, so they are not entered.
        if let Some(small) = self.small.get_mut(patch.small_topology()) {
            *small = start;
        }
        start
    }

    /// The compact template at a start that was found after the last [`Self::make_room`].
    #[inline(always)]
    pub(crate) fn get(&self, start: Start) -> Template<'_, u8, CompactPoint> {
        self.compact.get(start)
    }

    /// The template of a patch that is neither compact nor culled. Makes it if the patch is to have
    /// one; otherwise `None`. The template has points only if factors are integers.
    #[inline(always)]
    pub(crate) fn other(
        &mut self,
        patch: PacketPatch<'_>,
        with: Making<'_>,
    ) -> Option<Template<'_, u16, DomainPoint>> {
        let start = match self.others.find(patch.topology()) {
            Some(start) => start,
            None if self.is_wanted(patch) => self.make_other(patch, with),
            None => return None,
        };
        Some(self.others.get(start))
    }

    /// Whether a patch is not large, or has the topology of the previous large patch.
    #[inline(always)]
    fn is_wanted(&mut self, patch: PacketPatch<'_>) -> bool {
        let topology = patch.topology();
        // A guess: a large topology that comes twice in a row will come again. Making a template
        // costs more than writing the patch, and of unlike large patches hardly one is met again.
        patch.points() as usize <= ALWAYS_KEPT
            || core::mem::replace(&mut self.last_large, topology) == topology
    }

    #[cold]
    #[inline(never)]
    fn make_compact(&mut self, patch: PacketPatch<'_>, with: Making<'_>, stored: Stored) -> Start {
        let domain = patch.domain();
        // `make_room` was called for this packet, so the template fits, and nothing that was found
        // for the packet moves.
        self.made.make(patch, with);
        let to = &mut self.compact.points.free(patch.points() as usize)[..patch.points() as usize];
        if patch.integer() {
            for (to, &point) in to.iter_mut().zip(&self.made.points) {
                *to = short(point);
            }
        } else {
            // A fractional patch's points differ from patch to patch; its codes do not. A minimum
            // patch has no rings to walk, but its corners have codes too.
            if patch.is_minimum() {
                for (to, &point) in to.iter_mut().zip(&self.made.points) {
                    *to = corner(domain, point);
                }
            } else {
                points::codes(domain, &patch.edges(), to);
            }
            to.as_flattened_mut().iter_mut().for_each(|code| *code = stored(domain, *code));
        }
        let start = self.made.keep(&mut self.compact, patch, patch.points());
        // With few templates their sets stay in the first-level cache, and the table of 32 KiB
        // would push them out.
        if self.compact.has_many() {
            self.make_small();
        }
        start
    }

    #[cold]
    #[inline(never)]
    fn make_other(&mut self, patch: PacketPatch<'_>, with: Making<'_>) -> Start {
        // Fractional points are not kept: these patches have too many for codes.
        let points = if patch.integer() { patch.points() } else { 0 };
        self.others.make_room(points as usize, patch.indices() as usize);
        self.made.make(patch, with);
        let to = &mut self.others.points.free(points as usize)[..points as usize];
        to.copy_from_slice(&self.made.points[..points as usize]);
        self.made.keep(&mut self.others, patch, points)
    }
}

impl MadePatch {
    const fn bytes(&self) -> usize {
        self.points.capacity() * size_of::<DomainPoint>()
            + self.indices.capacity() * size_of::<u16>()
    }

    /// Makes room for a patch, and for whole blocks after it.
    fn make_room(&mut self, points: usize, indices: usize) {
        let (points, indices) = (points + room::PADDING, indices + room::PADDING);
        if self.points.len() < points {
            self.points.reserve_exact(points - self.points.len());
            self.points.resize(points, DomainPoint::default());
        }
        if self.indices.len() < indices {
            self.indices.reserve_exact(indices - self.indices.len());
            self.indices.resize(indices, 0);
        }
    }

    /// Makes the indices of a patch, and its points if it is a minimum patch or factors are
    /// integers.
    fn make(&mut self, patch: PacketPatch<'_>, (settings, tables): Making<'_>) {
        self.make_room(patch.points() as usize, patch.indices() as usize);
        if patch.is_minimum() {
            return self.make_minimum(settings, patch.domain());
        }
        if patch.integer() {
            points::emit(patch, tables, &mut Writer::new(&mut self.points));
        }
        connect::emit(settings, patch, 0, &mut Writer::new(&mut self.indices));
    }

    /// Makes the minimum patch of a domain, using the core.
    #[expect(clippy::cast_possible_truncation, reason = "indices of at most 4 points")]
    fn make_minimum(&mut self, settings: &Settings, domain: Domain) {
        let mut wide = [0; 8];
        let patch = Patch::new(settings.config, PatchFactors::uniform(domain, 1.0));
        let written = patch.write(&mut self.points, &mut wide);
        debug_assert!(written.is_ok(), "a minimum patch has at most 4 points and 6 indices");
        for (narrow, wide) in self.indices.iter_mut().zip(wide) {
            *narrow = wide as u16;
        }
    }

    /// Adds a template to the cache, of whose points the caller has already written `points`.
    fn keep<I, P, const S: usize, const N: usize, const M: usize>(
        &self,
        cache: &mut Cache<I, P, S, N, M>,
        patch: PacketPatch<'_>,
        points: u32,
    ) -> Start
    where
        I: TryFrom<u16> + Copy + Default,
        P: Copy + Default,
    {
        let indices = patch.indices() as usize;
        for (to, &index) in cache.indices.free(indices).iter_mut().zip(&self.indices[..indices]) {
            *to = I::try_from(index).unwrap_or_default();
        }
        cache.add(patch.topology(), points as usize, indices)
    }
}

/// A point of a compact patch with integer factors, in half the room. `ONE` becomes 0xFFFF, which
/// never occurs as a coordinate. Templates of larger patches have whole points, because lengthening
/// takes up to twice as long as a copy.
#[expect(clippy::cast_possible_truncation, reason = "16.16 numbers up to ONE")]
fn short(point: DomainPoint) -> CompactPoint {
    [point.u, point.v].map(|coordinate| coordinate.to_bits().min(u32::from(u16::MAX)) as u16)
}

/// The point that [`short`] shortened.
#[inline(always)]
pub(crate) fn long<P: OutputPoint>(point: CompactPoint) -> P {
    let [u, v] = point.map(|coordinate| {
        let bits = u32::from(coordinate);
        bits + ((bits + 1) >> 16)
    });
    P::from_bits(u, v)
}

/// [`long`], in fewer instructions of AVX-512, which adds where a mask is set.
#[inline(always)]
pub(crate) fn long_by_comparison<P: OutputPoint>(point: CompactPoint) -> P {
    let [u, v] = point.map(|coordinate| {
        let bits = u32::from(coordinate);
        if bits == u32::from(u16::MAX) { ONE } else { bits }
    });
    P::from_bits(u, v)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tour;

    /// The numbers at the head of this file.
    #[test]
    fn the_worked_patch() {
        let packet = tour::packet();
        let (settings, mut tables) = (Settings::new(tour::CONFIG), LocationTables::EMPTY);
        let mut templates = Templates::new();
        let start = templates.find(packet.patch(0), (&settings, &mut tables), |_, code| code);
        let template = templates.get(start);
        assert_eq!(template.points[..43], tour::all_codes()[..], "codes");
        assert_eq!(template.indices[..9], [0, 1, 22, 22, 1, 23, 23, 1, 24], "indices");
    }

    /// Coordinates of integer factors keep their bits in half the room, because 0xFFFF never
    /// occurs.
    #[test]
    fn shortened_points() {
        for bits in [0, 0x0444, 0x8000, 0xFBBC, 0x1_0000] {
            let point = DomainPoint::from_bits(bits, 0x1_0000 - bits);
            assert_eq!(long::<DomainPoint>(short(point)), point, "{bits:#x}");
            assert_eq!(long_by_comparison::<DomainPoint>(short(point)), point, "{bits:#x}");
        }
    }
}
