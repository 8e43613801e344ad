//! `tess_batch_run`.

use super::hostile::{CANARY, NO_POINT, Wrongs};
use super::patch::{capacity, is_possible};
use crate::input::Bytes;
use crate::{compare_with_model, repeatable};
use std::cell::RefCell;
use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::ptr::null_mut;
use tess_capi::batch::{
    TESS_INDEX_U32, TESS_LEVEL_DETECT, TESS_MEMORY_ANY, TESS_MEMORY_INITIALISED,
    TESS_NUMBERING_PER_PATCH, TESS_POINT_FIXED, TessBatch, TessBatchCounts, TessBatchOutput,
    TessRange, tess_batch_create, tess_batch_free, tess_batch_run,
};
use tess_capi::status::{TESS_BUFFER_TOO_SMALL, TESS_OK, TESS_TOO_LARGE, TESS_UNKNOWN_VALUE};
use tess_capi::types::{TessConfig, TessPoint};
use tess_core::{Config, Domain, DomainPoint, PatchFactors, Tessellation};
use tess_verify::Case;

const NO_RANGE: TessRange =
    TessRange { first_point: CANARY, points: CANARY, first_index: CANARY, indices: CANARY };

/// The buffers of a batch.
struct BatchMemory {
    points: Vec<TessPoint>,
    indices: Vec<u32>,
    ranges: Vec<TessRange>,
    /// Whether the caller wants ranges.
    has_ranges: bool,
}

pub(super) fn check(bytes: &mut Bytes<'_>) -> Result<(), String> {
    let choices: Vec<u8> = (0..12).map(|_| bytes.byte()).collect();
    let (config, patches) = bytes.batch(5);
    let Some(first) = patches.first() else { return Ok(()) };
    let case = Case { config, factors: *first };
    let model: Vec<_> =
        patches.iter().map(|&factors| Case { config, factors }.patch().tessellate()).collect();
    let mut wrongs = Wrongs::default();
    let mut choices = Bytes(&choices);
    let (output, memory) = output(&mut choices, &mut wrongs, &model);
    let factors: Vec<f32> = patches.iter().flat_map(PatchFactors::iter).collect();
    let (status, counts) = run(&case, &factors, &output)?;
    wrongs.judge("tess_batch_run", &case, status)?;
    if wrongs.is_empty() {
        let needed = TessBatchCounts {
            patches: patches.len(),
            points: model.iter().map(|patch| patch.points.len()).sum(),
            indices: model.iter().map(|patch| patch.indices.len()).sum(),
        };
        if counts != needed {
            return Err(repeatable(&case, &format!("tess_batch_run: {counts:?}, not {needed:?}")));
        }
        return compare(config, &patches, &model, &memory);
    }
    let untouched = memory.points.iter().all(|&point| point == NO_POINT)
        && memory.indices.iter().all(|&index| index == CANARY)
        && memory.ranges.iter().all(|&range| range == NO_RANGE);
    if untouched { Ok(()) } else { Err(repeatable(&case, "tess_batch_run wrote, but refused")) }
}

/// Output buffers, some of them wrong.
fn output(
    bytes: &mut Bytes<'_>,
    wrongs: &mut Wrongs,
    model: &[Tessellation],
) -> (TessBatchOutput, BatchMemory) {
    let mut sized = |needed: usize, size: usize| {
        let (capacity, room) = capacity(bytes, needed);
        let possible = is_possible(capacity, size);
        wrongs.add_if(!possible, TESS_TOO_LARGE);
        // A possible capacity must really exist, because the library may trust it.
        (capacity, if possible { capacity } else { room })
    };
    let needed_points = model.iter().map(|patch| patch.points.len()).sum();
    let needed_indices = model.iter().map(|patch| patch.indices.len()).sum();
    let (point_capacity, points) = sized(needed_points, 8);
    let (index_capacity, indices) = sized(needed_indices, 4);
    let (range_capacity, ranges) = sized(model.len(), 16);
    let mut memory = BatchMemory {
        points: vec![NO_POINT; points],
        indices: vec![CANARY; indices],
        ranges: vec![NO_RANGE; ranges],
        has_ranges: true,
    };
    let points = wrongs.room(bytes, memory.points.as_mut_ptr(), point_capacity);
    let indices = wrongs.room(bytes, memory.indices.as_mut_ptr(), index_capacity);
    let ranges = wrongs.room(bytes, memory.ranges.as_mut_ptr(), range_capacity);
    // Null asks for no ranges.
    memory.has_ranges = !ranges.is_null();
    let has_few_ranges = memory.has_ranges && range_capacity < model.len();
    let is_small = point_capacity < needed_points || index_capacity < needed_indices;
    wrongs.add_if(is_small || has_few_ranges, TESS_BUFFER_TOO_SMALL);
    let [point_format, index_type, numbering] =
        [TESS_POINT_FIXED, TESS_INDEX_U32, TESS_NUMBERING_PER_PATCH].map(|good| {
            let wrong = bytes.byte() == 255;
            wrongs.add_if(wrong, TESS_UNKNOWN_VALUE);
            if wrong { 3 } else { good } // no format, type or numbering is 3
        });
    let output = TessBatchOutput {
        points: points.cast(),
        point_capacity,
        indices: indices.cast(),
        index_capacity,
        ranges,
        range_capacity,
        point_format,
        index_type,
        numbering,
        base_vertex: 0,
        memory: if bytes.byte() % 2 == 0 { TESS_MEMORY_ANY } else { TESS_MEMORY_INITIALISED },
    };
    (output, memory)
}

fn run(
    case: &Case,
    factors: &[f32],
    output: &TessBatchOutput,
) -> Result<(u32, TessBatchCounts), String> {
    let Config { partitioning, output: primitive, split } = case.config;
    let config = TessConfig {
        domain: case.domain() as u32,
        partitioning: partitioning as u32,
        output: primitive as u32,
        split: split as u32,
    };
    let mut counts = TessBatchCounts::default();
    let batch: Result<_, String> =
        MADE.with_borrow_mut(|made| match made.entry((case.domain(), case.config)) {
            Entry::Occupied(made) => Ok(made.get().0),
            Entry::Vacant(place) => Ok(place.insert(Made::new(case, &config)?).0),
        });
    let batch = batch?;
    // SAFETY: a batch that was made; buffers that are null, misaligned, impossibly large or as
    // large as they claim.
    let status =
        unsafe { tess_batch_run(batch, factors.as_ptr(), factors.len(), output, &mut counts) };
    Ok((status, counts))
}

thread_local! {
    /// Batches hold tables that take milliseconds to make.
    static MADE: RefCell<HashMap<(Domain, Config), Made>> = RefCell::new(HashMap::new());
}

/// A batch that was made, until the thread ends.
struct Made(*mut TessBatch);

impl Made {
    fn new(case: &Case, config: &TessConfig) -> Result<Self, String> {
        let mut batch = null_mut();
        // SAFETY: the pointers are to memory of this function and its caller.
        let status = unsafe { tess_batch_create(config, TESS_LEVEL_DETECT, &mut batch) };
        if status == TESS_OK {
            return Ok(Self(batch));
        }
        Err(repeatable(case, &format!("tess_batch_create answered {status}")))
    }
}

impl Drop for Made {
    fn drop(&mut self) {
        // SAFETY: a batch that was made and is no longer used.
        unsafe { tess_batch_free(self.0) };
    }
}

fn compare(
    config: Config,
    patches: &[PatchFactors],
    model: &[Tessellation],
    memory: &BatchMemory,
) -> Result<(), String> {
    let mut next = TessRange::default();
    for (number, (&factors, model)) in patches.iter().zip(model).enumerate() {
        let case = Case { config, factors };
        let count = |elements: usize| u32::try_from(elements).expect("a small patch");
        next.first_point += next.points;
        next.first_index += next.indices;
        (next.points, next.indices) = (count(model.points.len()), count(model.indices.len()));
        let range = memory.ranges.get(number).filter(|_| memory.has_ranges);
        if let Some(range) = range.filter(|&&range| range != next) {
            return Err(repeatable(&case, &format!("tess_batch_run: {range:?}, not {next:?}")));
        }
        let part = |first: u32, count: u32| first as usize..(first as usize + count as usize);
        let points = &memory.points[part(next.first_point, next.points)];
        let indices = &memory.indices[part(next.first_index, next.indices)];
        let points = points.iter().map(|point| DomainPoint::from_bits(point.u, point.v)).collect();
        let observed = Tessellation { points, indices: indices.to_vec() };
        compare_with_model("tess_batch_run", &case, observed, model)?;
    }
    Ok(())
}
