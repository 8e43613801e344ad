//! Frames that do not fit are coarser or empty, and a stage makes more room if it may.

use crate::both::{Both, Builder};
use crate::drawing::{scene, some_factors};
use crate::model::{compare, compare_factors, drawn};
use crate::scene::{PATCHES, Scene};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, Patch, PatchFactors};
use tess_gpu::Capacity;
use tess_wgpu::stage::{Feedback, Overflow, Points, Room};
use tess_wgpu::{Gpu, TessellationStage};

/// The patches' output.
fn needed(scene: &Scene) -> Capacity {
    let counts = scene.patches.iter().map(|&factors| Patch::new(scene.config, factors).counts());
    counts.fold(Capacity::default(), |sum, own| Capacity {
        points: sum.points + own.points,
        primitives: sum.primitives + own.primitives,
    })
}

/// The feedback of frame `frame`, for which the device is polled.
fn feedback(scene: &Scene, stage: &mut Both, frame: u64) -> Feedback {
    for _ in 0..8 {
        if let Some(feedback) = stage.feedback().filter(|feedback| feedback.frame >= frame) {
            return feedback;
        }
        scene.frame(stage, PATCHES.into()).expect("it draws");
    }
    panic!("frame {frame} was never heard of");
}

/// The factors as the stage scales them.
pub(crate) fn scaled(patches: &[PatchFactors], domain: Domain, scale: f32) -> Vec<PatchFactors> {
    let one = |factor: f32| {
        // NaN stays too.
        if factor > 1.0 { (factor.min(64.0) * scale).max(1.0) } else { factor }
    };
    let of = |patch: &PatchFactors| {
        let mut factors = patch.iter();
        PatchFactors::from_fn(domain, |_| one(factors.next().expect("as many")))
    };
    patches.iter().map(of).collect()
}

/// The factors of a stage's last frame, as words.
fn factors_of(scene: &Scene, stage: &TessellationStage) -> Vec<u32> {
    let buffer = stage.factors();
    let bytes = scene.gpu.read(buffer, buffer.size()).expect("they are there");
    bytemuck::pod_collect_to_vec(&bytes)
}

/// Rooms that lack one triangle, one point, or both.
fn too_little(room: Capacity) -> [Capacity; 3] {
    let Capacity { points, primitives } = room;
    [
        Capacity { points, primitives: primitives - 1 },
        Capacity { points: points - 1, primitives },
        Capacity { points: points - 1, primitives: primitives - 1 },
    ]
}

#[test]
#[ignore = "slow: many frames"]
fn a_frame_that_does_not_fit_is_coarser() {
    for partitioning in Partitioning::ALL {
        let scene = scene(Domain::Quad, partitioning);
        let room = needed(&scene);
        for points in [Points::Stored, Points::PullWithoutIndices, Points::Evaluated] {
            for (room, fits) in
                [(room, true)].into_iter().chain(too_little(room).map(|room| (room, false)))
            {
                let builder = scene.builder().room(Room::Exactly(room)).points(points);
                let mut stage = scene.build(builder);
                let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
                let feedback = feedback(&scene, &mut stage, 0);
                assert_eq!(feedback.scale < 1.0, !fits, "{feedback:?} in {room:?}");
                let all = needed(&scene);
                assert_eq!(
                    [feedback.points, feedback.primitives],
                    [all.points, all.primitives].map(u64::from),
                    "what the factors ask for"
                );
                assert!(feedback.drawn <= u64::from(room.primitives) && feedback.drawn > 0);
                let patches = scaled(&scene.patches, scene.domain, feedback.scale);
                let expected = scene.pixels(&patches);
                assert_eq!(compare(&observed, &expected), Ok(()), "{points:?} in {room:?}");
            }
        }
    }
}

#[test]
fn the_scale_is_the_greatest_of_the_ladder_that_fits() {
    let scene = scene(Domain::Triangle, Partitioning::FractionalEven);
    let all = needed(&scene);
    for part in [2, 3, 5, 8] {
        let room = Capacity { points: all.points / part, primitives: all.primitives / part };
        let mut stage = scene.build(scene.builder().room(Room::Exactly(room)));
        let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
        let scale = feedback(&scene, &mut stage, 0).scale;
        let at = |scale| {
            let patches = scaled(&scene.patches, scene.domain, scale);
            let counts = patches.iter().map(|&patch| Patch::new(scene.config, patch).counts());
            counts.fold([0, 0], |sum, own| [sum[0] + own.points, sum[1] + own.primitives])
        };
        let fits =
            |[points, primitives]: [u32; 2]| points <= room.points && primitives <= room.primitives;
        if fits(at(1.0 / 64.0)) {
            assert!(fits(at(scale)), "1/{part}: {scale}");
            // One step of the ladder is 1.6 percent.
            assert!(!fits(at(scale * 1.017)), "1/{part}: {scale} could be more");
            let patches = scaled(&scene.patches, scene.domain, scale);
            let expected = scene.pixels(&patches);
            assert_eq!(compare(&observed, &expected), Ok(()), "1/{part}");
            let factors = compare_factors(&factors_of(&scene, &stage), &patches);
            assert_eq!(factors, Ok(()), "1/{part}: at least 1");
        } else {
            assert_eq!(drawn(&observed), 0, "1/{part}: nothing fits");
        }
    }
}

#[test]
#[ignore = "slow: many frames"]
fn a_frame_that_does_not_fit_is_empty_if_so_asked() {
    let scene = scene(Domain::Quad, Partitioning::FractionalOdd);
    let room = needed(&scene);
    for points in crate::drawing::WAYS {
        let builder = || scene.builder().overflow(Overflow::DrawNothing).points(points);
        let mut stage = scene.build(builder().room(Room::Exactly(room)));
        let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
        let expected = scene.pixels(&scene.patches);
        assert_eq!(compare(&observed, &expected), Ok(()), "{points:?}");
        for room in too_little(room) {
            let mut stage = scene.build(builder().room(Room::Exactly(room)));
            let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
            assert_eq!(drawn(&observed), 0, "{points:?} in {room:?}");
            let feedback = feedback(&scene, &mut stage, 0);
            let all = u64::from(needed(&scene).primitives);
            assert_eq!([feedback.drawn, feedback.primitives], [0, all], "what it would take");
        }
    }
}

#[test]
fn not_even_the_coarsest_frame_fits() {
    let scene = scene(Domain::Quad, Partitioning::Integer);
    for room in [Capacity { points: 27, primitives: 100 }, Capacity { points: 100, primitives: 13 }]
    {
        let mut stage = scene.build(scene.builder().room(Room::Exactly(room)));
        let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
        assert_eq!(drawn(&observed), 0, "seven patches of 4 points and 2 triangles");
    }
    let room = Capacity { points: 28, primitives: 14 };
    let mut stage = scene.build(scene.builder().room(Room::Exactly(room)));
    let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
    let patches = scaled(&scene.patches, scene.domain, 1.0 / 64.0);
    assert_eq!(compare(&observed, &scene.pixels(&patches)), Ok(()), "they just fit");
    let factors = compare_factors(&factors_of(&scene, &stage), &patches);
    assert_eq!(factors, Ok(()), "every factor is 1 or culls");
}

#[test]
fn factors_that_are_no_numbers_stay_culled() {
    let mut scene = scene(Domain::Quad, Partitioning::FractionalOdd);
    let odd = [f32::NAN, -3.0, f32::NEG_INFINITY, 0.0, f32::INFINITY, 1e30, 0.5, 64.5];
    scene.patches = odd.map(|factor| PatchFactors::uniform(Domain::Quad, factor)).to_vec();
    scene = Scene::new(scene.domain, scene.config, scene.patches);
    let room = Capacity { points: 4000, primitives: 7000 };
    let mut stage = scene.build(scene.builder().room(Room::Exactly(room)));
    let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
    let scale = feedback(&scene, &mut stage, 0).scale;
    assert!(scale < 1.0, "{scale}");
    let expected = scene.pixels(&scaled(&scene.patches, scene.domain, scale));
    assert_eq!(compare(&observed, &expected), Ok(()), "four patches are drawn");
}

/// The memory that the README states.
#[test]
fn a_patch_takes_88_64_or_40_bytes_besides_its_output() {
    for (domain, expected) in [(Domain::Quad, 88), (Domain::Triangle, 64), (Domain::Isoline, 40)] {
        let scene = Scene::new(
            domain,
            scene(Domain::Quad, Partitioning::FractionalOdd).config,
            some_factors(domain),
        );
        let patches = 1 << 14;
        let source = crate::scene::source(domain);
        let stage = Builder::new(&source, domain, scene.config, patches)
            .bind_group(&scene.layout, &scene.group)
            .target(crate::scene::FORMAT)
            .room(Room::Bytes(1000))
            .build(&scene.gpu.device)
            .unwrap_or_else(|error| panic!("{error}"));
        let (batch, _) = stage.inside();
        let buffers = [stage.factors(), batch.topologies(), batch.contexts(), batch.offsets()];
        let bytes: u64 = buffers.map(wgpu::Buffer::size).iter().sum();
        assert_eq!(bytes / u64::from(patches), expected, "{domain:?}: {bytes} bytes");
    }
}

/// A stage that draws only depth. It stores neither points nor indices, so its room can be of any
/// size.
fn large(gpu: &Gpu, domain: Domain, hull: &str, patches: u32, room: Capacity) -> Both {
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let source = format!(
        "struct Vertex {{ @builtin(position) position: vec4f }}\n{hull}\n\
         fn domain(number: u32, uv: vec2f) -> Vertex {{ return Vertex(vec4f(uv, 0.0, 1.0)); }}"
    );
    let depth = wgpu::DepthStencilState {
        format: wgpu::TextureFormat::Depth32Float,
        depth_write_enabled: Some(true),
        depth_compare: Some(wgpu::CompareFunction::Less),
        stencil: wgpu::StencilState::default(),
        bias: wgpu::DepthBiasState::default(),
    };
    Builder::new(&source, domain, config, patches)
        .depth(depth)
        .points(Points::PullWithoutIndices)
        .room(Room::Exactly(room))
        .build(&gpu.device)
        .unwrap_or_else(|error| panic!("{error}"))
}

/// 2^19 quads of factor 64 give 2^32 triangles, whose low word by itself would fit anywhere. The
/// device takes 2048 workgroups in a row, so every pass has several rows.
#[test]
#[ignore = "slow: millions of patches"]
fn sums_beyond_32_bits_are_seen() {
    let limits = wgpu::Limits { max_compute_workgroups_per_dimension: 2048, ..Default::default() };
    let gpu = crate::common::device::limited(limits);
    let hull = "fn hull(number: u32) -> QuadFactors { return tess_quad_factors(vec4f(64.0)); }";
    let patches = 1 << 19;
    let room = Capacity { points: u32::MAX, primitives: 5_000_000 };
    let mut stage = large(&gpu, Domain::Quad, hull, patches, room);
    let found = stage.make_room(&gpu.queue, patches).expect("the device answers");
    assert_eq!([found.points, found.primitives], [4225 << 19, 1 << 32], "{found:?}");
    // Factor 2 gives 8 triangles for each patch, factor 3 would give 18.
    assert_eq!(found.drawn, 8 << 19, "{found:?}");
    assert!((2.0..3.0).contains(&(64.0 * found.scale).ceil()), "{found:?}");
}

/// An isoline patch of factors 64 has 64 lines of 65 points and 64 segments, so points can exceed
/// 32 bits where primitives do not.
#[test]
#[ignore = "slow: millions of patches"]
fn points_beyond_32_bits_are_seen_where_primitives_are_fewer() {
    let gpu = pollster::block_on(Gpu::open()).unwrap_or_else(|error| panic!("{error}"));
    let hull = "fn hull(number: u32) -> IsolineFactors { return IsolineFactors(64.0, 64.0); }";
    let patches = 1_040_000;
    let room = Capacity { points: u32::MAX, primitives: u32::MAX };
    let mut stage = large(&gpu, Domain::Isoline, hull, patches, room);
    let found = pollster::block_on(stage.make_room_async(&gpu.queue, patches));
    let found = found.expect("the device answers");
    let all = u64::from(patches);
    assert_eq!([found.points, found.primitives], [all * 64 * 65, all * 64 * 64], "{found:?}");
    assert_eq!(found.drawn, all * 63 * 63, "the next scale gives factor 63: {found:?}");
}
