//! The model is given back: materials, images, names, parts, colours, further texture coordinates
//! and tangents; vertices that patches share are written once.

use crate::edges::CUBE;
use crate::support::{Gltf, floats_of, obj, written};
use serde_json::{Value, json};
use tess_mesh::tess_surface::{Address, FactorRule};
use tess_mesh::write::Obj;
use tess_mesh::{Job, Loaded};

fn obj_of(loaded: &Loaded, factor: f32) -> String {
    let mut obj = Obj::new(Vec::new()).with_parts(&loaded.parts, "../in/");
    let job =
        Job { parts: Some(&loaded.parts), ..Job::new(&loaded.model, FactorRule::Uniform(factor)) };
    job.run(&mut obj, &mut ()).expect("a sink without faults");
    String::from_utf8(obj.finish().expect("whole")).expect("text")
}

fn count(text: &str, start: &str) -> usize {
    text.lines().filter(|line| line.starts_with(start)).count()
}

/// A triangle with everything that a file can have.
fn rich() -> Gltf {
    let mut gltf = Gltf::triangle();
    let uv = gltf.floats(&[0., 0., 1., 0., 0., 1.], "VEC2", 3);
    let second = gltf.floats(&[0.5, 0., 0.75, 0., 0.5, 1.], "VEC2", 3);
    let colors = gltf.accessor(&[255, 0, 0, 0, 0, 255, 0, 0, 0, 0, 255, 0], 5121, "VEC3", 3);
    gltf.document["bufferViews"][3]["byteStride"] = json!(4);
    gltf.document["accessors"][colors]["normalized"] = json!(true);
    let tangents = gltf.floats(&[1., 0., 0., -1.].repeat(3), "VEC4", 3);
    let image = gltf.view(b"not really a PNG");
    for (name, accessor) in
        [("TEXCOORD_0", uv), ("TEXCOORD_1", second), ("COLOR_0", colors), ("TANGENT", tangents)]
    {
        gltf.attribute(name, accessor);
    }
    gltf.primitive()["material"] = json!(1);
    gltf.document["meshes"][0]["name"] = json!("sheet");
    gltf.document["nodes"][0]["name"] = json!("sail");
    gltf.document["nodes"][0]["scale"] = json!([2, 2, -2]);
    gltf.document["materials"] = json!([{}, {
        "name": "red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1],
            "baseColorTexture": {
                "index": 0, "extensions": {"KHR_texture_transform": {"scale": [2, 2]}}}},
    }]);
    gltf.document["textures"] = json!([{"source": 0, "sampler": 0}, {"source": 1}]);
    gltf.document["samplers"] = json!([{"wrapS": 33648, "wrapT": 33071}]);
    gltf.document["images"] =
        json!([{"bufferView": image, "mimeType": "image/png"}, {"uri": "b%20c.png"}]);
    gltf.document["extensionsUsed"] = json!(["KHR_texture_transform", "KHR_lights_punctual"]);
    gltf
}

#[test]
fn gltf_keeps_what_it_can() {
    let loaded = rich().loaded();
    assert_eq!(loaded.notes, [""; 0], "nothing is lost");
    assert_eq!(loaded.address, [Address::Mirror, Address::Clamp], "the sampler's");
    let (document, bytes) = written(&loaded, 2.0);
    let input = rich().document;
    for list in ["materials", "textures", "samplers"] {
        assert_eq!(document[list], input[list], "{list}");
    }
    assert_eq!(document["extensionsUsed"], json!(["KHR_texture_transform"]), "those of materials");
    assert_eq!(document["images"][1], json!({"uri": "../in/b%20c.png"}), "by reference");
    let view =
        &document["bufferViews"][document["images"][0]["bufferView"].as_u64().unwrap() as usize];
    let [start, length] =
        ["byteOffset", "byteLength"].map(|name| view[name].as_u64().unwrap() as usize);
    assert_eq!(&bytes[start..start + length], b"not really a PNG", "embedded");
    assert_eq!(
        (&document["nodes"][0]["name"], &document["meshes"][0]["name"]),
        (&json!("sail"), &json!("sheet")),
        "names"
    );
    let primitive = &document["meshes"][0]["primitives"][0];
    assert_eq!(primitive["material"], json!(1), "material");
    let values = |name: &str| floats_of(&document, &bytes, &primitive["attributes"][name]);
    let positions = values("POSITION");
    assert_eq!(positions.len(), 7, "a triangle of factor 2");
    for (at, position) in positions.iter().enumerate() {
        let [x, y] = [position[0] / 2.0, position[1] / 2.0];
        if x > 0.3 && x < 0.4 {
            continue; // the middle, at thirds
        }
        assert_eq!(values("TEXCOORD_0")[at], [x, y], "the first texture coordinates");
        assert_eq!(values("TEXCOORD_1")[at], [0.5 + x / 4.0, y], "the second ones");
        assert_eq!(values("COLOR_0")[at], [1.0 - x - y, x, y, 1.0], "colours");
        // The node mirrors.
        assert_eq!(values("TANGENT")[at], [1.0, 0.0, 0.0, 1.0], "tangents");
    }
}

#[test]
fn a_material_without_images() {
    let mut gltf = Gltf::triangle();
    gltf.primitive()["material"] = json!(0);
    let materials =
        json!([{"name": "red", "pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}}]);
    gltf.document["materials"] = materials.clone();
    let loaded = gltf.loaded();
    let (document, _) = written(&loaded, 3.0);
    assert_eq!(document["materials"], materials, "as it was");
    let attributes = &document["meshes"][0]["primitives"][0]["attributes"];
    assert_eq!(attributes.get("TEXCOORD_0"), None, "no invented texture coordinates");
    let text = obj_of(&loaded, 3.0);
    assert!(text.contains("usemtl red\n") && !text.contains("vt "), "{text}");
}

/// Two nodes with one mesh of two primitives: parts with names and materials of their own.
#[test]
fn parts_stay_apart() {
    let mut gltf = Gltf::triangle();
    let primitives = json!([
        {"attributes": {"POSITION": 0}, "material": 0}, {"attributes": {"POSITION": 0}, "material": 1},
    ]);
    gltf.document["meshes"] = json!([{"primitives": primitives, "name": "m"}]);
    gltf.document["nodes"] =
        json!([{"mesh": 0, "name": "a"}, {"mesh": 0, "name": "b", "translation": [5, 0, 0]}]);
    gltf.document["scenes"] = json!([{"nodes": [0, 1]}]);
    gltf.document["materials"] = json!([{"name": "x"}, {"name": "y"}]);
    let (document, _) = written(&gltf.loaded(), 1.0);
    let names = |list: &str| -> Vec<Value> {
        document[list].as_array().unwrap().iter().map(|value| value["name"].clone()).collect()
    };
    assert_eq!(
        (names("nodes"), names("meshes")),
        (vec![json!("a"), json!("b")], vec![json!("m"); 2]),
        "names"
    );
    for mesh in document["meshes"].as_array().unwrap() {
        let materials: Vec<&Value> =
            mesh["primitives"].as_array().unwrap().iter().map(|p| &p["material"]).collect();
        assert_eq!(materials, [&json!(0), &json!(1)], "materials");
    }
    let text = obj_of(&gltf.loaded(), 1.0);
    let named: Vec<&str> = text.lines().filter(|line| line.starts_with(['o', 'g', 'u'])).collect();
    assert_eq!(
        named,
        ["o a", "g m", "usemtl x", "usemtl y", "o b", "usemtl x", "usemtl y"],
        "{text}"
    );
}

#[test]
fn obj_keeps_names_and_colours() {
    let text = "mtllib a b.mtl\no box\ng left side\nusemtl oak # dark\n\
        v 0 0 0 1 0 0\nv 1 0 0 0 1 0\nv 0 1 0 0 0 1\nv 1 1 0 1 1 1\nvt 0 0\nvt 1 0\nvt 0 1\n\
        f 1/1 2/2 3/3\ng right\nf 2 4 3\n";
    let loaded = obj(text);
    let written_text = obj_of(&loaded, 1.0);
    let expected = "mtllib ../in/a b.mtl\no box\ng left side\nusemtl oak\n";
    assert!(written_text.starts_with(expected), "{written_text}");
    assert!(written_text.contains("\ng right\n"), "{written_text}");
    assert_eq!((count(&written_text, "vt "), count(&written_text, "v ")), (3, 6), "{written_text}");
    assert!(written_text.contains("v 1 0 0 0 1 0\n"), "{written_text}");
    assert!(written_text.contains("\nf 4//4 5//5 6//6\n"), "{written_text}");
    let again = obj(&written_text);
    assert_eq!(again.model.len(), 2, "it is read back");
    let (document, bytes) = written(&loaded, 2.0);
    assert_eq!(document["materials"], json!([{"name": "oak"}]), "by name");
    let primitive = &document["meshes"][0]["primitives"][0];
    let colors = floats_of(&document, &bytes, &primitive["attributes"]["COLOR_0"]);
    assert!(colors.contains(&vec![0.5, 0.5, 0.0, 1.0]), "{colors:?}");
}

/// Each object and group of an OBJ file is a node of glTF.
#[test]
fn objects_become_nodes() {
    let text =
        "v 0 0 0\nv 1 0 0\nv 0 1 0\no a\nf 1 2 3\no b\nf 1 3 2\no a\nf 2 3 1\ng c\nf 3 2 1\n";
    let (document, _) = written(&obj(text), 1.0);
    let nodes = document["nodes"].as_array().expect("nodes").iter();
    let names: Vec<&Value> = nodes.map(|node| &node["name"]).collect();
    assert_eq!(names, [&json!("a"), &json!("b"), &json!("a")], "a, b, and group c of a");
}

/// A closed smooth surface has as many vertices as a mesh with shared vertices.
#[test]
fn vertices_are_shared() {
    let smooth = obj(&format!("s 1\n{CUBE}"));
    let hard = obj(CUBE);
    for (factor, side, faces) in [(1.0, 2, 12), (2.0, 3, 48), (4.0, 5, 192)] {
        let text = obj_of(&smooth, factor);
        assert_eq!(count(&text, "f "), faces, "triangles");
        // Euler: V = 2 + E - F, and E = 3/2 F.
        assert_eq!(count(&text, "v "), 2 + faces / 2, "shared by all");
        assert_eq!(count(&obj_of(&hard, factor), "v "), 6 * side * side, "hard edges are seams");
    }
    let (document, _) = written(&smooth, 1.0);
    assert_eq!(document["accessors"][1]["count"], json!(8), "in glTF too");
}

/// A seam of texture coordinates stays: the positions are there twice.
#[test]
fn seams_stay() {
    let text = "s 1\nv 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n\
        f 1/1 2/2 3/3 4/4\nf 2/1 5/2 6/3 3/4\n";
    assert_eq!(count(&obj_of(&obj(text), 3.0), "v "), 32, "two squares of 16");
    let joined = text.replace("f 2/1 5/2 6/3 3/4", "f 2/2 5/1 6/4 3/3");
    assert_eq!(count(&obj_of(&obj(&joined), 3.0), "v "), 28, "four are shared");
}
