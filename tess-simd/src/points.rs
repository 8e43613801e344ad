//! The domain points of a patch, in order (spec section 6).
//!
//! Every run of points along an edge is one coordinate held and the other read from a table of
//! locations; seen from the other end a location is `ONE` minus itself. For small patches of fractional
//! factors, `code` notes what each point is made of, and `permute` or `lookup` makes it.

mod code;
mod coordinate;
mod isoline;
mod lookup;
#[cfg(target_arch = "x86_64")]
pub(crate) mod permute;
mod quad;
mod run;
mod tables;
mod triangle;

pub(crate) use code::{Code, EDGE, TRIANGLE_INSIDE, codes, corner};
pub(crate) use lookup::Coordinates;
pub(crate) use tables::LocationTables;

use crate::block::BlockPatch;
use crate::format::PointFormat;
use crate::level::Level;
use crate::writer::Writer;
use tess_core::Domain;

/// Emits the points of a regular patch.
#[inline(always)]
pub(crate) fn emit<P: PointFormat>(
    patch: BlockPatch<'_>,
    tables: &mut LocationTables,
    out: &mut Writer<'_, P>,
) {
    let (edges, locations) = (&patch.edges(), tables.of(patch));
    match patch.domain() {
        Domain::Isoline => isoline::emit(edges, locations, out),
        Domain::Triangle => triangle::emit(edges, locations, out),
        Domain::Quad => quad::emit(edges, locations, out),
    }
}

/// Writes the points of a small patch of fractional factors, whose codes are given.
pub(crate) trait SmallPoints<P> {
    fn emit(&mut self, patch: BlockPatch<'_>, codes: &[Code], out: &mut Writer<'_, P>);
}

/// A code as the points of small patches are written from at a CPU level: itself for permutes, otherwise
/// where its coordinates stand in [`Coordinates`].
pub(crate) fn for_level(level: Level, domain: Domain, code: Code) -> Code {
    match level {
        Level::Avx512 => code,
        _ => code.map(|code| lookup::place_of(domain, code)),
    }
}
