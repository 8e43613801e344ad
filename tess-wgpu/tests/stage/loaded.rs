//! Evaluated vertices of more than 32 bytes: loaded from a storage buffer where a draw can bind
//! them, and as attributes elsewhere. The pictures are those of small vertices.

use crate::common::objects::{group, layout, storage, whole};
use crate::drawing::scene;
use crate::evaluated::on_small_bindings;
use crate::model::{compare, drawn};
use crate::scene::{FORMAT, PATCHES, Scene, source};
use tess_core::{Domain, Partitioning};
use tess_gpu::Capacity;
use tess_wgpu::stage::{Material, Points, Room};
use wgpu::ShaderStages;

/// The scene's WGSL with a position of this many bytes; the vertex takes 16 more.
fn wide(text: &str, bytes: u32) -> String {
    let position = "@builtin(position) position";
    assert!(text.contains(position), "{text}");
    text.replace(position, &format!("@size({bytes}) {position}"))
}

/// The ways in which a material draws: whether it loads from a storage buffer, as attributes.
fn ways(material: &Material) -> [bool; 2] {
    let told = format!("{material:?}");
    ["load: Storage", "load: Attributes"].map(|way| told.contains(way))
}

#[test]
fn large_vertices_are_loaded_from_a_storage_buffer() {
    let scene = scene(Domain::Quad, Partitioning::FractionalOdd);
    let expected = scene.pixels(&scene.patches);
    for (bytes, is_large) in [(16, false), (32, true), (48, true)] {
        let text = wide(&source(Domain::Quad), bytes);
        let builder = scene.builder_of(&text).points(Points::Evaluated).room(Room::WorstCase);
        let mut stage = scene.build(builder.groups(&[0, 3]));
        assert_eq!(ways(&stage.material), [is_large, !is_large], "{bytes}");
        let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
        assert_eq!(compare(&observed, &expected), Ok(()), "{bytes}");
        let groups = scene.frame_with(&mut stage, PATCHES.into(), |stage, pass| {
            for group in [1, 0] {
                stage.draw_group(pass, group).expect("the group is there");
            }
        });
        assert_eq!(compare(&groups.expect("it draws"), &expected), Ok(()), "{bytes}, in groups");
    }
}

/// A bind group of the scene's factors, this number of times.
fn bound(scene: &Scene, count: usize) -> (wgpu::BindGroupLayout, wgpu::BindGroup) {
    let visibility = ShaderStages::VERTEX | ShaderStages::COMPUTE;
    let of = layout(&scene.gpu.device, visibility, vec![storage(true); count]);
    let bound = group(&scene.gpu.device, &of, whole(vec![&scene.factors; count]));
    (of, bound)
}

/// The stage's own bind group then has two bindings. In the last picture, two materials bind
/// different groups of one output.
#[test]
fn loaded_vertices_go_with_the_factors() {
    let scene = scene(Domain::Quad, Partitioning::FractionalEven);
    let first = "bitcast<u32>(tess_factors(vertex.number).edges.x)";
    let text = source(Domain::Quad).replace("vertex.number, 1u", &format!("{first}, 1u"));
    let [small, large] = [16, 32].map(|bytes| {
        let text = wide(&text, bytes);
        let builder = scene.builder_of(&text).points(Points::Evaluated).room(Room::WorstCase);
        let mut stage = scene.build(builder);
        assert_eq!(ways(&stage.material), [bytes == 32, bytes == 16]);
        let picture = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
        let (of, bound) = bound(&scene, 7);
        let other = stage.material(&text).bind_group(&of, &bound).target(FORMAT);
        let other = other.build().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(ways(&other), [false, true], "no storage buffer is left");
        let twice = scene.frame_with(&mut stage, PATCHES.into(), |stage, pass| {
            stage.draw(pass);
            other.draw(pass, stage.frame()).expect("it is the last frame");
        });
        assert!(twice.expect("it draws") == picture, "both draw the same");
        picture
    });
    let of_a_patch = scene.patches[3].iter().next().expect("a factor").to_bits();
    assert!(large.iter().any(|pixel| pixel[2] == of_a_patch), "the factors are seen");
    assert!(drawn(&large) > 1000 && small == large, "the same picture");
}

/// 4 MiB, the most of a binding, hold 7943 vertices of 528 bytes. The room grows beyond that, and
/// no frame is lost on the way.
#[test]
#[ignore = "slow: many pipelines"]
fn room_that_outgrows_a_binding_is_drawn_with_attributes() {
    let scene = on_small_bindings();
    let (small, large) = (source(Domain::Quad), wide(&source(Domain::Quad), 512));
    let of = |text, room| scene.build(scene.builder_of(text).room(room).points(Points::Evaluated));
    let mut stage = of(&large, Room::Automatic { most_bytes: 32 << 20 });
    assert_eq!(ways(&stage.material), [true, true], "the room can be of either kind");
    let rooms = [0, 1, 2, 3, 4].map(|frame| {
        let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
        let room = stage.capacity();
        let mut alone = of(&small, Room::Exactly(room));
        let expected = scene.frame(&mut alone, PATCHES.into()).expect("it draws");
        assert!(drawn(&observed) > 1000 && observed == expected, "frame {frame}, {room:?}");
        528 * u64::from(room.points)
    });
    assert!(rooms[0] <= 4 << 20 && rooms[4] > 4 << 20, "{rooms:?}");
    let most = of(&large, Room::Automatic { most_bytes: 4 << 20 });
    assert_eq!(ways(&most.material), [true, false], "no frame has more than a binding");
}

#[test]
fn without_room_nothing_is_drawn() {
    let scene = scene(Domain::Quad, Partitioning::Integer);
    let text = wide(&source(Domain::Quad), 32);
    let room = Room::Exactly(Capacity { points: 0, primitives: 0 });
    let builder = scene.builder_of(&text).points(Points::Evaluated).room(room);
    let observed = scene.frame(&mut scene.build(builder), PATCHES.into()).expect("it draws");
    assert_eq!(drawn(&observed), 0, "no point has room");
}

/// The user's bind groups may leave none to the stage, or no storage buffer.
#[test]
fn large_vertices_leave_the_user_all_bind_groups_and_buffers() {
    let scene = scene(Domain::Quad, Partitioning::Integer);
    let expected = scene.pixels(&scene.patches);
    let text = wide(&source(Domain::Quad), 32);
    let builder = scene.builder_of(&text).points(Points::Evaluated).room(Room::WorstCase);
    let mut stage = scene.build(builder);
    let [none, one, seven, eight] = [0, 1, 7, 8].map(|count| bound(&scene, count));
    for (groups, is_loaded) in [
        (vec![&one], true),
        (vec![&one, &none, &none], true),
        (vec![&one, &none, &none, &none], false),
        (vec![&seven], true),
        (vec![&eight], false),
    ] {
        let mut material = stage.material(&text).target(FORMAT);
        for (layout, group) in &groups {
            material = material.bind_group(layout, group);
        }
        stage.material = material.build().unwrap_or_else(|error| panic!("{error}"));
        assert_eq!(ways(&stage.material), [is_loaded, !is_loaded], "{} groups", groups.len());
        let observed = scene.frame(&mut stage, PATCHES.into()).expect("it draws");
        assert_eq!(compare(&observed, &expected), Ok(()), "{} groups", groups.len());
    }
}
