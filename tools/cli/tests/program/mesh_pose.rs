//! Tests of `tess mesh` on valid glTF files: poses, and the forms that triangles and numbers may
//! have.
#![expect(clippy::float_arithmetic, reason = "poses are made of floats")]

use crate::mesh::{counts, mesh, write};
use crate::mesh_gltf::{triangle, write_gltf};
use crate::mesh_input::refused;
use crate::support::{Folder, Run, directory};
use serde_json::{Value, json};
use std::fs;

/// The triangle as a file that is being built.
struct Builder {
    folder: Folder,
    document: Value,
    bytes: Vec<u8>,
}

impl Builder {
    fn new(test: &str) -> Self {
        let (document, bytes) = triangle();
        Self { folder: directory(test), document, bytes }
    }

    /// Adds an accessor and returns its number.
    fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let views = self.document["bufferViews"].as_array_mut().expect("a list");
        views.push(json!({"buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len()}));
        let view = views.len() - 1;
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        self.document["buffers"][0]["byteLength"] = json!(self.bytes.len());
        let accessors = self.document["accessors"].as_array_mut().expect("a list");
        accessors.push(json!({
            "bufferView": view, "componentType": component, "type": kind, "count": count,
        }));
        accessors.len() - 1
    }

    fn vectors(&mut self, vectors: &[[f32; 3]]) -> usize {
        let number = self.accessor(&bytes_of(vectors.as_flattened()), 5126, "VEC3", vectors.len());
        self.document["accessors"][number]["min"] = json!([-9, -9, -9]);
        self.document["accessors"][number]["max"] = json!([9, 9, 9]);
        number
    }

    fn primitive(&mut self) -> &mut Value {
        &mut self.document["meshes"][0]["primitives"][0]
    }

    /// A run at factor 1 with flat surfaces, and the positions and normals that it writes.
    fn run(&self) -> (Run, Vec<[f32; 3]>, Vec<[f32; 3]>) {
        let input = write_gltf(&self.folder, "in.gltf", self.document.clone(), &self.bytes);
        let out = self.folder.join("out.obj");
        let run = mesh(&input, "--factor 1", &out);
        let text = fs::read_to_string(&out).expect("it was written");
        (run, triples(&text, "v "), triples(&text, "vn "))
    }

    /// The positions that a run writes without a note.
    fn positions(&self) -> Vec<[f32; 3]> {
        let (run, positions, _) = self.run();
        assert!(!run.stderr.contains("note"), "{run}");
        positions
    }
}

fn bytes_of(floats: &[f32]) -> Vec<u8> {
    floats.iter().flat_map(|float| float.to_le_bytes()).collect()
}

/// The numbers of the lines that begin with `keyword`, sorted.
fn triples(text: &str, keyword: &str) -> Vec<[f32; 3]> {
    let lines = text.lines().filter_map(|line| line.strip_prefix(keyword));
    let numbers = lines.map(|line| line.split(' ').map(|word| word.parse().expect("a number")));
    let mut triples: Vec<[f32; 3]> =
        numbers.map(|numbers| numbers.collect::<Vec<_>>().try_into().expect("three")).collect();
    triples.sort_by(|a, b| a.partial_cmp(b).expect("numbers"));
    triples
}

fn assert_near(found: &[[f32; 3]], expected: &[[f32; 3]], what: &str) {
    assert_eq!(found.len(), expected.len(), "{what}: {found:?}");
    for (a, b) in found.as_flattened().iter().zip(expected.as_flattened()) {
        assert!((a - b).abs() < 1e-5, "{what}: {found:?}, not {expected:?}");
    }
}

const REST: [[f32; 3]; 3] = [[0., 0., 0.], [0., 1., 0.], [1., 0., 0.]];

/// A change of a valid file.
type Change = fn(&mut Value);

#[test]
fn morph_targets_have_the_weights_of_the_node_or_the_mesh() {
    let mut file = Builder::new("mesh_morph");
    let up = file.vectors(&[[0., 0., 0.], [0., 0., 0.], [0., 5., 0.]]);
    let far = file.vectors(&[[0., 0., -2.]; 3]);
    let turn = file.vectors(&[[2., 0., -1.]; 3]);
    file.primitive()["targets"] = json!([{"POSITION": up}, {"POSITION": far, "NORMAL": turn}]);
    assert_eq!(file.positions(), REST, "without weights they are 0");
    file.document["meshes"][0]["weights"] = json!([1.0, 0.5]);
    assert_near(&file.positions(), &[[0., 0., -1.], [0., 6., -1.], [1., 0., -1.]], "the mesh's");
    // The normals are (0, 0, 1) + (1, 0, -0.5), but the surface is flat, so corners keep their
    // normals.
    let normal = [1.0 / 1.25_f32.sqrt(), 0.0, 0.5 / 1.25_f32.sqrt()];
    assert_near(&file.run().2, &[normal; 3], "normals");
    file.document["nodes"][0]["weights"] = json!([0.2, 0.0]);
    assert_near(&file.positions(), &[[0., 0., 0.], [0., 2., 0.], [1., 0., 0.]], "the node's");
    file.document["nodes"][0]["weights"] = json!([1]);
    let input = write_gltf(&file.folder, "short.gltf", file.document.clone(), &file.bytes);
    refused(&input, "", "meshes[0].primitives[0].targets: there are 2, but 1 weights");
}

/// Two joints, and vertices attached to the first, to both and to the second.
fn skinned(test: &str) -> Builder {
    let mut file = Builder::new(test);
    let joints = file.accessor(&[0, 0, 0, 0, 0, 1, 0, 0, 1, 0, 0, 0], 5121, "VEC4", 3);
    let weights = [1., 0., 0., 0., 0.5, 0.5, 0., 0., 1., 0., 0., 0.];
    let weights = file.accessor(&bytes_of(&weights), 5126, "VEC4", 3);
    file.primitive()["attributes"]["JOINTS_0"] = json!(joints);
    file.primitive()["attributes"]["WEIGHTS_0"] = json!(weights);
    file.document["skins"] = json!([{"joints": [1, 2]}]);
    file.document["nodes"] = json!([
        {"mesh": 0, "skin": 0, "scale": [10, 10, 10], "translation": [5, 5, 5]},
        {"translation": [3, 0, 0], "children": [2]},
        {"translation": [0, 0, 2]},
    ]);
    file
}

#[test]
fn joints_move_vertices_and_the_node_does_not() {
    let mut file = skinned("mesh_skin");
    let [a, b, c] = [[3., 0., 0.], [3., 1., 2.], [4., 0., 1.]];
    assert_near(&file.positions(), &[a, b, c], "joints");
    // The bind pose of the second joint is a quarter turn about z.
    let turned = [0., 1., 0., 0., -1., 0., 0., 0., 0., 0., 1., 0., 0., 0., 0., 1.];
    let identity: [f32; 16] = std::array::from_fn(|k| if k % 5 == 0 { 1.0 } else { 0.0 });
    let inverse = [identity, turned].concat();
    let inverse = file.accessor(&bytes_of(&inverse), 5126, "MAT4", 2);
    file.document["skins"][0]["inverseBindMatrices"] = json!(inverse);
    assert_near(&file.positions(), &[[2., 0., 2.], [3., 0., 0.], [3.5, 0.5, 1.]], "bind poses");
    // The same weights as bytes.
    let weights = [255, 0, 0, 0, 127, 127, 0, 0, 255, 0, 0, 0];
    let weights = file.accessor(&weights, 5121, "VEC4", 3);
    file.document["accessors"][weights]["normalized"] = json!(true);
    file.primitive()["attributes"]["WEIGHTS_0"] = json!(weights);
    assert_near(
        &file.positions(),
        &[[2., 0., 2.], [3., 0., 0.], [3.5, 0.5, 1.]],
        "rounded weights",
    );
    // A joint that is in no scene still moves vertices.
    file.document["scenes"][0]["nodes"] = json!([0]);
    assert_eq!(file.positions().len(), 3, "joints outside of the scene");
}

#[test]
fn skins_that_are_wrong() {
    let cases: &[(Change, &str)] = &[
        (
            |gltf| gltf["nodes"][0]["skin"] = json!(3),
            "nodes[0].skin: 3 is out of range: there are 1 skins",
        ),
        (|gltf| gltf["skins"][0]["joints"] = json!([1, 7]), "skins[0].joints: 7 is out of range"),
        (
            |gltf| gltf["skins"][0]["joints"] = json!([1]),
            "attributes.JOINTS_0: 1 is out of range: there are 1 joints",
        ),
        (
            |gltf| gltf["skins"][0]["inverseBindMatrices"] = json!(0),
            "skins[0].inverseBindMatrices: accessors[0] is Vec3 of Float; it must be MAT4",
        ),
        (
            |gltf| gltf["accessors"][4]["componentType"] = json!(5120),
            "JOINTS_0: accessors[4] is Vec4 of Byte",
        ),
    ];
    for (change, message) in cases {
        let mut file = skinned("mesh_skin_wrong");
        change(&mut file.document);
        let input = write_gltf(&file.folder, "wrong.gltf", file.document.clone(), &file.bytes);
        refused(&input, "", message);
    }
}

#[test]
fn normals_of_mirrored_and_flattened_nodes() {
    let mut file = Builder::new("mesh_flattened");
    let tilted = file.vectors(&[[0.6, 0., 0.8]; 3]);
    file.primitive()["attributes"]["NORMAL"] = json!(tilted);
    for (scale, normal) in [
        ([1., 1., -1.], [0.6, 0., -0.8]),
        ([-1., 1., 1.], [-0.6, 0., 0.8]),
        ([2., 2., 2.], [0.6, 0., 0.8]),
        ([4., 1., 3.], [0.49, 0., 0.872]), // (0.6 / 4, 0, 0.8 / 3)
        ([3., 3., 0.], [0., 0., 1.]),
        ([-3., 3., 0.], [0., 0., -1.]),
        ([1e-20, 1e-20, 1.], [1., 0., 0.]),
    ] {
        file.document["nodes"][0]["scale"] = json!(scale);
        let (run, _, normals) = file.run();
        assert!(!run.stderr.contains("note"), "{scale:?}: {run}");
        for found in normals {
            let error = found.iter().zip(normal).map(|(a, b): (&f32, f32)| (a - b).abs());
            assert!(error.fold(0.0, f32::max) < 1e-3, "{scale:?}: {found:?}, not {normal:?}");
        }
    }
    file.document["nodes"] = json!([{"mesh": 0}, {"mesh": 0, "scale": [0, 0, 0]}]);
    file.document["scenes"][0]["nodes"] = json!([0, 1]);
    let (run, positions, _) = file.run();
    run.says("note: 1 face with corners in the same place: left out, as they have no area (first: nodes[1]");
    assert_eq!(positions, REST, "the other node is there");
}

/// A square of two triangles as a list, a strip and a fan, and then with lines and points as well.
#[test]
fn strips_fans_lines_and_points() {
    let mut file = Builder::new("mesh_modes");
    let square = file.vectors(&[[0., 0., 0.], [1., 0., 0.], [0., 1., 0.], [1., 1., 0.]]);
    let fan = file.vectors(&[[0., 0., 0.], [1., 0., 0.], [1., 1., 0.], [0., 1., 0.]]);
    let list = file.accessor(&[0, 1, 2, 2, 1, 3], 5121, "SCALAR", 6);
    for (mode, primitive) in [
        (4, json!({"attributes": {"POSITION": square}, "indices": list})),
        (5, json!({"attributes": {"POSITION": square}})),
        (6, json!({"attributes": {"POSITION": fan}})),
    ] {
        file.document["meshes"][0]["primitives"] = json!([primitive]);
        file.primitive()["mode"] = json!(mode);
        let (run, _, normals) = file.run();
        assert_eq!(counts(&run), [2, 6, 2], "mode {mode}");
        assert_eq!(normals, [[0., 0., 1.]; 4], "mode {mode}: both face one way");
        assert!(!run.stderr.contains("note"), "mode {mode}: {run}");
    }
    for mode in 0..4 {
        let lines = json!({"attributes": {"POSITION": square}, "mode": mode});
        let primitives = file.document["meshes"][0]["primitives"].as_array_mut().expect("a list");
        primitives.push(lines);
    }
    let (run, ..) = file.run();
    run.says(
        "note: 4 primitives of points or lines: left out, as these have no surface \
         (first: meshes[0].primitives[1])",
    );
    assert_eq!(counts(&run), [2, 6, 2], "the fan is left");
    file.document["meshes"][0]["primitives"] =
        json!([{"attributes": {"POSITION": square}, "mode": 4}]);
    let (run, ..) = file.run();
    run.says("note: 1 primitive with indices that make no whole triangle: those are left out");
    assert_eq!(counts(&run), [1, 3, 1], "four vertices are one triangle and a rest");
}

/// Changes that do not change the triangle.
#[test]
fn files_that_mean_the_same() {
    let cases: &[(Change, &str)] = &[
        (|gltf| gltf["accessors"][0]["count"] = json!(3.0), "a whole number with a point"),
        (|gltf| gltf["scenes"][0]["nodes"] = json!([0.0]), "a node's number with a point"),
        (
            |gltf| {
                gltf["extensionsRequired"] = json!(["KHR_texture_transform", "KHR_materials_unlit"])
            },
            "materials",
        ),
        (
            |gltf| gltf["extensionsRequired"] = json!(["KHR_lights_punctual", "EXT_texture_webp"]),
            "lights",
        ),
        (|gltf| _ = gltf.as_object_mut().expect("a document").remove("scenes"), "no scenes"),
        (|gltf| _ = gltf.as_object_mut().expect("a document").remove("scene"), "the first scene"),
    ];
    for (change, what) in cases {
        let mut file = Builder::new("mesh_same");
        change(&mut file.document);
        if *what == "no scenes" {
            _ = file.document.as_object_mut().expect("a document").remove("scene");
        }
        assert_eq!(file.positions(), REST, "{what}");
    }
    let mut animated = Builder::new("mesh_animated");
    animated.document["animations"] = json!([{"channels": [], "samplers": []}]);
    let (run, positions, _) = animated.run();
    run.says("note: 1 animation: not applied; the model is in the pose that it has at rest (first: animations[0])");
    assert_eq!(positions, REST, "at rest");
}

#[test]
fn small_integers() {
    let mut file = Builder::new("mesh_quantized");
    let shorts: Vec<u8> =
        [0i16, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0].iter().flat_map(|x| x.to_le_bytes()).collect();
    let positions = file.accessor(&shorts, 5122, "VEC3", 3);
    file.document["bufferViews"][4]["byteStride"] = json!(8);
    file.document["accessors"][positions]["min"] = json!([0, 0, 0]);
    file.document["accessors"][positions]["max"] = json!([1, 1, 0]);
    file.primitive()["attributes"]["POSITION"] = json!(positions);
    let normals = file.accessor(&[0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 127, 0], 5120, "VEC3", 3);
    file.document["bufferViews"][5]["byteStride"] = json!(4);
    file.document["accessors"][normals]["normalized"] = json!(true);
    file.primitive()["attributes"]["NORMAL"] = json!(normals);
    let input = write_gltf(&file.folder, "plain.gltf", file.document.clone(), &file.bytes);
    refused(&input, "", "POSITION: accessors[4] is Vec3 of Short; it must be VEC3 of Float");
    for list in ["extensionsUsed", "extensionsRequired"] {
        file.document[list] = json!(["KHR_mesh_quantization"]);
    }
    let (_, positions, normals) = file.run();
    assert_eq!((positions.as_slice(), normals), (&REST[..], vec![[0., 0., 1.]; 3]), "as floats");
}

#[test]
fn compressed_primitives_are_named() {
    let mut file = Builder::new("mesh_draco");
    let draco = json!({"bufferView": 0, "attributes": {"POSITION": 0}});
    file.primitive()["extensions"] = json!({"KHR_draco_mesh_compression": draco});
    assert_eq!(file.positions(), REST, "the data is there without compression too");
    _ = file.document["accessors"][0].as_object_mut().expect("an accessor").remove("bufferView");
    let input = write_gltf(&file.folder, "draco.gltf", file.document.clone(), &file.bytes);
    refused(
        &input,
        "",
        "meshes[0].primitives[0].extensions.KHR_draco_mesh_compression: it is compressed with Draco",
    );
    file.document["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    let input = write_gltf(&file.folder, "draco.gltf", file.document.clone(), &file.bytes);
    refused(&input, "", "extensionsRequired[0]: `KHR_draco_mesh_compression` is not supported");
    let empty = write(&file.folder, "empty.gltf", r#"{"asset": {"version": "2.0"}}"#);
    refused(&empty, "", "there is no face");
}
