//! A patch's stitches as data: applied to their rows, their steps give the patch's triangles.

use tess_core::{
    Config, Domain, OutputPrimitive, Partitioning, Patch, PatchFactors, SplitOrder, Step,
    StitchKind,
};

/// The triangles that the steps of all stitches make, with each stitch's kind.
fn stitched(patch: &Patch, split: SplitOrder) -> (Vec<StitchKind>, Vec<u32>) {
    let (mut kinds, mut indices) = (Vec::new(), Vec::new());
    patch.stitches(|stitch| {
        kinds.push(stitch.kind);
        let (mut outer, mut inner) = (0, 0);
        stitch.steps(split, |step: Step| {
            assert_eq!((step.outer, step.inner), (outer, inner), "{stitch:?}: goes on by one");
            match step.advances {
                tess_core::Side::Outer => outer += 1,
                tess_core::Side::Inner => inner += 1,
            }
            indices.extend(step.triangle(&stitch.outer, &stitch.inner));
        });
        let ends = (stitch.outer_points - 1, stitch.inner_points - 1);
        assert_eq!((outer, inner), ends, "{stitch:?}: ends on the last entries of both rows");
    });
    (kinds, indices)
}

#[test]
fn steps_on_rows_are_the_triangles_of_the_patch() {
    let mut kinds_seen = Vec::new();
    for split in SplitOrder::ALL {
        let config =
            Config { split, ..Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw) };
        for domain in [Domain::Triangle, Domain::Quad] {
            for (a, b) in [(2, 3), (5, 5), (6, 6), (7, 4), (4, 7), (9, 6), (6, 9), (64, 63)] {
                let factors =
                    PatchFactors::from_fn(domain, |i| f32::from([a, b, a / 2 + 1, 3u8, a, b][i]));
                let patch = Patch::new(config, factors);
                let (kinds, indices) = stitched(&patch, split);
                assert_eq!(indices, patch.tessellate().indices, "{config:?}, {factors:?}");
                kinds_seen.extend(kinds.iter().map(std::mem::discriminant));
            }
        }
    }
    for kind in [
        StitchKind::Transition { edge: 0 },
        StitchKind::Ring { ring: 2, edge: 0 },
        StitchKind::Centre(tess_core::stitch::Diagonals::Forward),
        StitchKind::CentreTriangle,
    ] {
        assert!(kinds_seen.contains(&std::mem::discriminant(&kind)), "no {kind:?} was tried");
    }
}

#[test]
fn patches_without_rings_have_no_stitches() {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    for (domain, factor) in [(Domain::Isoline, 5.0), (Domain::Triangle, 1.0), (Domain::Quad, 0.0)] {
        let patch = Patch::new(config, PatchFactors::uniform(domain, factor));
        patch.stitches(|stitch| panic!("{domain:?} {factor}: {stitch:?}"));
    }
}
