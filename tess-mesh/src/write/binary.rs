//! The binary part of glTF, and the JSON that describes it.
//!
//! ```text
//!   indices of part 0 | indices of part 1 | ... | vertices of part 0 | vertices of part 1 | ... | images
//! ```
//!
//! The numbers of indices are known in advance, but not those of vertices, which patches share: so
//! the indices come first. Every thread makes the bytes of a part of a block and writes them to
//! their place.

use super::Totals;
use super::share::Sharing;
use super::{Block, GltfOptions, IndexWidth, WriteAt};
use crate::load::Up;
use crate::parts::{ChannelKind, Part, Parts};
use glam::Vec3;
use rayon::prelude::*;
use serde_json::{Map, Value, json};
use std::io;

/// The largest number of vertices that 16 bits can index: 65535 itself restarts primitives.
const MAX_NARROW: u64 = 65535;

/// The number of bytes that a thread writes at a time. They stay in its cache, and allocators keep
/// blocks of this size.
const PART: usize = 1 << 16;

/// The smallest and the largest coordinates of positions.
type Bounds = (Vec3, Vec3);

const EMPTY: Bounds = (Vec3::INFINITY, Vec3::NEG_INFINITY);

/// The output of one part.
#[derive(Debug)]
struct PartBytes {
    /// The number of indices.
    indices: u64,
    /// Whether indices have 16 bits.
    narrow: bool,
    /// The offset of the first index in the binary part.
    first_index: u64,
    /// The number of indices written so far.
    written: u64,
    /// The offset of the first vertex in the binary part.
    first_vertex: u64,
    /// The number of vertices written so far.
    vertices: u64,
    bounds: Bounds,
    layout: Layout,
}

/// The values of a vertex.
#[derive(Clone, Debug)]
struct Layout {
    has_texcoords: bool,
    channels: Vec<ChannelKind>,
}

impl Layout {
    fn of(part: Option<&Part>, parts: Option<&Parts>) -> Self {
        let kinds = part.zip(parts).map(|(part, parts)| {
            part.channels.iter().map(|&channel| parts.channels[channel].kind).collect()
        });
        Self {
            has_texcoords: part.is_none_or(|part| part.has_texcoords),
            channels: kinds.unwrap_or_default(),
        }
    }

    /// The names of the attributes, and the number of components of each.
    fn attributes(&self) -> Vec<(String, usize)> {
        let texcoord = self.has_texcoords.then(|| ("TEXCOORD_0".to_owned(), 2));
        let first = [("POSITION".to_owned(), 3), ("NORMAL".to_owned(), 3)];
        let channels = self.channels.iter().map(|kind| (kind.attribute(), kind.components()));
        first.into_iter().chain(texcoord).chain(channels).collect()
    }

    /// The size of a vertex in bytes.
    fn stride(&self) -> usize {
        self.attributes().iter().map(|(_, components)| 4 * components).sum()
    }

    /// Writes the values of a vertex.
    fn write(&self, block: &Block<'_>, at: usize, bytes: &mut [u8]) {
        let vertex = &block.vertices[at];
        let [s, t] = vertex.texcoord.to_array();
        // glTF has (0, 0) at the upper left of the image.
        let texcoord = [s, 1.0 - t];
        let texcoord = if self.has_texcoords { &texcoord[..] } else { &[] };
        let floats = vertex.position.to_array().into_iter().chain(vertex.normal.to_array());
        let floats = floats.chain(texcoord.iter().copied());
        let channels = self.channels.iter().zip(block.channels);
        let channels =
            channels.flat_map(|(kind, values)| values[at].into_iter().take(kind.components()));
        for (bytes, float) in bytes.as_chunks_mut().0.iter_mut().zip(floats.chain(channels)) {
            *bytes = float.to_le_bytes();
        }
    }
}

/// The binary part while it is being written.
#[derive(Debug)]
pub(crate) struct Binary<'a, W> {
    pub(crate) file: W,
    /// The offset of the binary part in the file.
    pub(crate) start: u64,
    options: GltfOptions<'a>,
    outputs: Vec<PartBytes>,
    /// The part of the last block, and its vertices.
    part: usize,
    sharing: Sharing,
    /// The offset of each embedded image in the binary part.
    images: Vec<u64>,
    length: u64,
}

impl<'a, W: WriteAt> Binary<'a, W> {
    pub(crate) fn new(file: W, start: u64, options: GltfOptions<'a>) -> Self {
        let (outputs, images) = (Vec::new(), Vec::new());
        let sharing = Sharing::default();
        Self { file, start, options, outputs, part: 0, sharing, images, length: 0 }
    }

    /// Takes the sizes of all parts. Errors: more than a format can number.
    pub(crate) fn begin(&mut self, parts: &[Totals]) -> io::Result<()> {
        let width = self.options.indices;
        let mut end = 0;
        for (number, totals) in parts.iter().enumerate() {
            if width == IndexWidth::Bits16 && totals.vertices > MAX_NARROW {
                return Err(io::Error::other("more than 65535 vertices need indices of 32 bits"));
            }
            if totals.vertices >= u64::from(u32::MAX) {
                return Err(too_large());
            }
            let narrow = width != IndexWidth::Bits32 && totals.vertices <= MAX_NARROW;
            let part = self.options.parts.and_then(|parts| parts.list.get(number));
            self.outputs.push(PartBytes {
                indices: totals.indices,
                narrow,
                first_index: end,
                written: 0,
                first_vertex: 0,
                vertices: 0,
                bounds: EMPTY,
                layout: Layout::of(part, self.options.parts),
            });
            end += (totals.indices * if narrow { 2 } else { 4 }).next_multiple_of(4);
        }
        self.length = end;
        if let Some(first) = self.outputs.first_mut() {
            first.first_vertex = end;
        }
        Ok(())
    }

    pub(crate) fn block(&mut self, block: &Block<'_>) -> io::Result<()> {
        if self.part != block.part {
            self.part = block.part;
            self.sharing = Sharing::default();
            self.outputs[block.part].first_vertex = self.length;
        }
        let shared = self.sharing.number(block);
        let (low, high) = self.write_vertices(block, &shared.new)?;
        let numbers = &shared.numbers;
        if self.outputs[block.part].narrow {
            // So few vertices have 16-bit indices.
            self.write_indices(block, |index| {
                let [low, high, ..] = numbers[index as usize].to_le_bytes();
                [low, high]
            })?;
        } else {
            self.write_indices(block, |index| numbers[index as usize].to_le_bytes())?;
        }
        let output = &mut self.outputs[block.part];
        output.bounds = (output.bounds.0.min(low), output.bounds.1.max(high));
        output.vertices += shared.new.len() as u64;
        output.written += block.indices.len() as u64;
        self.length = output.first_vertex + output.vertices * output.layout.stride() as u64;
        Ok(())
    }

    /// Writes the vertices of a block that are new.
    fn write_vertices(&self, block: &Block<'_>, new: &[u32]) -> io::Result<Bounds> {
        let output = &self.outputs[block.part];
        let stride = output.layout.stride();
        let start = self.start + output.first_vertex + output.vertices * stride as u64;
        let per_part = PART / stride;
        let parts = new.par_chunks(per_part).enumerate();
        let written = parts.map_init(Vec::new, |bytes, (number, vertices)| {
            bytes.resize(vertices.len() * stride, 0);
            let mut bounds = EMPTY;
            for (&at, bytes) in vertices.iter().zip(bytes.chunks_exact_mut(stride)) {
                output.layout.write(block, at as usize, bytes);
                let position = block.vertices[at as usize].position;
                bounds = (bounds.0.min(position), bounds.1.max(position));
            }
            self.file.write_at(bytes, start + (number * per_part * stride) as u64)?;
            Ok(bounds)
        });
        written.try_reduce(|| EMPTY, |a, b| Ok((a.0.min(b.0), a.1.max(b.1))))
    }

    fn write_indices<const N: usize>(
        &self,
        block: &Block<'_>,
        bytes_of: impl Fn(u32) -> [u8; N] + Sync,
    ) -> io::Result<()> {
        let output = &self.outputs[block.part];
        let start = self.start + output.first_index + output.written * N as u64;
        let parts = block.indices.par_chunks(PART / N).enumerate();
        let written = parts.map_init(Vec::new, |bytes, (number, indices)| {
            bytes.resize(indices.len() * N, 0);
            for (&index, bytes) in indices.iter().zip(bytes.as_chunks_mut().0) {
                *bytes = bytes_of(index);
            }
            self.file.write_at(bytes, start + (number * PART) as u64)
        });
        written.collect()
    }

    /// Writes the images, pads the binary part to a multiple of four bytes, and returns its length.
    pub(crate) fn end(&mut self) -> io::Result<u64> {
        let images = self.options.parts.map(|parts| &parts.materials.images[..]);
        for (_, bytes) in images.unwrap_or_default() {
            let at = self.length.next_multiple_of(4);
            self.file.write_at(bytes, self.start + at)?;
            self.images.push(at);
            self.length = at + bytes.len() as u64;
        }
        let end = self.length.next_multiple_of(4);
        let zeros = &[0; 4][..usize::try_from(end - self.length).unwrap_or(0)];
        self.file.write_at(zeros, self.start + self.length)?;
        self.length = end;
        Ok(end)
    }

    /// The length in bytes that the document cannot exceed, before anything is written.
    pub(crate) fn longest_document(&self) -> usize {
        // The widest number has 24 characters; here most have one.
        let numbers = self.outputs.iter().map(|output| 12 + 4 * output.layout.attributes().len());
        let images = self.options.parts.map_or(0, |parts| parts.materials.images.len());
        self.document(None).to_string().len() + 24 * (numbers.sum::<usize>() + 4 * images + 4)
    }

    /// The document; `uri` refers to the file of the binary part, if it is a separate file.
    pub(crate) fn document(&self, uri: Option<&str>) -> Value {
        let mut buffer = json!({ "byteLength": self.length });
        if let Some(uri) = uri {
            buffer["uri"] = uri.into();
        }
        let mut lists = Lists::default();
        for (number, output) in self.outputs.iter().enumerate() {
            let primitive = lists.primitive(output);
            let part = self.options.parts.and_then(|parts| parts.list.get(number));
            lists.add(part, primitive, self.options.up);
        }
        let mut document = json!({
            "asset": { "version": "2.0", "generator": concat!("tess ", env!("CARGO_PKG_VERSION")) },
            "scene": 0,
            "scenes": [{ "nodes": (0..lists.nodes.len()).collect::<Vec<_>>() }],
            "nodes": lists.nodes,
            "meshes": lists.meshes,
            "accessors": lists.accessors,
        });
        self.add_materials(&mut document, &mut lists.views);
        document["bufferViews"] = lists.views.into();
        document["buffers"] = json!([buffer]);
        document
    }

    /// Adds the lists that describe materials, with each image's new place.
    fn add_materials(&self, document: &mut Value, views: &mut Vec<Value>) {
        let Some(materials) = self.options.parts.map(|parts| &parts.materials) else { return };
        let mut lists: Map<String, Value> = materials.document.clone();
        if lists.is_empty() && !materials.names.is_empty() {
            let named = materials.names.iter().map(|name| json!({ "name": name }));
            lists.insert("materials".to_owned(), named.collect());
        }
        if let Some(Value::Array(images)) = lists.get_mut("images") {
            for image in images.iter_mut() {
                let uri = image["uri"].as_str().filter(|uri| !uri.contains(':'));
                if let Some(uri) = uri.map(|uri| format!("{}{uri}", self.options.image_prefix)) {
                    image["uri"] = uri.into();
                }
            }
            for (k, (number, bytes)) in materials.images.iter().enumerate() {
                let at = self.images.get(k).copied().unwrap_or_default();
                views.push(json!({ "buffer": 0, "byteOffset": at, "byteLength": bytes.len() }));
                images[*number]["bufferView"] = (views.len() - 1).into();
            }
        }
        for (name, list) in lists {
            document[name] = list;
        }
    }
}

/// The lists of a document while it is being made.
#[derive(Default)]
struct Lists {
    nodes: Vec<Value>,
    meshes: Vec<Value>,
    accessors: Vec<Value>,
    views: Vec<Value>,
    /// The number in the file that was read of each node.
    numbers: std::collections::BTreeMap<usize, usize>,
}

impl Lists {
    /// Adds the accessors of a part, and returns its primitive.
    fn primitive(&mut self, output: &PartBytes) -> Value {
        let PartBytes {
            indices, narrow, first_index, first_vertex, vertices, bounds, layout, ..
        } = output;
        let stride = layout.stride();
        let width = if *narrow { 2 } else { 4 };
        self.views.push(json!({
            "buffer": 0, "byteOffset": first_index, "byteLength": indices * width, "target": 34963,
        }));
        self.views.push(json!({
            "buffer": 0, "byteOffset": first_vertex, "byteLength": vertices * stride as u64,
            "byteStride": stride, "target": 34962,
        }));
        let view = self.views.len() - 1;
        self.accessors.push(json!({
            "bufferView": view - 1, "componentType": if *narrow { 5123 } else { 5125 },
            "count": indices, "type": "SCALAR",
        }));
        let mut primitive = json!({ "attributes": {}, "indices": self.accessors.len() - 1 });
        let mut offset = 0;
        for (name, components) in layout.attributes() {
            let mut accessor = json!({
                "bufferView": view, "byteOffset": offset, "componentType": 5126,
                "count": vertices, "type": format!("VEC{components}"),
            });
            if name == "POSITION" {
                accessor["min"] = json!(bounds.0.to_array());
                accessor["max"] = json!(bounds.1.to_array());
            }
            offset += 4 * components;
            primitive["attributes"][name] = self.accessors.len().into();
            self.accessors.push(accessor);
        }
        primitive
    }

    /// Adds a primitive to the mesh of its part's node.
    fn add(&mut self, part: Option<&Part>, mut primitive: Value, up: Up) {
        if let Some(material) = part.and_then(|part| part.material) {
            primitive["material"] = material.into();
        }
        let next = self.nodes.len();
        let node = *self.numbers.entry(part.map_or(0, |part| part.node)).or_insert(next);
        if node < next {
            if let Some(primitives) = self.meshes[node]["primitives"].as_array_mut() {
                primitives.push(primitive);
            }
            return;
        }
        let mut mesh = json!({ "primitives": [primitive] });
        let mut value = json!({ "mesh": node });
        if let Some(name) = part.and_then(|part| part.group.as_ref()) {
            mesh["name"] = name.as_str().into();
        }
        if let Some(name) = part.and_then(|part| part.object.as_ref().or(part.group.as_ref())) {
            value["name"] = name.as_str().into();
        }
        if up == Up::Z {
            // In glTF y is up: a quarter turn about x moves z there.
            let half = std::f32::consts::FRAC_1_SQRT_2;
            value["rotation"] = json!([-half, 0, 0, half]);
        }
        self.meshes.push(mesh);
        self.nodes.push(value);
    }
}

fn too_large() -> io::Error {
    io::Error::other("more than 2^32 - 2 vertices, which glTF cannot number; write OBJ")
}
