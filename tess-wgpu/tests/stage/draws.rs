//! Values of a draw that the WGSL asks for: the factors, the instance and the view.

use crate::drawing::{WAYS, scene};
use crate::model::compare;
use crate::room::scaled;
use crate::scene::{FORMAT, PATCHES, SIZE, Scene, in_pass, source};
use tess_core::{Domain, Partitioning};
use tess_gpu::Capacity;
use tess_wgpu::stage::{Frame, Points, Room, StageError};
use tess_wgpu::{DeviceLimits, Error, Gpu};
use wgpu::BufferUsages as Usage;

/// The scene's WGSL, with pixels that hold the bits of a patch's first factor instead of its
/// number.
fn with_factors(domain: Domain) -> String {
    let first = if domain == Domain::Isoline { "density" } else { "edges.x" };
    let text = source(domain);
    let returned = "uv, number);";
    assert!(text.contains(returned), "{text}");
    text.replace(returned, &format!("uv, bitcast<u32>(tess_factors(number).{first}));"))
}

/// Each way with each domain and each room.
#[test]
fn domain_sees_the_factors_that_are_drawn() {
    see_their_factors(|numbers| numbers.iter().sum::<usize>() % 2 == 0);
}

#[test]
#[ignore = "slow: every way with every domain in every room"]
fn domain_sees_its_factors_in_every_way() {
    see_their_factors(|_| true);
}

/// Draws where `is_chosen` is true of the numbers of domain, room and way. The second room is too
/// small, so the factors are scaled down.
fn see_their_factors(is_chosen: impl Fn([usize; 3]) -> bool) {
    let rooms = [Room::WorstCase, Room::Exactly(Capacity { points: 300, primitives: 350 })];
    for (of_domain, domain) in [Domain::Triangle, Domain::Quad].into_iter().enumerate() {
        let scene = scene(domain, Partitioning::FractionalOdd);
        let text = with_factors(domain);
        for (of_room, room) in rooms.into_iter().enumerate() {
            let ways = WAYS.into_iter().enumerate();
            for (_, points) in ways.filter(|(way, _)| is_chosen([of_domain, of_room, *way])) {
                sees_its_factors(&scene, &text, points, room);
            }
        }
    }
}

fn sees_its_factors(scene: &Scene, text: &str, points: Points, room: Room) {
    let mut stage = scene.build(scene.builder_of(text).points(points).room(room));
    let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
    let scale = stage.feedback().expect("the frame ran").scale;
    assert_eq!(scale < 1.0, room != Room::WorstCase, "{scale} in {room:?}");
    let patches = scaled(&scene.patches, scene.domain, scale);
    let first: Vec<u32> =
        patches.iter().map(|patch| patch.iter().next().expect("a factor").to_bits()).collect();
    let expected = scene.pixels(&patches).into_iter().map(|pixel| {
        pixel.map(|[u, v, number, is_drawn]| match is_drawn {
            1 => [u, v, first[number as usize], 1],
            _ => [0; 4],
        })
    });
    let expected: Vec<_> = expected.collect();
    assert_eq!(compare(&observed, &expected), Ok(()), "{points:?}, {:?}, {room:?}", scene.domain);
}

/// The first four patches, with each instance one row lower.
#[test]
fn instances_are_drawn_and_numbered() {
    let scene = scene(Domain::Quad, Partitioning::FractionalEven);
    let row = "let at = place(number) + uv;";
    let text = source(Domain::Quad);
    assert!(text.contains(row), "{text}");
    let in_domain = text.replace(row, "let at = place(number + 4u * tess_instance()) + uv;");
    let in_project = text
        + "fn lower(vertex: Vertex) -> Vertex {\n    var other = vertex;\n    \
           other.position.y -= f32(tess_instance());\n    return other;\n}\n";
    let mut patches = scene.patches[..4].to_vec();
    patches.extend_from_within(..);
    let expected = scene
        .pixels(&patches)
        .into_iter()
        .map(|pixel| pixel.map(|[u, v, number, is_drawn]| [u, v, number % 4, is_drawn]));
    let both: Vec<_> = expected.collect();
    let one = scene.pixels(&scene.patches[..4]);
    for points in WAYS {
        for (text, project) in [(&in_domain, None), (&in_project, Some("lower"))] {
            if points == Points::Evaluated && project.is_none() {
                continue;
            }
            let builder = scene.builder_of(text).points(points).groups(&[0]).room(Room::WorstCase);
            let builder = project.into_iter().fold(builder, |builder, name| builder.project(name));
            let mut stage = scene.build(builder);
            for (count, expected) in [(1, &one), (2, &both), (1, &one)] {
                stage.set_instances(count).expect("there is room");
                let observed = scene.frame(&mut stage, 4.into()).expect("it draws");
                assert_eq!(compare(&observed, expected), Ok(()), "{count}, {points:?}");
                let observed = scene.frame_with(&mut stage, 4.into(), |stage, pass| {
                    stage.draw_group(pass, 0).expect("it is there");
                });
                let observed = observed.expect("it draws");
                assert_eq!(compare(&observed, expected), Ok(()), "{count}, of the group");
            }
        }
    }
}

/// Each layer of the target shows the patches, moved by its number.
#[test]
fn views_are_drawn_at_once_and_numbered() {
    let gpu = Gpu::open_with(DeviceLimits::Highest, wgpu::Features::MULTIVIEW);
    let gpu = pollster::block_on(gpu).unwrap_or_else(|error| panic!("{error}"));
    // On OpenGL, wgpu lacks the feature.
    if gpu.info.backend == wgpu::Backend::Gl {
        return;
    }
    let like = scene(Domain::Quad, Partitioning::FractionalEven);
    let scene = Scene::on(gpu, Domain::Quad, like.config, like.patches);
    let text = source(Domain::Quad)
        + "fn of_view(vertex: Vertex) -> Vertex {\n    var other = vertex;\n    \
           other.position.y -= f32(tess_view());\n    return other;\n}\n";
    let target = scene.gpu.device.create_texture(&wgpu::TextureDescriptor {
        label: Some("two layers"),
        size: wgpu::Extent3d { width: SIZE[0], height: SIZE[1], depth_or_array_layers: 2 },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
        view_formats: &[],
    });
    let views = std::num::NonZeroU32::new(0b11);
    for points in WAYS {
        let builder = scene.builder_of(&text).points(points).room(Room::WorstCase);
        let builder = builder.project("of_view").views(views.expect("two bits"));
        let mut stage = scene.build(builder);
        let mut encoder = scene.gpu.device.create_command_encoder(&Default::default());
        stage.prepare(&mut encoder, 4).expect("it is prepared");
        in_pass(&mut encoder, &target, views, |pass| stage.draw(pass));
        let layers = layers(&scene.gpu, encoder, &target);
        let row = (SIZE[0] * SIZE[1] / 2) as usize;
        let expected = scene.pixels(&scene.patches[..4]);
        assert_eq!(compare(&layers[0], &expected), Ok(()), "{points:?}, view 0");
        let (above, below) = layers[1].split_at(row);
        assert!(above.iter().all(|pixel| pixel[3] == 0), "{points:?}: view 1 is a row lower");
        let moved = [below, above].concat();
        assert_eq!(compare(&moved, &expected), Ok(()), "{points:?}, view 1");
    }
}

/// The pixels of both layers, after the commands have run.
fn layers(
    gpu: &Gpu,
    mut encoder: wgpu::CommandEncoder,
    target: &wgpu::Texture,
) -> [Vec<crate::scene::Pixel>; 2] {
    let size = u64::from(2 * 16 * SIZE[0] * SIZE[1]);
    let pixels = gpu.buffer("pixels", size, Usage::COPY_DST | Usage::COPY_SRC).expect("room");
    encoder.copy_texture_to_buffer(
        target.as_image_copy(),
        wgpu::TexelCopyBufferInfo {
            buffer: &pixels,
            layout: wgpu::TexelCopyBufferLayout {
                offset: 0,
                bytes_per_row: Some(16 * SIZE[0]),
                rows_per_image: Some(SIZE[1]),
            },
        },
        target.size(),
    );
    gpu.run(encoder).expect("the device finishes");
    let all: Vec<crate::scene::Pixel> =
        bytemuck::pod_collect_to_vec(&gpu.read(&pixels, size).expect("it answers"));
    let (first, second) = all.split_at(all.len() / 2);
    [first.to_vec(), second.to_vec()]
}

/// The refusal of a stage.
fn refused(scene: &Scene, text: &str, points: Points, project: Option<&str>) -> Error {
    let builder = scene.builder_of(text).points(points);
    let builder = project.into_iter().fold(builder, |builder, name| builder.project(name));
    builder.build(&scene.gpu.device).map(|_| ()).expect_err("it is refused")
}

#[test]
fn values_of_a_draw_are_refused_where_there_is_no_draw() {
    let scene = scene(Domain::Quad, Partitioning::Integer);
    let text = source(Domain::Quad);
    let in_hull = |call: &str| {
        text.replace("let at = 6u * number;", &format!("let at = 6u * (number + {call});"))
    };
    let row = "let at = place(number) + uv;";
    let in_domain = text.replace(row, &format!("let now = tess_instance(); {row}"));
    for (text, points, function, instead) in [
        (in_hull("tess_instance()"), Points::Stored, "hull", "`domain`"),
        (in_hull("tess_view()"), Points::Evaluated, "hull", "`project`"),
        (in_hull("u32(tess_factors(0u).edges.x)"), Points::Pull, "hull", "`domain`"),
        (in_domain, Points::Evaluated, "domain", "`project`"),
    ] {
        let error = refused(&scene, &text, points, None).to_string();
        let says = format!("has no value in `{function}`");
        assert!(error.contains(&says) && error.contains(instead), "{error}");
        assert!(error.starts_with("line "), "{error}");
    }
    let error = refused(&scene, &text, Points::Stored, Some("camera"));
    assert_eq!(error, StageError::NoSuchFunction { name: "camera".to_owned() }.into());
    assert!(error.to_string().contains("fn camera(vertex: Vertex) -> Vertex"), "{error}");
}

#[test]
fn vertices_that_no_buffer_holds_are_refused() {
    let scene = scene(Domain::Quad, Partitioning::Integer);
    let text = source(Domain::Quad);
    let member = "@location(1) @interpolate(flat) number: u32,";
    assert!(text.contains(member), "{text}");
    for (to, says) in [
        (
            "@builtin(clip_distances) number: array<f32, 1>,",
            "`number` is `@builtin(clip_distances)`, which no vertex buffer can hold",
        ),
        ("@location(AT) number: u32,", "write the `@location` of `number` as a number"),
        ("@location(1) number: array<u32, 2>,", "the type `array<u32,2>`, which no vertex"),
        ("number: u32,", "`number` has neither `@location` nor `@builtin`"),
    ] {
        let wrong = text.replace(member, to);
        let error = refused(&scene, &wrong, Points::Evaluated, None).to_string();
        assert!(error.contains(says) && error.starts_with("line "), "{error}");
    }
    let error =
        refused(&scene, &text.replace("struct Vertex", "struct Edge"), Points::Evaluated, None);
    assert!(error.to_string().contains("there is no `struct Vertex`"), "{error}");
    let far = text.replace("@location(1)", "@location(16)");
    let limit = "max_vertex_attributes";
    let expected = Error::LimitTooLow { limit, needed: 17, got: 16 };
    assert_eq!(refused(&scene, &far, Points::Evaluated, None), expected);
}

/// The number of groups changes before a material is made that reads what no other does: its bind
/// group, too, belongs to the output that is drawn.
#[test]
fn a_material_that_is_made_after_other_groups_draws_them() {
    let scene = scene(Domain::Quad, Partitioning::Integer);
    let text = with_factors(Domain::Quad);
    for points in WAYS {
        let mut both = scene.build(scene.builder().points(points).groups(&[0]));
        both.set_groups(&[0, 3]).expect("they ascend");
        let other = both.material(&text).bind_group(&scene.layout, &scene.group).target(FORMAT);
        let other = other.build().unwrap_or_else(|error| panic!("{error}"));
        for frame in 0..2 {
            let mut encoder = scene.gpu.device.create_command_encoder(&Default::default());
            both.prepare(&mut encoder, PATCHES).expect("it is prepared");
            let drawn = scene.draw_only(encoder, |pass| {
                both.draw_group(pass, 0).expect("the first material");
                other.draw_group(pass, both.frame(), 1).expect("the groups are new");
            });
            let drawn = drawn.unwrap_or_else(|error| panic!("{points:?}, frame {frame}: {error}"));
            let patches = drawn.iter().filter(|pixel| pixel[3] == 1).count();
            assert!(patches > 0, "{points:?}, frame {frame}: nothing is drawn");
        }
    }
}

#[test]
fn only_the_last_frame_of_a_materials_own_stage_is_drawn() {
    let scene = scene(Domain::Quad, Partitioning::Integer);
    let mut stage = scene.build(scene.builder().points(Points::Evaluated));
    let mut other = scene.build(scene.builder().points(Points::Evaluated));
    let refusal = |both: &crate::both::Both, frame: &Frame| {
        let encoder = scene.gpu.device.create_command_encoder(&Default::default());
        let mut refused = None;
        let drawn = scene.draw_only(encoder, |pass| {
            refused = both.material.draw(pass, frame).err();
        });
        let pixels = drawn.expect("the pass goes on");
        assert_eq!(refused.is_some(), crate::model::drawn(&pixels) == 0, "{refused:?}");
        refused
    };
    scene.frame(&mut other, PATCHES.into()).expect("it draws");
    scene.frame(&mut stage, PATCHES.into()).expect("it draws");
    let first = stage.frame().clone();
    assert_eq!(refusal(&stage, &first), None, "again");
    assert_eq!(refusal(&other, &first), Some(StageError::OtherStage.into()));
    scene.frame(&mut stage, PATCHES.into()).expect("it draws");
    let old = StageError::OldFrame { frame: 0, last: 1 };
    assert_eq!(refusal(&stage, &first), Some(old.clone().into()));
    assert!(old.to_string().contains("draw the frame that the last `prepare` returned"), "{old}");
    stage.make_room(&scene.gpu.queue, PATCHES).expect("the device answers");
    let last = stage.frame().clone();
    assert_eq!(refusal(&stage, &last), Some(StageError::OldFrame { frame: 1, last: 2 }.into()));
    // A hot reload replaces the stage and forgets a material, which holds no part of the new one.
    let gone = other.frame().clone();
    drop(std::mem::replace(&mut other, stage));
    let error = refusal(&other, &gone).expect("nothing stale is drawn");
    assert_eq!(error, StageError::StageGone.into());
    assert!(error.to_string().contains("make its materials again"), "{error}");
}

#[test]
fn a_material_without_project_among_others_with_it_says_so() {
    let scene = scene(Domain::Quad, Partitioning::Integer);
    let text = source(Domain::Quad) + "fn seen(vertex: Vertex) -> Vertex { return vertex; }";
    let stage = scene.builder_of(&text).points(Points::Evaluated).of_stage();
    let stage = stage.build(&scene.gpu.device).unwrap_or_else(|error| panic!("{error}"));
    let material = || stage.material(&text).bind_group(&scene.layout, &scene.group).target(FORMAT);
    let projected = material().project("seen").build().expect("the first");
    let refused = material().build().map(drop).expect_err("it would be drawn elsewhere");
    assert_eq!(refused, StageError::ProjectForgotten { function: None }.into());
    assert!(refused.to_string().contains("add `.project(...)`"), "{refused}");
    let meant = material().unprojected().build();
    assert_eq!(meant.map(drop), Ok(()), "as it says");
    assert_eq!(material().project("seen").build().map(drop), Ok(()), "like the first");
    drop(projected);
    let plain = material().build().expect("the others are gone");
    let refused = material().project("seen").build().map(drop).expect_err("the other way round");
    let function = Some("seen".to_owned());
    assert_eq!(refused, StageError::ProjectForgotten { function }.into());
    assert!(refused.to_string().contains("`.project(\"seen\")`"), "{refused}");
    drop(plain);
}

#[test]
fn a_material_has_the_struct_of_the_stored_vertices() {
    let quads = scene(Domain::Quad, Partitioning::Integer);
    let wide = source(Domain::Quad)
        .replace("flat) number: u32,", "flat) number: u32, @location(2) more: f32,");
    let wide = wide.replace("uv, number);", "uv, number, 0.0);");
    let other = StageError::OtherVertex;
    for (points, expected) in [(Points::Evaluated, Some(other.into())), (Points::Stored, None)] {
        let stage = quads.build(quads.builder().points(points));
        let built = stage.material(&wide).bind_group(&quads.layout, &quads.group).target(FORMAT);
        assert_eq!(built.build().err(), expected, "{points:?}");
    }
}
