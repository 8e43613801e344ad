//! The order in which a patch's triangles are written.

use crate::data::writer::Writer;
use crate::stages::packet::PacketPatch;
use crate::stages::settings::Settings;
use alloc::vec::Vec;
use core::ops::Range;
use tess_core::cache_order::CacheOrder;
use tess_core::{Domain, Order, OutputPrimitive};

/// Whether a patch's triangles are written in an order other than the specification's.
#[inline(always)]
pub(crate) const fn reorders(settings: &Settings, patch: PacketPatch<'_>) -> bool {
    let triangles = matches!(
        settings.config.output,
        OutputPrimitive::TriangleCw | OutputPrimitive::TriangleCcw
    );
    matches!(settings.order, Order::VertexCache)
        && triangles
        && !matches!(patch.domain(), Domain::Isoline)
        && !patch.is_minimum()
}

/// Sends all indices of a patch that is not culled to `emit`, in the order in which they are
/// written, as ranges of their places in the specification's order.
pub(crate) fn runs(
    settings: &Settings,
    patch: PacketPatch<'_>,
    mut emit: impl FnMut(Range<usize>),
) {
    let mut written = 0;
    if reorders(settings, patch) {
        let emit = |Range { start, end }: Range<u32>| {
            written += (end - start) as usize * 3;
            emit(3 * start as usize..3 * end as usize);
        };
        match (patch.domain(), patch.edges()) {
            (Domain::Quad, [u0, v0, u1, v1, inside_u, inside_v]) => {
                CacheOrder::new([u0, v0, u1, v1], [inside_u, inside_v]).runs(emit);
            }
            (_, [u0, v0, w0, inside, ..]) => CacheOrder::new([u0, v0, w0], [inside; 2]).runs(emit),
        }
    }
    emit(written..patch.indices() as usize);
}

/// A run's place in the specification's order and its length, in indices.
pub(crate) type Run = [u16; 2];

/// The most runs of a patch: for each edge, column and ring, and for what is inside all rings.
const MOST_RUNS: usize = 4 * 17 * 32 + 1;

/// Makes room in a list for the runs of any patch. It has them as elements, not as capacity, so
/// that a copy of the list has the room too.
pub(crate) fn make_room(list: &mut Vec<Run>) {
    list.resize(MOST_RUNS, [0; 2]);
}

/// Notes all [`runs`] of a patch at the beginning of a list.
#[expect(clippy::cast_possible_truncation, reason = "a patch has fewer than 2^16 indices")]
pub(crate) fn note<'a>(
    settings: &Settings,
    patch: PacketPatch<'_>,
    list: &'a mut Vec<Run>,
) -> &'a [Run] {
    make_room(list);
    let mut count = 0;
    runs(settings, patch, |run| {
        list[count] = [run.start as u16, run.len() as u16];
        count += 1;
    });
    &list[..count]
}

/// Writes the indices of a patch, run by run. `specified` has them in the specification's order,
/// followed by unspecified elements.
// The runs are a list because a loop over it has the instructions of the level. A function to which
// the core sends them has those of the baseline.
#[inline(always)]
pub(crate) fn emit<I: Copy + Default>(
    runs: &[Run],
    specified: &[u16],
    out: &mut Writer<'_, I>,
    index: impl Fn(u16) -> I,
) {
    for &[start, length] in runs {
        let source = specified.get(usize::from(start)..).unwrap_or_default();
        out.map::<_, RUN>(length.into(), source, &index);
    }
}

/// Indices written at a time: the number that a column has of a ring stitch.
const RUN: usize = 24;
