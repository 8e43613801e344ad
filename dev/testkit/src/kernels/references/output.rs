//! Points, indices and ranges.

use super::places;
use crate::kernels::Case;
use crate::kernels::words::{Words, coordinates};
use tess_core::fixed_point::ONE;
use tess_core::place::place;
use tess_core::row::Row;
use tess_core::stitch::{self, Diagonals};
use tess_core::{Domain, DomainPoint, OutputPrimitive, Patch, Primitive, Sink, Step};
use tess_simd::{Format, Kernel};

pub(crate) fn floats(case: &Case, words: &mut Words) {
    let point = |&x: &u32| DomainPoint::from_bits(x, ONE - x).to_f32().map(f32::to_bits);
    let all: Vec<_> = case.input.numbers.iter().map(point).collect();
    words.each(&["u"], all.iter().map(|[u, _]| *u));
    words.each(&["v"], all.iter().map(|[_, v]| *v));
}

/// A point's coordinates in the format.
fn in_format(case: &Case, point: DomainPoint) -> [u32; 2] {
    if case.input.format == Format::FixedU32 {
        coordinates(point)
    } else {
        point.to_f32().map(f32::to_bits)
    }
}

/// An index in the format, counted from the base.
fn index(case: &Case, base: u32, index: u32, narrow: bool) -> u32 {
    let index = base.wrapping_add(index);
    if narrow || case.input.format == Format::F32U16 { index & 0xFFFF } else { index }
}

pub(crate) fn written_points(case: &Case, words: &mut Words) {
    for (run, &number) in case.input.numbers.iter().enumerate() {
        let [method, first, ..] = number.to_be_bytes().map(u32::from);
        let length = if method > 2 { 1 } else { number & 0xFFFF };
        let point = |k| DomainPoint::from_bits(64 * (first + k), ONE - 64 * (first + k));
        words.points(run, (0..length).map(|k| in_format(case, point(k))));
    }
}

pub(crate) fn written_indices(case: &Case, words: &mut Words) {
    for (run, &number) in case.input.numbers.iter().enumerate() {
        let [method, first, ..] = number.to_be_bytes().map(u32::from);
        let length = if method > 2 { 3 } else { number & 0xFFFF };
        let source = |k| if method == 2 { 64 * first + k } else { 64 * (first + k) };
        words.indices(run, (0..length).map(|k| index(case, case.input.base, source(k), false)));
    }
}

pub(crate) fn tables(case: &Case, words: &mut Words) {
    for (number, patch) in case.patches.iter().enumerate() {
        for factor in patch.processed().factors().iter().flat_map(|factors| factors.iter()) {
            words.add(
                number,
                &["location of point"],
                places(&factor.context, factor.context.points),
            );
        }
    }
}

/// A part of the model's output of a patch.
struct Part<T>(Vec<T>);

impl Sink for Part<DomainPoint> {
    fn point(&mut self, point: DomainPoint) {
        self.0.push(point);
    }

    fn primitive(&mut self, _: Primitive) {}
}

impl Sink for Part<u32> {
    fn point(&mut self, _: DomainPoint) {}

    fn primitive(&mut self, primitive: Primitive) {
        self.0.extend(primitive.indices());
    }
}

fn points_of(patch: &Patch) -> Vec<DomainPoint> {
    let mut points = Part(Vec::with_capacity(patch.counts().points as usize));
    patch.emit(&mut points);
    points.0
}

/// The indices of a patch in the order of the case.
fn indices_of(case: &Case, patch: &Patch) -> Vec<u32> {
    let mut indices = Part(Vec::with_capacity(patch.counts().indices as usize));
    match case.input.order {
        tess_core::Order::Specification => patch.emit(&mut indices),
        order @ tess_core::Order::VertexCache => return patch.tessellate_in(order).indices,
    }
    indices.0
}

pub(crate) fn points(case: &Case, words: &mut Words) {
    for (number, patch) in case.patches.iter().enumerate() {
        words.points(number, points_of(patch).into_iter().map(coordinates));
    }
}

/// The stitch of a number, in the winding of the output.
fn steps(case: &Case, number: u32, mut to: impl FnMut(Step)) {
    let [kind, outer, inner, _] = number.to_be_bytes().map(u32::from);
    match kind {
        0 => stitch::transition(case.input.config.split, outer, inner, &mut to),
        1 => stitch::ring(inner, &mut to),
        2 => stitch::strip(inner, Diagonals::Forward, &mut to),
        _ => stitch::strip(inner, Diagonals::ForwardExceptMiddle, &mut to),
    }
}

/// A triangle in the winding of the output; nothing if the output has no triangles.
fn wound<T: Copy>(case: &Case, [a, b, c]: [T; 3]) -> impl Iterator<Item = T> {
    let (triangle, corners) = match case.input.config.output {
        OutputPrimitive::TriangleCw => ([a, b, c], 3),
        OutputPrimitive::TriangleCcw => ([a, c, b], 3),
        _ => ([a, b, c], 0),
    };
    triangle.into_iter().take(corners)
}

pub(crate) fn stitches(case: &Case, words: &mut Words) {
    for (number, &stitch) in case.input.numbers.iter().enumerate() {
        let mut codes = Vec::new();
        steps(case, stitch, |step| {
            codes.extend(wound(
                case,
                step.vertices().map(|(side, entry)| match side {
                    tess_core::Side::Outer => entry,
                    tess_core::Side::Inner => entry.wrapping_sub(128),
                }),
            ));
        });
        words.add(number, &["code of index"], codes);
    }
}

pub(crate) fn rows_u16(case: &Case, words: &mut Words) {
    rows(case, words, true);
}

pub(crate) fn rows_u32(case: &Case, words: &mut Words) {
    rows(case, words, false);
}

fn rows(case: &Case, words: &mut Words, narrow: bool) {
    let all = case.input.numbers.as_chunks::<6>().0;
    for (number, &[stitch, outer, inner, how, outer_index, inner_index]) in all.iter().enumerate() {
        let [plain, outer_at, inner_at, down] = how.to_be_bytes();
        let mut rows = [Row::ascending(outer), Row::ascending(inner)];
        if plain == 0 {
            if down != 0 {
                rows[1] = Row::descending(inner);
            }
            if outer_at != 255 {
                rows[0] = rows[0].with(outer_at.into(), outer_index);
            }
            if inner_at != 255 {
                rows[1] = rows[1].with(inner_at.into(), inner_index);
            }
        }
        let mut indices = Vec::new();
        steps(case, stitch, |step| indices.extend(wound(case, step.triangle(&rows[0], &rows[1]))));
        words.indices(number, indices.into_iter().map(|i| index(case, 0, i, narrow)));
    }
}

pub(crate) fn indices_u16(case: &Case, words: &mut Words) {
    indices(case, words, true);
}

pub(crate) fn indices_u32(case: &Case, words: &mut Words) {
    indices(case, words, false);
}

fn indices(case: &Case, words: &mut Words, narrow: bool) {
    for (number, patch) in case.patches.iter().enumerate() {
        let all = indices_of(case, patch).into_iter();
        words.indices(number, all.map(|i| index(case, case.input.base, i, narrow)));
    }
}

/// The points of templates, where factors are integers, then the indices.
pub(crate) fn templates(case: &Case, words: &mut Words) {
    let with_points = case.input.config.partitioning.has_integer_factors();
    for (number, patch) in case.patches.iter().enumerate().filter(|_| with_points) {
        words.points(number, points_of(patch).into_iter().map(coordinates));
    }
    for (number, patch) in case.patches.iter().enumerate() {
        words.indices(number, indices_of(case, patch));
    }
}

/// The points of all patches, then their indices.
pub(crate) fn output(case: &Case, words: &mut Words) {
    for (number, patch) in case.patches.iter().enumerate() {
        words.points(number, points_of(patch).into_iter().map(|point| in_format(case, point)));
    }
    let mut base = case.input.base;
    for (number, patch) in case.patches.iter().enumerate() {
        let from = if case.input.per_batch { base } else { 0 };
        let all = indices_of(case, patch).into_iter();
        words.indices(number, all.map(|i| index(case, from, i, false)));
        base = base.wrapping_add(patch.counts().points);
    }
}

const RANGE: &[&str] = &["first point", "points", "first index", "indices"];

pub(crate) fn output_and_ranges(case: &Case, words: &mut Words) {
    let mut ranges = Vec::new();
    let mut end = [0; 2];
    for patch in &case.patches {
        let counts = patch.counts();
        ranges.push([end[0], counts.points, end[1], counts.indices]);
        end = [end[0] + counts.points, end[1] + counts.indices];
    }
    words.add(0, &["end of points", "end of indices"], end);
    output(case, words);
    for (number, range) in ranges.into_iter().enumerate() {
        words.add(number, RANGE, range);
    }
}

/// The buffers' contents before: each place has its number and one, repeatedly.
pub(crate) fn repeated(case: &Case, words: &mut Words) {
    let runs = case.input.numbers.as_chunks::<3>().0;
    let mut end = [0; 2];
    let mut starts = Vec::new();
    for [points, indices, times] in runs {
        starts.push(end);
        end = [end[0] + points * times, end[1] + indices * times];
    }
    words.add(0, &["end of points", "end of indices"], end);
    let one = if case.input.format == Format::FixedU32 { ONE } else { 1.0_f32.to_bits() };
    for (run, ([points, _, times], [start, _])) in runs.iter().zip(&starts).enumerate() {
        let period = move |_| (0..*points).map(move |k| [start + k, one]);
        words.points(run, (0..*times).flat_map(period));
    }
    for (run, ([points, indices, times], [_, start])) in runs.iter().zip(&starts).enumerate() {
        let step = if case.input.per_batch { *points } else { 0 };
        let all = (0..*times).flat_map(|t| (0..*indices).map(move |k| start + k + step * t));
        words.indices(run, all.map(|i| index(case, 0, i, false)));
    }
    for (run, ([points, indices, times], [point, index])) in runs.iter().zip(&starts).enumerate() {
        for t in 0..*times {
            words.add(run, RANGE, [point + points * t, *points, index + indices * t, *indices]);
        }
    }
}

/// An output in the form of the model's words: codes become points, and other words stay.
pub(crate) fn readable(kernel: Kernel, case: &Case, words: Vec<u32>) -> Vec<u32> {
    if kernel != Kernel::Codes {
        return words;
    }
    let mut codes = words.as_chunks::<2>().0.iter();
    let mut points = Vec::with_capacity(words.len());
    for patch in &case.patches {
        for code in codes.by_ref().take(patch.counts().points as usize) {
            points.extend(code.map(|code| coordinate(patch, code)));
        }
    }
    points
}

/// The coordinate that a code stands for: see the head of `stages/points/coordinate_code`.
fn coordinate(patch: &Patch, code: u32) -> u32 {
    let Some(factors) = patch.processed().factors() else { return u32::MAX };
    let [factor, position, term] = [code >> 8 & 7, code >> 5 & 7, code & 31];
    let context = |i: u32| factors.iter().nth(i as usize).map(|factor| factor.context);
    let location = |i, p| {
        let context = context(i).filter(|context| p < context.points);
        context.map_or(u32::MAX, |context| place(&context, p).to_bits())
    };
    let is_triangle = factors.domain() == Domain::Triangle;
    let constant = if is_triangle { triangle_term(term, |ring| location(3, ring)) } else { 0 };
    let x = location(factor, position);
    match code >> 15 {
        0 => constant.wrapping_add(x),
        _ if is_triangle => constant.wrapping_sub(x),
        _ => ONE.wrapping_sub(x),
    }
}

/// The number that a triangle's code adds to a location.
fn triangle_term(term: u32, location: impl Fn(u32) -> u32) -> u32 {
    const TWO_THIRDS: u32 = 0xAAAA;
    if term == 30 {
        return 0x5555;
    }
    let ring = term % 6;
    let at = if ring == 0 { 0 } else { location(ring) };
    let perpendicular = at.wrapping_mul(TWO_THIRDS).wrapping_add(ONE / 2) >> 16;
    let shift = perpendicular.div_ceil(2);
    match term / 6 {
        0 => perpendicular,
        1 => shift.wrapping_neg(),
        2 => ONE.wrapping_sub(shift),
        3 => shift.wrapping_sub(perpendicular),
        _ => ONE.wrapping_add(shift).wrapping_sub(perpendicular),
    }
}
