//! The binary part of glTF: interleaved vertices, then indices, and the JSON that describes them.
//!
//! The numbers of vertices and indices are known in advance. So every thread makes the bytes of a
//! part of a block and writes them to their place.

use super::{IndexWidth, MeshBlock, Options, Sink, Totals, glb};
use crate::commands::mesh::input::Up;
use crate::output::OutputFile;
use glam::Vec3;
use rayon::prelude::*;
use serde_json::{Value, json};
use std::io::{self, Write};
use tess_surface::Sample;

/// Position, normal and texture coordinates: eight floats.
const STRIDE: usize = 32;

/// The largest number of vertices that 16 bits can index: 65535 itself restarts primitives.
const MAX_NARROW: u64 = 65535;

/// The number of bytes that a thread writes at a time. They stay in its cache, and allocators keep
/// blocks of this size.
const PART: usize = 1 << 16;

/// The smallest and the largest coordinates of positions.
type Bounds = (Vec3, Vec3);

const EMPTY: Bounds = (Vec3::INFINITY, Vec3::NEG_INFINITY);

/// The output while its binary part is being written.
pub(super) struct Binary {
    /// The file of the binary part.
    file: OutputFile,
    /// The offset of the binary part in the file.
    start: u64,
    /// The file of the JSON and its reference to the binary part, if the two are separate files.
    json: Option<(OutputFile, String)>,
    options: Options,
    totals: Totals,
    narrow: bool,
    bounds: Bounds,
    /// The number of indices written so far.
    indices: u64,
}

impl Binary {
    pub(super) const fn new(
        file: OutputFile,
        start: u64,
        json: Option<(OutputFile, String)>,
        options: &Options,
    ) -> Self {
        let (options, totals) = (*options, Totals { vertices: 0, indices: 0 });
        Self { file, start, json, options, totals, narrow: false, bounds: EMPTY, indices: 0 }
    }

    fn write_vertices(&self, block: &MeshBlock<'_>) -> io::Result<Bounds> {
        let start = self.start + block.first_vertex * STRIDE as u64;
        let parts = block.vertices.par_chunks(PART / STRIDE).enumerate();
        let written = parts.map_init(Vec::new, |bytes, (number, vertices)| {
            bytes.resize(vertices.len() * STRIDE, 0);
            let mut bounds = EMPTY;
            for (vertex, bytes) in vertices.iter().zip(bytes.as_chunks_mut().0) {
                *bytes = vertex_bytes(vertex);
                bounds = (bounds.0.min(vertex.position), bounds.1.max(vertex.position));
            }
            self.file.write_at(bytes, start + (number * PART) as u64)?;
            Ok(bounds)
        });
        written.try_reduce(|| EMPTY, |a, b| Ok((a.0.min(b.0), a.1.max(b.1))))
    }

    fn write_indices<const N: usize>(
        &self,
        block: &MeshBlock<'_>,
        bytes_of: impl Fn(u32) -> [u8; N] + Sync,
    ) -> io::Result<()> {
        let start = self.start + self.vertex_bytes() + self.indices * N as u64;
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

    const fn vertex_bytes(&self) -> u64 {
        self.totals.vertices * STRIDE as u64
    }

    const fn index_bytes(&self) -> u64 {
        self.totals.indices * if self.narrow { 2 } else { 4 }
    }

    /// The length of the binary part in bytes.
    fn length(&self) -> u64 {
        (self.vertex_bytes() + self.index_bytes()).next_multiple_of(4)
    }

    /// The document; `uri` refers to the file of the binary part, if it is a separate file.
    fn document(&self, uri: Option<&str>) -> Value {
        let vertex_bytes = self.vertex_bytes();
        let mut buffer = json!({ "byteLength": self.length() });
        if let Some(uri) = uri {
            buffer["uri"] = uri.into();
        }
        // In glTF y is up: a quarter turn about x moves z there.
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let node = match self.options.up {
            Up::Y => json!({ "mesh": 0 }),
            Up::Z => json!({ "mesh": 0, "rotation": [-half, 0, 0, half] }),
        };
        let attribute = |offset: u64, kind: &str| {
            json!({
                "bufferView": 0, "byteOffset": offset, "componentType": 5126,
                "count": self.totals.vertices, "type": kind,
            })
        };
        let mut position = attribute(0, "VEC3");
        position["min"] = json!(self.bounds.0.to_array());
        position["max"] = json!(self.bounds.1.to_array());
        let indices = json!({
            "bufferView": 1, "componentType": if self.narrow { 5123 } else { 5125 },
            "count": self.totals.indices, "type": "SCALAR",
        });
        json!({
            "asset": { "version": "2.0", "generator": concat!("tess ", env!("CARGO_PKG_VERSION")) },
            "scene": 0,
            "scenes": [{ "nodes": [0] }],
            "nodes": [node],
            "meshes": [{ "primitives": [{
                "attributes": { "POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2 }, "indices": 3,
            }] }],
            "accessors": [position, attribute(12, "VEC3"), attribute(24, "VEC2"), indices],
            "bufferViews": [
                { "buffer": 0, "byteOffset": 0, "byteLength": vertex_bytes, "byteStride": STRIDE,
                  "target": 34962 },
                { "buffer": 0, "byteOffset": vertex_bytes, "byteLength": self.index_bytes(),
                  "target": 34963 },
            ],
            "buffers": [buffer],
        })
    }
}

impl Sink for Binary {
    fn begin(&mut self, totals: Totals) -> io::Result<()> {
        let width = self.options.indices;
        if width == IndexWidth::Bits16 && totals.vertices > MAX_NARROW {
            return Err(io::Error::other("more than 65535 vertices need --indices 32 (or auto)"));
        }
        if totals.vertices >= u64::from(u32::MAX) {
            return Err(too_large());
        }
        self.totals = totals;
        self.narrow = width != IndexWidth::Bits32 && totals.vertices <= MAX_NARROW;
        Ok(())
    }

    fn block(&mut self, block: &MeshBlock<'_>) -> io::Result<()> {
        let (low, high) = self.write_vertices(block)?;
        self.bounds = (self.bounds.0.min(low), self.bounds.1.max(high));
        let first = u32::try_from(block.first_vertex).map_err(|_| too_large())?;
        if self.narrow {
            // So few vertices have 16-bit indices.
            self.write_indices(block, |index| {
                let [low, high, ..] = (first + index).to_le_bytes();
                [low, high]
            })?;
        } else {
            self.write_indices(block, |index| (first + index).to_le_bytes())?;
        }
        self.indices += block.indices.len() as u64;
        Ok(())
    }

    /// Pads the binary part to a multiple of four bytes, and writes the JSON.
    fn finish(mut self: Box<Self>) -> io::Result<()> {
        let padding = self.length() - self.vertex_bytes() - self.index_bytes();
        let end = self.start + self.length();
        let zeros = &[0; 4][..usize::try_from(padding).unwrap_or(0)];
        self.file.write_at(zeros, end - padding)?;
        let Some((mut json, uri)) = self.json.take() else {
            self.file.write_at(&glb::beginning(&self.document(None), self.length())?, 0)?;
            return self.file.finish();
        };
        json.write_all(crate::output::json(&self.document(Some(&uri))).as_bytes())?;
        self.file.finish()?;
        json.finish()
    }
}

fn vertex_bytes(vertex: &Sample) -> [u8; STRIDE] {
    let [s, t] = vertex.texcoord.to_array();
    let ([x, y, z], [nx, ny, nz]) = (vertex.position.to_array(), vertex.normal.to_array());
    // glTF has (0, 0) at the upper left of the image.
    let floats = [x, y, z, nx, ny, nz, s, 1.0 - t];
    let mut bytes = [0; STRIDE];
    for (bytes, float) in bytes.as_chunks_mut().0.iter_mut().zip(floats) {
        *bytes = float.to_le_bytes();
    }
    bytes
}

fn too_large() -> io::Error {
    io::Error::other("more than 2^32 - 2 vertices, which glTF cannot number; write OBJ")
}
