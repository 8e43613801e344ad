//! Tests of `tess mesh` on glTF files that break the rules of the format: each is a valid file with
//! one change.

use crate::mesh::{counts, mesh, write};
use crate::mesh_input::refused;
use crate::support::{directory, tess};
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};
use std::fs;
use std::path::{Path, PathBuf};

/// A triangle with normals, texture coordinates and 16-bit indices, all in one buffer.
pub(crate) fn triangle() -> (Value, Vec<u8>) {
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

/// The first primitive of a document's first mesh.
fn primitive(gltf: &mut Value) -> &mut Value {
    &mut gltf["meshes"][0]["primitives"][0]
}

fn remove(object: &mut Value, name: &str) {
    let removed = object.as_object_mut().and_then(|members| members.remove(name));
    assert!(removed.is_some(), "{name} was there");
}

/// Writes the document as a file that contains its buffer.
pub(crate) fn write_gltf(folder: &Path, name: &str, mut document: Value, bytes: &[u8]) -> PathBuf {
    if document["buffers"][0].get("uri").is_none() {
        let data = BASE64_STANDARD.encode(bytes);
        document["buffers"][0]["uri"] =
            json!(format!("data:application/octet-stream;base64,{data}"));
    }
    write(folder, name, document.to_string())
}

/// A change of the triangle, and part of the message with which the result is refused.
type Broken = (fn(&mut Value), &'static str);

fn check(name: &str, cases: &[Broken]) {
    let folder = directory(name);
    let (document, bytes) = triangle();
    let right = write_gltf(&folder, "right.gltf", document.clone(), &bytes);
    assert_eq!(counts(&mesh(&right, "--factor 1", &folder.join("right.obj"))), [1, 3, 1], "right");
    for (change, message) in cases {
        let mut wrong = document.clone();
        change(&mut wrong);
        refused(&write_gltf(&folder, "wrong.gltf", wrong, &bytes), "", message);
    }
}

#[test]
#[expect(clippy::too_many_lines, reason = "a table of cases")]
fn types_that_attributes_must_not_have() {
    let cases: &[Broken] = &[
        (
            |gltf| {
                gltf["accessors"][0]["componentType"] = json!(5120);
                gltf["bufferViews"][0]["byteStride"] = json!(12);
            },
            "meshes[0].primitives[0].attributes.POSITION: accessors[0]",
        ),
        (
            |gltf| {
                gltf["accessors"][0]["componentType"] = json!(5121);
                gltf["bufferViews"][0]["byteStride"] = json!(12);
            },
            "is Vec3 of UnsignedByte; it must be VEC3 of Float",
        ),
        (
            |gltf| {
                gltf["accessors"][0]["componentType"] = json!(5122);
                gltf["bufferViews"][0]["byteStride"] = json!(12);
            },
            "meshes[0].primitives[0].attributes.POSITION: accessors[0]",
        ),
        (
            |gltf| {
                gltf["accessors"][0]["componentType"] = json!(5125);
                gltf["bufferViews"][0]["byteStride"] = json!(12);
            },
            "meshes[0].primitives[0].attributes.POSITION: accessors[0]",
        ),
        (
            |gltf| {
                gltf["accessors"][0]["componentType"] = json!(5124);
                gltf["bufferViews"][0]["byteStride"] = json!(12);
            },
            "accessors[0].componentType: 5124 is not a component type",
        ),
        (
            |gltf| {
                gltf["accessors"][0]["componentType"] = json!((1_u64 << 31) + 5126);
                gltf["bufferViews"][0]["byteStride"] = json!(12);
            },
            "is not a component type",
        ),
        (|gltf| gltf["accessors"][0]["type"] = json!("VEC2"), "is Vec2 of Float; it must be VEC3"),
        (
            |gltf| {
                gltf["accessors"][0]["type"] = json!("VEC4");
                gltf["accessors"][0]["count"] = json!(2);
            },
            "is Vec4 of Float; it must be VEC3",
        ),
        (
            |gltf| {
                gltf["accessors"][0]["type"] = json!("MAT4");
                gltf["bufferViews"][0]["byteLength"] = json!(104);
                gltf["accessors"][0]["count"] = json!(1);
            },
            "is Mat4 of Float",
        ),
        (
            |gltf| gltf["accessors"][0]["type"] = json!("VEC5"),
            "accessors[0].type: unknown variant `VEC5`",
        ),
        (
            |gltf| gltf["accessors"][1]["type"] = json!("SCALAR"),
            "NORMAL: accessors[1] is Scalar of Float",
        ),
        (
            |gltf| {
                gltf["accessors"][3]["type"] = json!("VEC2");
                gltf["accessors"][3]["count"] = json!(2);
            },
            "meshes[0].primitives[0].indices: accessors[3] is Vec2 of UnsignedShort",
        ),
        (
            |gltf| gltf["accessors"][3]["componentType"] = json!(5122),
            "accessors[3] is Scalar of Short",
        ),
        (
            |gltf| gltf["accessors"][3]["componentType"] = json!(5120),
            "accessors[3] is Scalar of Byte",
        ),
        (|gltf| remove(&mut primitive(gltf)["attributes"], "POSITION"), "there is no face"),
        (|gltf| primitive(gltf)["mode"] = json!(7), "primitives[0].mode: 7 is not a mode: 0 to 6"),
    ];
    check("mesh_gltf_types", cases);
}

/// One replaced position, whose index is at this byte of the indices.
fn sparse(byte_offset: u32) -> Value {
    let indices = json!({"bufferView": 3, "componentType": 5123, "byteOffset": byte_offset});
    json!({"count": 1, "values": {"bufferView": 0}, "indices": indices})
}

#[test]
#[expect(clippy::too_many_lines, reason = "a table of cases")]
fn bytes_that_are_not_there() {
    let cases: &[Broken] = &[
        (
            |gltf| gltf["accessors"][0]["count"] = json!(4),
            "accessors[0].count: 4 elements of 12 bytes, 12 apart",
        ),
        (|gltf| gltf["accessors"][1]["count"] = json!(4), "accessors[1].count: 4 elements"),
        (|gltf| gltf["accessors"][1]["byteOffset"] = json!(4), "accessors[1].count: 3 elements"),
        (|gltf| gltf["accessors"][0]["count"] = json!(u64::MAX), "accessors[0].count:"),
        (
            |gltf| gltf["accessors"][0]["bufferView"] = json!(4),
            "accessors[0].bufferView: 4 is out of range",
        ),
        (
            |gltf| gltf["accessors"][0]["bufferView"] = json!(1_u64 << 32),
            "accessors[0].bufferView:",
        ),
        (|gltf| remove(&mut gltf["accessors"][0], "bufferView"), "all faces, 1, have no area"),
        (
            |gltf| gltf["bufferViews"][0]["byteStride"] = json!(4),
            "accessors[0].bufferView: its byteStride 4",
        ),
        (
            |gltf| gltf["bufferViews"][0]["byteStride"] = json!(13),
            "accessors[0].count: 3 elements of 12 bytes, 13 apart",
        ),
        (
            |gltf| gltf["bufferViews"][0]["byteLength"] = json!(105),
            "bufferViews[0].byteLength: 105 bytes from 0",
        ),
        (
            |gltf| gltf["bufferViews"][0]["byteOffset"] = json!(u64::MAX),
            "bufferViews[0].byteLength:",
        ),
        (
            |gltf| gltf["bufferViews"][0]["buffer"] = json!(1),
            "bufferViews[0].buffer: 1 is out of range",
        ),
        (
            |gltf| gltf["buffers"][0]["byteLength"] = json!(105),
            "buffers[0]: it has 104 of its 105 bytes",
        ),
        (
            |gltf| gltf["buffers"][0]["byteLength"] = json!(1_u64 << 40),
            "buffers[0].byteLength: 1099511627776 bytes of 1 bytes each",
        ),
        (
            |gltf| primitive(gltf)["attributes"]["POSITION"] = json!(9),
            "POSITION: 9 is out of range",
        ),
        (|gltf| primitive(gltf)["indices"] = json!(9), "indices: 9 is out of range"),
        (|gltf| gltf["accessors"][3]["count"] = json!(2), "there is no face"),
        (
            |gltf| gltf["bufferViews"][3]["byteOffset"] = json!(12),
            "accessors[3] index 16256 at 1 is out of",
        ),
        (
            |gltf| {
                gltf["accessors"][0]["sparse"] = sparse(10);
                gltf["bufferViews"][3]["byteOffset"] = json!(72);
                gltf["bufferViews"][3]["byteLength"] = json!(24);
            },
            "accessors[0].sparse.indices: 16256 is out of range: there are 3 elements",
        ),
        (
            |gltf| gltf["accessors"][0]["sparse"] = sparse(8),
            "accessors[0].sparse.indices: count: 1 elements",
        ),
        (
            |gltf| gltf["accessors"][0]["sparse"] = sparse(1),
            "accessors[0].sparse.indices: 256 is out of range",
        ),
    ];
    check("mesh_gltf_bytes", cases);
}

/// JSON is UTF-8, even in members that are not read.
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
    let cases: &[Broken] = &[
        (
            |gltf| gltf["asset"]["version"] = json!("1.0"),
            "asset.version: 1.0 is not read, only 2.x",
        ),
        (
            |gltf| gltf["asset"]["version"] = json!("3.0"),
            "asset.version: 3.0 is not read, only 2.x",
        ),
        (|gltf| gltf["asset"]["version"] = json!("two"), "asset.version: `two` is not a version"),
        (
            |gltf| gltf["asset"]["version"] = json!(2),
            r#"asset.version: 2 is not a version such as "2.0""#,
        ),
        (
            |gltf| remove(&mut gltf["asset"], "version"),
            "asset.version: it is missing; only glTF 2.x is read",
        ),
        // Version 1 has objects where version 2 has lists.
        (
            |gltf| {
                gltf["asset"]["version"] = json!("1.0");
                gltf["nodes"] = json!({"node": {}});
            },
            "asset.version: 1.0 is not read",
        ),
        (
            |gltf| gltf["asset"]["minVersion"] = json!("2.9"),
            "asset.minVersion: 2.9 is needed, but 2.0",
        ),
        (
            |gltf| gltf["extensionsRequired"] = json!(["KHR_texture_transform", "X_y"]),
            "extensionsRequired[1]: `X_y` is not",
        ),
        (|gltf| gltf["scene"] = json!(1), "scene: 1 is out of range: there are 1 scenes"),
        (
            |gltf| gltf["nodes"][0]["mesh"] = json!(7),
            "nodes[0].mesh: 7 is out of range: there are 1 meshes",
        ),
        (
            |gltf| gltf["nodes"][0]["scale"] = json!([1, 1e39, 1]),
            "nodes[0].scale: a number is too large",
        ),
        (
            |gltf| gltf["nodes"][0]["rotation"] = json!([1, 1, 1, 1]),
            "nodes[0].rotation: it is not a unit",
        ),
        (|gltf| gltf["nodes"][0]["matrix"] = json!(vec![0; 16]), "nodes[0].matrix: its last row"),
    ];
    check("mesh_gltf_documents", cases);
}

/// A chain of nodes, each of which has the next node as its child twice.
fn twins(count: usize) -> Value {
    let node = |k: usize| {
        if k + 1 < count { json!({"children": [k + 1, k + 1]}) } else { json!({"mesh": 0}) }
    };
    (0..count).map(node).collect()
}

/// Nodes must form trees, so that walking through them ends.
#[test]
fn nodes_in_circles() {
    let cases: &[Broken] = &[
        (
            |gltf| gltf["nodes"][0]["children"] = json!([0]),
            "nodes: node 0 is below itself; nodes must form trees",
        ),
        (
            |gltf| gltf["nodes"] = twins(40),
            "nodes[0].children[1]: node 1 is a child of another node already",
        ),
        (
            |gltf| gltf["nodes"][0]["children"] = json!([5]),
            "nodes[0].children[0]: 5 is out of range",
        ),
        (|gltf| gltf["scenes"][0]["nodes"] = json!([3]), "scenes[0].nodes[0]: 3 is out of range"),
    ];
    check("mesh_gltf_nodes", cases);
}

#[test]
fn many_nodes() {
    let folder = directory("mesh_gltf_chain");
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
    // A small file with a large scene: 16 million vertices, five times.
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
    let message = "primitives[0]: 16777216 vertices of 64 bytes each";
    refused(&many, "--max-memory 100", message);
    refused(&many, "--max-memory 100", "--max-memory raises the limit");
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
        (glb[..glb.len() - 4].to_vec(), "GLB chunk 1: its length is "),
        (changed(4, 1), "GLB header: version 1; only 2 is read; convert the file"),
        (changed(8, length[0] - 4), "GLB chunk 1: its length is "),
        (changed(15, 1), "GLB chunk 0: its length is"),
        (changed(16, b'B'), "GLB chunk 0: it must be of type JSON"),
        (
            [b"glTF", &2u32.to_le_bytes()[..], &0u32.to_le_bytes()].concat(),
            "GLB chunk 0: it must be of type JSON",
        ),
        ([b"glTF", &2u32.to_le_bytes()[..], &12u32.to_le_bytes()].concat(), "GLB chunk 0: "),
    ] {
        refused(&write(&folder, "cut.glb", bytes), "", message);
    }
    tess(&format!("mesh {} -o {}", whole.display(), folder.join("out.png").display())).exits(0);
}
