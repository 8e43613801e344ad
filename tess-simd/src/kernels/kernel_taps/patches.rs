//! Stages of patches that went through the front end.

use super::Kernel;
use super::numbers::stitch;
use super::{TapInput, TapOutput};
use crate::data::format::IndexFormat;
use crate::data::writer::Writer;
use crate::stages::connect;
#[cfg(target_arch = "x86_64")]
use crate::stages::packet::PacketPatch;
use crate::stages::points::{self, CompactPoints, LocationTables, codes};
#[cfg(target_arch = "x86_64")]
use crate::stages::points::{
    Code,
    permute::{self, Permutes},
};
use crate::stages::stitch::{CODES_AT_ONCE, Replaced, Rows};
use crate::stages::template::{Templates, long};
use tess_core::DomainPoint;

/// Runs a stage of patches; returns whether the kernel is such a stage.
#[inline(always)]
pub(crate) fn of_patches(kernel: Kernel, work: &TapInput, made: &mut TapOutput) -> bool {
    match kernel {
        Kernel::Tables => {
            made.words.clear();
            for patch in work.patches() {
                let tables = made.tables.of(patch);
                for (factor, table) in tables.iter().enumerate().take(work.domain.factors()) {
                    let points = patch.edge_points(factor) as usize;
                    made.words.extend_from_slice(&table.from(0)[..points]);
                }
            }
        }
        Kernel::Points => {
            let mut out = Writer::new(&mut made.points);
            for patch in work.patches() {
                points::emit(patch, &mut made.tables, &mut out);
            }
        }
        Kernel::Codes => {
            let mut all = &mut made.codes[..];
            for patch in work.patches() {
                let (here, rest) = all.split_at_mut(patch.points() as usize);
                codes(work.domain, &patch.edges(), here);
                all = rest;
            }
        }
        Kernel::CompactTemplate | Kernel::Template => of_templates(kernel, work, made),
        Kernel::ConnectU32 | Kernel::ConnectInColumns => connect_as(work, &mut made.indices),
        Kernel::ConnectU16 => connect_as(work, &mut made.narrow),
        Kernel::RowsU32 => rows_as(work, &mut made.indices),
        Kernel::RowsU16 => rows_as(work, &mut made.narrow),
        _ => return false,
    }
    true
}

/// Copies the indices and points of the patches' templates.
#[inline(always)]
fn of_templates(kernel: Kernel, work: &TapInput, made: &mut TapOutput) {
    made.points.clear();
    made.indices.clear();
    let TapOutput { tables, templates, points, indices, .. } = made;
    for patch in work.patches() {
        let (point_count, index_count) = (patch.points() as usize, patch.indices() as usize);
        let with = (&work.settings, &mut *tables);
        if kernel == Kernel::CompactTemplate {
            templates.make_room();
            let template = templates.find(patch, with, |_, code| code);
            let template = templates.get(template);
            indices.extend(template.indices[..index_count].iter().map(|&index| u32::from(index)));
            if patch.integer() {
                let all = template.points[..point_count].iter();
                points.extend(all.map(|&point| long::<DomainPoint>(point)));
            }
        } else if let Some(template) = templates.other(patch, with) {
            indices.extend(template.indices[..index_count].iter().map(|&index| u32::from(index)));
            points.extend_from_slice(
                &template.points[..if patch.integer() { point_count } else { 0 }],
            );
        }
    }
}

#[inline(always)]
fn connect_as<I: IndexFormat>(work: &TapInput, indices: &mut [I]) {
    let mut out = Writer::new(indices);
    for patch in work.patches() {
        connect::emit(&work.settings, patch, work.base, &mut out);
    }
}

/// Stitches between rows: see [`crate::Input::numbers`].
#[inline(always)]
fn rows_as<I: IndexFormat>(work: &TapInput, indices: &mut [I]) {
    let mut out = Writer::new(indices);
    for &[number, outer, inner, how, outer_index, inner_index] in work.numbers.as_chunks::<6>().0 {
        let codes = stitch(work, number);
        let [plain, outer_at, inner_at, down] = how.to_be_bytes();
        if plain != 0 {
            codes.emit_ascending::<_, CODES_AT_ONCE>(outer, inner, &mut out);
            continue;
        }
        let replaced = |at: u8, index| (at != u8::MAX).then(|| Replaced { at: at.into(), index });
        let rows = Rows {
            outer,
            inner,
            descending: down != 0,
            outer_replaced: replaced(outer_at, outer_index),
            inner_replaced: replaced(inner_at, inner_index),
        };
        codes.emit::<_, CODES_AT_ONCE>(&rows, &mut out);
    }
}

/// Points of compact patches with fractional factors.
#[inline(always)]
fn compact_points<'a, M: CompactPoints<Writer<'a, DomainPoint>>>(
    work: &TapInput,
    (templates, tables): (&mut Templates, &mut LocationTables),
    points: &'a mut [DomainPoint],
    make: &mut M,
) {
    let mut out = Writer::new(points);
    for patch in work.patches() {
        templates.make_room();
        let start = templates.find(patch, (&work.settings, tables), M::stored);
        make.emit(patch, templates.get(start).points, &mut out);
    }
}

#[inline(always)]
pub(crate) fn compact_by_lookup(work: &TapInput, made: &mut TapOutput) {
    let TapOutput { templates, tables, points, lookup, .. } = made;
    compact_points(work, (templates, tables), points, lookup);
}

#[cfg(target_arch = "x86_64")]
tess_level::with_avx512! {
    pub(crate) fn compact_by_permutes(work: &TapInput, made: &mut TapOutput) {
        let permute = |patch: PacketPatch<'_>, codes: &[Code], out: &mut Writer<'_, DomainPoint>| {
            permute::emit(patch, codes, out);
        };
        let TapOutput { templates, tables, points, .. } = made;
        compact_points(work, (templates, tables), points, &mut Permutes(permute));
    }
}
