//! Every way to draw gives the model's triangles.

use crate::model::{compare, drawn};
use crate::scene::{PATCHES, Scene};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, PatchFactors};
use tess_gpu::Order;
use tess_wgpu::Error;
use tess_wgpu::TessellationStage;
use tess_wgpu::stage::{Factors, PatchCount, Points, Room, StageError};
use wgpu::BufferUsages as Usage;

pub(crate) const WAYS: [Points; 4] =
    [Points::Stored, Points::Pull, Points::PullWithoutIndices, Points::Evaluated];

/// Different factors for each edge and patch; one patch is culled.
pub(crate) fn some_factors(domain: Domain) -> Vec<PatchFactors> {
    let factor = |patch: u8, factor: u8| match (patch, factor) {
        (5, 1) => 0.0,
        _ => 1.0 + f32::from(patch) * 0.75 + f32::from(factor * 3 % 5),
    };
    let of = |patch: u8| {
        let mut number = 0;
        PatchFactors::from_fn(domain, |_| {
            number += 1;
            factor(patch, number)
        })
    };
    (0..8).map(of).collect()
}

pub(crate) fn scene(domain: Domain, partitioning: Partitioning) -> Scene {
    let config = Config::new(partitioning, OutputPrimitive::TriangleCw);
    Scene::new(domain, config, some_factors(domain))
}

/// Each way with each domain and each partitioning.
#[test]
fn ways_to_draw_give_the_models_triangles() {
    are_drawn(|numbers| numbers.iter().sum::<usize>() % 2 == 0);
}

#[test]
#[ignore = "slow: every way with every domain in every partitioning"]
fn every_way_to_draw_gives_the_models_triangles() {
    are_drawn(|_| true);
}

/// Draws in those ways for which `is_chosen` is true of the numbers of domain, partitioning and
/// way.
fn are_drawn(is_chosen: impl Fn([usize; 3]) -> bool) {
    let partitionings = [Partitioning::Integer, Partitioning::FractionalOdd];
    for (of_domain, domain) in [Domain::Triangle, Domain::Quad].into_iter().enumerate() {
        for (of_partitioning, partitioning) in partitionings.into_iter().enumerate() {
            let scene = scene(domain, partitioning);
            let expected = scene.pixels(&scene.patches);
            let ways = WAYS.into_iter().enumerate();
            for (_, points) in ways.filter(|(way, _)| is_chosen([of_domain, of_partitioning, *way]))
            {
                let mut stage = scene.build(scene.builder().points(points));
                let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
                assert_eq!(compare(&observed, &expected), Ok(()), "{points:?}, {domain:?}");
            }
        }
    }
}

/// Folded patches, in which rings overlap, so that their order decides which triangle is seen.
#[test]
#[ignore = "slow: every way in every order"]
fn a_given_order_is_that_of_every_way_to_draw() {
    let scene = scene(Domain::Quad, Partitioning::FractionalOdd);
    let unfolded = "place(number) + uv;";
    let source = crate::scene::source(Domain::Quad);
    assert!(source.contains(unfolded), "{source}");
    let source = source.replace(unfolded, "place(number) + abs(uv - vec2f(0.3, 0.4));");
    let picture = |points, order: Option<Order>| {
        let builder = scene.builder_of(&source).points(points).room(Room::WorstCase);
        let builder = order.into_iter().fold(builder, |builder, order| builder.order(order));
        scene.frame(&mut scene.build(builder), PATCHES.into()).expect("it draws")
    };
    let of_orders = [Order::Specification, Order::VertexCache].map(|order| {
        let pictures = WAYS.map(|points| picture(points, Some(order)));
        assert!(pictures.iter().all(|other| *other == pictures[0]), "{order:?}");
        pictures[0].clone()
    });
    assert!(of_orders[0] != of_orders[1], "the order is seen");
    let defaults = WAYS.map(|points| picture(points, None));
    let [specification, vertex_cache] = of_orders;
    let cached = || vertex_cache.clone();
    assert!(defaults == [cached(), cached(), specification, cached()], "as documented");
}

#[test]
fn another_factor_is_another_picture() {
    let scene = scene(Domain::Quad, Partitioning::FractionalOdd);
    let mut stage = scene.build(scene.builder());
    let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
    for patch in 0..8 {
        let mut patches = scene.patches.clone();
        patches[patch] = PatchFactors::uniform(Domain::Quad, 9.5);
        let difference = compare(&observed, &scene.pixels(&patches));
        assert!(difference.is_err(), "patch {patch} makes no difference");
    }
}

#[test]
fn factors_come_from_the_host_or_a_buffer_too() {
    let scene = scene(Domain::Quad, Partitioning::FractionalEven);
    let expected = scene.pixels(&scene.patches);
    let given = Factors::Buffer(&scene.factors);
    let mut stage = scene.build(scene.builder().factors(given));
    let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
    assert_eq!(compare(&observed, &expected), Ok(()), "from a buffer");
    let fewer = scene.pixels(&scene.patches[..3]);
    let observed = scene.frame(&mut stage, 3.into()).expect("it draws");
    assert_eq!(compare(&observed, &fewer), Ok(()), "three patches from a buffer");
    let mut stage = scene.build(scene.builder().factors(Factors::Host));
    let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
    assert_eq!(drawn(&observed), 0, "before there are factors");
    let mut encoder = scene.gpu.device.create_command_encoder(&Default::default());
    stage.set_factors(&mut encoder, &scene.patches).expect("they are the stage's");
    scene.gpu.run(encoder).expect("the device finishes");
    let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
    assert_eq!(compare(&observed, &expected), Ok(()), "from the host");
    let observed = scene.frame(&mut stage, 3.into()).expect("it draws");
    assert_eq!(compare(&observed, &fewer), Ok(()), "three patches from the host");
}

#[test]
fn the_number_of_patches_changes_from_frame_to_frame() {
    let scene = scene(Domain::Quad, Partitioning::Integer);
    let mut stage = scene.build(scene.builder());
    for count in [3, 8, 0, 1, 7] {
        let expected = scene.pixels(&scene.patches[..count]);
        let host = u32::try_from(count).expect("a few");
        let observed = scene.frame(&mut stage, host.into()).expect("it draws");
        assert_eq!(compare(&observed, &expected), Ok(()), "{count} patches, from the host");
        // The number from the device may also be too large.
        let asked = if count == 8 { 1000 } else { host };
        let bytes = [7_u32, asked].map(u32::to_le_bytes).concat();
        let buffer = scene.gpu.upload("count", &bytes, Usage::COPY_SRC).expect("there is room");
        let count_of = PatchCount::Device(&buffer, 4);
        let observed = scene.frame(&mut stage, count_of).expect("it draws");
        assert_eq!(compare(&observed, &expected), Ok(()), "{count} patches, from the device");
    }
}

#[test]
#[ignore = "slow: many pipelines"]
fn groups_are_drawn_one_by_one() {
    let scene = scene(Domain::Quad, Partitioning::FractionalOdd);
    for points in WAYS {
        let builder = scene.builder().groups(&[0, 3, 3, 6]).points(points);
        let mut stage = scene.build(builder);
        for (group, range) in [(0, 0..3), (1, 3..3), (2, 3..6), (3, 6..8)] {
            let observed = scene.frame_with(&mut stage, PATCHES.into(), |stage, pass| {
                stage.draw_group(pass, group).expect("it is there");
            });
            let mut patches = vec![PatchFactors::uniform(Domain::Quad, 0.0); 8];
            patches[range.clone()].clone_from_slice(&scene.patches[range]);
            let expected = scene.pixels(&patches);
            let observed = observed.expect("it draws");
            assert_eq!(compare(&observed, &expected), Ok(()), "group {group}, {points:?}");
        }
    }
}

#[test]
#[ignore = "slow: many pipelines"]
fn an_engine_draws_groups_with_its_own_pipeline() {
    let scene = scene(Domain::Quad, Partitioning::FractionalOdd);
    for points in [Points::Stored, Points::Evaluated] {
        an_engine_draws(&scene, points);
    }
}

fn an_engine_draws(scene: &Scene, points: Points) {
    let builder = scene.builder().points(points).groups(&[0]).of_stage();
    let layout = builder.vertex_layout().expect("a sound struct");
    let shader = builder.vertex_shader(None).expect("a sound struct");
    let pipeline = scene.pipeline(shader, "tess_vertex", &[Some(layout.buffer())]);
    let mut stage = builder.build(&scene.gpu.device).unwrap_or_else(|error| panic!("{error}"));
    let mut picture = |groups: &[u32], arguments: fn(&TessellationStage) -> wgpu::Buffer, at| {
        stage.set_groups(groups).expect("they ascend");
        let mut encoder = scene.gpu.device.create_command_encoder(&Default::default());
        stage.prepare(&mut encoder, PATCHES).expect("it is prepared");
        let observed = scene.draw_only(encoder, |pass| {
            let vertices = stage.vertices().expect("they are stored");
            let indices = stage.indices().expect("they are stored");
            pass.set_pipeline(&pipeline);
            pass.set_vertex_buffer(0, vertices.slice(..));
            pass.set_index_buffer(indices.slice(..), wgpu::IndexFormat::Uint32);
            pass.draw_indexed_indirect(&arguments(&stage), at);
        });
        observed.expect("it draws")
    };
    // The last groups are as many as those before.
    for groups in [&[0, 3, 6][..], &[0, 1, 1, 7], &[2], &[5]] {
        let ends = groups[1..].iter().copied().chain([PATCHES]);
        for (group, range) in groups.iter().zip(ends).map(|(&begin, end)| begin..end).enumerate() {
            let at = TessellationStage::GROUP_BYTES * group as u64;
            let observed = picture(groups, TessellationStage::group_indirect, at);
            let mut patches = vec![PatchFactors::uniform(Domain::Quad, 0.0); 8];
            let range = range.start as usize..range.end as usize;
            patches[range.clone()].clone_from_slice(&scene.patches[range]);
            let expected = scene.pixels(&patches);
            assert_eq!(compare(&observed, &expected), Ok(()), "group {group} of {groups:?}");
            let others = scene.pixels(&scene.patches);
            assert!(compare(&observed, &others).is_err(), "all patches would be seen");
        }
    }
    let observed = picture(&[0], TessellationStage::indirect, 0);
    assert_eq!(compare(&observed, &scene.pixels(&scene.patches)), Ok(()), "all of them");
    assert_eq!(stage.vertex_layout(), &layout, "of the stage too");
}

/// If the number of groups stays the same, they are copied in the next frame. If they are set again
/// before it, only the last ones count.
#[test]
fn the_last_groups_before_a_frame_count() {
    let scene = scene(Domain::Quad, Partitioning::Integer);
    let mut stage = scene.build(scene.builder().groups(&[0, 3]));
    stage.set_groups(&[0, 5]).expect("as many as before");
    stage.set_groups(&[0, 1, 7]).expect("more than before");
    for (group, range) in [(0, 0..1), (1, 1..7), (2, 7..8)] {
        let observed = scene.frame_with(&mut stage, PATCHES.into(), |stage, pass| {
            stage.draw_group(pass, group).expect("it is there");
        });
        let mut patches = vec![PatchFactors::uniform(Domain::Quad, 0.0); 8];
        patches[range.clone()].clone_from_slice(&scene.patches[range]);
        let expected = scene.pixels(&patches);
        assert_eq!(compare(&observed.expect("it draws"), &expected), Ok(()), "group {group}");
    }
}

#[test]
fn misplaced_groups_leave_the_stage_as_it_was() {
    let scene = scene(Domain::Quad, Partitioning::Integer);
    let mut stage = scene.build(scene.builder().groups(&[0, 3]));
    let refused = stage.set_groups(&[4, 3]);
    assert_eq!(refused, Err(Error::MisplacedGroup { group: 1, begin: 3, range: [4, PATCHES] }));
    let observed = scene.frame_with(&mut stage, PATCHES.into(), |stage, pass| {
        stage.draw_group(pass, 1).expect("it is still there");
    });
    assert_ne!(drawn(&observed.expect("it draws")), 0, "patches 3 to 7");
}

#[test]
fn a_vertex_shader_for_an_engine_reads_stored_points() {
    let scene = scene(Domain::Quad, Partitioning::Integer);
    for points in [Points::Pull, Points::PullWithoutIndices] {
        let refused = scene.builder().points(points).of_stage().vertex_shader(None);
        assert_eq!(refused.err(), Some(StageError::NothingStored.into()), "{points:?}");
        let stage = scene.build(scene.builder().points(points));
        assert_eq!(stage.vertices(), None, "{points:?}: the vertex shader computes them");
        assert_eq!(stage.indices().is_some(), points == Points::Pull, "{points:?}");
    }
}

/// The calls for browsers, which do not block.
#[test]
fn a_stage_is_made_and_read_without_blocking() {
    let scene = scene(Domain::Triangle, Partitioning::Integer);
    let built = pollster::block_on(scene.builder().build_async(&scene.gpu.device));
    let mut stage = built.unwrap_or_else(|error| panic!("{error}"));
    let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
    assert_eq!(compare(&observed, &scene.pixels(&scene.patches)), Ok(()), "as ever");
    let bytes: Vec<u8> = (0..=255).collect();
    let buffer = scene.gpu.upload("bytes", &bytes, Usage::COPY_SRC).expect("there is room");
    assert_eq!(pollster::block_on(scene.gpu.read_async(&buffer, 100)), Ok(bytes[..100].to_vec()));
    let beyond = pollster::block_on(scene.gpu.read_async(&buffer, 1000));
    assert!(matches!(beyond, Err(Error::Refused { .. })), "{beyond:?}");
}
