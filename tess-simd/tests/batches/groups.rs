//! Ranges of groups, and batches in parts.

use tess_core::{Config, OutputPrimitive, Partitioning, QuadFactors};
use tess_simd::{BadGroupError, Numbering, Output, PatchRange, Tessellator, group_ranges};

/// Three patches of 4, 0 and 9 points, and of 6, 0 and 24 indices.
const RANGES: [PatchRange; 3] = [
    PatchRange { first_point: 0, points: 4, first_index: 0, indices: 6 },
    PatchRange { first_point: 4, points: 0, first_index: 6, indices: 0 },
    PatchRange { first_point: 4, points: 9, first_index: 6, indices: 24 },
];

fn groups(starts: &[u32]) -> Vec<[u32; 4]> {
    let groups = group_ranges(&RANGES, starts).expect("groups");
    groups.map(|g| [g.first_point, g.points, g.first_index, g.indices]).collect()
}

#[test]
fn groups_follow_each_other() {
    assert_eq!(groups(&[]), [[0; 4]; 0], "none");
    assert_eq!(groups(&[0]), [[0, 13, 0, 30]], "all");
    assert_eq!(groups(&[0, 1]), [[0, 4, 0, 6], [4, 9, 6, 24]], "a culled patch in one");
    assert_eq!(groups(&[1, 1, 2]), [[4, 0, 6, 0], [4, 0, 6, 0], [4, 9, 6, 24]], "empty ones");
    assert_eq!(groups(&[0, 3]), [[0, 13, 0, 30], [13, 0, 30, 0]], "one behind the last patch");
}

#[test]
fn groups_that_cannot_be() {
    let bad = |starts: &[u32]| group_ranges(&RANGES, starts).err();
    let past = BadGroupError { group: 1, start: 4, lowest: 0, patches: 3 };
    assert_eq!(bad(&[0, 4]), Some(past), "past the end");
    let back = BadGroupError { group: 2, start: 1, lowest: 2, patches: 3 };
    assert_eq!(bad(&[0, 2, 1]), Some(back), "back");
}

/// A batch in two parts has the indices of the whole batch, if the numbers of the second part
/// continue those of the first.
#[test]
fn a_part_is_numbered_behind_the_parts_before_it() {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let patches = [2.0, 3.0, 5.0, 1.0].map(QuadFactors::uniform);
    let mut tessellator = Tessellator::new(config);
    let mut indices = |patches: &[QuadFactors], numbering| {
        let mut output = Output::<[f32; 2], u32>::new();
        let counts = tessellator.tessellate(patches, numbering, &mut output).expect("it fits");
        let points = u32::try_from(counts.points).expect("a few");
        (points, output.indices().to_vec())
    };
    for numbering in [Numbering::PerPatch, Numbering::PerBatch { base_vertex: 1000 }] {
        let (_, whole) = indices(&patches, numbering);
        let (first_point, mut parts) = indices(&patches[..2], numbering);
        parts.extend(indices(&patches[2..], numbering.behind(first_point)).1);
        assert_eq!(parts, whole, "{numbering:?}");
    }
    let end = Numbering::PerBatch { base_vertex: u32::MAX };
    assert_eq!(end.behind(2), Numbering::PerBatch { base_vertex: 1 }, "modulo 2^32");
}
