//! Points that are evaluated once: the stored vertices, and every draw of them.

use crate::common::device::limited;
use crate::drawing::{WAYS, scene};
use crate::model::{compare, drawn};
use crate::scene::{FORMAT, PATCHES, Scene, source};
use tess_core::{Config, Domain, OutputPrimitive, Partitioning, Patch, PatchFactors};
use tess_gpu::layout::Status;
use tess_wgpu::TessellationStage;
use tess_wgpu::stage::{Material, Points, Room};

/// The vertices of a frame of the scene, as words: position, u and v, number, and one word that is
/// never written.
fn model(scene: &Scene, patches: &[PatchFactors]) -> Vec<[u32; 7]> {
    let of_patch = |(number, &factors): (u16, &PatchFactors)| {
        let points = Patch::new(scene.config, factors).tessellate().points;
        let vertex = move |[u, v]: [f32; 2]| {
            let (x, y) = (f32::from(number % 4) + u, f32::from(number / 4) + v);
            let floats = [0.5 * x - 1.0, 1.0 - y, 0.5, 1.0, u, v];
            let mut words = [u32::from(number); 7];
            words[..6].copy_from_slice(&floats.map(f32::to_bits));
            words
        };
        points.into_iter().map(move |point| vertex(point.to_f32()))
    };
    (0..).zip(patches).flat_map(of_patch).collect()
}

/// The vertices of a stage's last frame.
fn stored(scene: &Scene, stage: &TessellationStage) -> Vec<[u32; 7]> {
    let status = scene.gpu.read(&stage.status(), 32).expect("it answers");
    let status: Status = bytemuck::pod_read_unaligned(&status);
    let layout = stage.vertex_layout();
    assert_eq!(layout.array_stride, 32, "{layout:?}");
    let vertices = stage.vertices().expect("they are stored");
    let bytes = scene.gpu.read(&vertices, 32 * status.points()).expect("it answers");
    let words: Vec<[u32; 8]> = bytemuck::pod_collect_to_vec(&bytes);
    words.into_iter().map(|all| [0, 1, 2, 3, 4, 5, 6].map(|word| all[word])).collect()
}

#[test]
#[ignore = "slow: many pipelines"]
fn the_vertices_are_what_domain_returns_for_the_models_points() {
    for domain in [Domain::Triangle, Domain::Quad] {
        for partitioning in Partitioning::ALL {
            let scene = scene(domain, partitioning);
            let mut stage = scene.build(scene.builder().points(Points::Evaluated));
            for count in [8, 3, 0, 8] {
                scene.frame(&mut stage, count.into()).expect("it draws");
                let mut expected = model(&scene, &scene.patches[..count as usize]);
                assert_eq!(stored(&scene, &stage), expected, "{domain:?}, {partitioning:?}");
                if let Some(last) = expected.last_mut() {
                    last[5] ^= 1;
                    assert_ne!(stored(&scene, &stage), expected, "a bit of the last is seen");
                }
            }
        }
    }
}

/// Large quads on a device whose bindings hold 4 MiB.
pub(crate) fn on_small_bindings() -> Scene {
    let gpu = limited(wgpu::Limits {
        max_storage_buffer_binding_size: 4 << 20,
        ..wgpu::Limits::default()
    });
    let config = Config::new(Partitioning::Integer, OutputPrimitive::TriangleCw);
    let patches = [40.0, 41.0, 64.0, 0.0, 50.0, 1.0, 63.0, 47.0]
        .map(|factor| PatchFactors::uniform(Domain::Quad, factor));
    Scene::on(gpu, Domain::Quad, config, patches.to_vec())
}

/// One binding holds only part of the vertices: 4 MiB hold 3968 vertices of 1056 bytes, so these
/// quads take five windows.
#[test]
fn vertices_beyond_one_binding_are_evaluated_in_windows() {
    let scene = on_small_bindings();
    let wide = source(Domain::Quad)
        .replace("@builtin(position) position", "@size(1040) @builtin(position) position");
    let build =
        |text: &str, room| scene.build(scene.builder_of(text).room(room).points(Points::Evaluated));
    let mut narrow = build(&source(Domain::Quad), Room::WorstCase);
    let mut stage = build(&wide, Room::Bytes(32 << 20));
    assert_eq!(stage.vertex_layout().array_stride, 1056, "1040, 8 and 4, rounded up to 16");
    let room = stage.capacity();
    let needed: usize = model(&scene, &scene.patches).len();
    assert!(room.points as usize > needed && needed > 4 * 3968, "{room:?} for {needed}");
    let expected = scene.frame(&mut narrow, PATCHES.into()).expect("it draws");
    let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
    assert!(observed == expected && drawn(&observed) > 1000, "the picture is the same");
    let layout = stage.vertex_layout();
    let at = |name: &str| layout.member(name).expect("a member").offset;
    assert_eq!([at("position"), at("uv"), at("number")], [0, 1040, 1048], "{layout:?}");
}

#[test]
fn room_that_grows_replaces_the_vertices() {
    let scene = scene(Domain::Quad, Partitioning::FractionalOdd);
    let room = Room::Automatic { most_bytes: 1 << 20 };
    let mut stage = scene.build(scene.builder().points(Points::Evaluated).room(room));
    let first = stage.vertices().expect("they are stored");
    for _ in 0..4 {
        scene.frame(&mut stage, PATCHES.into()).expect("it draws");
    }
    assert_ne!(stage.vertices(), Some(first), "the room grew");
    assert_eq!(stored(&scene, &stage), model(&scene, &scene.patches), "in the new room");
}

/// The scene's WGSL with another mark, and with a function of `project` that moves the places by a
/// number of patches.
fn material(mark: u32, by: u32) -> String {
    source(Domain::Quad).replace("vertex.number, 1u", &format!("vertex.number, {mark}u"))
        + &format!(
            "fn moved(vertex: Vertex) -> Vertex {{\n    var other = vertex;\n    \
             let cell = (vertex.number + {by}u) % 8u;\n    \
             let by = place(cell) - place(vertex.number);\n    \
             other.position += vec4f(0.5 * by.x, -by.y, 0.0, 0.0);\n    return other;\n}}\n"
        )
}

/// Each of them draws the same as a separate stage would.
#[test]
#[ignore = "slow: many pipelines"]
fn one_output_is_drawn_with_many_materials() {
    let scene = scene(Domain::Quad, Partitioning::FractionalEven);
    for points in WAYS {
        let room = Room::Automatic { most_bytes: 4 << 20 };
        let first = material(1, 0);
        let builder = scene.builder_of(&first).points(points).room(room).groups(&[0, 3]);
        let builder = builder.project("moved");
        let mut stage = scene.build(builder);
        let others = [2, 3].map(|mark| {
            let text = material(mark, mark);
            let other = stage.material(&text).project("moved").target(FORMAT);
            let other = other.bind_group(&scene.layout, &scene.group).build();
            (mark, other.unwrap_or_else(|error| panic!("{error}")))
        });
        // The first frame is coarser; later ones have more room.
        for frame in 0..4 {
            let mut encoder = scene.gpu.device.create_command_encoder(&Default::default());
            stage.prepare(&mut encoder, PATCHES).expect("it is prepared");
            scene.gpu.run(encoder).expect("the device finishes");
            let draw = |material: &Material, group| {
                let encoder = scene.gpu.device.create_command_encoder(&Default::default());
                let drawn = scene.draw_only(encoder, |pass| {
                    let drawn = match group {
                        None => material.draw(pass, stage.frame()),
                        Some(group) => material.draw_group(pass, stage.frame(), group),
                    };
                    drawn.expect("it is the last frame");
                });
                drawn.expect("it draws")
            };
            let own = draw(&stage.material, None);
            if frame == 3 {
                let expected = scene.pixels(&scene.patches);
                assert_eq!(compare(&own, &expected), Ok(()), "{points:?}, with room");
            }
            for (mark, other) in &others {
                let alone = material(*mark, *mark);
                let builder = scene.builder_of(&alone).project("moved").points(points);
                let mut alone = scene.build(builder.room(Room::Exactly(stage.capacity())));
                let expected = scene.frame(&mut alone, PATCHES.into()).expect("it draws");
                assert!(draw(other, None) == expected, "{points:?}, {mark}, frame {frame}");
                assert!(expected != own, "the material is seen");
                let rest = draw(other, Some(1));
                let is_seen = rest.iter().any(|pixel| pixel[3] == *mark);
                assert!(is_seen && rest != expected, "{points:?}: a group of it");
            }
        }
    }
}

/// Four octaves of noise, which a GPU's compiler may round differently in a compute shader: the
/// README says which pictures agree nevertheless.
#[test]
#[ignore = "slow: a pipeline of a thousand instructions"]
fn a_long_domain_gives_the_same_bits_wherever_the_readme_says_so() {
    let scene = scene(Domain::Quad, Partitioning::FractionalEven);
    let row = "let at = place(number) + uv;";
    let text = source(Domain::Quad);
    assert!(text.contains(row), "{text}");
    let text = text.replace(row, "let at = place(number) + uv + 0.01 * noise(place(number) + uv);")
        + "fn noise(at: vec2f) -> vec2f {\n    var sum = vec2f();\n    var scale = 1.0;\n    \
           for (var octave = 0; octave < 4; octave++) {\n        \
           let cell = scale * at * mat2x2f(0.8, 0.6, -0.6, 0.8);\n        \
           sum += sin(cell.yx * 12.9898 + cell * 78.233) / scale;\n        scale *= 2.0;\n    }\n    \
           return sum;\n}\n";
    // The flat member holds the bits of the place instead of those of the domain point.
    let text = text.replace("uv, number);", "at, number);");
    let mut stage = scene.build(scene.builder_of(&text).points(Points::Evaluated));
    let mut encoder = scene.gpu.device.create_command_encoder(&Default::default());
    stage.make_room(&scene.gpu.queue, PATCHES).expect("the device answers");
    stage.prepare(&mut encoder, PATCHES).expect("it is prepared");
    scene.gpu.run(encoder).expect("the device finishes");
    let pictures = [1, 2].map(|mark| {
        let marked = text.replace("vertex.number, 1u", &format!("vertex.number, {mark}u"));
        let other = stage.material(&marked).target(FORMAT);
        let other = other.bind_group(&scene.layout, &scene.group).build();
        let other = other.unwrap_or_else(|error| panic!("{error}"));
        let encoder = scene.gpu.device.create_command_encoder(&Default::default());
        let drawn = scene.draw_only(encoder, |pass| {
            other.draw(pass, stage.frame()).expect("it is the last frame");
        });
        drawn.expect("it draws")
    });
    let [first, second] = &pictures;
    assert!(drawn(first) > 1000 && first != second, "two materials");
    let place = |[u, v, number, _]: &[u32; 4]| [*u, *v, *number];
    assert!(first.iter().map(place).eq(second.iter().map(place)), "of the same vertices");
    let [stored, pulled, unindexed] = [Points::Stored, Points::Pull, Points::PullWithoutIndices]
        .map(|points| {
            let order = tess_gpu::Order::Specification;
            let builder = scene.builder_of(&text).points(points).room(Room::WorstCase).order(order);
            scene.frame(&mut scene.build(builder), PATCHES.into()).expect("it draws")
        });
    assert!(stored == pulled && pulled == unindexed, "vertex shaders agree");
    assert!(drawn(&stored) > 1000, "they are seen");
}

/// With `project` and a `domain` without a camera, every way to draw gives the same picture.
#[test]
#[ignore = "slow: many pipelines"]
fn project_is_called_after_domain_in_every_way_to_draw() {
    let scene = scene(Domain::Quad, Partitioning::FractionalOdd);
    let text = material(1, 3);
    let mut patches = scene.patches.clone();
    patches.rotate_right(3);
    let expected = scene.pixels(&patches).into_iter().map(|pixel| {
        pixel.map(|[u, v, number, is_drawn]| [u, v, (number + 5 * is_drawn) % 8, is_drawn])
    });
    let expected: Vec<_> = expected.collect();
    let unmoved = scene.pixels(&scene.patches);
    for points in WAYS {
        let builder = scene.builder_of(&text).points(points).room(Room::WorstCase);
        let mut stage = scene.build(builder.clone().project("moved"));
        let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
        assert_eq!(compare(&observed, &expected), Ok(()), "{points:?}");
        let observed = scene.frame(&mut scene.build(builder), PATCHES.into()).expect("it draws");
        assert_eq!(compare(&observed, &unmoved), Ok(()), "{points:?}, without");
    }
}
