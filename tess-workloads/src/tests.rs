//! The workloads match their descriptions, and are the same everywhere.

use super::*;
use std::collections::BTreeSet;
use tess_core::QuadFactors;

fn quads(workload: &Workload) -> Vec<QuadFactors> {
    let quad = |patch: &PatchFactors| match patch {
        PatchFactors::Quad(factors) => *factors,
        _ => panic!("{} has quads alone", workload.name),
    };
    workload.patches.iter().map(quad).collect()
}

#[test]
fn sizes() {
    let expected = [
        ("uniform-1", 4096, 4096 * 4, 4096 * 2),
        ("uniform-16", 4096, 4096 * 17 * 17, 4096 * 2 * 16 * 16),
        ("uniform-64", 4096, 4096 * 65 * 65, 4096 * 2 * 64 * 64),
        ("seed-table/quad-48", 1, 49 * 49, 2 * 48 * 48),
        // The sums over density and detail: lines * (segments + 1), lines * segments.
        ("seed-table/isolines", 4096, 2080 * (2080 + 64), 2080 * 2080),
    ];
    for (name, patches, points, primitives) in expected {
        let [workload] = &Workload::named(name)[..] else { panic!("{name} is one workload") };
        let totals = workload.totals();
        let sizes = (totals.patches, totals.points, totals.primitives);
        assert_eq!(sizes, (patches, points, primitives), "{name}");
        let corners = if name.ends_with("isolines") { 2 } else { 3 };
        assert_eq!(totals.indices, corners * primitives, "{name}");
        let bytes = [IndexWidth::U16, IndexWidth::U32].map(|index| totals.bytes(index));
        let all = [2, 4].map(|index| 8 * points + index * corners * primitives);
        assert_eq!(bytes, all, "{name}");
    }
}

/// Recorded from the model. A change makes measurements incomparable.
#[test]
fn patches_are_the_recorded_ones() {
    let digest_of_factors = |workload: &Workload| {
        let mut digest = Fnv1a::default();
        for patch in &workload.patches {
            match patch {
                PatchFactors::Triangle(t) => {
                    digest.words([t.u0, t.v0, t.w0, t.inside].map(f32::to_bits));
                }
                PatchFactors::Quad(q) => {
                    digest.words(q.outer().map(f32::to_bits));
                    digest.words(q.inside().map(f32::to_bits));
                }
                PatchFactors::Isoline(i) => digest.words([i.density, i.detail].map(f32::to_bits)),
            }
        }
        digest.finish()
    };
    let [triangles, _, quads, _] = <[_; 4]>::try_from(meshes()).expect("four workloads");
    let workloads = [terrain(), character(), worst(), mosaic(), mosaic_even(), triangles, quads];
    let expected = [
        "7882a688b5a89231",
        "4a0aa6c8d93bdb91",
        "c9fbe51766e01c87",
        "4adce9ab57ef8035",
        "4a7e91d85cffc977",
        "3ff5ec126ce0a534",
        "1b59cb60ed8e7701",
    ];
    let digests = workloads.each_ref().map(|w| format!("{:016x}", digest_of_factors(w)));
    assert_eq!(digests, expected, "{:?}", workloads.map(|w| w.name));
}

#[test]
fn meshes_are_groups() {
    let workloads = meshes();
    for pair in workloads.chunks(2) {
        let [each, at_once] = pair else { panic!("pairs") };
        assert_eq!(each.patches, at_once.patches, "{}", each.name);
        let sizes: Vec<_> = each.group_ranges().map(|range| range.len()).collect();
        assert_eq!(sizes.len(), 256, "{}", each.name);
        assert_eq!(sizes.iter().sum::<usize>(), each.patches.len(), "{}", each.name);
        assert!(sizes.iter().all(|size| (40..=400).contains(size)), "{sizes:?}");
        assert_eq!(each.cache_batches(IndexWidth::U32).len(), 256, "a call for each group");
        assert_eq!(at_once.cache_batches(IndexWidth::U32).len(), 1, "one call for all");
    }
    assert_eq!(mosaic().group_ranges().count(), 0, "no groups");
}

/// A call with unlike neighbours has the same output as one with equal neighbours, from other
/// factors.
#[test]
fn neighbours_are_unlike_where_it_says_so() {
    for factor in [1, 8] {
        let [alike] = &Workload::named(&format!("uniform-{factor}"))[..] else {
            panic!("one workload")
        };
        let [unlike] = &Workload::named(&format!("single/unlike-{factor}"))[..] else {
            panic!("one")
        };
        assert_eq!(
            unlike.digest(Order::Specification),
            alike.digest(Order::Specification),
            "the same output"
        );
        assert_eq!(unlike.patches.len(), alike.patches.len(), "{factor}");
    }
    for workload in single() {
        let pairs = workload.patches.windows(2).filter(|pair| pair[0] == pair[1]).count();
        let alike = if workload.name.contains("uniform") { workload.patches.len() - 1 } else { 0 };
        // In mosaic, one pair in 4096 is equal by chance.
        let chance = if workload.name.ends_with("mosaic") { 20 } else { 0 };
        assert!(pairs >= alike && pairs <= alike + chance, "{}: {pairs}", workload.name);
    }
}

#[test]
fn mosaics_have_the_factors_they_say() {
    for patch in quads(&mosaic()) {
        let mut factors = patch.outer().into_iter().chain(patch.inside());
        assert!(factors.all(|f| [1.0, 2.0, 3.0, 4.0].contains(&f)), "{patch:?}");
    }
    let even = quads(&mosaic_even());
    let mean = even.iter().flat_map(QuadFactors::outer).map(f64::from).sum::<f64>() / 80_000.0;
    assert!((3.4..3.6).contains(&mean), "uniform in 1..6: mean {mean}");
}

#[test]
fn terrain_neighbours_agree() {
    let patches = quads(&terrain());
    for z in 0..64 {
        for x in 0..64 {
            let patch = patches[64 * z + x];
            if x < 63 {
                let right = patches[64 * z + x + 1];
                assert_eq!(patch.u1.to_bits(), right.u0.to_bits(), "edge right of ({x}, {z})");
            }
            if z < 63 {
                let below = patches[64 * (z + 1) + x];
                assert_eq!(patch.v1.to_bits(), below.v0.to_bits(), "edge below ({x}, {z})");
            }
        }
    }
    let factors = patches.iter().flat_map(QuadFactors::outer);
    let (low, high) = factors.fold((f32::MAX, 0.0f32), |(l, h), f| (l.min(f), h.max(f)));
    assert!((2.6..2.8).contains(&low) && (62.0..64.0).contains(&high), "range {low}..{high}");
}

/// Log-uniform factors in 1..8: a quarter is in each of four intervals of ratio 8^(1/4).
#[test]
fn character_is_log_uniform() {
    let mut quarters = [0u32; 4];
    for patch in character().patches {
        let PatchFactors::Triangle(factors) = patch else { panic!("triangles alone") };
        for factor in factors.outer() {
            assert!((1.0..8.0).contains(&factor), "factor {factor}");
            let boundaries = [8.0, 64.0, 512.0].map(|power: f64| power.sqrt().sqrt());
            let quarter = boundaries.partition_point(|&boundary| boundary <= f64::from(factor));
            quarters[quarter] += 1;
        }
    }
    assert!(quarters.iter().all(|&n| (14_500..15_500).contains(&n)), "of 60000: {quarters:?}");
}

#[test]
fn cache_batches_cover_every_patch_once() {
    for workload in Workload::all() {
        let empty = Workload { patches: Vec::new(), ..workload.clone() };
        for index_type in [IndexWidth::U16, IndexWidth::U32] {
            let batches = workload.cache_batches(index_type);
            let mut next = 0;
            for batch in &batches {
                assert_eq!(batch.start, next, "{}: batches follow each other", workload.name);
                next = batch.end;
                let part =
                    Workload { patches: workload.patches[batch.clone()].to_vec(), ..empty.clone() };
                let bytes = part.totals().bytes(index_type);
                let expected = match workload.calls {
                    Calls::SinglePatch => batch.len() == 1,
                    Calls::Group => workload.group_ranges().any(|group| group == *batch),
                    Calls::AllGroups => batch.len() == workload.patches.len(),
                    Calls::Batch if batches.len() == 1 => true,
                    Calls::Batch => {
                        bytes >= CACHE_BATCH_BYTES && batch.len() >= CACHE_BATCH_PATCHES
                    }
                };
                assert!(expected, "{}: batch {batch:?} of {bytes} bytes", workload.name);
            }
            assert_eq!(next, workload.patches.len(), "{}: all patches", workload.name);
        }
    }
}

/// 8 patches of factor 64 reach 1 MiB, 125 of factor 16 do, and factor 1 does not with all of its
/// patches.
#[test]
fn cache_batches_are_no_larger_than_they_must_be() {
    let batches = |factor| uniform(factor).cache_batches(IndexWidth::U32).len();
    assert_eq!([64, 16, 1].map(batches), [4096 / 8, 4096 / 125, 1]);
}

/// The digest is that of the model's output, patch by patch; another order has another digest.
#[test]
fn digests_are_those_of_the_output() {
    let workload = &Workload::named("seed-table/quad-48")[0];
    let mut digest = Fnv1a::default();
    for &factors in &workload.patches {
        digest.patch(&Patch::new(workload.config, factors).tessellate());
    }
    assert_eq!(workload.digest(Order::Specification), digest.finish());
    assert_ne!(workload.digest(Order::VertexCache), digest.finish());
}

#[test]
fn streams_reach_a_gibibyte() {
    let workload = uniform(64);
    let bytes = workload.totals().bytes(IndexWidth::U32);
    let repeats = workload.stream_repeats(IndexWidth::U32);
    assert!(repeats * bytes >= STREAM_BYTES && (repeats - 1) * bytes < STREAM_BYTES, "{repeats}");
}

#[test]
fn families_and_unknown_names() {
    assert_eq!(Workload::named("uniform").len(), 7, "uniform is a family");
    assert_eq!(Workload::named("seed-table").len(), 7, "seed-table is a family");
    assert_eq!(Workload::named("single").len(), 16, "single is a family");
    let in_turn = [single(), seed_table()].concat();
    assert!(in_turn.iter().all(|one| one.calls == Calls::SinglePatch), "a patch a call");
    assert_eq!(Workload::named("uniform-6").len(), 0, "not a prefix of uniform-64");
    assert_eq!(Workload::named("nothing").len(), 0, "unknown");
    assert_eq!(Workload::named("mosaic").len(), 1, "mosaic is a workload and no family");
    assert_eq!(Workload::named("meshes").len(), 4, "meshes is a family");
    assert_eq!(Workload::all().len(), 39, "all");
    let names: BTreeSet<String> =
        Workload::all().into_iter().map(|workload| workload.name).collect();
    assert_eq!(names.len(), 39, "each has a name of its own");
}
