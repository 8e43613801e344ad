//! The order in which a patch's triangles are written.

use crate::data::writer::Writer;
use crate::stages::packet::PacketPatch;
use crate::stages::settings::Settings;
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

/// Writes a patch's indices. `specified` has them in the specification's order, followed by
/// unspecified elements.
#[inline(always)]
pub(crate) fn emit<I: Copy + Default>(
    settings: &Settings,
    patch: PacketPatch<'_>,
    specified: &[u16],
    out: &mut Writer<'_, I>,
    index: impl Fn(u16) -> I,
) {
    runs(settings, patch, |run| {
        out.map::<_, RUN>(run.len(), specified.get(run.start..).unwrap_or_default(), &index);
    });
}

/// Indices written at a time: the number that a column has of a ring stitch.
const RUN: usize = 24;
