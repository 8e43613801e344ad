//! The binary part of glTF: interleaved vertices, then indices, and the JSON that describes them.
//!
//! How many vertices there will be is not known beforehand. So they go straight to the output and
//! the indices to a second file, whose content is appended at the end, narrowed if it can be.

use super::{IndexWidth, Options};
use crate::commands::mesh::input::Up;
use crate::commands::mesh::pipeline::Block;
use glam::Vec3;
use serde_json::{Value, json};
use std::fs::File;
use std::io::{self, BufReader, BufWriter, Read, Seek, Write};

/// Position, normal and texture coordinates: eight floats.
const STRIDE: u64 = 32;

/// The largest number of vertices that 16 bits can number: 65535 itself restarts primitives.
const MAX_NARROW: u64 = 65535;

/// Collects the binary part into `vertices`, which becomes the output.
pub(super) struct Binary<W: Write> {
    pub(super) vertices: BufWriter<W>,
    indices: BufWriter<File>,
    vertex_count: u64,
    index_count: u64,
    bounds: (Vec3, Vec3),
    width: IndexWidth,
    up: Up,
}

/// What the JSON says of the binary part.
pub(super) struct Layout {
    vertex_count: u64,
    index_count: u64,
    narrow: bool,
    bounds: (Vec3, Vec3),
    up: Up,
}

impl<W: Write> Binary<W> {
    pub(super) fn new(vertices: W, options: &Options) -> io::Result<Self> {
        Ok(Self {
            vertices: BufWriter::with_capacity(1 << 20, vertices),
            indices: BufWriter::with_capacity(1 << 20, tempfile::tempfile()?),
            vertex_count: 0,
            index_count: 0,
            bounds: (Vec3::INFINITY, Vec3::NEG_INFINITY),
            width: options.indices,
            up: options.up,
        })
    }

    pub(super) fn block(&mut self, block: &Block<'_>) -> io::Result<()> {
        for vertex in block.vertices {
            let [s, t] = vertex.texcoord.to_array();
            let ([x, y, z], [nx, ny, nz]) = (vertex.position.to_array(), vertex.normal.to_array());
            // glTF has (0, 0) at the upper left of the image.
            let floats = [x, y, z, nx, ny, nz, s, 1.0 - t];
            self.vertices.write_all(floats.map(f32::to_le_bytes).as_flattened())?;
            self.bounds = (self.bounds.0.min(vertex.position), self.bounds.1.max(vertex.position));
        }
        self.vertex_count += block.vertices.len() as u64;
        self.index_count += block.indices.len() as u64;
        self.check()?;
        for &index in block.indices {
            let index = block.first_vertex + u64::from(index);
            let index = u32::try_from(index).map_err(|_| too_large())?;
            self.indices.write_all(&index.to_le_bytes())?;
        }
        Ok(())
    }

    fn check(&self) -> io::Result<()> {
        match self.width {
            IndexWidth::Bits16 if self.vertex_count > MAX_NARROW => {
                Err(io::Error::other("more than 65535 vertices need --indices 32 (or auto)"))
            }
            _ if self.vertex_count >= u64::from(u32::MAX) => Err(too_large()),
            _ => Ok(()),
        }
    }

    /// How large the binary part is or will be.
    pub(super) fn layout(&self) -> Layout {
        let narrow = self.width != IndexWidth::Bits32 && self.vertex_count <= MAX_NARROW;
        Layout {
            vertex_count: self.vertex_count,
            index_count: self.index_count,
            narrow,
            bounds: self.bounds,
            up: self.up,
        }
    }

    /// Appends the indices; the binary part is whole then, a multiple of four bytes.
    pub(super) fn finish(self, layout: &Layout) -> io::Result<W> {
        let mut vertices = self.vertices;
        let mut indices = self.indices.into_inner().map_err(io::IntoInnerError::into_error)?;
        indices.rewind()?;
        let mut indices = BufReader::with_capacity(1 << 20, indices);
        if layout.narrow {
            for _ in 0..layout.index_count {
                let mut bytes = [0; 4];
                indices.read_exact(&mut bytes)?;
                vertices.write_all(&bytes[..2])?; // little endian: the low half
            }
            let padding: &[u8] = if layout.index_count.is_multiple_of(2) { &[] } else { &[0; 2] };
            vertices.write_all(padding)?;
        } else {
            io::copy(&mut indices, &mut vertices)?;
        }
        vertices.into_inner().map_err(io::IntoInnerError::into_error)
    }
}

fn too_large() -> io::Error {
    io::Error::other("more than 2^32 - 2 vertices, which glTF cannot number; write OBJ")
}

impl Layout {
    fn index_bytes(&self) -> u64 {
        self.index_count * if self.narrow { 2 } else { 4 }
    }

    /// Length of the binary part in bytes.
    pub(super) fn length(&self) -> u64 {
        (self.vertex_count * STRIDE + self.index_bytes()).next_multiple_of(4)
    }

    /// The document; `uri` names the file of the binary part, if it is a file of its own.
    pub(super) fn document(&self, uri: Option<&str>) -> Value {
        let vertex_bytes = self.vertex_count * STRIDE;
        let mut buffer = json!({ "byteLength": self.length() });
        if let Some(uri) = uri {
            buffer["uri"] = uri.into();
        }
        // glTF is y up: a quarter turn about x lays z there.
        let half = std::f32::consts::FRAC_1_SQRT_2;
        let node = match self.up {
            Up::Y => json!({ "mesh": 0 }),
            Up::Z => json!({ "mesh": 0, "rotation": [-half, 0, 0, half] }),
        };
        let attribute = |offset: u64, kind: &str| {
            json!({
                "bufferView": 0, "byteOffset": offset, "componentType": 5126,
                "count": self.vertex_count, "type": kind,
            })
        };
        let mut position = attribute(0, "VEC3");
        position["min"] = json!(self.bounds.0.to_array());
        position["max"] = json!(self.bounds.1.to_array());
        let indices = json!({
            "bufferView": 1, "componentType": if self.narrow { 5123 } else { 5125 },
            "count": self.index_count, "type": "SCALAR",
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
