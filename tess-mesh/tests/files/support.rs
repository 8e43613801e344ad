//! Reading, and measuring what comes out.

use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use tess_mesh::tess_surface::FactorRule;
use tess_mesh::tess_surface::glam::Vec3;
use tess_mesh::write::{Block, Glb, GltfOptions, IndexWidth, Sink, WriteAt};
use tess_mesh::{Format, Job, LoadError, LoadOptions, Loaded, Totals, read};

pub(crate) fn obj_with(text: &str, options: &LoadOptions) -> Result<Loaded, LoadError> {
    read(text.as_bytes(), Format::Obj, None, options)
}

#[track_caller]
pub(crate) fn obj(text: &str) -> Loaded {
    obj_with(text, &LoadOptions::default()).expect("it is read")
}

/// Whether one of the notes contains this text.
#[track_caller]
pub(crate) fn has_note(loaded: &Loaded, text: &str) {
    let notes = &loaded.notes;
    assert!(notes.iter().any(|note| note.contains(text)), "no `{text}` in {notes:#?}");
}

/// A result as triangles.
#[derive(Default)]
pub(crate) struct Triangles {
    pub(crate) corners: Vec<[Vec3; 3]>,
}

impl Sink for Triangles {
    fn begin(&mut self, _: &[Totals]) -> io::Result<()> {
        Ok(())
    }

    fn block(&mut self, block: &Block<'_>) -> io::Result<()> {
        let at = |index: u32| block.vertices[index as usize].position;
        self.corners.extend(block.indices.as_chunks::<3>().0.iter().map(|corners| corners.map(at)));
        Ok(())
    }
}

/// The triangles of a model with this factor everywhere.
pub(crate) fn tessellated(loaded: &Loaded, factor: f32) -> Triangles {
    let mut triangles = Triangles::default();
    let job =
        Job { parts: Some(&loaded.parts), ..Job::new(&loaded.model, FactorRule::Uniform(factor)) };
    job.run(&mut triangles, &mut ()).expect("a sink without faults");
    triangles
}

impl Triangles {
    /// Six times the volume, divided by six; exact enough for small whole coordinates.
    pub(crate) fn volume(&self) -> f32 {
        self.corners.iter().map(|[a, b, c]| a.dot(b.cross(*c))).sum::<f32>() / 6.0
    }

    pub(crate) fn area(&self) -> f32 {
        self.corners.iter().map(|[a, b, c]| 0.5 * (*b - *a).cross(*c - *a).length()).sum()
    }

    /// The edges that belong to one triangle only, among triangles with three places.
    pub(crate) fn open_edges(&self) -> usize {
        let key = |at: Vec3| (at + Vec3::ZERO).to_array().map(f32::to_bits);
        let mut uses: BTreeMap<_, usize> = BTreeMap::new();
        for corners in &self.corners {
            let [a, b, c] = corners.map(key);
            if a != b && b != c && c != a {
                for (from, to) in [(a, b), (b, c), (c, a)] {
                    *uses.entry((from.min(to), from.max(to))).or_default() += 1;
                }
            }
        }
        uses.values().filter(|&&count| count == 1).count()
    }
}

/// A glTF file under construction: its document and its only buffer.
pub(crate) struct Gltf {
    pub(crate) document: Value,
    pub(crate) bytes: Vec<u8>,
}

impl Gltf {
    /// A triangle of three positions.
    pub(crate) fn triangle() -> Self {
        let mut gltf = Self {
            document: json!({
                "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
                "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {}}]}],
                "accessors": [], "bufferViews": [], "buffers": [{}],
            }),
            bytes: Vec::new(),
        };
        let positions = gltf.floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.], "VEC3", 3);
        gltf.attribute("POSITION", positions);
        gltf
    }

    pub(crate) fn primitive(&mut self) -> &mut Value {
        &mut self.document["meshes"][0]["primitives"][0]
    }

    pub(crate) fn attribute(&mut self, name: &str, accessor: usize) {
        self.primitive()["attributes"][name] = json!(accessor);
    }

    /// The number of a new buffer view.
    pub(crate) fn view(&mut self, bytes: &[u8]) -> usize {
        let views = self.document["bufferViews"].as_array_mut().expect("a list");
        views.push(json!({
            "buffer": 0, "byteOffset": self.bytes.len(), "byteLength": bytes.len(),
        }));
        self.bytes.extend(bytes);
        self.bytes.resize(self.bytes.len().next_multiple_of(4), 0);
        views.len() - 1
    }

    /// The number of a new accessor.
    pub(crate) fn accessor(
        &mut self,
        bytes: &[u8],
        component: u32,
        kind: &str,
        count: usize,
    ) -> usize {
        let view = self.view(bytes);
        let accessors = self.document["accessors"].as_array_mut().expect("a list");
        accessors.push(json!({
            "bufferView": view, "componentType": component, "type": kind, "count": count,
        }));
        accessors.len() - 1
    }

    pub(crate) fn floats(&mut self, numbers: &[f32], kind: &str, count: usize) -> usize {
        let bytes: Vec<u8> = numbers.iter().flat_map(|number| number.to_le_bytes()).collect();
        self.accessor(&bytes, 5126, kind, count)
    }

    /// The file as JSON with its buffer in it.
    pub(crate) fn text(&self) -> Vec<u8> {
        let mut document = self.document.clone();
        let data = BASE64_STANDARD.encode(&self.bytes);
        document["buffers"][0]["byteLength"] = json!(self.bytes.len());
        document["buffers"][0]["uri"] = json!(format!("data:;base64,{data}"));
        document.to_string().into_bytes()
    }

    pub(crate) fn load(&self) -> Result<Loaded, LoadError> {
        read(&self.text(), Format::Gltf, None, &LoadOptions::default())
    }

    #[track_caller]
    pub(crate) fn loaded(&self) -> Loaded {
        self.load().expect("it is read")
    }

    /// The message with which the file is refused.
    #[track_caller]
    pub(crate) fn refused(&self) -> String {
        self.load().expect_err("it is refused").to_string()
    }
}

/// A file in memory.
#[derive(Default)]
pub(crate) struct Memory(std::sync::Mutex<Vec<u8>>);

impl WriteAt for Memory {
    fn write_at(&self, bytes: &[u8], offset: u64) -> io::Result<()> {
        let mut content = self.0.lock().expect("no thread panics");
        let end = offset as usize + bytes.len();
        if content.len() < end {
            content.resize(end, 0);
        }
        content[offset as usize..end].copy_from_slice(bytes);
        Ok(())
    }
}

impl Memory {
    /// The document and the binary part of a GLB file.
    pub(crate) fn glb(self) -> (Value, Vec<u8>) {
        let file = self.0.into_inner().expect("no thread panics");
        let word = |at: usize| {
            u32::from_le_bytes(file[at..at + 4].try_into().expect("four bytes")) as usize
        };
        assert_eq!(word(8), file.len(), "the length in the header");
        let end = 20 + word(12);
        assert_eq!(word(end), file.len() - end - 8, "the length of the binary part");
        let document = serde_json::from_slice(&file[20..end]).expect("JSON");
        (document, file[end + 8..].to_vec())
    }
}

/// An empty folder for a test.
pub(crate) fn folder(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    _ = fs::remove_dir_all(&folder);
    fs::create_dir_all(&folder).expect("a folder");
    folder
}

/// The document and the binary part of the GLB file that a model becomes.
pub(crate) fn written(loaded: &Loaded, factor: f32) -> (Value, Vec<u8>) {
    let options = GltfOptions {
        up: loaded.up,
        indices: IndexWidth::Auto,
        parts: Some(&loaded.parts),
        image_prefix: "../in/",
    };
    let mut glb = Glb::new(Memory::default(), options);
    let job =
        Job { parts: Some(&loaded.parts), ..Job::new(&loaded.model, FactorRule::Uniform(factor)) };
    job.run(&mut glb, &mut ()).expect("it is written");
    glb.finish().expect("it is whole").glb()
}

/// The numbers of an accessor of floats.
pub(crate) fn floats_of(document: &Value, bytes: &[u8], accessor: &Value) -> Vec<Vec<f32>> {
    let number = |value: &Value| value.as_u64().expect("a number") as usize;
    let accessor = &document["accessors"][number(accessor)];
    let view = &document["bufferViews"][number(&accessor["bufferView"])];
    let components = accessor["type"].as_str().and_then(|kind| kind[3..].parse().ok());
    let components: usize = components.expect("VEC2 to VEC4");
    let start = number(&view["byteOffset"]) + number(&accessor["byteOffset"]);
    let element = |k: usize| {
        let at = start + k * number(&view["byteStride"]);
        let words = bytes[at..at + 4 * components].as_chunks::<4>().0;
        words.iter().map(|&word| f32::from_le_bytes(word)).collect()
    };
    (0..number(&accessor["count"])).map(element).collect()
}

/// The numbers of an accessor of indices.
pub(crate) fn numbers_of(document: &Value, bytes: &[u8], accessor: &Value) -> Vec<usize> {
    let number = |value: &Value| value.as_u64().expect("a number") as usize;
    let accessor = &document["accessors"][number(accessor)];
    let view = &document["bufferViews"][number(&accessor["bufferView"])];
    let size = if accessor["componentType"] == 5123 { 2 } else { 4 };
    let start = number(&view["byteOffset"]);
    assert!(start.is_multiple_of(4), "aligned: {view}");
    let own = &bytes[start..start + number(&view["byteLength"])];
    assert_eq!(own.len(), size * number(&accessor["count"]), "as long as its view: {view}");
    let elements = own.chunks_exact(size);
    elements
        .map(|bytes| bytes.iter().rev().fold(0, |n, &byte| n << 8 | usize::from(byte)))
        .collect()
}
