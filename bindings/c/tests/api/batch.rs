//! Batches against the model, in every format, numbering and CPU level; and what they refuse.

use super::samples::{self, patch_factors, samples};
use std::ffi::c_void;
use std::ptr::{null, null_mut};
use tess_capi::batch::{
    TESS_INDEX_U16, TESS_INDEX_U32, TESS_LEVEL_AVX512, TESS_LEVEL_DETECT, TESS_MEMORY_ANY,
    TESS_MEMORY_INITIALISED, TESS_NUMBERING_PER_BATCH, TESS_NUMBERING_PER_PATCH, TESS_POINT_F32,
    TESS_POINT_F32_APART, TESS_POINT_FIXED, TessBatch, TessBatchCounts, TessBatchOutput, TessRange,
    tess_batch_count, tess_batch_create, tess_batch_free, tess_batch_groups, tess_batch_level,
    tess_batch_patch, tess_batch_run,
};
use tess_capi::status::{
    TESS_BUFFER_TOO_SMALL, TESS_INDEX_TOO_LARGE, TESS_LEVEL_UNAVAILABLE, TESS_MISALIGNED,
    TESS_NULL_POINTER, TESS_OK, TESS_OUT_OF_RANGE, TESS_OVERLAP, TESS_TOO_LARGE,
    TESS_UNKNOWN_VALUE, TESS_WRONG_FACTOR_COUNT, TessStatus,
};
use tess_capi::types::{TessConfig, TessCounts};
use tess_core::{Domain, Patch, Tessellation};

/// A batch and memory for its output, all of it filled with `FILL`.
struct Fixture {
    batch: *mut TessBatch,
    factors: Vec<f32>,
    patches: Vec<Tessellation>,
    points: Vec<[u32; 2]>,
    indices: Vec<u32>,
    ranges: Vec<TessRange>,
}

const FILL: u32 = 0xCCCC_CCCC;
const FILLED_RANGE: TessRange =
    TessRange { first_point: FILL, points: FILL, first_index: FILL, indices: FILL };

impl Fixture {
    fn new(config: TessConfig, level: u32) -> Result<Self, TessStatus> {
        let mut batch = null_mut();
        match unsafe { tess_batch_create(&config, level, &mut batch) } {
            TESS_OK => {}
            status => return Err(status),
        }
        let same = |c: &TessConfig| c.domain == config.domain;
        let samples: Vec<_> = samples().into_iter().filter(|s| same(&s.config)).collect();
        let model = samples::model(&config);
        let domain = Domain::ALL[config.domain as usize];
        let patches: Vec<Tessellation> = samples
            .iter()
            .map(|s| Patch::new(model, patch_factors(domain, &s.factors)).tessellate())
            .collect();
        let factors = samples.into_iter().flat_map(|s| s.factors).collect();
        let points = vec![[FILL; 2]; patches.iter().map(|p| p.points.len()).sum()];
        let indices = vec![FILL; patches.iter().map(|p| p.indices.len()).sum()];
        let ranges = vec![FILLED_RANGE; patches.len()];
        Ok(Self { batch, factors, patches, points, indices, ranges })
    }

    fn output(&mut self) -> TessBatchOutput {
        TessBatchOutput {
            points: self.points.as_mut_ptr().cast(),
            point_capacity: self.points.len(),
            indices: self.indices.as_mut_ptr().cast(),
            index_capacity: self.indices.len(),
            ranges: self.ranges.as_mut_ptr(),
            range_capacity: self.ranges.len(),
            point_format: TESS_POINT_FIXED,
            index_type: TESS_INDEX_U32,
            numbering: TESS_NUMBERING_PER_PATCH,
            base_vertex: 0,
            memory: TESS_MEMORY_ANY,
        }
    }

    /// The output, filled anew.
    fn fresh(&mut self) -> TessBatchOutput {
        self.points.fill([FILL; 2]);
        self.indices.fill(FILL);
        self.ranges.fill(FILLED_RANGE);
        self.output()
    }

    fn run(&self, output: &TessBatchOutput) -> (TessStatus, TessBatchCounts) {
        let mut counts = TessBatchCounts::default();
        let (f, n) = (self.factors.as_ptr(), self.factors.len());
        (unsafe { tess_batch_run(self.batch, f, n, output, &mut counts) }, counts)
    }

    fn needed(&self) -> TessBatchCounts {
        TessBatchCounts {
            patches: self.patches.len(),
            points: self.points.len(),
            indices: self.indices.len(),
        }
    }
}

impl Drop for Fixture {
    fn drop(&mut self) {
        unsafe { tess_batch_free(self.batch) };
    }
}

#[test]
fn every_level_and_format() {
    let mut levels_run = 0;
    for level in TESS_LEVEL_DETECT..=TESS_LEVEL_AVX512 {
        for (domain, partitioning, output, split) in [(2, 2, 2, 0), (1, 3, 3, 1), (0, 0, 1, 0)] {
            let config = TessConfig { domain, partitioning, output, split };
            let mut fixture = match Fixture::new(config, level) {
                Ok(fixture) => fixture,
                Err(status) => {
                    assert_eq!(status, TESS_LEVEL_UNAVAILABLE, "level {level}");
                    continue;
                }
            };
            levels_run += 1;
            let mut runs_at = 9;
            assert_eq!(unsafe { tess_batch_level(fixture.batch, &mut runs_at) }, TESS_OK, "level");
            assert!(runs_at == level || level == TESS_LEVEL_DETECT, "{runs_at} is not {level}");
            let (f, n) = (fixture.factors.as_ptr(), fixture.factors.len());
            let mut counts = TessBatchCounts::default();
            let status = unsafe { tess_batch_count(fixture.batch, f, n, &mut counts) };
            assert_eq!((status, counts), (TESS_OK, fixture.needed()), "{config:?}");
            for point_format in [TESS_POINT_FIXED, TESS_POINT_F32, TESS_POINT_F32_APART] {
                for index_type in [TESS_INDEX_U32, TESS_INDEX_U16] {
                    for memory in [TESS_MEMORY_ANY, TESS_MEMORY_INITIALISED] {
                        let formats =
                            TessBatchOutput { point_format, index_type, memory, ..fixture.fresh() };
                        let ran = fixture.run(&formats);
                        assert_eq!(ran, (TESS_OK, fixture.needed()), "{config:?} {formats:?}");
                        check(&fixture, &formats);
                    }
                }
            }
            let numbered = TessBatchOutput {
                numbering: TESS_NUMBERING_PER_BATCH,
                base_vertex: 1000,
                ..fixture.output()
            };
            for memory in [TESS_MEMORY_ANY, TESS_MEMORY_INITIALISED] {
                let numbered = TessBatchOutput { memory, ..numbered };
                assert_eq!(fixture.run(&numbered), (TESS_OK, fixture.needed()), "{config:?}");
                check(&fixture, &numbered);
            }
        }
    }
    assert!(levels_run >= 6, "the detected level and the baseline run everywhere");
}

/// Memory that was never written, as from `malloc`, receives the same as any other.
#[test]
fn memory_need_not_be_initialised() {
    let mut fixture = Fixture::new(CONFIG, TESS_LEVEL_DETECT).expect("a batch");
    let needed = fixture.needed();
    let mut points = Vec::<[u32; 2]>::with_capacity(needed.points);
    let mut indices = Vec::<u32>::with_capacity(needed.indices);
    let mut ranges = Vec::<TessRange>::with_capacity(needed.patches);
    let output = TessBatchOutput {
        points: points.as_mut_ptr().cast(),
        indices: indices.as_mut_ptr().cast(),
        ranges: ranges.as_mut_ptr(),
        ..fixture.output()
    };
    assert_eq!(fixture.run(&output), (TESS_OK, needed), "into new memory");
    unsafe {
        points.set_len(needed.points);
        indices.set_len(needed.indices);
        ranges.set_len(needed.patches);
    }
    (fixture.points, fixture.indices, fixture.ranges) = (points, indices, ranges);
    check(&fixture, &output);
}

/// A point, as the words that a format has for it.
fn point_at(points: &[[u32; 2]], number: usize, format: u32) -> [u32; 2] {
    let words = points.as_flattened();
    match format {
        TESS_POINT_F32_APART => [words[number], words[points.len() + number]],
        _ => points[number],
    }
}

/// Compares what was written with the model.
fn check(fixture: &Fixture, output: &TessBatchOutput) {
    let (mut first_point, mut first_index) = (0, 0);
    let small = |count: usize| u32::try_from(count).expect("a small count");
    for (patch, range) in fixture.patches.iter().zip(&fixture.ranges) {
        let expected = TessRange {
            first_point: small(first_point),
            points: small(patch.points.len()),
            first_index: small(first_index),
            indices: small(patch.indices.len()),
        };
        assert_eq!(*range, expected, "range");
        for (i, point) in patch.points.iter().enumerate() {
            let observed = point_at(&fixture.points, first_point + i, output.point_format);
            let expected = match output.point_format {
                TESS_POINT_FIXED => [point.u.to_bits(), point.v.to_bits()],
                _ => point.to_f32().map(f32::to_bits),
            };
            assert_eq!(observed, expected, "point {i}");
        }
        let base = match output.numbering {
            TESS_NUMBERING_PER_PATCH => 0,
            _ => output.base_vertex + small(first_point),
        };
        for (i, index) in patch.indices.iter().enumerate() {
            let at = first_index + i;
            let observed = match output.index_type {
                TESS_INDEX_U32 => fixture.indices[at],
                _ => unsafe { u32::from(*fixture.indices.as_ptr().cast::<u16>().add(at)) },
            };
            assert_eq!(observed, base + index, "index {i}");
        }
        first_point += patch.points.len();
        first_index += patch.indices.len();
    }
}

const CONFIG: TessConfig = TessConfig { domain: 2, partitioning: 2, output: 2, split: 0 };

#[test]
fn bad_outputs_write_nothing() {
    let mut fixture = Fixture::new(CONFIG, TESS_LEVEL_DETECT).expect("a batch");
    let good = fixture.output();
    let askew = |pointer: *mut c_void| pointer.wrapping_byte_add(1);
    let too_many = usize::MAX / 8 + 1;
    let needed = fixture.needed();
    for (bad, status) in [
        (TessBatchOutput { point_capacity: needed.points - 1, ..good }, TESS_BUFFER_TOO_SMALL),
        (TessBatchOutput { index_capacity: needed.indices - 1, ..good }, TESS_BUFFER_TOO_SMALL),
        (TessBatchOutput { range_capacity: needed.patches - 1, ..good }, TESS_BUFFER_TOO_SMALL),
        (TessBatchOutput { points: null_mut(), point_capacity: 0, ..good }, TESS_BUFFER_TOO_SMALL),
        (TessBatchOutput { points: null_mut(), ..good }, TESS_NULL_POINTER),
        (TessBatchOutput { indices: null_mut(), ..good }, TESS_NULL_POINTER),
        (TessBatchOutput { ranges: null_mut(), ..good }, TESS_NULL_POINTER),
        (TessBatchOutput { points: askew(good.points), ..good }, TESS_MISALIGNED),
        (TessBatchOutput { indices: askew(good.indices), ..good }, TESS_MISALIGNED),
        (TessBatchOutput { point_capacity: too_many, ..good }, TESS_TOO_LARGE),
        (TessBatchOutput { index_capacity: usize::MAX, ..good }, TESS_TOO_LARGE),
        (TessBatchOutput { range_capacity: too_many, ..good }, TESS_TOO_LARGE),
        (TessBatchOutput { points: good.indices, ..good }, TESS_OVERLAP),
        (TessBatchOutput { points: fixture.factors.as_mut_ptr().cast(), ..good }, TESS_OVERLAP),
        (TessBatchOutput { point_format: 3, ..good }, TESS_UNKNOWN_VALUE),
        (TessBatchOutput { index_type: 2, ..good }, TESS_UNKNOWN_VALUE),
        (TessBatchOutput { numbering: 2, ..good }, TESS_UNKNOWN_VALUE),
        (TessBatchOutput { memory: 2, ..good }, TESS_UNKNOWN_VALUE),
        (
            TessBatchOutput {
                numbering: TESS_NUMBERING_PER_BATCH,
                base_vertex: 65_535,
                index_type: TESS_INDEX_U16,
                ..good
            },
            TESS_INDEX_TOO_LARGE,
        ),
    ] {
        let (observed, counts) = fixture.run(&bad);
        assert_eq!(observed, status, "{bad:?}");
        let is_reported = status == TESS_BUFFER_TOO_SMALL;
        let expected = if is_reported { needed } else { TessBatchCounts::default() };
        assert_eq!(counts, expected, "counts say what is needed where room lacks: {bad:?}");
    }
    let counts_in = |pointer: *mut c_void| {
        let (f, n) = (fixture.factors.as_ptr(), fixture.factors.len());
        unsafe { tess_batch_run(fixture.batch, f, n, &good, pointer.cast()) }
    };
    let factors = fixture.factors.as_ptr().cast_mut().cast::<c_void>();
    for buffer in [good.points, good.indices, good.ranges.cast(), factors] {
        // Two floats in, so that 8 bytes are aligned wherever the buffer is.
        let inside = buffer.wrapping_byte_add(8 + buffer.align_offset(8));
        assert_eq!(counts_in(inside), TESS_OVERLAP, "the counts lie in {buffer:?}");
    }
    assert!(fixture.points.iter().all(|&p| p == [FILL; 2]), "no point was written");
    assert!(fixture.indices.iter().all(|&i| i == FILL), "no index was written");
    assert!(fixture.ranges.iter().all(|&r| r == FILLED_RANGE), "no range was written");
}

#[test]
fn bad_inputs_are_refused() {
    let mut fixture = Fixture::new(CONFIG, TESS_LEVEL_DETECT).expect("a batch");
    let output = fixture.output();
    let (b, f) = (fixture.batch, fixture.factors.as_ptr());
    let mut counts = TessBatchCounts::default();
    let mut handle = null_mut();
    unsafe {
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

/// Each patch alone, in every pair of formats, into buffers that are just large enough and into larger ones.
#[test]
fn one_patch_a_call() {
    let config = TessConfig { domain: 2, partitioning: 2, output: 2, split: 0 };
    let fixture = Fixture::new(config, TESS_LEVEL_DETECT).expect("always available");
    for (number, expected) in fixture.patches.iter().enumerate() {
        for room in [0, 200] {
            let mut points = vec![[FILL; 2]; expected.points.len() + room];
            let mut indices = vec![FILL; expected.indices.len() + room];
            let mut output = room_for(&mut points, &mut indices);
            let (status, counts) = one(&fixture, number, &output);
            assert_eq!(status, TESS_OK, "patch {number}");
            let found = (counts.points as usize, counts.indices as usize);
            assert_eq!(found, (expected.points.len(), expected.indices.len()), "patch {number}");
            let bits = |point: &tess_core::DomainPoint| [point.u.to_bits(), point.v.to_bits()];
            let same = points.iter().zip(&expected.points).all(|(a, b)| *a == bits(b));
            assert!(same && indices.starts_with(&expected.indices), "patch {number}, room {room}");
            let behind = points.iter().skip(found.0 + 64).all(|&point| point == [FILL; 2]);
            assert!(behind, "patch {number}: far behind the output");

            (output.point_format, output.index_type) = (TESS_POINT_F32, TESS_INDEX_U16);
            output.memory = TESS_MEMORY_INITIALISED;
            assert_eq!(one(&fixture, number, &output).0, TESS_OK, "patch {number}");
            let floats = |point: &tess_core::DomainPoint| point.to_f32().map(f32::to_bits);
            let same = points.iter().zip(&expected.points).all(|(a, b)| *a == floats(b));
            assert!(same, "patch {number} in floats, room {room}");

            points.fill([FILL; 2]);
            let output = room_for(&mut points, &mut indices);
            let output = TessBatchOutput { point_format: TESS_POINT_F32_APART, ..output };
            assert_eq!(one(&fixture, number, &output).0, TESS_OK, "patch {number}");
            let at = |i| point_at(&points, i, TESS_POINT_F32_APART);
            let same = expected.points.iter().enumerate().all(|(i, p)| at(i) == floats(p));
            assert!(same && indices.starts_with(&expected.indices), "patch {number} apart");
            let behind = (found.0 + 64..points.len()).all(|i| at(i) == [FILL; 2]);
            assert!(behind, "patch {number}: far behind the coordinates");
        }
    }
}

/// Refused calls write nothing but the sizes.
#[test]
fn one_patch_is_refused() {
    let config = TessConfig { domain: 2, partitioning: 0, output: 2, split: 0 };
    let fixture = Fixture::new(config, TESS_LEVEL_DETECT).expect("always available");
    let number = fixture.patches.iter().position(|patch| patch.points.len() > 8).expect("one");
    let expected = &fixture.patches[number];
    let (mut points, mut indices) =
        (vec![[FILL; 2]; expected.points.len() - 1], vec![FILL; expected.indices.len()]);
    let small = room_for(&mut points, &mut indices);
    let (status, counts) = one(&fixture, number, &small);
    assert_eq!((status, counts.points as usize), (TESS_BUFFER_TOO_SMALL, points.len() + 1));
    assert_eq!(points, vec![[FILL; 2]; points.len()], "points of a buffer that is too small");
    assert_eq!(indices, vec![FILL; indices.len()], "indices of a buffer that is too small");
    let unknown = TessBatchOutput { point_format: 9, ..small };
    assert_eq!(one(&fixture, number, &unknown).0, TESS_UNKNOWN_VALUE, "a format");
    let unknown = TessBatchOutput { memory: 2, ..small };
    assert_eq!(one(&fixture, number, &unknown).0, TESS_UNKNOWN_VALUE, "memory");
    let both = TessBatchOutput { indices: small.points, index_capacity: 1, ..small };
    assert_eq!(one(&fixture, number, &both).0, TESS_OVERLAP, "points and indices");
    let (b, f) = (fixture.batch, fixture.factors.as_ptr());
    let mut counts = TessCounts::default();
    unsafe {
        assert_eq!(tess_batch_patch(null_mut(), f, &small, &mut counts), TESS_NULL_POINTER);
        assert_eq!(tess_batch_patch(b, null(), &small, &mut counts), TESS_NULL_POINTER);
        assert_eq!(tess_batch_patch(b, f, null(), &mut counts), TESS_NULL_POINTER);
        assert_eq!(tess_batch_patch(b, f, &small, null_mut()), TESS_NULL_POINTER);
    }
}

fn room_for(points: &mut [[u32; 2]], indices: &mut [u32]) -> TessBatchOutput {
    TessBatchOutput {
        points: points.as_mut_ptr().cast(),
        point_capacity: points.len(),
        indices: indices.as_mut_ptr().cast(),
        index_capacity: indices.len(),
        ranges: null_mut(),
        range_capacity: 0,
        point_format: TESS_POINT_FIXED,
        index_type: TESS_INDEX_U32,
        numbering: TESS_NUMBERING_PER_PATCH,
        base_vertex: 0,
        memory: TESS_MEMORY_ANY,
    }
}

/// One patch of a fixture of quads.
fn one(fixture: &Fixture, number: usize, output: &TessBatchOutput) -> (TessStatus, TessCounts) {
    let mut counts = TessCounts::default();
    let factors = fixture.factors[6 * number..][..6].as_ptr();
    (unsafe { tess_batch_patch(fixture.batch, factors, output, &mut counts) }, counts)
}
