//! Rules of glTF, each broken once: what the surface needs is refused with its place.

use crate::support::{Gltf, has_note};
use serde_json::json;

/// The beginning of a message, and the change after which a triangle is refused with it.
type Refused = (&'static str, fn(&mut Gltf));

/// The number of a new sparse part of the positions.
fn sparse(gltf: &mut Gltf, indices: &[u8], component: u32) {
    let indices = gltf.view(indices);
    let values = gltf.view(&[0; 24]);
    gltf.document["accessors"][0]["sparse"] = json!({
        "count": 2, "indices": {"bufferView": indices, "componentType": component},
        "values": {"bufferView": values},
    });
}

fn skin(gltf: &mut Gltf, matrices: usize) {
    let numbers: Vec<f32> = (0..16 * matrices).map(|k| f32::from(u8::from(k % 5 == 0))).collect();
    let inverse = gltf.floats(&numbers, "MAT4", matrices);
    gltf.document["skins"] = json!([{"joints": [0, 0], "inverseBindMatrices": inverse}]);
    gltf.document["nodes"][0]["skin"] = json!(0);
}

#[test]
fn accessors_that_are_refused() {
    let cases: &[Refused] = &[
        ("accessors[0].normalized: only bytes and shorts can be normalized", |gltf| {
            gltf.document["accessors"][0]["componentType"] = json!(5125);
            gltf.document["accessors"][0]["normalized"] = json!(true);
        }),
        ("accessors[0].sparse.indices: they do not increase", |gltf| sparse(gltf, &[1, 1], 5121)),
        ("accessors[0].sparse.indices: they do not increase", |gltf| sparse(gltf, &[2, 1], 5121)),
        ("accessors[0].sparse.indices: 3 is out of range: there are 3 elements", |gltf| {
            sparse(gltf, &[1, 3], 5121);
        }),
        ("accessors[0].sparse.indices.componentType: Byte is not an unsigned integer", |gltf| {
            sparse(gltf, &[0, 1], 5120);
        }),
        ("accessors[0].sparse.count: 4 is more than the accessor's count, 3", |gltf| {
            sparse(gltf, &[0, 1, 2, 3], 5121);
            gltf.document["accessors"][0]["sparse"]["count"] = json!(4);
        }),
        ("skins[0].inverseBindMatrices: accessors[1] has 1 matrices for 2 joints", |gltf| {
            skin(gltf, 1);
        }),
        ("nodes[0]: a morph weight is too large for 32 bits", |gltf| {
            gltf.document["nodes"][0]["weights"] = json!([1e39]);
        }),
        ("meshes[0].primitives[0].indices: accessors[1] index 255 at 2 is out of range", |gltf| {
            // There are more vertices than that, but the largest byte restarts a strip.
            gltf.document["accessors"][0] =
                json!({"componentType": 5126, "type": "VEC3", "count": 300});
            let indices = gltf.accessor(&[0, 1, 255], 5121, "SCALAR", 3);
            gltf.primitive()["indices"] = json!(indices);
        }),
        (
            "there is no face: 1 primitive with indices that make no whole triangle: those are left out",
            |gltf| {
                let indices = gltf.accessor(&[0, 1], 5121, "SCALAR", 2);
                gltf.primitive()["indices"] = json!(indices);
                gltf.primitive()["mode"] = json!(5);
            },
        ),
    ];
    for (message, change) in cases {
        let mut gltf = Gltf::triangle();
        change(&mut gltf);
        let refused = gltf.refused();
        assert!(refused.starts_with(message), "{refused}, not {message}");
    }
}

/// Elements that are not a multiple of their unit apart are read, with a note.
#[test]
fn elements_that_are_not_aligned() {
    let mut gltf = Gltf::triangle();
    gltf.bytes = [0.0f32, 0., 0., 1., 0., 0., 0., 1., 0.]
        .chunks(3)
        .flat_map(|at| [at.iter().flat_map(|x| x.to_le_bytes()).collect(), vec![9, 9]].concat())
        .collect();
    gltf.document["bufferViews"][0]["byteLength"] = json!(42);
    gltf.document["bufferViews"][0]["byteStride"] = json!(14);
    has_note(&gltf.loaded(), "1 value that breaks a rule of glTF");
}

/// Of two primitives one has colours: they are two parts, and the other's colours are white.
#[test]
fn colours_of_one_primitive() {
    let mut gltf = Gltf::triangle();
    let colors = gltf.floats(&[0.5; 9], "VEC3", 3);
    let with = json!({"attributes": {"POSITION": 0, "COLOR_0": colors}});
    for (primitives, white) in [
        (json!([{"attributes": {"POSITION": 0}}, with.clone()]), 0..3),
        (json!([with.clone(), {"attributes": {"POSITION": 0}}]), 3..6),
    ] {
        gltf.document["meshes"] = json!([{"primitives": primitives}]);
        let loaded = gltf.loaded();
        assert_eq!(loaded.parts.list.len(), 2, "with and without");
        let values = &loaded.parts.channels[0].values;
        for (vertex, value) in values.iter().enumerate() {
            let expected = if white.contains(&vertex) { [1.0; 4] } else { [0.5, 0.5, 0.5, 1.0] };
            assert_eq!(value.to_vec(), expected.to_vec(), "vertex {vertex}");
        }
    }
}

/// Places in the second primitive are counted from its first triangle.
#[test]
fn places_in_later_primitives() {
    let mut gltf = Gltf::triangle();
    let bad = gltf.floats(&[0., 0., f32::NAN, 0., 0., 1.], "VEC2", 3);
    gltf.document["meshes"] = json!([{"primitives": [
        {"attributes": {"POSITION": 0}}, {"attributes": {"POSITION": 0, "TEXCOORD_0": bad}},
    ]}]);
    has_note(&gltf.loaded(), "(first: nodes[0], meshes[0].primitives[1], triangle 0)");
}

/// Only the first buffer is that of a GLB file.
#[test]
fn a_second_buffer_without_a_uri() {
    let mut gltf = Gltf::triangle();
    gltf.document["bufferViews"][0]["buffer"] = json!(1);
    gltf.document["buffers"] = json!([{"byteLength": 36}, {"byteLength": 36}]);
    let mut json = gltf.document.to_string().into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let word = |number: usize| u32::try_from(number).expect("a small file").to_le_bytes();
    let (head, bin) = (word(json.len()), word(gltf.bytes.len()));
    let length = word(28 + json.len() + gltf.bytes.len());
    let file = [b"glTF", &word(2)[..], &length, &head, b"JSON", &json, &bin, b"BIN\0", &gltf.bytes];
    let read = tess_mesh::read(&file.concat(), tess_mesh::Format::Gltf, None, &Default::default());
    let message = read.expect_err("its contents are nowhere").to_string();
    assert_eq!(message, "buffers[1]: it has no uri, and is not the first buffer of a GLB file");
}
