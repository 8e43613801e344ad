//! Batches in memory that was never written, and what they refuse. The sequences of calls have the
//! rest.

use super::samples::{self, patch_factors, samples};
use std::mem::MaybeUninit;
use std::ptr::{null, null_mut};
use tess_capi::batch::{
    TESS_INDEX_U32, TESS_LEVEL_DETECT, TESS_MEMORY_ANY, TESS_NUMBERING_PER_PATCH, TESS_POINT_FIXED,
    TessBatchCounts, TessBatchOutput, TessRange, tess_batch_count, tess_batch_create,
    tess_batch_free, tess_batch_groups, tess_batch_level, tess_batch_run,
};
use tess_capi::status::{
    TESS_NULL_POINTER, TESS_OK, TESS_OUT_OF_RANGE, TESS_OVERLAP, TESS_TOO_LARGE,
    TESS_UNKNOWN_VALUE, TESS_WRONG_FACTOR_COUNT,
};
use tess_capi::types::{TessConfig, TessPoint};
use tess_core::{Domain, Patch, Tessellation};

const CONFIG: TessConfig = TessConfig { domain: 2, partitioning: 2, output: 2, split: 0 };

const FILL: u32 = 0xCCCC_CCCC;
const FILLED_RANGE: TessRange =
    TessRange { first_point: FILL, points: FILL, first_index: FILL, indices: FILL };

fn output_of(
    points: &mut [MaybeUninit<TessPoint>],
    indices: &mut [MaybeUninit<u32>],
    ranges: &mut [MaybeUninit<TessRange>],
) -> TessBatchOutput {
    TessBatchOutput {
        points: points.as_mut_ptr().cast(),
        point_capacity: points.len(),
        indices: indices.as_mut_ptr().cast(),
        index_capacity: indices.len(),
        ranges: ranges.as_mut_ptr().cast(),
        range_capacity: ranges.len(),
        point_format: TESS_POINT_FIXED,
        index_type: TESS_INDEX_U32,
        numbering: TESS_NUMBERING_PER_PATCH,
        base_vertex: 0,
        memory: TESS_MEMORY_ANY,
    }
}

/// Memory that was never written, as from `malloc`, receives what any other does.
#[test]
fn memory_need_not_be_initialised() {
    let quads: Vec<_> =
        samples().into_iter().filter(|s| s.config.domain == CONFIG.domain).collect();
    let factors: Vec<f32> = quads.iter().flat_map(|quad| quad.factors.clone()).collect();
    let of_model = |factors: &[f32]| -> Tessellation {
        Patch::new(samples::model(&CONFIG), patch_factors(Domain::Quad, factors)).tessellate()
    };
    let model: Vec<_> = quads.iter().map(|quad| of_model(&quad.factors)).collect();
    let points: Vec<_> =
        model.iter().flat_map(|one| one.points.iter().copied().map(samples::point)).collect();
    let indices: Vec<u32> = model.iter().flat_map(|one| one.indices.clone()).collect();
    let mut written_points = Box::new_uninit_slice(points.len());
    let mut written_indices = Box::new_uninit_slice(indices.len());
    let mut ranges = Box::new_uninit_slice(model.len());
    let output = output_of(&mut written_points, &mut written_indices, &mut ranges);
    let mut counts = TessBatchCounts::default();
    let mut batch = null_mut();
    let ranges = unsafe {
        assert_eq!(tess_batch_create(&CONFIG, TESS_LEVEL_DETECT, &mut batch), TESS_OK, "a batch");
        let (f, n) = (factors.as_ptr(), factors.len());
        assert_eq!(tess_batch_run(batch, f, n, &output, &mut counts), TESS_OK, "into new memory");
        tess_batch_free(batch);
        assert_eq!(*written_points.assume_init(), points, "points");
        assert_eq!(*written_indices.assume_init(), indices, "indices");
        ranges.assume_init()
    };
    let sizes = |range: &TessRange| [range.points as usize, range.indices as usize];
    let expected = model.iter().map(|one| [one.points.len(), one.indices.len()]);
    assert!(ranges.iter().map(sizes).eq(expected), "ranges");
}

#[test]
fn bad_inputs_are_refused() {
    let (factors, output) = ([1.0f32; 7], output_of(&mut [], &mut [], &mut []));
    let f = factors.as_ptr();
    let mut counts = TessBatchCounts::default();
    let (mut b, mut handle) = (null_mut(), null_mut());
    unsafe {
        assert_eq!(tess_batch_create(&CONFIG, TESS_LEVEL_DETECT, &mut b), TESS_OK, "a batch");
        assert_eq!(tess_batch_count(null_mut(), f, 6, &mut counts), TESS_NULL_POINTER, "no batch");
        assert_eq!(tess_batch_count(b, null(), 6, &mut counts), TESS_NULL_POINTER, "no factors");
        assert_eq!(tess_batch_count(b, f, 6, null_mut()), TESS_NULL_POINTER, "no counts");
        assert_eq!(tess_batch_count(b, f, 7, &mut counts), TESS_WRONG_FACTOR_COUNT, "seven");
        let many = usize::MAX / 6 * 6;
        assert_eq!(tess_batch_count(b, f, many, &mut counts), TESS_TOO_LARGE, "impossibly many");
        assert_eq!(tess_batch_run(b, f, many, &output, &mut counts), TESS_TOO_LARGE, "many");
        assert_eq!(tess_batch_run(b, f, 6, null(), &mut counts), TESS_NULL_POINTER, "no output");
        assert_eq!(tess_batch_run(b, f, 6, &output, null_mut()), TESS_NULL_POINTER, "no counts");
        assert_eq!(tess_batch_run(null_mut(), f, 6, &output, &mut counts), TESS_NULL_POINTER);
        assert_eq!(tess_batch_level(b, null_mut()), TESS_NULL_POINTER, "no level");
        let bad = TessConfig { domain: 3, ..CONFIG };
        assert_eq!(tess_batch_create(&bad, 0, &mut handle), TESS_UNKNOWN_VALUE, "domain");
        assert_eq!(tess_batch_create(&CONFIG, 4, &mut handle), TESS_UNKNOWN_VALUE, "level");
        assert_eq!(tess_batch_create(null(), 0, &mut handle), TESS_NULL_POINTER, "no config");
        assert_eq!(tess_batch_create(&CONFIG, 0, null_mut()), TESS_NULL_POINTER, "no handle");
        assert!(handle.is_null(), "no handle was made");
        tess_batch_free(null_mut());
        // An empty batch is a batch.
        assert_eq!(tess_batch_run(b, null(), 0, &output, &mut counts), TESS_OK, "no patches");
        assert_eq!(counts, TessBatchCounts::default(), "no patches");
        tess_batch_free(b);
    }
}

#[test]
fn groups_are_joined_ranges() {
    let range = |first_point, points, first_index, indices| TessRange {
        first_point,
        points,
        first_index,
        indices,
    };
    let ranges = [range(0, 4, 0, 6), range(4, 0, 6, 0), range(4, 9, 6, 24)];
    let groups = |starts: &[u32]| {
        let mut found = vec![FILLED_RANGE; starts.len()];
        let to = found.as_mut_ptr();
        let (from, at) = (ranges.as_ptr(), starts.as_ptr());
        (unsafe { tess_batch_groups(from, 3, at, starts.len(), to) }, found)
    };
    let two = vec![range(0, 4, 0, 6), range(4, 9, 6, 24)];
    assert_eq!(groups(&[0, 1]), (TESS_OK, two), "two groups");
    assert_eq!(groups(&[]), (TESS_OK, vec![]), "none");
    assert_eq!(groups(&[0, 4]), (TESS_OUT_OF_RANGE, vec![FILLED_RANGE; 2]), "past the end");
    assert_eq!(groups(&[2, 1]), (TESS_OUT_OF_RANGE, vec![FILLED_RANGE; 2]), "back");
    let mut shared = ranges;
    let status = unsafe { tess_batch_groups(&shared[0], 3, &0, 1, &raw mut shared[1]) };
    assert_eq!(status, TESS_OVERLAP, "a range that is read and written");
    let mut words = [0u32; 16];
    words[1] = 1;
    let at = words.as_mut_ptr();
    for (start, group) in [(0, 0), (3, 0), (7, 0), (0, 1)] {
        let (starts, to) = unsafe { (at.add(start), at.add(group).cast::<TessRange>()) };
        let status = unsafe { tess_batch_groups(ranges.as_ptr(), 3, starts, 2, to) };
        assert_eq!(status, TESS_OVERLAP, "starts at word {start}, groups at word {group}");
    }
    assert!(words[0] == 0 && words[1] == 1 && words[2..] == [0; 14], "nothing is written");
    let null_groups = unsafe { tess_batch_groups(ranges.as_ptr(), 3, &0, 1, null_mut()) };
    assert_eq!(null_groups, TESS_NULL_POINTER, "nowhere to write");
}
