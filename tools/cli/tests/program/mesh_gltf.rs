//! `tess mesh` on glTF files that break the rules of the format.

use crate::mesh::{counts, mesh, write};
use crate::mesh_input::refused;
use crate::support::{directory, tess};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

/// A triangle with normals, texture coordinates and 16-bit indices, all in one buffer.
fn triangle() -> (Value, Vec<u8>) {
    let positions = [0.0f32, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0];
    let normals = [0.0f32, 0.0, 1.0].repeat(3);
    let texcoords = [0.0f32, 0.0, 1.0, 0.0, 0.0, 1.0];
    let floats = positions.iter().chain(&normals).chain(&texcoords);
    let mut bytes: Vec<u8> = floats.flat_map(|float| float.to_le_bytes()).collect();
    bytes.extend([0, 0, 1, 0, 2, 0, 0, 0]);
    let view =
        |offset: u32, length: u32| json!({"buffer": 0, "byteOffset": offset, "byteLength": length});
    let accessor = |view: u32, component: u32, kind: &str| json!({"bufferView": view, "componentType": component, "count": 3, "type": kind});
    let mut document = json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{
            "attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2}, "indices": 3,
        }]}],
        "accessors": [
            accessor(0, 5126, "VEC3"), accessor(1, 5126, "VEC3"), accessor(2, 5126, "VEC2"),
            accessor(3, 5123, "SCALAR"),
        ],
        "bufferViews": [view(0, 36), view(36, 36), view(72, 24), view(96, 8)],
        "buffers": [{"byteLength": 104}],
    });
    document["accessors"][0]["min"] = json!([0, 0, 0]);
    document["accessors"][0]["max"] = json!([1, 1, 0]);
    (document, bytes)
}

/// Puts a value in its place, such as `accessors/0/type`; `null` removes what is there.
fn set(document: &mut Value, path: &str, value: Value) {
    let (parent, name) = path.rsplit_once('/').unwrap_or(("", path));
    let pointer = if parent.is_empty() { String::new() } else { format!("/{parent}") };
    match document.pointer_mut(&pointer) {
        Some(Value::Array(list)) => list[name.parse::<usize>().expect("an index")] = value,
        Some(Value::Object(members)) if value.is_null() => _ = members.remove(name),
        Some(Value::Object(members)) => _ = members.insert(name.to_owned(), value),
        _ => panic!("{path} is in no list and no object"),
    }
}

/// The document as a file, its buffer in it.
fn write_gltf(folder: &Path, name: &str, mut document: Value, bytes: &[u8]) -> PathBuf {
    if document["buffers"][0].get("uri").is_none() {
        let data = BASE64_STANDARD.encode(bytes);
        document["buffers"][0]["uri"] =
            json!(format!("data:application/octet-stream;base64,{data}"));
    }
    write(folder, name, document.to_string())
}

/// Each line has changes of the triangle, `PATH=JSON` with `; ` between them, and what is said of the result.
fn check(folder: &str, cases: &str) {
    let folder = directory(folder);
    let (document, bytes) = triangle();
    let right = write_gltf(&folder, "right.gltf", document.clone(), &bytes);
    assert_eq!(counts(&mesh(&right, "--factor 1", &folder.join("right.obj"))), [1, 3, 1], "right");
    for case in cases.trim().lines() {
        let (changes, message) = case.split_once(" | ").expect("changes and a message");
        let mut wrong = document.clone();
        for change in changes.trim().split("; ") {
            let (path, value) = change.split_once('=').expect("a path and a value");
            set(&mut wrong, path, serde_json::from_str(value).expect(value));
        }
        refused(&write_gltf(&folder, "wrong.gltf", wrong, &bytes), "", message);
    }
}

#[test]
fn types_that_attributes_must_not_have() {
    check(
        "mesh_gltf_types",
        r#"
         accessors/0/componentType=5120; bufferViews/0/byteStride=12 | meshes[0].primitives[0].attributes.POSITION: accessors[0]
         accessors/0/componentType=5121; bufferViews/0/byteStride=12 | is Vec3 of UnsignedByte; it must be VEC3 of Float
         accessors/0/componentType=5122; bufferViews/0/byteStride=12 | meshes[0].primitives[0].attributes.POSITION: accessors[0]
         accessors/0/componentType=5125; bufferViews/0/byteStride=12 | meshes[0].primitives[0].attributes.POSITION: accessors[0]
         accessors/0/componentType=5124; bufferViews/0/byteStride=12 | accessors[0].componentType: 5124 is not a component type
         accessors/0/componentType=2147488774; bufferViews/0/byteStride=12 | is not a component type
         accessors/0/type="VEC2" | is Vec2 of Float; it must be VEC3
         accessors/0/type="VEC4"; accessors/0/count=2 | is Vec4 of Float; it must be VEC3
         accessors/0/type="MAT4"; bufferViews/0/byteLength=104; accessors/0/count=1 | is Mat4 of Float
         accessors/0/type="VEC5" | accessors[0].type: unknown variant `VEC5`
         accessors/1/type="SCALAR" | NORMAL: accessors[1] is Scalar of Float
         accessors/2/type="VEC3"; bufferViews/2/byteLength=36; bufferViews/2/byteOffset=64 | TEXCOORD_0: accessors[2] is Vec3
         accessors/2/componentType=5123 | TEXCOORD_0: accessors[2] is Vec2 of
         accessors/3/type="VEC2"; accessors/3/count=2 | meshes[0].primitives[0].indices: accessors[3] is Vec2 of UnsignedShort
         accessors/3/componentType=5122 | accessors[3] is Scalar of Short
         accessors/3/componentType=5120 | accessors[3] is Scalar of Byte
         accessors/0/normalized=true | accessors[0].normalized: only bytes
         accessors/0/min=null | accessors[0] has no min or no max
         meshes/0/primitives/0/attributes/NORMALS=1 | NORMALS: accessors[1] has a
         meshes/0/primitives/0/attributes/POSITION=null | attributes: no POSITION
         meshes/0/primitives/0/mode=5 | primitives[0].mode: mode 5; only"#,
    );
}

#[test]
fn bytes_that_are_not_there() {
    let sparse = r#"{"count":1,"values":{"bufferView":0},"indices":{"bufferView":3,"componentType":5123,"byteOffset""#;
    let cases = r#"
         accessors/0/count=4 | accessors[0].count: 4 elements of 12 bytes, 12 apart
         accessors/1/count=4 | accessors[1].count: 4 elements
         accessors/1/byteOffset=4 | accessors[1].count: 3 elements
         accessors/0/count=18446744073709551615 | accessors[0].count:
         accessors/0/count=0 | accessors[0].count: it is 0
         accessors/0/bufferView=4 | accessors[0].bufferView: 4 is out of range
         accessors/0/bufferView=4294967296 | accessors[0].bufferView:
         accessors/0/bufferView=null | it is missing, and so is sparse
         bufferViews/0/byteStride=4 | accessors[0].bufferView: its byteStride 4
         bufferViews/0/byteStride=13 | bufferViews[0].byteStride: 13 is not
         bufferViews/0/byteLength=105 | bufferViews[0].byteLength: 105 bytes from 0
         bufferViews/0/byteOffset=18446744073709551615 | bufferViews[0].byteLength:
         bufferViews/1/byteOffset=38 | accessors[1].byteOffset: components
         bufferViews/0/buffer=1 | bufferViews[0].buffer: 1 is out of range
         buffers/0/byteLength=105 | buffers[0]: it has 104 of its 105 bytes
         buffers/0/byteLength=1099511627776 | the buffers have more than 4 GiB
         meshes/0/primitives/0/attributes/POSITION=9 | POSITION: 9 is out of range
         meshes/0/primitives/0/indices=9 | indices: 9 is out of range
         accessors/2/count=2 | attributes.TEXCOORD_0: its count is not that of
         accessors/3/count=2 | accessors[3] 2 indices are no whole triangles
         bufferViews/3/byteOffset=12 | accessors[3] index 16256 at 1 is out of
         accessors/0/sparse=SPARSE:10}}; bufferViews/3/byteOffset=72; bufferViews/3/byteLength=24 | accessors[0].sparse.indices: 16256 is out of range: there are 3 elements
         accessors/0/sparse=SPARSE:8}} | accessors[0].sparse.indices: count: 1 elements
         accessors/0/sparse=SPARSE:1}} | accessors[0].sparse.indices: byteOffset: comp"#;
    check("mesh_gltf_bytes", &cases.replace("SPARSE", sparse));
}

/// JSON is UTF-8, also in the members that nobody reads.
#[test]
fn text_that_is_not_utf8() {
    let folder = directory("mesh_gltf_utf8");
    let (mut document, bytes) = triangle();
    document["extras"] = json!("caf\u{e9}");
    let input = write_gltf(&folder, "text.gltf", document, &bytes);
    mesh(&input, "--factor 1", &folder.join("out.obj"));
    let text = fs::read(&input).expect("it was written");
    let at = text.windows(2).position(|pair| pair == "\u{e9}".as_bytes()).expect("an e acute");
    let latin = [b"\n", &text[..at], b"\xE9", &text[at + 2..]].concat();
    refused(&write(&folder, "latin.gltf", latin), "", "the JSON is not UTF-8 at line 2");
}

#[test]
fn documents_for_other_readers() {
    check(
        "mesh_gltf_documents",
        r#"
         asset/version="1.0" | asset.version: 1.0 is not read, only 2.x
         asset/version="3.0" | asset.version: 3.0 is not read, only 2.x
         asset/version="two" | asset.version: `two` is not a version
         asset/version=2 | asset.version: invalid type
         asset/minVersion="2.9" | asset.minVersion: 2.9 is needed, but 2.0
         extensionsRequired=["X_y"] | extensionsRequired[0]: `X_y` is not
         scene=1 | scene: 1 is out of range: there are 1 scenes
         nodes/0/mesh=7 | nodes[0].mesh: 7 is out of range: there are 1 meshes
         nodes/0/scale=[1, 1e39, 1] | nodes[0].scale: a number is too large
         nodes/0/rotation=[1, 1, 1, 1] | nodes[0].rotation: it is not a unit
         nodes/0/matrix=[0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0] | nodes[0].matrix: its last row"#,
    );
}

/// Nodes form trees, so that walking them ends.
#[test]
fn nodes_in_circles() {
    let doubled: Vec<Value> = (0..40)
        .map(|k| if k < 39 { json!({"children": [k + 1, k + 1]}) } else { json!({"mesh": 0}) })
        .collect();
    let folder = directory("mesh_gltf_chain");
    let nodes = r#"
         nodes/0/children=[0] | scenes[0].nodes[0]: node 0 is a child of node 0
         nodes=DOUBLED | nodes[0].children[1]: node 1 is a child of node 0 already
         nodes/0/children=[5] | nodes[0].children[0]: 5 is out of range
         scenes/0/nodes=[0, 0] | scenes[0].nodes[1]: node 0 is there twice
         scenes/0/nodes=[3] | scenes[0].nodes[0]: 3 is out of range"#;
    check("mesh_gltf_nodes", &nodes.replace("DOUBLED", &json!(doubled).to_string()));
    let (mut chain, bytes) = triangle();
    let nodes = (0..20_000)
        .map(|k| if k < 19_999 { json!({"children": [k + 1]}) } else { json!({"mesh": 0}) });
    chain["nodes"] = nodes.collect();
    let chain = write_gltf(&folder, "chain.gltf", chain, &bytes);
    assert_eq!(
        counts(&mesh(&chain, "--factor 1", &folder.join("chain.obj"))),
        [1, 3, 1],
        "a chain"
    );
    // A small file of a large scene: 16 million vertices, five times.
    let (mut many, bytes) = triangle();
    many["nodes"] = (0..5).map(|_| json!({"mesh": 0})).collect();
    many["scenes"][0]["nodes"] = json!([0, 1, 2, 3, 4]);
    let mut accessor = json!({"componentType": 5126, "count": 1 << 24, "type": "VEC3",
        "min": [0, 0, 0], "max": [0, 0, 0]});
    accessor["sparse"] = json!({"count": 1, "indices": {"bufferView": 3, "componentType": 5123},
        "values": {"bufferView": 0}});
    many["accessors"][0] = accessor;
    many["meshes"][0]["primitives"][0]["attributes"] = json!({"POSITION": 0});
    let many = write_gltf(&folder, "many.gltf", many, &bytes);
    refused(&many, "", "primitives[0]: the scene has more than 67108864 vertices or triangles");
}

#[test]
fn buffers_stay_in_the_folder() {
    let parent = directory("mesh_gltf_buffers");
    let folder = parent.join("model");
    fs::create_dir_all(folder.join("data")).expect("folders");
    let (document, bytes) = triangle();
    write(&parent, "outside.bin", &bytes);
    write(&folder, "in side.bin", &bytes);
    write(&folder.join("data"), "deep.bin", [&bytes[..], &[0; 1000]].concat());
    write(&folder, "short.bin", &bytes[..50]);
    let with_uri = |uri: &str| {
        let mut document = document.clone();
        document["buffers"][0]["uri"] = json!(uri);
        write_gltf(&folder, "model.gltf", document, &[])
    };
    for uri in ["in%20side.bin", "data/deep.bin", "data/../in side.bin", "./data/deep.bin"] {
        let run = mesh(&with_uri(uri), "--factor 1", &folder.join("out.obj"));
        assert_eq!(counts(&run), [1, 3, 1], "{uri}");
    }
    let outside = parent.join("outside.bin");
    #[cfg_attr(not(unix), expect(unused_mut, reason = "links are Unix's"))]
    let mut cases = vec![
        (outside.to_str().expect("UTF-8"), "is not a file in the model's folder or below it"),
        (
            "/dev/zero",
            "buffers[0].uri: `/dev/zero` is not a file in the model's folder or below it",
        ),
        ("../outside.bin", "is not a file in the model's folder"),
        ("data/../../outside.bin", "is not a file in the model's folder"),
        ("%2e%2e/outside.bin", "is not a file in the model's folder"),
        ("file:///dev/zero", "is not a file in the model's folder"),
        ("https://example.org/x.bin", "is not a file in the model's folder"),
        ("%zz", "is not a file in the model's folder"),
        ("data", "data is not an ordinary file"),
        ("none.bin", "cannot read"),
        ("short.bin", "buffers[0]: it has 50 of its 104 bytes"),
        ("data:,text", "data without `;base64,` is not read"),
        ("data:;base64,?", "buffers[0].uri: "),
        ("data:;base64,AAAA", "buffers[0]: it has 3 of its 104 bytes"),
    ];
    #[cfg(unix)]
    {
        use std::os::unix::fs::symlink;
        symlink(&outside, folder.join("link.bin")).expect("a link");
        symlink("/dev/zero", folder.join("zero.bin")).expect("a link");
        cases.push(("link.bin", "is a link to a file outside of the model's folder"));
        cases.push(("zero.bin", "is a link to a file outside of the model's folder"));
    }
    for (uri, message) in cases {
        refused(&with_uri(uri), "", message);
    }
}

/// Headers and chunks that contradict the file.
#[test]
fn binary_files_that_are_cut() {
    let folder = directory("mesh_gltf_binary");
    let whole = folder.join("whole.glb");
    mesh(Path::new(""), "--factor 1", &whole);
    let glb = fs::read(&whole).expect("it was written");
    let changed = |at: usize, byte: u8| {
        let mut glb = glb.clone();
        glb[at] = byte;
        glb
    };
    let length = u32::try_from(glb.len()).expect("a small file").to_le_bytes();
    for (bytes, message) in [
        (glb[..10].to_vec(), "GLB header: it is cut off"),
        (glb[..glb.len() - 4].to_vec(), "GLB header: the length is "),
        (changed(4, 1), "GLB header: version 1; only 2 is read"),
        (changed(8, length[0] ^ 1), "GLB header: the length is "),
        (changed(12, glb[12] ^ 1), "GLB chunk 0: its length"),
        (changed(15, 1), "GLB chunk 0: its length is"),
        (changed(16, b'B'), "GLB chunk 0: it must be of type JSON"),
        (
            [b"glTF", &2u32.to_le_bytes()[..], &0u32.to_le_bytes()].concat(),
            "GLB header: the length is 0",
        ),
        ([b"glTF", &2u32.to_le_bytes()[..], &12u32.to_le_bytes()].concat(), "GLB chunk 0: "),
    ] {
        refused(&write(&folder, "cut.glb", bytes), "", message);
    }
    tess(&format!("mesh {} -o {}", whole.display(), folder.join("out.png").display())).exits(0);
}
