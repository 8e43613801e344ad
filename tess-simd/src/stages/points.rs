//! The domain points of a patch, in order (spec section 6).
//!
//! In every run of points along an edge, one coordinate is constant and the other is read from a
//! table of locations; seen from the other end, a location is `ONE` minus the one in the table. For
//! compact patches with fractional factors, `coordinate_code` describes each point by a code, and
//! `permute` or `lookup` makes points from the codes.

mod coordinate_code;
mod isoline;
mod lookup;
#[cfg(target_arch = "x86_64")]
pub(crate) mod permute;
mod quad;
mod tables;
mod triangle;

pub(crate) use coordinate_code::{Code, codes, corner};
pub(crate) use lookup::Lookup;
use tables::FactorLocations;
pub(crate) use tables::LocationTables;

use crate::data::point_writer::PointWriter;
use crate::stages::packet::PacketPatch;
use tess_core::Domain;

/// Points written at a time.
const POINTS_AT_ONCE: usize = 8;

/// Emits the points of a regular patch.
#[inline(always)]
pub(crate) fn emit(
    patch: PacketPatch<'_>,
    tables: &mut LocationTables,
    out: &mut impl PointWriter,
) {
    let (edges, locations) = (&patch.edges(), tables.of(patch));
    match patch.domain() {
        Domain::Isoline => isoline::emit(edges, locations, out),
        Domain::Triangle => triangle::walk(edges, &mut Runs { locations, out }),
        Domain::Quad => quad::walk(edges, &mut Runs { locations, out }),
    }
}

/// Writes the points of each run of a walk.
struct Runs<'a, W> {
    locations: FactorLocations<'a>,
    out: &'a mut W,
}

/// A way to make the points of compact patches with fractional factors.
///
/// The same type decides what a template stores of a code and reads it back, so that the two match.
pub(crate) trait CompactPoints<W> {
    /// Whether the level writes templates fastest in blocks of 64 indices and 24 points: its stores
    /// are so wide that elements past the patch's last cost less than a mispredicted branch. Other
    /// levels write blocks of 16 and 8.
    const LONG_BLOCKS: bool;

    /// The form in which a template stores a coordinate's code.
    fn stored(domain: Domain, code: u16) -> u16;

    /// Writes the points of a patch from the codes in its template.
    fn emit(&mut self, patch: PacketPatch<'_>, stored: &[Code], out: &mut W);
}
