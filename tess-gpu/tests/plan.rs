//! Plans: the buffers, bindings and dispatches of a host for a batch.

mod common;

use tess_core::{Config, Domain, OutputPrimitive, Partitioning, SplitOrder};
use tess_gpu::layout::Job;
use tess_gpu::sizes::ALIGNMENT;
use tess_gpu::{
    Capacity, Dispatch, IndexType, Limits, Numbering, Plan, Resource, Setup, Span, Stage,
    Workgroups, Written, tables,
};

/// Limits that cut batches often.
const LOW: Limits = Limits { storage_binding: 4 << 20, workgroups: 5 };

const ALL: Capacity = Capacity { points: u32::MAX, primitives: u32::MAX };

fn span(dispatch: &Dispatch, resource: Resource) -> Span {
    let found = dispatch.bindings().find(|&(other, _)| other == resource);
    found.expect("the stage binds it").1
}

/// A setup of each domain, index type and point format.
fn some_setups() -> impl Iterator<Item = Setup> {
    common::all_setups().into_iter().step_by(37)
}

/// Batches from empty to the largest, with room for nothing, something and everything.
fn plans(setup: Setup, limits: Limits) -> Vec<Plan> {
    let some = Capacity { points: 3_000_001, primitives: 5_000_003 };
    let mut plans = Vec::new();
    for patches in [0, 1, 256, 70_000, 1 << 22, 1 << 24] {
        for capacity in [Capacity::default(), some, ALL] {
            plans.push(Plan::new(setup, patches, capacity, limits));
        }
    }
    plans
}

/// WebGPU's limits: portions and windows end before a dispatch needs more workgroups than a row
/// has.
#[test]
fn default_limits_need_no_rows() {
    for setup in some_setups() {
        let plan = Plan::new(setup, u32::MAX, ALL, Limits::WEBGPU);
        for dispatch in plan.dispatches() {
            match dispatch.workgroups() {
                Workgroups::Direct([_, rows, _]) => assert_eq!(rows, 1, "{dispatch:?}"),
                Workgroups::Indirect(_) => {
                    let elements = match dispatch.stage() {
                        Stage::ExpandPoints => span(&dispatch, Resource::Points).size / 8,
                        Stage::ExpandPrimitives => {
                            let bytes = u64::from(setup.primitive_bytes());
                            span(&dispatch, Resource::Indices).size / bytes
                        }
                        _ => continue,
                    };
                    assert!(elements.div_ceil(u64::from(plan.tile())) <= 65535, "{dispatch:?}");
                }
            }
        }
    }
}

/// Every binding is within its buffer, at an offset and of a size that a device can bind.
#[test]
#[ignore = "slow: every plan of many setups"]
fn bindings_lie_within_buffers_and_limits() {
    for limits in [Limits::WEBGPU, LOW] {
        for plan in some_setups().flat_map(|setup| plans(setup, limits)) {
            for dispatch in plan.dispatches() {
                for (resource, Span { offset, size }) in dispatch.bindings() {
                    let is_sound = offset.is_multiple_of(ALIGNMENT)
                        && size > 0
                        && offset + size <= plan.buffer_size(resource);
                    let may_exceed = limits == LOW
                        && matches!(
                            resource,
                            Resource::Tiles | Resource::Arguments | Resource::Catalogue
                        );
                    assert!(
                        is_sound && (may_exceed || size <= limits.storage_binding),
                        "{resource:?} {offset} {size} of {dispatch:?}"
                    );
                }
            }
        }
    }
}

/// The windows of each output follow one another, once for each portion, from its first byte to its
/// last, and so do the portions of the factors.
#[test]
fn portions_and_windows_cover_everything_once() {
    for plan in some_setups().flat_map(|setup| plans(setup, LOW)) {
        let stages = match plan.is_short() {
            true => [Stage::Short, Stage::ExpandShort, Stage::ExpandShort],
            false => [Stage::Factors, Stage::ExpandPoints, Stage::ExpandPrimitives],
        };
        let resources = [Resource::Factors, Resource::Points, Resource::Indices];
        for (stage, resource) in stages.into_iter().zip(resources) {
            let own = plan.dispatches().filter(|dispatch| dispatch.stage() == stage);
            let mut end = plan.buffer_size(resource);
            for Span { offset, size } in own.map(|dispatch| span(&dispatch, resource)) {
                let is_first = end == plan.buffer_size(resource) && offset == 0;
                assert!(is_first || offset == end, "{resource:?} of {plan:?}");
                end = offset + size;
            }
            let is_expected = plan.portions() == 0 || end == plan.buffer_size(resource);
            assert!(is_expected, "{end} of {resource:?} of {plan:?}");
        }
    }
}

/// Each dispatch of a portion has the job of its portion and window, and its own dispatch size.
#[test]
fn jobs_are_those_of_the_dispatches() {
    let setup = common::all_setups()[0];
    for plan in plans(setup, LOW) {
        let jobs = plan.jobs();
        assert_eq!(jobs.len() as u64, plan.buffer_size(Resource::Job), "{plan:?}");
        let (mut first_patch, mut sizes) = (0, Vec::new());
        for dispatch in plan.dispatches() {
            let Span { offset, size } = span(&dispatch, Resource::Job);
            assert_eq!(offset, ALIGNMENT * u64::from(dispatch.job()), "{dispatch:?}");
            let bytes = &jobs[usize::try_from(offset).expect("in memory")..][..size_of::<Job>()];
            let job: Job = bytemuck::pod_read_unaligned(bytes);
            assert_eq!(size, bytes.len() as u64, "{dispatch:?}");
            if matches!(dispatch.stage(), Stage::Short | Stage::Factors) {
                assert_eq!(job.first_patch, first_patch, "{dispatch:?}");
                first_patch += job.patches;
            }
            let window = match dispatch.stage() {
                Stage::ExpandPoints => span(&dispatch, Resource::Points).offset / 8,
                Stage::ExpandPrimitives => {
                    let bytes = u64::from(setup.primitive_bytes());
                    span(&dispatch, Resource::Indices).offset / bytes
                }
                _ => 0,
            };
            assert_eq!(u64::from(job.window_first * plan.tile()), window, "{dispatch:?}");
            if let Workgroups::Indirect(at) = dispatch.workgroups() {
                assert!(at + 12 <= plan.buffer_size(Resource::Arguments), "{dispatch:?}");
                sizes.push(at);
            }
        }
        assert_eq!(first_patch, plan.patches(), "{plan:?}");
        sizes.sort_unstable();
        assert!(sizes.windows(2).all(|pair| pair[1] - pair[0] >= 12), "{plan:?}");
    }
}

/// With a limit of workgroups, no row of a dispatch is longer than the limit.
#[test]
fn rows_keep_to_the_limit() {
    let setup = common::all_setups()[0];
    for workgroups in [1, 5, 300] {
        let limits = Limits { storage_binding: 128 << 20, workgroups };
        for dispatch in Plan::new(setup, 1 << 20, ALL, limits).dispatches() {
            let Workgroups::Direct([x, y, z]) = dispatch.workgroups() else { continue };
            let needed = match dispatch.stage() {
                Stage::Factors => 1 << 12,
                Stage::Scan => 1 << 4,
                _ => 1,
            };
            assert!(x <= workgroups && z == 1, "{dispatch:?}: {x}");
            assert!(x * y >= needed && x * (y - 1) < needed, "{dispatch:?}: {x} by {y}");
        }
    }
}

/// Each group has a thread: the last workgroup may have fewer groups.
#[test]
fn every_group_has_a_thread() {
    for (groups, expected) in [(1, 1), (63, 1), (64, 1), (65, 2), (128, 2), (129, 3)] {
        let plan = Plan::new(quads(), 5000, ALL, Limits::WEBGPU).with_groups(groups);
        let dispatch = plan.dispatches().find(|it| it.stage() == Stage::Groups);
        let workgroups = dispatch.map(|dispatch| dispatch.workgroups());
        assert_eq!(workgroups, Some(Workgroups::Direct([expected, 1, 1])), "{groups} groups");
    }
}

/// A room of one point less than 16 bits can number leaves out the index that restarts primitives.
#[test]
fn sixteen_bits_without_the_restart_index() {
    let setup = Setup { index_type: IndexType::U16, ..quads() };
    let points = IndexType::U16.points_without_restart();
    assert_eq!((points, IndexType::U32.points_without_restart()), (65_535, u32::MAX));
    let room = |points| {
        let plan = Plan::new(setup, 5000, Capacity { points, ..ALL }, Limits::WEBGPU);
        plan.buffer_size(Resource::Points)
    };
    assert_eq!(room(points), 8 * 65_535, "no point of number 65535");
    assert_eq!(room(u32::MAX), 8 * 65_536, "as many as 16 bits number");
}

/// A tile holds either points or primitives, so each output has its own last tile.
#[test]
fn a_short_batch_has_tiles_for_each_output() {
    let setup = common::all_setups()[0];
    for (points, primitives, expected) in [(16, 18, 2), (128, 128, 2), (129, 128, 3), (1, 257, 4)] {
        let plan = Plan::new(setup, 1, Capacity { points, primitives }, Limits::WEBGPU);
        assert_eq!((plan.is_short(), plan.tile()), (true, 128), "{plan:?}");
        let last = plan.dispatches().last().expect("two");
        assert_eq!(last.stage(), Stage::ExpandShort, "{last:?}");
        assert_eq!(
            last.workgroups(),
            Workgroups::Direct([expected, 1, 1]),
            "{points}, {primitives}"
        );
    }
}

/// A short batch binds its whole output at once: 4 MiB of triangles end at 349525.
#[test]
fn the_output_of_a_short_batch_is_bound_at_once() {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let setup = Setup::new(Domain::Quad, config);
    for (primitives, expected) in [(349_525, true), (349_526, false)] {
        let plan = Plan::new(setup, 1, Capacity { points: 100, primitives }, LOW);
        assert_eq!(plan.is_short(), expected, "{primitives} triangles, {LOW:?}");
        let plan = Plan::new(setup, 1, Capacity { points: 100, primitives }, Limits::WEBGPU);
        assert!(plan.is_short(), "{primitives} triangles with WebGPU's limits");
    }
}

/// Quads with fractional factors, of which 4 MiB of contexts are one section and a third.
fn quads() -> Setup {
    Setup::new(Domain::Quad, Config::new(Partitioning::FractionalEven, OutputPrimitive::TriangleCw))
}

/// Two portions of 65536 patches, two windows of 256 tiles of points and three of 170 tiles of
/// triangles: 12 jobs.
#[test]
fn buffers_have_the_bytes_of_their_layouts() {
    let room = Capacity { points: 600_000, primitives: 1_000_001 };
    let plan = Plan::new(quads(), 70_000, room, LOW).with_groups(3);
    assert_eq!((plan.portions(), plan.groups()), (2, 3), "{plan:?}");
    assert_eq!((plan.point_windows(), plan.primitive_windows()), (2, 3), "{plan:?}");
    for (resource, bytes) in [
        (Resource::Job, 12 * 256),
        (Resource::Factors, 70_000 * 24),
        (Resource::Tables, 4 * tables(SplitOrder::Ruler).len() as u64),
        (Resource::Topologies, 2 * 65_536 * 8),
        (Resource::Contexts, 2 * 65_536 * 48),
        // 65536 patches, 256 blocks twice and a section; the first portion's is rounded up to 256
        // bytes.
        (Resource::Offsets, 528_640 + 528_392),
        (Resource::Status, 32 + 2 * 16),
        // 293 tiles of points and 489 of triangles, with two more entries for each.
        (Resource::Tiles, 4 * (295 + 491)),
        (Resource::Arguments, 32 + 12 * 12),
        (Resource::Catalogue, 4 * 548_866),
        (Resource::Groups, 3 * 4),
        (Resource::Draws, 3 * 20),
        (Resource::Points, 600_000 * 8),
        (Resource::Indices, 1_000_001 * 12 + 4),
    ] {
        assert_eq!(plan.buffer_size(resource), bytes, "{resource:?}");
    }
}

/// The second portion has 4464 patches; the last window of each output ends with it.
#[test]
fn dispatches_bind_their_portion_and_window() {
    let room = Capacity { points: 600_000, primitives: 1_000_001 };
    let plan = Plan::new(quads(), 70_000, room, LOW);
    let spans = |stage, resource| -> Vec<(u64, u64)> {
        let own = plan.dispatches().filter(|dispatch| dispatch.stage() == stage);
        own.map(|dispatch| span(&dispatch, resource)).map(|span| (span.offset, span.size)).collect()
    };
    for (resource, first, second) in [
        (Resource::Factors, (0, 65_536 * 24), (65_536 * 24, 4464 * 24)),
        (Resource::Topologies, (0, 65_536 * 8), (65_536 * 8, 65_536 * 8)),
        (Resource::Contexts, (0, 65_536 * 48), (65_536 * 48, 65_536 * 48)),
        (Resource::Offsets, (0, 528_392), (528_640, 528_392)),
    ] {
        assert_eq!(spans(Stage::Factors, resource), [first, second], "{resource:?}");
    }
    let tiles = 256 * 2048 * 8;
    let windows = [(0, tiles), (tiles, 600_000 * 8 - tiles)];
    assert_eq!(spans(Stage::ExpandPoints, Resource::Points), windows.repeat(2), "points");
    let tiles = 170 * 2048 * 12;
    let windows = [(0, tiles), (tiles, tiles), (2 * tiles, 1_000_001 * 12 + 4 - 2 * tiles)];
    assert_eq!(spans(Stage::ExpandPrimitives, Resource::Indices), windows.repeat(2), "indices");
    let jobs = plan.jobs();
    let patches = [0, 6].map(|job| bytemuck::pod_read_unaligned::<u32>(&jobs[256 * job..][..4]));
    assert_eq!(patches, [65_536, 4464], "the first word of a job");
}

/// The same batch with only a part of its output written.
#[test]
fn what_is_not_written_has_no_windows() {
    let room = Capacity { points: 600_000, primitives: 1_000_001 };
    for (written, windows, has_catalogue) in [
        (Written::Everything, [2, 3], true),
        (Written::Indices, [0, 3], true),
        (Written::Arguments, [0, 0], false),
    ] {
        let plan = Plan::writing(written, quads(), 70_000, room, LOW);
        assert_eq!([plan.point_windows(), plan.primitive_windows()], windows, "{written:?}");
        assert_eq!(plan.has_catalogue(), has_catalogue, "{written:?}");
        let bytes = [Resource::Points, Resource::Indices].map(|output| plan.buffer_size(output));
        let all = [600_000 * 8, 1_000_001 * 12 + 4];
        let expected = [0, 1].map(|output| if windows[output] == 0 { 0 } else { all[output] });
        assert_eq!(bytes, expected, "{written:?}");
    }
}

#[test]
fn a_patch_finds_its_offsets() {
    let plan = Plan::new(quads(), 70_000, Capacity::default(), LOW);
    // The second portion begins after 528640 bytes.
    let first = 528_640 / 8;
    let in_second = [300, 65_536 + 1, 65_536 + 512].map(|entry| first + entry);
    assert_eq!(plan.offset_entries(65_836), in_second, "patch 300 of the second portion");
    assert_eq!(plan.alike_entry(65_836), first + 65_536 + 256 + 1, "its block's topology");
    let plan = Plan::new(quads(), 10_000_000, Capacity::default(), Limits::WEBGPU);
    let in_first = [100_000, 2_752_512 + 390, 2_752_512 + 2 * 10_752 + 1];
    assert_eq!(plan.offset_entries(100_000), in_first, "42 sections in the first portion");
    assert_eq!(plan.alike_entry(100_000), 2_752_512 + 10_752 + 390, "its block's topology");
}

/// Batches of 16384 patches or more, if they give triangles.
#[test]
fn large_batches_of_triangles_have_a_catalogue() {
    let lines = Config::new(Partitioning::Integer, OutputPrimitive::Line);
    for (setup, patches, expected) in [
        (quads(), 16_383, false),
        (quads(), 16_384, true),
        (Setup::new(Domain::Quad, lines), 16_384, false),
    ] {
        let plan = Plan::new(setup, patches, Capacity::default(), Limits::WEBGPU);
        assert_eq!(plan.has_catalogue(), expected, "{patches} {:?}", setup.config.output);
        let without = plan.buffer_size(Resource::Catalogue) == ALIGNMENT;
        assert_eq!(without, !expected, "what is bound");
    }
}

#[test]
fn the_stages_of_a_batch_follow_its_size() {
    use Stage::{
        ExpandPoints, ExpandPrimitives, ExpandShort, Factors, Partition, Scan, Short, Totals,
    };
    let long: &[Stage] = &[Factors, Scan, Totals, Partition, ExpandPoints, ExpandPrimitives];
    let room = Capacity { points: 100, primitives: 100 };
    for (patches, expected) in [(0, &[Totals][..]), (1, &[Short, ExpandShort]), (2000, long)] {
        let plan = Plan::new(quads(), patches, room, Limits::WEBGPU);
        let stages: Vec<Stage> = plan.dispatches().map(|dispatch| dispatch.stage()).collect();
        assert_eq!(stages, expected, "{patches} patches");
    }
}

/// A short batch has at most 1024 patches and 524288 elements.
#[test]
fn short_batches_have_little_of_everything() {
    let room = |points, primitives| Capacity { points, primitives };
    for (patches, room, expected) in [
        (0, room(1, 1), false),
        (1, Capacity::default(), true),
        (1024, room(1, 524_287), true),
        (1025, room(1, 1), false),
        (1, room(2, 524_287), false),
        (1, room(0, 1), false),
        (1, room(1, 0), false),
    ] {
        let plan = Plan::new(quads(), patches, room, Limits::WEBGPU);
        assert_eq!(plan.is_short(), expected, "{patches} patches, {room:?}");
        let long = Plan::in_long_stages(quads(), patches, room, Limits::WEBGPU);
        assert!(!long.is_short() && long.tile() == 2048, "{patches} patches, {room:?}");
    }
}

/// A tile is the smallest power of two of which 2048 hold the output.
#[test]
fn tiles_of_short_batches_grow_with_their_room() {
    for (primitives, tile) in [(1, 128), (262_143, 128), (262_144, 256), (524_287, 256)] {
        let plan = Plan::new(quads(), 1, Capacity { points: 1, primitives }, Limits::WEBGPU);
        assert_eq!(plan.tile(), tile, "{primitives} triangles");
    }
}

/// A smaller limit than 4 MiB counts as 4 MiB.
#[test]
fn the_least_binding_is_4_mib() {
    let least = Limits { storage_binding: 1, workgroups: 0 };
    let plan = Plan::new(quads(), 70_000, ALL, least);
    let same = Plan::new(quads(), 70_000, ALL, Limits { storage_binding: 4 << 20, workgroups: 1 });
    assert_eq!(plan, same, "4 MiB and a workgroup");
    assert_eq!(plan.portion_patches(), 65_536, "a whole section");
}

/// Sixteen patches of 65 by 65 points are more than 16-bit indices can number, unless each patch is
/// numbered from 0 or indices are not written.
#[test]
fn points_beyond_16_bits_are_no_room() {
    let most = 1 << 16;
    for (index_type, numbering, written, expected) in [
        (IndexType::U16, Numbering::PerBatch, Written::Everything, most),
        (IndexType::U16, Numbering::PerBatch, Written::Indices, most),
        (IndexType::U16, Numbering::PerBatch, Written::Arguments, 16 * 4225),
        (IndexType::U16, Numbering::PerPatch, Written::Everything, 16 * 4225),
        (IndexType::U32, Numbering::PerBatch, Written::Everything, 16 * 4225),
    ] {
        let setup = Setup { index_type, numbering, ..quads() };
        let room = Capacity::worst_case(setup, 16);
        let forms = [
            Plan::writing(written, setup, 16, room, Limits::WEBGPU),
            Plan::in_long_stages(setup, 16, room, Limits::WEBGPU),
            Plan::new(setup, 16, room, Limits::WEBGPU),
        ];
        let forms = if written == Written::Everything { &forms[..] } else { &forms[..1] };
        for plan in forms {
            let job: Job = bytemuck::pod_read_unaligned(&plan.jobs()[..size_of::<Job>()]);
            assert_eq!(job.point_capacity, expected, "{plan:?}");
        }
    }
}

/// A patch of factor 64 has 65 by 65 points; the sum saturates at 32 bits.
#[test]
fn the_worst_case_is_that_of_factor_64() {
    let room = |points, primitives| Capacity { points, primitives };
    assert_eq!(Capacity::worst_case(quads(), 10), room(42_250, 81_920), "ten quads");
    assert_eq!(Capacity::uniform(quads(), 10, 2.0), room(90, 80), "of factor 2");
    assert_eq!(Capacity::worst_case(quads(), u32::MAX), ALL, "as much as there is");
}
