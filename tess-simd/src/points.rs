//! The domain points of a patch, in order (spec section 6).
//!
//! Every run of points along an edge is one coordinate held and the other read from a table of
//! locations; seen from the other end a location is `ONE` minus itself. For small patches of fractional
//! factors, `code` notes what each point is made of, and `permute` makes it.

mod code;
mod coordinate;
mod isoline;
#[cfg(target_arch = "x86_64")]
pub(crate) mod permute;
mod quad;
mod run;
mod tables;
mod triangle;

pub(crate) use code::{Code, EDGE, TRIANGLE_INSIDE, codes, corner};
pub(crate) use tables::LocationTables;

use crate::block::BlockPatch;
use crate::format::PointFormat;
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
