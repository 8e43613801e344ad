//! Ranges of groups.

use tess_simd::{BadGroup, PatchRange, group_ranges};

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
    let past = BadGroup { group: 1, start: 4, lowest: 0, patches: 3 };
    assert_eq!(bad(&[0, 4]), Some(past), "past the end");
    let back = BadGroup { group: 2, start: 1, lowest: 2, patches: 3 };
    assert_eq!(bad(&[0, 2, 1]), Some(back), "back");
}
