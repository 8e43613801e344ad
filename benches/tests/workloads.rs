//! Workloads are measured correctly: compares the first batch of each, by the model and by the SIMD
//! backend, with the random-access formulation, which shares no walk with them.

use tess_core::{DomainPoint, Patch, PatchFactors};
use tess_simd::{Numbering, Output, OwnedBatch, Tessellator};
use tess_workloads::{IndexWidth, Workload};

/// Points and indices of all patches.
type Whole = (Vec<DomainPoint>, Vec<u32>);

fn whole(patches: impl Iterator<Item = (Vec<DomainPoint>, Vec<u32>)>) -> Whole {
    patches.fold(Default::default(), |(mut points, mut indices), patch| {
        points.extend(patch.0);
        indices.extend(patch.1);
        (points, indices)
    })
}

fn by_model(workload: &Workload, patches: &[PatchFactors]) -> Whole {
    whole(patches.iter().map(|&factors| {
        let patch = Patch::new(workload.config, factors).tessellate();
        (patch.points, patch.indices)
    }))
}

fn by_simd(workload: &Workload, patches: &[PatchFactors]) -> Whole {
    let patches = OwnedBatch::try_from(patches).expect("patches of one domain");
    let mut output = Output::<DomainPoint, u32>::new();
    let mut tessellator = Tessellator::new(workload.config);
    let counts = tessellator.tessellate(patches.batch(), Numbering::PerPatch, &mut output);
    counts.expect("the output is no larger than memory");
    (output.points().to_vec(), output.indices().to_vec())
}

fn expected(workload: &Workload, patches: &[PatchFactors]) -> Whole {
    whole(patches.iter().map(|&factors| {
        let patch = Patch::new(workload.config, factors);
        let indices = patch.primitives().flat_map(|primitive| primitive.indices().to_vec());
        (patch.points().collect(), indices.collect())
    }))
}

#[test]
fn every_workload_is_right() {
    let all = Workload::all();
    assert!(all.len() >= 23, "workloads: {}", all.len());
    for workload in all {
        let batch = workload.cache_batches(IndexWidth::U32).swap_remove(0);
        let patches = &workload.patches[batch];
        let expected = expected(&workload, patches);
        assert!(by_model(&workload, patches) == expected, "model, {}", workload.name);
        assert!(by_simd(&workload, patches) == expected, "SIMD, {}", workload.name);
    }
}

/// The comparison can fail: other factors give other indices.
#[test]
fn another_patch_is_seen() {
    let workload = Workload::all().swap_remove(0);
    let mut patches = workload.patches[..2].to_vec();
    let expected = expected(&workload, &patches);
    patches[1] = PatchFactors::uniform(patches[1].domain(), 7.0);
    assert!(by_simd(&workload, &patches) != expected, "another factor");
}
