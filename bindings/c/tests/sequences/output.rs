//! Output of a call, put into images of its buffers, and the first difference of a buffer from it.

use super::arguments::{Arguments, BatchCall};
use super::calls::{BufferName, To};
use super::memory::Image;
use super::model::Model;
use tess_capi::batch::{TESS_INDEX_U16, TESS_NUMBERING_PER_BATCH, TESS_POINT_FIXED, TessRange};
use tess_capi::types::TessCounts;

pub(crate) fn put_words<const N: usize>(image: &mut Image, first: usize, words: [u32; N]) {
    for (i, word) in words.into_iter().enumerate() {
        *image.element(first + i) = word.to_ne_bytes();
    }
}

pub(crate) fn put_counts(image: &mut Image, way: BatchCall, model: &Model) {
    let [points, indices, patches] = model.sizes();
    if way == BatchCall::Single {
        let (_, case, ..) = model.parts().next().expect("one patch");
        let TessCounts { points, primitives, indices } = case.patch().counts().into();
        return put_words(image, 0, [points, primitives, indices]);
    }
    for (i, count) in [patches, points, indices].into_iter().enumerate() {
        *image.element(i) = count.to_ne_bytes();
    }
}

pub(crate) fn put_output(images: &mut [Image], given: &Arguments, model: &Model, to: &To) {
    for (number, _, output, range) in model.parts() {
        for (i, point) in output.points.iter().enumerate() {
            let words = match to.point_format {
                TESS_POINT_FIXED => [point.u.to_bits(), point.v.to_bits()],
                _ => point.to_f32().map(f32::to_bits),
            };
            for (which, word) in words.into_iter().enumerate() {
                let at = given.coordinate(to, range.first_point as usize + i, which);
                *images[BufferName::Points as usize].element(at) = word.to_ne_bytes();
            }
        }
        let is_numbered = given.way == BatchCall::Batch && to.numbering == TESS_NUMBERING_PER_BATCH;
        let base = if is_numbered { given.base_vertex.wrapping_add(range.first_point) } else { 0 };
        for (i, index) in output.indices.iter().enumerate() {
            let (at, index) = (range.first_index as usize + i, base.wrapping_add(*index));
            let image = &mut images[BufferName::Indices as usize];
            match u16::try_from(index) {
                Ok(short) if to.index_type == TESS_INDEX_U16 => {
                    *image.element(at) = short.to_ne_bytes()
                }
                _ => *image.element(at) = index.to_ne_bytes(),
            }
        }
        if given.way == BatchCall::Batch && given.has_ranges() {
            let TessRange { first_point, points, first_index, indices } = range;
            let image = &mut images[BufferName::Ranges as usize];
            put_words(image, 4 * number, [first_point, points, first_index, indices]);
        }
    }
}

/// The first byte that differs, in words.
pub(crate) fn described(
    part: BufferName,
    at: isize,
    (observed, expected): (&Image, &Image),
    given: &Arguments,
    model: &Model,
    to: &To,
) -> String {
    let name = format!("{part:?}").to_lowercase();
    let values = |size: usize, element: usize| {
        let [observed, expected] = [observed, expected].map(|image| image.value(element, size));
        format!("observed {observed} ({observed:#x}), expected {expected} ({expected:#x})")
    };
    let Ok(byte) = usize::try_from(at) else {
        return format!("{name}: byte {at}, before the buffer, was written");
    };
    let size = match part {
        BufferName::Points | BufferName::Ranges => 4,
        _ => given.sizes[part as usize],
    };
    let element = byte / size;
    let owner = model.parts().find_map(|(number, case, output, range)| {
        let own = match part {
            BufferName::Points => (0..2 * output.points.len()).find_map(|i| {
                let at = given.coordinate(to, range.first_point as usize + i / 2, i % 2);
                (at == element).then(|| format!("{} of its point {}", ["u", "v"][i % 2], i / 2))
            }),
            BufferName::Indices => element
                .checked_sub(range.first_index as usize)
                .filter(|&i| i < output.indices.len())
                .map(|i| format!("its index {i}")),
            BufferName::Ranges if given.way == BatchCall::Batch => {
                (element / 4 == number).then(|| format!("word {} of its range", element % 4))
            }
            _ => None,
        };
        own.map(|own| format!("patch {number}, {own}: {case}"))
    });
    match owner {
        Some(owner) => format!("{name}: element {element}, {}; {owner}", values(size, element)),
        None if part == BufferName::Counts => {
            format!("counts: byte {byte} is not what the model says")
        }
        None => format!("{name}: byte {byte}, which is no output, was written"),
    }
}
