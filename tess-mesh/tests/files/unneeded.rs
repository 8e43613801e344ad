//! What nobody needs refuses nothing: it is left out with a note. What the surface needs is refused
//! with its place.

use crate::edges::CUBE;
use crate::support::{Gltf, has_note, obj, obj_with, tessellated};
use serde_json::{Value, json};
use tess_mesh::LoadOptions;

/// Words about a change of a document, and the change.
type Case = (&'static str, fn(&mut Value));

#[test]
fn obj_lines_that_nobody_needs() {
    for (line, note) in [
        ("vw 0 0 1", "1 line with a keyword that is not known: left out (first: `vw`, line 15)"),
        ("$ by hand", "1 line with a keyword that is not known"),
        ("t crease 2/1/0", "1 line with a keyword that is not known"),
        ("curv 0 1 1 2", "1 line of free-form curves or surfaces: left out"),
        ("vt -1.#IND 0", "1 `vt` or `vn` line that is not numbers: not used (first: line 15)"),
        ("vn 0 x 0", "1 `vt` or `vn` line that is not numbers"),
        ("vn 1 2", "1 `vt` or `vn` line that is not numbers"),
        ("vt", "1 `vt` or `vn` line that is not numbers"),
        ("f 1 2", "1 face with fewer than three corners: left out (first: line 15)"),
        ("f", "1 face with fewer than three corners"),
        ("p 1", "1 `l` or `p` line: left out"),
    ] {
        let loaded = obj(&format!("s off\n{}{line}\n", CUBE));
        assert_eq!((loaded.model.len(), loaded.notes.len()), (6, 1), "{line}: {:?}", loaded.notes);
        has_note(&loaded, &note.replace("line 15", "line 16"));
    }
    for line in ["v 1 one 1", "v nan 0 0", "v 1 2 1e39", "v 1 1", "v 1 2 3 0.5", "v 1 2 3 x y z"] {
        let loaded = obj(&format!("s off\n{CUBE}{line}\n"));
        assert_eq!(loaded.notes, [""; 0], "{line}: no face uses it");
    }
}

#[test]
fn values_that_are_not_there() {
    let texcoords = "1 face with texture coordinates that are not there, or not finite";
    for (lines, note) in [
        ("f 1/1 2/2 3/3", texcoords),
        ("f 1/x 2/2 3/3", texcoords),
        ("f 1/-1 2/-1 3/-1", texcoords),
        ("vt 0 0\nf 1/1 2/1 3", texcoords),
        ("vt nan 0\nf 1/1 2/1 3/1", texcoords),
        ("vt 1e30 0\nf 1/1 2/1 3/1", texcoords),
        ("f 1//1 2//2 3//3", "1 face with normals that are not there: they get smooth normals"),
        ("vn 0 0 1\nf 1//1 2//1 3", "1 face with normals that are not there"),
    ] {
        let loaded = obj(&format!("s off\nv 0 0 0\nv 1 0 0\nv 0 1 0\n{lines}\n"));
        has_note(&loaded, note);
        assert_eq!(loaded.model.len(), 1, "{lines}");
        assert!(!loaded.parts.list[0].has_texcoords, "{lines}");
        assert!((tessellated(&loaded, 3.0).area() - 0.5).abs() < 1e-6, "{lines}");
    }
}

#[test]
fn lines_that_go_on() {
    let loaded = obj("v 0 0 \\\n0\nv 1 0 0\nv 0 1 0 # \\\nf 1 \\\r\n 2 \\\n 3\n");
    assert_eq!(loaded.model.len(), 1, "one face");
    let error = obj_with("v 0 0 0\nf 1 \\\n1 \\\n9\n", &LoadOptions::default());
    let message = error.expect_err("a position is missing").to_string();
    assert_eq!(message, "line 2: position index 9 is out of range: there are 1");
}

/// A position that a face uses is needed.
#[test]
fn positions_that_are_needed() {
    for (line, message) in [
        (
            "v 1 one 1",
            "line 4: `v 1 one 1`: `one` is not a number; a position is three numbers; line 5 uses it",
        ),
        ("v 1 nan 1", "line 4: `v 1 nan 1`: `nan` is NaN, infinite or too large for 32 bits"),
        ("v 1 1", "line 4: `v 1 1`: a position is three numbers; line 5 uses it"),
    ] {
        let text = format!("v 0 0 0\nv 1 0 0\nv 0 1 0\n{line}\nf 1 2 4\n");
        let error = obj_with(&text, &LoadOptions::default()).expect_err("it is needed");
        assert!(error.to_string().starts_with(message), "{error}");
    }
    let polygon = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv x 0 0\nf 1 2 3 4 5\n";
    let error = obj_with(polygon, &LoadOptions::default()).expect_err("it is needed");
    assert!(error.to_string().starts_with("line 5: `v x 0 0`: `x` is not a number"), "{error}");
}

/// Changes of a glTF file after which it means the same.
#[test]
fn gltf_values_that_nobody_needs() {
    let cases: &[Case] = &[
        ("an accessor", |gltf| {
            gltf["accessors"].as_array_mut().expect("a list").push(json!({"bufferView": 9}));
        }),
        ("a view without bytes", |gltf| {
            let views = gltf["bufferViews"].as_array_mut().expect("a list");
            views.push(json!({"buffer": 0, "byteLength": 0}));
        }),
        ("a buffer that is not there", |gltf| {
            let buffers = gltf["buffers"].as_array_mut().expect("a list");
            buffers.push(json!({"byteLength": 8, "uri": "missing.bin"}));
        }),
        ("a node in no scene", |gltf| {
            let nodes = gltf["nodes"].as_array_mut().expect("a list");
            nodes.push(json!({"mesh": 7, "skin": 8, "rotation": [1, 1, 1, 1]}));
        }),
        ("a skin", |gltf| gltf["skins"] = json!([{}])),
        ("cameras", |gltf| gltf["cameras"] = json!(5)),
        ("joints without a skin", |gltf| {
            gltf["meshes"][0]["primitives"][0]["attributes"]["JOINTS_0"] = json!(99);
        }),
        ("a morph target without weights", |gltf| {
            gltf["meshes"][0]["primitives"][0]["targets"] = json!([{"POSITION": 99}]);
        }),
        ("a weight of 0", |gltf| {
            gltf["meshes"][0]["primitives"][0]["targets"] = json!([{"POSITION": 99}]);
            gltf["meshes"][0]["weights"] = json!([0]);
        }),
        ("a version with three numbers", |gltf| gltf["asset"]["version"] = json!("2.0.1")),
    ];
    for (what, change) in cases {
        let mut gltf = Gltf::triangle();
        change(&mut gltf.document);
        let loaded = gltf.loaded();
        assert_eq!((loaded.model.len(), &loaded.notes[..]), (1, &[][..]), "{what}");
    }
}

#[test]
fn gltf_values_that_are_left_out() {
    let cases: &[Case] = &[
        (
            "1 attribute that cannot be read: left out (first: meshes[0].primitives[0].attributes.TEXCOORD_0)",
            |gltf| gltf["meshes"][0]["primitives"][0]["attributes"]["TEXCOORD_0"] = json!(0),
        ),
        ("1 attribute that cannot be read: left out", |gltf| {
            gltf["meshes"][0]["primitives"][0]["attributes"]["COLOR_0"] = json!(77)
        }),
        ("1 value that breaks a rule of glTF: read all the same", |gltf| {
            gltf["meshes"][0]["primitives"][0]["attributes"]["NORMALS"] = json!(0)
        }),
        (
            "1 value that breaks a rule of glTF: read all the same, as the surface does not depend on it (first: scenes[0].nodes[1])",
            |gltf| {
                gltf["nodes"] = json!([{"children": [1]}, {"mesh": 0}]);
                gltf["scenes"][0]["nodes"] = json!([0, 1]);
            },
        ),
        ("1 value that breaks a rule of glTF", |gltf| gltf["scenes"][0]["nodes"] = json!([0, 0])),
        ("1 value that breaks a rule of glTF", |gltf| {
            gltf["meshes"][0]["primitives"][0]["material"] = json!(3)
        }),
        (
            "1 node that KHR_node_visibility hides: left out, with all below it (first: nodes[1])",
            |gltf| {
                gltf["nodes"] = json!([{"mesh": 0}, {"children": [2],
                    "extensions": {"KHR_node_visibility": {"visible": false}}}, {"mesh": 0}]);
                gltf["scenes"][0]["nodes"] = json!([0, 1]);
                gltf["extensionsRequired"] = json!(["KHR_node_visibility"]);
            },
        ),
    ];
    for (note, change) in cases {
        let mut gltf = Gltf::triangle();
        change(&mut gltf.document);
        let loaded = gltf.loaded();
        has_note(&loaded, note);
        assert_eq!(loaded.model.len(), 1, "{note}");
    }
    // A place that is not a multiple of the size.
    let mut gltf = Gltf::triangle();
    gltf.bytes.insert(0, 0);
    gltf.document["bufferViews"][0]["byteOffset"] = json!(1);
    has_note(&gltf.loaded(), "1 value that breaks a rule of glTF");
}

#[test]
fn texture_coordinates_that_are_not_numbers() {
    let mut gltf = Gltf::triangle();
    let texcoords = gltf.floats(&[0., 0., f32::NAN, 0., 0., 1.], "VEC2", 3);
    gltf.attribute("TEXCOORD_0", texcoords);
    has_note(&gltf.loaded(), "1 face with texture coordinates that are not there, or not finite");
    let mut gltf = Gltf::triangle();
    let colors = gltf.floats(&[0., 0., f32::INFINITY, 0., 0., 1., 1., 1., 1.], "VEC3", 3);
    gltf.attribute("COLOR_0", colors);
    has_note(&gltf.loaded(), "1 attribute that cannot be read");
}

/// A scene that shows nothing: which one, and what would show something.
#[test]
fn nothing_is_shown() {
    let cases: &[Case] = &[
        (
            "there is no face: scenes[0] is shown, and none of its nodes has a mesh; scene 1 has some",
            |gltf| {
                gltf["scenes"] = json!([{}, {"nodes": [0]}]);
            },
        ),
        (
            "there is no face: scenes[0] is shown, and none of its nodes has a mesh; nodes[0] has one",
            |gltf| {
                gltf["scenes"] = json!([{}]);
            },
        ),
        ("there is no face: no node has a mesh; a node with `\"mesh\": 0` in scenes[0]", |gltf| {
            gltf["nodes"] = json!([{}]);
        }),
        ("there is no face: KHR_node_visibility hides 1 nodes of scenes[0]", |gltf| {
            gltf["nodes"][0]["extensions"] = json!({"KHR_node_visibility": {"visible": false}});
        }),
        ("there is no face: 1 primitive of points or lines: left out", |gltf| {
            gltf["meshes"][0]["primitives"][0]["mode"] = json!(1);
        }),
    ];
    for (message, change) in cases {
        let mut gltf = Gltf::triangle();
        change(&mut gltf.document);
        let refused = gltf.refused();
        assert!(refused.starts_with(message), "{refused}");
    }
    let mut gltf = Gltf::triangle();
    gltf.document["scenes"] = json!([{}, {"nodes": [0]}]);
    let options = LoadOptions { scene: Some(1), ..LoadOptions::default() };
    let loaded = tess_mesh::read(&gltf.text(), tess_mesh::Format::Gltf, None, &options);
    assert_eq!(loaded.expect("the other scene").model.len(), 1, "chosen");
}

#[test]
fn other_versions() {
    for version in ["1.0", "1.0.1"] {
        let text = format!(r#"{{"asset": {{"version": "{version}"}}, "meshes": {{}}}}"#);
        let options = LoadOptions::default();
        let error = tess_mesh::read(text.as_bytes(), tess_mesh::Format::Gltf, None, &options);
        let message = error.expect_err("glTF 1").to_string();
        assert_eq!(
            message,
            format!(
                "asset.version: {version} is not read, only 2.x: it is glTF 1; convert the file, or \
                 export the model as glTF 2"
            )
        );
    }
}
