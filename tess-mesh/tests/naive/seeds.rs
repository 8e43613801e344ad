//! Seeds of the readers of mesh files: small valid files of every form.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};

const CUBE: &str =
    "v -1 -1 -1\nv 1 -1 -1\nv 1 1 -1\nv -1 1 -1\nv -1 -1 1\nv 1 -1 1\nv 1 1 1\nv -1 1 1\n";
const FACES: &str = "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

/// OBJ files.
pub(crate) fn obj() -> Vec<Vec<u8>> {
    let attributes = "vt 0 0\nvt 1 0 0\nvt 0.5\nvn 0 0 1\nvn 0 1e-3 -2.5E1\n";
    let texts = [
        format!("{CUBE}{FACES}"),
        format!("\u{feff}{CUBE}{FACES}"),
        format!("# a comment\r\no cube\r\n{}", format!("{CUBE}{FACES}").replace('\n', " # x\r\n")),
        format!("{FACES}{CUBE}"),
        format!("{CUBE}{attributes}f 1/1 2/2 3/3\nf 1//1 3//2 4//1\nf 1/1/1 2/2/2 6/3/1 5/1/2\n"),
        format!("{CUBE}{attributes}f -8/-3/-2 -7/-2/-1 -6/-1/-2\nf -1 -2 -3 -4\n"),
        format!("{CUBE}f 1 2 2\nf 1 1 2 3\nf 1 2 3 3\nf 4 4 4 4\nf 1 2 1 3\nf 5 6 7\n"),
        format!("mtllib a.mtl\n{CUBE}g x y\nusemtl m\ns off\nl 1 2 3\np 1\n{FACES}"),
        "v 0 0 0 1\nv 1 0 0 .5 .5 .5\nv\t0 1. -0\nf 1 2 3".to_owned(),
        format!("{CUBE}vt 0 0\nvn nan 0 inf\nf 1/1/ 4/1/ 3/1/\nf 1// 2// 6// 5//\nf 1 4 8 7 3 2\n"),
    ];
    let mut seeds: Vec<Vec<u8>> = texts.into_iter().map(String::into_bytes).collect();
    seeds.push([b"# caf\xE9 \xFF\ng \xE9\n", CUBE.as_bytes(), FACES.as_bytes()].concat());
    seeds
}

/// Bezier patch files.
pub(crate) fn bpt() -> Vec<Vec<u8>> {
    let rows = |end: &str, line_end: &str| {
        let row = |k: usize| format!("{} {} {}{end}{line_end}", k % 4, k / 4, k % 3);
        (0..16).map(row).collect::<String>()
    };
    let one = |end: &str, line_end: &str| format!("3 3{line_end}{}", rows(end, line_end));
    let plain = one("", "\n");
    [
        format!("1\n{plain}"),
        format!("2\n{plain}{plain}"),
        format!("1\n{}", one(" 2", "\n")),
        format!("1\n{}", one(" 0.5", "\n")),
        format!("\u{feff}1\r\n{}", one("", "\r\n")),
        format!("\n 1 \n\n{}\n", one("", " \n\t\n")),
        format!("3\n{plain}{}{plain}", one(" 1e-3", "\n")),
        format!("1\n{}", plain.replace(" 2 ", " -2.5e3 ")),
        format!("# a patch\n1 # of one\n4 4\n{}", rows("", " #\n")),
        format!("2 3 3 {} 3 3\n{}", rows("", " "), rows("", "\t")),
        format!("1\n3 3\n{}", rows(" 2", " ")),
    ]
    .map(String::into_bytes)
    .to_vec()
}

/// A file under construction.
struct Builder {
    document: Value,
    bytes: Vec<u8>,
}

impl Builder {
    /// Four vertices and their positions.
    fn new() -> Self {
        let document = json!({
            "asset": {"version": "2.0"}, "scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
            "meshes": [{"primitives": [{"attributes": {}}]}],
            "accessors": [], "bufferViews": [], "buffers": [{"byteLength": 0}],
        });
        let mut builder = Self { document, bytes: Vec::new() };
        let positions = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0, 0.5, -1.0, -1.0, 2.0];
        let number = builder.accessor(&floats(&positions), 5126, "VEC3", 4);
        builder.document["accessors"][number]["min"] = json!([-1, -1, 0]);
        builder.document["accessors"][number]["max"] = json!([1, 1, 2]);
        builder.attribute("POSITION", number);
        builder
    }

    fn view(&mut self, bytes: &[u8]) -> usize {
        let views = self.document["bufferViews"].as_array_mut().expect("a list");
        views.push(json!({"buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len()}));
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        views.len() - 1
    }

    fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let view = self.view(bytes);
        let accessors = self.document["accessors"].as_array_mut().expect("a list");
        accessors.push(json!({
            "bufferView": view, "componentType": component, "type": kind, "count": count,
        }));
        accessors.len() - 1
    }

    fn attribute(&mut self, name: &str, accessor: usize) {
        self.document["meshes"][0]["primitives"][0]["attributes"][name] = json!(accessor);
    }

    fn indices(mut self, bytes: &[u8], component: u32, size: usize) -> Self {
        let number = self.accessor(bytes, component, "SCALAR", bytes.len() / size);
        self.document["meshes"][0]["primitives"][0]["indices"] = json!(number);
        self
    }

    fn with(mut self, change: impl FnOnce(&mut Self)) -> Self {
        change(&mut self);
        self
    }

    fn text(mut self) -> Vec<u8> {
        let data = BASE64_STANDARD.encode(&self.bytes);
        self.document["buffers"][0]["byteLength"] = json!(self.bytes.len());
        self.document["buffers"][0]["uri"] = json!(format!("data:;base64,{data}"));
        self.document.to_string().into_bytes()
    }

    fn binary(mut self) -> Vec<u8> {
        self.document["buffers"][0]["byteLength"] = json!(self.bytes.len());
        let mut json = self.document.to_string().into_bytes();
        json.resize(json.len().next_multiple_of(4), b' ');
        let word = |length: usize| u32::try_from(length).unwrap_or(0).to_le_bytes();
        let length = 28 + json.len() + self.bytes.len();
        let (head, bin) = (word(json.len()), word(self.bytes.len()));
        [b"glTF", &word(2)[..], &word(length), &head, b"JSON", &json, &bin, b"BIN\0", &self.bytes]
            .concat()
    }
}

fn floats(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|number| number.to_le_bytes()).collect()
}

/// glTF and GLB files.
#[allow(clippy::too_many_lines, reason = "a table of files; fuzz targets have no such limit")]
pub(crate) fn gltf() -> Vec<Vec<u8>> {
    let bytes = [0u8, 1, 2, 0, 2, 3];
    let narrow: Vec<u8> = bytes.iter().flat_map(|&byte| [byte, 0]).collect();
    let words: Vec<u8> = bytes.iter().flat_map(|&byte| [byte, 0, 0, 0]).collect();
    let small = || Builder::new().indices(&bytes, 5121, 1);
    let normals = |b: &mut Builder| {
        let numbers = [0.0, 0.0, 1.0].repeat(4);
        let number = b.accessor(&floats(&numbers), 5126, "VEC3", 4);
        b.attribute("NORMAL", number);
    };
    let texcoords =
        |b: &mut Builder, data: &[u8], component: u32, normalized: bool, stride: u32| {
            let number = b.accessor(data, component, "VEC2", 4);
            b.document["accessors"][number]["normalized"] = json!(normalized);
            let view = b.document["accessors"][number]["bufferView"].as_u64().unwrap_or(0) as usize;
            b.document["bufferViews"][view]["byteStride"] = json!(stride);
            b.attribute("TEXCOORD_0", number);
        };
    let placed = small().with(normals).with(|b| {
        b.document["nodes"] = json!([
            {"children": [1, 2], "rotation": [0, 0.6, 0, 0.8], "translation": [1, 2, 3.5]},
            {"mesh": 0, "scale": [1, -2, 0.5]},
            {
                "mesh": 0,
                "matrix": [0, 1, 0, 0, -1, 0, 0, 0, 0, 0, 2, 0, 5, 6, 7, 1],
                "children": [3],
            },
            {"mesh": 0, "translation": [0, 0, 1e3]},
        ]);
        b.document["scene"] = json!(0);
    });
    let sparse = small().with(|b| {
        let indices = b.view(&[1, 0, 3, 0]);
        let values = b.view(&floats(&[9.0, 8.0, 7.0, 6.0, 5.0, 4.0]));
        b.document["accessors"][0]["sparse"] = json!({
            "count": 2, "indices": {"bufferView": indices, "componentType": 5123},
            "values": {"bufferView": values},
        });
    });
    let zeros = Builder::new().with(|b| {
        let indices = b.view(&[0, 2, 5]);
        let values = b.view(&floats(&[9.0, 8.0, 7.0, 6.0, 5.0, 4.0, 1.0, 2.0, 4.0]));
        b.document["accessors"][0] = json!({
            "componentType": 5126, "type": "VEC3", "count": 6, "min": [0, 0, 0], "max": [9, 8, 7],
            "sparse": {"count": 3, "indices": {"bufferView": indices, "componentType": 5121},
                "values": {"bufferView": values}},
        });
    });
    let moved = |b: &mut Builder| {
        let moves = b.accessor(&floats(&[0.5, -1.0, 2.0].repeat(4)), 5126, "VEC3", 4);
        let turns = b.accessor(&floats(&[1.0, 0.0, -0.25].repeat(4)), 5126, "VEC3", 4);
        b.document["meshes"][0]["primitives"][0]["targets"] =
            json!([{"POSITION": moves}, {"NORMAL": turns, "POSITION": moves}]);
        b.document["meshes"][0]["weights"] = json!([0.5, 1]);
    };
    let skinned = |b: &mut Builder| {
        let joints = b.accessor(&[0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0, 1, 1, 0, 0], 5121, "VEC4", 4);
        let weights = floats(&[0.25, 0.75, 0.0, 0.0].repeat(4));
        let weights = b.accessor(&weights, 5126, "VEC4", 4);
        b.attribute("JOINTS_0", joints);
        b.attribute("WEIGHTS_0", weights);
        let inverse: Vec<f32> = (0..32u8).map(|k| f32::from(u8::from(k % 5 == k / 16))).collect();
        let inverse = b.accessor(&floats(&inverse), 5126, "MAT4", 2);
        b.document["skins"] = json!([{"joints": [1, 2.0], "inverseBindMatrices": inverse}]);
        b.document["nodes"] = json!([
            {"mesh": 0, "skin": 0, "scale": [9, 9, 9]}, {"translation": [1, 2, 3], "children": [2]},
            {"rotation": [0, 0.6, 0, 0.8], "scale": [1, -1, 0]},
        ]);
    };
    // A second set of joints, which moves every vertex as much as the first.
    let skinned_twice = |b: &mut Builder| {
        let joints = b.accessor(&[1, 0, 0, 0].repeat(4), 5121, "VEC4", 4);
        let weights = b.accessor(&floats(&[1.0, 0.0, 0.0, 0.0].repeat(4)), 5126, "VEC4", 4);
        b.attribute("JOINTS_1", joints);
        b.attribute("WEIGHTS_1", weights);
    };
    // The second joint mirrors: it turns the triangles that begin at a vertex of it inside out. The
    // third is not there, and moves nothing.
    let mirrored = |b: &mut Builder| {
        let joints = b.accessor(&[0, 7, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0], 5121, "VEC4", 4);
        let weights = b.accessor(&floats(&[1.0, 0.0, 0.0, 0.0].repeat(4)), 5126, "VEC4", 4);
        b.attribute("JOINTS_0", joints);
        b.attribute("WEIGHTS_0", weights);
        let indices = b.accessor(&[0, 1, 2, 2, 1, 0], 5121, "SCALAR", 6);
        b.document["meshes"][0]["primitives"][0]["indices"] = json!(indices);
        b.document["skins"] = json!([{"joints": [1, 2]}, {"joints": [2, 1]}]);
        b.document["nodes"] = json!([
            {"mesh": 0, "skin": 0, "children": [3]}, {"translation": [1, 2, 3]},
            {"scale": [1, -1, 1]}, {"mesh": 0, "skin": 1},
        ]);
        b.document["scenes"] = json!([{"nodes": [0, 1, 2]}]);
    };
    // Weights of a node are stronger than those of its mesh.
    let own_weights = |b: &mut Builder| b.document["nodes"][0]["weights"] = json!([2, -1]);
    let shorts = |b: &mut Builder| {
        let data: Vec<u8> = [1i16, -2, 32767, 0, -32768, 300, -5, 0, 7, 8, -9, 0, 1, 1, 1, 0]
            .iter()
            .flat_map(|number| number.to_le_bytes())
            .collect();
        let number = b.accessor(&data, 5122, "VEC3", 4);
        let view = b.document["accessors"][number]["bufferView"].as_u64().unwrap_or(0) as usize;
        b.document["bufferViews"][view]["byteStride"] = json!(8);
        b.document["accessors"][number]["normalized"] = json!(true);
        b.document["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
        b.attribute("NORMAL", number);
    };
    let sparse_offsets = small().with(|b| {
        let indices = b.view(&[9, 9, 1, 0, 3, 0]);
        let values = [&[0xFF; 4][..], &floats(&[9.0, 8.0, 7.0, 6.0, 5.0, 4.0])].concat();
        let values = b.view(&values);
        b.document["accessors"][0]["sparse"] = json!({
            "count": 2, "values": {"bufferView": values, "byteOffset": 4},
            "indices": {"bufferView": indices, "componentType": 5123, "byteOffset": 2},
        });
    });
    let modes = |mode: u32| {
        small().with(|b| {
            let triangles = b.document["meshes"][0]["primitives"][0].clone();
            b.document["meshes"][0]["primitives"][0]["mode"] = json!(mode);
            if mode < 4 {
                // A scene of lines alone has no surface.
                let primitives = b.document["meshes"][0]["primitives"].as_array_mut();
                primitives.expect("a list").push(triangles);
            }
            b.document["animations"] = json!([{}]);
            _ = b.document.as_object_mut().expect("a document").remove("scenes");
        })
    };
    let quantized = small().with(|b| {
        let number =
            b.accessor(&[1, 2, 255, 0, 3, 4, 5, 0, 6, 128, 8, 0, 9, 9, 1, 0], 5120, "VEC3", 4);
        let view = b.document["accessors"][number]["bufferView"].as_u64().unwrap_or(0) as usize;
        b.document["bufferViews"][view]["byteStride"] = json!(4);
        b.document["accessors"][number]["normalized"] = json!(true);
        b.document["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
        b.attribute("NORMAL", number);
    });
    let interleaved = Builder::new().with(|b| {
        let data: Vec<f32> = (0..32u16).map(|k| f32::from(k * k % 17) - 4.0).collect();
        let number = b.accessor(&floats(&data), 5126, "VEC3", 3);
        let view = b.document["accessors"][number]["bufferView"].clone();
        b.document["bufferViews"][1]["byteStride"] = json!(32);
        let range = json!({"min": [-4, -4, -4], "max": [12, 12, 12]});
        let attributes =
            [("POSITION", 0, "VEC3"), ("NORMAL", 12, "VEC3"), ("TEXCOORD_0", 24, "VEC2")];
        for (name, at, kind) in attributes {
            let accessors = b.document["accessors"].as_array_mut().expect("a list");
            accessors.push(json!({
                "bufferView": view, "byteOffset": at, "componentType": 5126, "type": kind, "count": 3,
                "min": range["min"], "max": range["max"],
            }));
            let number = accessors.len() - 1;
            b.attribute(name, number);
        }
    });
    vec![
        small().text(),
        Builder::new().indices(&narrow, 5123, 2).with(normals).text(),
        Builder::new().indices(&words, 5125, 4).with(normals).binary(),
        small()
            .with(|b| {
                texcoords(b, &[0, 255, 9, 9, 1, 2, 0, 0, 128, 7, 0, 0, 5, 6, 0, 0], 5121, true, 4)
            })
            .text(),
        small()
            .with(|b| {
                texcoords(b, &[0, 255, 1, 2, 128, 7, 5, 6, 0, 0, 9, 8, 7, 6, 5, 4], 5123, true, 4)
            })
            .binary(),
        small()
            .with(|b| {
                texcoords(b, &floats(&[0.0, 1.0, 0.25, 2.0, -1.0, 0.5, 1.0, 1.0]), 5126, false, 8)
            })
            .text(),
        placed.text(),
        sparse.text(),
        zeros.text(),
        interleaved.binary(),
        small().with(normals).with(moved).text(),
        small().with(normals).with(moved).with(skinned).text(),
        small().with(normals).with(skinned).with(skinned_twice).text(),
        small().with(mirrored).text(),
        small().with(normals).with(moved).with(own_weights).text(),
        small().with(shorts).text(),
        sparse_offsets.text(),
        modes(5).text(),
        modes(6).binary(),
        modes(1).text(),
        quantized.text(),
    ]
}
